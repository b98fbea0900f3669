#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "converter/convert.hpp"
#include "foam-cases/bake/bake_plan.hpp"
#include "foam-cases/farm/case_farm.hpp"
#include "foam-cases/farm/case_records.hpp"
#include "foam-cases/scene/scene_plan.hpp"
#include "samara/core/body/body.hpp"
#include "samara/formats/left_out_cases.hpp"
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

/// The body of a shape file, meshed by the program samara-mesh with its defaults, or of a body file, read as
/// it is. `scale`: metres for one unit of the shape file; a body file takes none but 1. `folder` receives
/// what is made on the way (shape.body.h5, log.mesh). Throws Error.
Body prepare_body(const std::filesystem::path& shape, double scale, const std::filesystem::path& folder);

/// Gives the body its Kirchhoff tensor where it has none: the one of the body file `earlier` where there is
/// such a file of the same surface, else by the command `samara kirchhoff`, for which `folder` receives what
/// is made on the way. Throws Error, which names `shape`, the file that the body was made of.
void add_kirchhoff_tensor(Body& body, const std::filesystem::path& shape,
                          const std::filesystem::path& earlier, const std::filesystem::path& folder);

/// What a bake of a scene is asked for.
struct SceneBakeOptions {
    BakeQuality quality;
    Inflow inflow;
    bool whole_grid = false;  ///< all directions, not those that the scene visits
    double tolerance = 0.1;
    std::optional<double> budget;
    int most_rounds = 8;
};

/// One request for each body of a scene, NAME.body.h5 in the folder. A body that asks for neither table loads
/// nor turbulence from tables gets a mesh and a Kirchhoff tensor alone.
std::vector<BakeRequest> requests_for_scene(const Scene& scene, const std::filesystem::path& folder,
                                            const SceneBakeOptions& options);

}  // namespace samara
