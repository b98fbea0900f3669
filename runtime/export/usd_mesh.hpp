#pragma once

#include <string>
#include <vector>

#include "samara/core/surface/display_mesh.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// A number as USD's text has it: the shortest that reads back as the same float.
std::string usd_float(double value);

/// (x, y, z) of floats.
std::string usd_float3(const Vector3d& vector);

/// The Mesh prim "mesh" of a surface, its lines indented by `indent` spaces: welded points, triangles,
/// normals (at the points of a smooth surface, at the triangles' corners where there are creases), no
/// subdivision. `grey`: its colour, from 0 to 1; `double_sided`: seen from behind, too.
std::string usd_mesh(const Surface& surface, std::size_t indent, double grey = 0.8,
                     bool double_sided = false);

/// The Mesh prim "mesh" of a look with its texture coordinates (primvars:st), a subset of faces for each of
/// its materials in use, and these beside it. `image_files`: where its images are, from the stage's folder.
std::string usd_display(const DisplayMesh& display, const std::vector<std::string>& image_files,
                        std::size_t indent);

}  // namespace samara
