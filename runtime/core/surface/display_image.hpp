#pragma once

#include <cstddef>
#include <string_view>
#include <utility>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/surface/display_mesh.hpp"

namespace samara {

/// No image of a look may be larger (bytes).
inline constexpr std::size_t most_image_bytes = 64U << 20U;

/// Nor all of them together, which may be parts of the same bytes.
inline constexpr std::size_t most_image_bytes_together = 256U << 20U;
inline constexpr const char* too_many_images = "has images of more than 256 MB together";

/// "png" or "jpg", by the first bytes of an image file that looks take; else nullptr.
inline const char* image_type(std::string_view bytes) {
    if (bytes.size() > most_image_bytes) return nullptr;
    if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return "png";
    return bytes.starts_with("\xff\xd8\xff") ? "jpg" : nullptr;
}

/// Adds an image to a look; false where it then had too many.
inline bool add_image(DisplayMesh& display, DisplayImage image) {
    std::size_t together = image.bytes.size();
    for (const DisplayImage& other : display.images) together += other.bytes.size();
    if (together > most_image_bytes_together) return false;
    display.images.push_back(std::move(image));
    return true;
}

/// The direction of a normal as a file gives it, of length one: of any length but zero, also where its square
/// under- or overflows. What has no direction (zero, infinite) gets z.
inline Vector3d unit_normal(const Vector3d& given) {
    const double largest = given.cwiseAbs().maxCoeff();
    if (!(largest > 0.0) || !given.allFinite()) return Vector3d::UnitZ();
    return (given / largest).normalized();
}

}  // namespace samara
