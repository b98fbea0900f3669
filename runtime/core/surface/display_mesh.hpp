#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// An image that a mesh is painted with.
struct DisplayImage {
    std::string name;
    std::string bytes;  ///< of the PNG or JPEG file, as its source has it (core/surface/display_image.hpp)
};

/// What is seen through a material.
enum class DisplayTransparency : std::int32_t {
    none,
    cut_out,  ///< nothing is there where the image's opacity is below a half
    blended,  ///< what is behind it, by color's opacity and the image's
};

/// A material slot of a mesh.
struct DisplayMaterial {
    std::string name;
    std::array<double, 4> color = {0.8, 0.8, 0.8, 1.0};  ///< red, green, blue and opacity, 0 to 1, linear
    std::int32_t image = -1;  ///< number of the one that color multiplies; -1: none
    DisplayTransparency transparency = DisplayTransparency::none;
};

/// A mesh that exports show in place of a body's surface: with what a picture needs of it, and as its file
/// has it, holes and all.
struct DisplayMesh {
    std::vector<Vector3d> positions;       ///< m, shape axes
    std::vector<Vector3d> normals;         ///< of length one, one for each position; or none
    std::vector<Eigen::Vector2d> texture;  ///< u to the right and v upwards, one for each position; or none
    std::vector<std::array<std::int32_t, 3>> corners;  ///< triangles, counter-clockwise from outside
    std::vector<std::int32_t> slots;                   ///< of each triangle the number of its material
    std::vector<DisplayMaterial> materials;            ///< one at least
    std::vector<DisplayImage> images;                  ///< that materials show
};

}  // namespace samara
