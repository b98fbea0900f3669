#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// An image of a material.
struct DisplayImage {
    std::string name;   ///< as its source has it
    std::string bytes;  ///< of the PNG or JPEG file, as its source has it (core/surface/display_image.hpp)
};

/// The transparency of a material.
enum class DisplayTransparency : std::int32_t {
    none,
    cut_out,  ///< invisible where the image's opacity is below a half
    blended,  ///< blended with what is behind it, by the opacity of color and image
};

/// A material slot of a mesh.
struct DisplayMaterial {
    std::string name;                                    ///< as its source has it
    std::array<double, 4> color = {0.8, 0.8, 0.8, 1.0};  ///< red, green, blue and opacity, 0 to 1, linear
    std::int32_t image = -1;  ///< number of the image that color multiplies; -1: none
    DisplayTransparency transparency = DisplayTransparency::none;  ///< what its opacity does
};

/// A mesh that exports show in place of a body's surface, with normals, texture and materials, as its file
/// has it, holes included.
struct DisplayMesh {
    std::vector<Vector3d> positions;       ///< m, shape axes
    std::vector<Vector3d> normals;         ///< of length one, one for each position; or none
    std::vector<Eigen::Vector2d> texture;  ///< u to the right and v upwards, one for each position; or none
    std::vector<std::array<std::int32_t, 3>> corners;  ///< triangles, counter-clockwise from outside
    std::vector<std::int32_t> slots;                   ///< the number of each triangle's material
    std::vector<DisplayMaterial> materials;            ///< one at least
    std::vector<DisplayImage> images;                  ///< of the materials
};

}  // namespace samara
