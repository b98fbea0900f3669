#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "converter/convert.hpp"
#include "foam-cases/bake/bake_plan.hpp"
#include "foam-cases/bake/bake_schedule.hpp"
#include "foam-cases/farm/case_farm.hpp"
#include "foam-cases/farm/case_records.hpp"
#include "foam-cases/scene/scene_plan.hpp"
#include "samara/analysis/verdicts/case_records.hpp"
#include "samara/commands/shared/load_body.hpp"
#include "samara/core/body/body.hpp"
#include "samara/scene/scene.hpp"

namespace samara {

/// One body to bake and the conditions it is baked for.
struct BakeRequest {
    std::string name;             ///< of the body; empty: the name of the shape
    std::filesystem::path shape;  ///< a shape file or a body file
    ShapeReading reading;         ///< of a shape file
    std::filesystem::path output;
    Fluid fluid;
    MassSpecification mass;  ///< with a density or a mass
    /// Where above 0, a second density (kg/m^3): the falls alternate between the two, and the tables are for
    /// the faster body.
    double other_density = 0.0;
    double gravity = 9.81;  ///< m/s^2
    /// The tables' main Reynolds number. The falls are then in a fluid of the same density in which the
    /// body's terminal speed has it. None: that of the terminal speed in `fluid`.
    std::optional<double> reynolds_number = {};
    BakeQuality quality;
    bool tables = true;  ///< false: only mesh and Kirchhoff tensor
    Inflow inflow;
    int ranks = 1;                       ///< MPI processes for each case
    std::optional<SceneGoal> goal = {};  ///< bakes what a scene needs, in rounds; else all directions
    int probes =
        0;  ///< above 0: the number of cases between the tables' nodes, written as CSV in place of tables
    /// With tables: k and epsilon alone are solved, around the Reynolds number of these tables, and replaced
    /// in them; all else of this body stays.
    std::optional<Body> baked = {};
};

/// The plan of a bake, before anything is solved.
struct BakePreparation {
    double terminal_speed = 0.0;          ///< m/s, an estimate (bake_speed()); 0 for k and epsilon alone
    std::optional<BakePlan> plan;         ///< with a goal the plan of the first round
    FarmWork work;                        ///< of the plan
    std::optional<ScenePlan> scene_plan;  ///< with a goal
    SampledFalls simulation;              ///< with a goal: falls before anything is baked
    Body body;                            ///< meshed, with its Kirchhoff tensor
};

/// The result of a bake.
struct BakeResult {
    BakePreparation preparation;
    std::optional<Conversion> conversion;
    std::size_t probes = 0;  ///< number of solved probes
    std::size_t reused = 0;  ///< cases that an earlier bake had solved
    std::vector<LeftOutCase> left_out;
    double cpu_seconds = 0.0;   ///< of all meshes, cases and falls
    CpuAccount account;         ///< of these, and of the other work of the bake
    double mesh_seconds = 0.0;  ///< wall clock, as the next three
    double kirchhoff_seconds = 0.0;
    double case_seconds = 0.0;  ///< of the cases, including their mesh
    double conversion_seconds = 0.0;
};

/// Returns the folder of cases of an output file: NAME.cases beside NAME.body.h5, or beside NAME.csv.
std::filesystem::path case_folder_of(const std::filesystem::path& output);

/// Returns the folder of cases of a bake: that of its output, or for turbulence alone NAME.turbulence.cases.
std::filesystem::path case_folder_of(const BakeRequest& request);

/// Meshes the body in a temporary folder, computes its Kirchhoff tensor unless an earlier bake did, and plans
/// its cases and, as the quality asks, its falls; writes nothing else. Throws Error.
BakePreparation prepare_bake(const BakeRequest& request);

/// Meshes the body, computes its Kirchhoff tensor, solves its cases in case_folder_of(request), and
/// writes the body file with its tables. With a goal it proceeds in rounds (scene_plan.hpp). Cases that an
/// earlier call solved with the same inputs are reused. `planned` is called with the plan before the long
/// work begins. Throws Error.
BakeResult bake_body(const BakeRequest& request, const FarmOptions& farm,
                     const std::function<void(const BakePreparation&)>& planned);

/// Returns the body of a shape file, meshed by the program samara-mesh with its defaults, or the body of a
/// body file, which takes the defaults of `reading` alone. `folder` receives intermediate files
/// (shape.body.h5, log.mesh). Throws Error.
Body prepare_body(const std::filesystem::path& shape, const ShapeReading& reading,
                  const std::filesystem::path& folder);

/// Computes the body's Kirchhoff tensor where it has none: copied from the body file `earlier` where that has
/// the same surface, else by the command `samara kirchhoff`, whose intermediate files go to `folder`. Throws
/// Error, which names `shape`, the file that the body was made of.
void add_kirchhoff_tensor(Body& body, const std::filesystem::path& shape,
                          const std::filesystem::path& earlier, const std::filesystem::path& folder);

/// The options of a bake of a scene.
struct SceneBakeOptions {
    BakeQuality quality;
    Inflow inflow;
    bool whole_grid = false;  ///< all directions, not only those that occur in the scene
    double tolerance = 0.1;
    std::optional<double> budget;
    int most_rounds = 8;
};

/// Returns a request for each body of a scene, with the output NAME.body.h5 in the folder. A body that uses
/// neither table loads nor turbulence from tables gets only a mesh and a Kirchhoff tensor.
std::vector<BakeRequest> requests_for_scene(const Scene& scene, const std::filesystem::path& folder,
                                            const SceneBakeOptions& options);

}  // namespace samara
