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

/// What a bake for one body of a scene aims at.
struct SceneGoal {
    Scene scene;
    std::size_t body = 0;    ///< of the scene
    double tolerance = 0.1;  ///< relative, of the descent speed; the others' in the catalogue's proportions
    std::optional<double> budget;  ///< CPU seconds, estimated; none: as many as the tolerance takes
    int most_rounds = 8;
    bool whole_grid = false;  ///< every candidate at once
    int falls = 16;           ///< in each ensemble
    int draws = 12;           ///< of the tables, for their error
};

/// What is known after a round of cases was solved.
struct PlanRound {
    std::size_t directions = 0;          ///< solved so far
    std::size_t cases = 0;               ///< so far, of all meshes and Reynolds numbers
    double estimated_cpu_seconds = 0.0;  ///< of these and the meshes
    double cpu_seconds = 0.0;            ///< that they took
    SampledFalls simulation;             ///< with the tables of this round; its visits are dropped
    MotionError error;
    double strayed = 0.0;  ///< share of the frames outside of the planned region
};

/// The plan for a body of a scene as it grows, round by round. What is chosen depends on the scene, the body
/// and the solved loads alone: not on the order in which cases finish.
struct ScenePlan {
    Candidates candidates;
    std::vector<std::size_t> chosen;  ///< of the candidates, in the order in which they were added
    PlannedRegion region;             ///< the directions that the planning flights visited
    BakePlan cases;
    std::vector<PlanRound> rounds;
    std::string stopped_because;      ///< empty while it goes on
    bool reynolds_collapsed = false;  ///< the check at another Reynolds number found the same coefficients
};

/// The first list of cases: at the Reynolds number at which the visits have their mean load, in the
/// directions that every table needs and the few that leave least uncertain where the visits are, with one
/// more case at a Reynolds number far from it where they spread over a factor of more than two. `flight`: of
/// the body without tables. Throws Error where it does not move in it.
ScenePlan first_plan(const SceneGoal& goal, const Body& body, const BakeQuality& quality,
                     const Inflow& inflow, const SampledFalls& simulation);

/// Judges a round: flies the baked body, works out what its tables leave uncertain, and either says why to
/// stop or adds the directions (and Reynolds numbers) that would lower the uncertainty most.
void judge_round(const SceneGoal& goal, const Conversion& conversion, double cpu_seconds, ScenePlan& plan);

/// Directions, cases and estimated CPU seconds of the whole grid that the plan's candidates are from, all of
/// its nodes solved at the plan's main Reynolds number, with the body's symmetry or without.
struct GridCost {
    std::size_t directions = 0;
    std::size_t cases = 0;
    double cpu_seconds = 0.0;
};
GridCost whole_grid(const ScenePlan& plan, bool with_symmetry);

}  // namespace samara
