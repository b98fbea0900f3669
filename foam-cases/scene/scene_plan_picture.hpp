#pragma once

#include <filesystem>
#include <string>

#include "foam-cases/scene/scene_plan.hpp"

namespace samara {

/// Draws where a body moves as it sees the flow: two halves of the sphere of directions, seen along the third
/// map axis from either side, the visits as dots and the planned cases, with their images under the symmetry,
/// as rings. PNG or SVG. Throws Error as draw_picture does.
void draw_plan(const std::filesystem::path& file, const std::string& name,
               const std::vector<FlowVisit>& visits, const Symmetry& symmetry, const ScenePlan& plan);

}  // namespace samara
