#pragma once

#include <optional>
#include <string>
#include <vector>

#include "converter/convert.hpp"
#include "foam-cases/bake/bake_plan.hpp"
#include "foam-cases/bake/direction_choice.hpp"
#include "foam-cases/falls/motion_error.hpp"
#include "samara/core/body/planned_region.hpp"

namespace samara {

/// The goal of a bake for one body of a scene.
struct SceneGoal {
    Scene scene;
    std::size_t body = 0;  ///< index in the scene
    double tolerance =
        0.1;  ///< relative, of the descent speed; that of other metrics is in proportion by the catalogue
    std::optional<double> budget;  ///< estimated CPU seconds; none: no limit
    int most_rounds = 8;
    bool whole_grid = false;  ///< solves every candidate in the first round
    int falls = 16;           ///< in each ensemble
    int draws = 12;           ///< number of random tables, for their error
};

/// The state after a round of cases.
struct PlanRound {
    std::size_t directions = 0;          ///< solved so far
    std::size_t cases = 0;               ///< number so far, of all meshes and Reynolds numbers
    double estimated_cpu_seconds = 0.0;  ///< of these cases and the meshes
    double cpu_seconds = 0.0;            ///< used by them
    SampledFalls simulation;             ///< falls with the tables of this round, without visits
    MotionError error;
    double strayed = 0.0;  ///< share of the frames outside the planned region
};

/// The plan for a body of a scene, extended in rounds. The choices depend only on the scene, the body and the
/// solved loads, not on the order in which cases finish.
struct ScenePlan {
    Candidates candidates;
    std::vector<std::size_t> chosen;  ///< indices of candidates, in the order in which they were added
    PlannedRegion region;             ///< the directions that occurred in the planning simulations
    BakePlan cases;
    std::vector<PlanRound> rounds;
    std::string stopped_because;      ///< empty while rounds follow
    bool reynolds_collapsed = false;  ///< the check at another Reynolds number found the same coefficients
};

/// Plans the first cases: at the Reynolds number of the visits' mean load, in the directions that every table
/// needs and the few that lower the uncertainty at the visits most, with one more case at a far Reynolds
/// number where the visits spread over a factor of more than two. `simulation`: falls of the body without
/// tables. Throws Error where the body does not move in it.
ScenePlan first_plan(const SceneGoal& goal, const Body& body, const BakeQuality& quality,
                     const Inflow& inflow, const SampledFalls& simulation);

/// Judges a round: simulates the baked body, estimates the uncertainty by its tables, which is at least the
/// change of the motion since the round before, and either sets the reason to stop or adds the directions
/// (and Reynolds numbers) that would lower the uncertainty most. A first round is not the last unless it
/// solves all directions.
void judge_round(const SceneGoal& goal, const Conversion& conversion, double cpu_seconds, ScenePlan& plan);

/// The cost of the whole grid of the plan's candidates, with all nodes solved at the plan's main Reynolds
/// number.
struct GridCost {
    std::size_t directions = 0;
    std::size_t cases = 0;
    double cpu_seconds = 0.0;
};

/// Returns the cost of the whole grid, with or without the body's symmetry.
GridCost whole_grid(const ScenePlan& plan, bool with_symmetry);

}  // namespace samara
