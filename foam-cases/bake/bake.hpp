#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "converter/convert.hpp"
#include "foam-cases/bake/bake_plan.hpp"
#include "foam-cases/farm/case_farm.hpp"
#include "foam-cases/farm/cpu_account.hpp"
#include "foam-cases/scene/scene_plan.hpp"
#include "samara/analysis/verdicts/case_records.hpp"
#include "samara/scene/scene.hpp"

namespace samara {

/// One body to bake and the conditions it is baked for.
struct BakeRequest {
    std::string name;             ///< of the body; empty: that of the shape
    std::filesystem::path shape;  ///< a shape file or a body file
    double scale = 1.0;           ///< metres for one unit of the shape file
    std::filesystem::path output;
    Fluid fluid;
    MassSpecification mass;  ///< its density or its mass is given
    /// Above 0: the falls are solved at the density and at this one (kg/m^3) in turn, the tables for the
    /// faster.
    double other_density = 0.0;
    double gravity = 9.81;  ///< m/s^2
    BakeQuality quality;
    bool tables = true;  ///< false: mesh and Kirchhoff tensor alone
    Inflow inflow;
    int ranks = 1;                       ///< processes that share each case, by MPI
    std::optional<SceneGoal> goal = {};  ///< bakes what the scene needs, in rounds; else all directions
    int probes = 0;  ///< above 0: so many cases between the tables' nodes, written as CSV, in place of tables
};

/// What is known before anything is solved.
struct BakePreparation {
    double terminal_speed = 0.0;          ///< m/s, an estimate (bake_speed())
    std::optional<BakePlan> plan;         ///< for a goal that of the first round
    std::optional<ScenePlan> scene_plan;  ///< for a goal
    SampledFalls simulation;              ///< for a goal, before anything is baked
    Body body;                            ///< meshed, with its Kirchhoff tensor
};

struct BakeResult {
    BakePreparation preparation;
    std::optional<Conversion> conversion;
    std::size_t probes = 0;  ///< rows of the table of cases, where probes were asked for
    std::size_t reused = 0;  ///< cases that an earlier bake had solved
    std::vector<LeftOutCase> left_out;
    double cpu_seconds = 0.0;   ///< of all meshes, cases and falls
    CpuAccount account;         ///< these, and what else the bake did
    double mesh_seconds = 0.0;  ///< wall clock, as the next three
    double kirchhoff_seconds = 0.0;
    double case_seconds = 0.0;  ///< of the cases, their mesh included
    double conversion_seconds = 0.0;
};

/// The folder of cases of an output file: NAME.cases beside NAME.body.h5, or beside NAME.csv.
std::filesystem::path case_folder_of(const std::filesystem::path& output);

/// Meshes the body in a temporary folder, computes its Kirchhoff tensor unless an earlier bake did, and plans
/// its cases and, as the quality asks, its falls; writes nothing else. Throws Error.
BakePreparation prepare_bake(const BakeRequest& request);

/// Meshes the body, computes its Kirchhoff tensor, solves its cases in case_folder_of(output), and
/// writes the body file with its tables. For a goal it goes on round by round (scene_plan.hpp). What an
/// earlier call solved on the same inputs is reused.
/// `planned` is told of the plan before anything long begins. Throws Error.
BakeResult bake_body(const BakeRequest& request, const FarmOptions& farm,
                     const std::function<void(const BakePreparation&)>& planned);

}  // namespace samara
