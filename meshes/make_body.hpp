#pragma once

#include <filesystem>
#include <functional>

#include "meshes/remeshing/remesh.hpp"
#include "samara/core/body/body.hpp"

namespace samara {

/// Makes a body from a shape file (shape_format): reads and welds its surface, joins parts that touch, checks
/// it, meshes it as the options say, and computes volume moments and symmetry. Name and source are filled;
/// Kirchhoff tensor and tables are not, since those of a .body.h5 belong to another surface. Throws Error,
/// one line that names the file, the place and the remedy. `progress`: called with the share of the work
/// done, 0 to 1.
Body make_body(const std::filesystem::path& shape, const MeshOptions& options = {},
               const std::function<void(double)>& progress = {});

}  // namespace samara
