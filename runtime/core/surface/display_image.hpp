#pragma once

#include <cstddef>
#include <string_view>
#include <utility>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/surface/display_mesh.hpp"

namespace samara {

/// The largest image of a display mesh (bytes).
inline constexpr std::size_t most_image_bytes = 64U << 20U;

/// The most bytes of all images of a display mesh together, which may be parts of the same bytes.
inline constexpr std::size_t most_image_bytes_together = 256U << 20U;
inline constexpr const char* too_many_images = "has images of more than 256 MB in total";

/// Returns "png" or "jpg" by the first bytes of an image file; nullptr where it is neither or too large.
inline const char* image_type(std::string_view bytes) {
    if (bytes.size() > most_image_bytes) return nullptr;
    if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return "png";
    return bytes.starts_with("\xff\xd8\xff") ? "jpg" : nullptr;
}

/// Adds an image to a display mesh; false, without effect, where its images would be too large together.
inline bool add_image(DisplayMesh& display, DisplayImage image) {
    std::size_t together = image.bytes.size();
    for (const DisplayImage& other : display.images) together += other.bytes.size();
    if (together > most_image_bytes_together) return false;
    display.images.push_back(std::move(image));
    return true;
}

/// Returns the direction of a normal as a file gives it, of length one, also where the square of its length
/// under- or overflows. A normal without direction (zero, infinite) becomes z.
inline Vector3d unit_normal(const Vector3d& given) {
    const double largest = given.cwiseAbs().maxCoeff();
    if (!(largest > 0.0) || !given.allFinite()) return Vector3d::UnitZ();
    return (given / largest).normalized();
}

}  // namespace samara
