#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "foam-cases/scene/scene_plan.hpp"

namespace samara {

/// Returns the cost of a grid as JSON: directions, cases and rounded CPU seconds.
nlohmann::json cost_as_json(const GridCost& cost);

/// Returns the progress of a bake for a scene as JSON (docs/explanation/what-a-scene-needs.md): goal, rounds
/// with their metrics and the uncertainty by the tables, the reason to stop, and the cost of the whole grid.
/// It does not depend on where and how fast the cases were solved.
nlohmann::json scene_plan_as_json(const SceneGoal& goal, const ScenePlan& plan);

/// Returns the last round as a line of text.
std::string round_as_line(const SceneGoal& goal, const ScenePlan& plan);

/// Returns the rounds as a text table.
std::string scene_plan_as_text(const SceneGoal& goal, const ScenePlan& plan);

/// A candidate direction and the visits that are nearest to it.
struct VisitedDirection {
    Vector3d direction;       ///< map axes
    double share = 0.0;       ///< of the time
    double load_share = 0.0;  ///< of the squared loads
    double lowest_reynolds_number = 0.0;
    double highest_reynolds_number = 0.0;
    int images = 1;       ///< number of equivalent directions by the symmetry
    bool solved = false;  ///< whether the plan solves it
};

/// Assigns the visits to the nearest candidate directions of the plan and returns these, most visited first.
std::vector<VisitedDirection> visited_directions(const std::vector<FlowVisit>& visits,
                                                 const Symmetry& symmetry, const ScenePlan& plan);

/// Returns the picture of a plan for draw_picture(): the visited directions, and the planned cases with their
/// images under the symmetry, as unit vectors in map axes.
nlohmann::json plan_picture(const std::string& name, const std::vector<FlowVisit>& visits,
                            const Symmetry& symmetry, const ScenePlan& plan);

}  // namespace samara
