#pragma once

#include <filesystem>

#include "foam-cases/bake/bake_plan.hpp"

namespace samara {

/// Bytes on the disk that what is planned comes to and is not there yet: meshes without mesh.json, cases and
/// falls without provenance.json in the folder. An estimate, within a factor of two.
double bytes_to_solve(const std::filesystem::path& folder, const BakePlan& plan);

/// Throws Error where the folder's disk has less than half of `bytes` free, before hours are spent on what
/// cannot be written.
void require_room(const std::filesystem::path& folder, double bytes);

}  // namespace samara
