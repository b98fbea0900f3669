#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "foam-cases/scene/scene_plan.hpp"

namespace samara {

/// Directions, cases and CPU seconds, rounded, of a grid.
nlohmann::json cost_as_json(const GridCost& cost);

/// What a bake for a scene aims at and has reached (docs/plan.md): goal, rounds with their measures and what
/// the tables leave uncertain in them, why it stopped, and what the whole grid would cost. The same wherever
/// and however fast it was solved.
nlohmann::json scene_plan_as_json(const SceneGoal& goal, const ScenePlan& plan);

/// The last round in one line, for progress.
std::string round_as_line(const SceneGoal& goal, const ScenePlan& plan);

/// The rounds as a table, for people.
std::string scene_plan_as_text(const SceneGoal& goal, const ScenePlan& plan);

/// Where the visits of a flight are: for each of the candidate directions the share of the time nearest to
/// it, the range of Reynolds numbers there, how many directions the symmetry makes of it, and whether the
/// plan solves it; most visited first.
struct VisitedDirection {
    Vector3d direction;       ///< map axes
    double share = 0.0;       ///< of the frames
    double load_share = 0.0;  ///< of the squared loads
    double lowest_reynolds_number = 0.0;
    double highest_reynolds_number = 0.0;
    int images = 1;
    bool solved = false;
};
std::vector<VisitedDirection> visited_directions(const std::vector<FlowVisit>& visits,
                                                 const Symmetry& symmetry, const ScenePlan& plan);

/// What the picture of a plan shows, as draw_picture() takes it: where a body moves as it meets the flow, and
/// the planned cases with their images under the symmetry, as unit vectors in the map axes.
nlohmann::json plan_picture(const std::string& name, const std::vector<FlowVisit>& visits,
                            const Symmetry& symmetry, const ScenePlan& plan);

}  // namespace samara
