#pragma once

#include <filesystem>
#include <functional>

#include "meshes/mesh_options.hpp"
#include "samara/core/body/body.hpp"

namespace samara {

/// Makes a body of a shape file (shape_format): its surface read, welded, its parts joined where they touch,
/// checked and meshed as the options say, its volume moments and its symmetry. Name and source are
/// filled, Kirchhoff tensor and tables are not: those of a .body.h5 belong to another surface. Throws Error,
/// one line that names the file, the place and the remedy. `progress`: called with the share of the work
/// done, 0 to 1.
Body make_body(const std::filesystem::path& shape, const MeshOptions& options = {},
               const std::function<void(double)>& progress = {});

}  // namespace samara
