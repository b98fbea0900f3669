#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "converter/cases/case_plan.hpp"
#include "converter/falls/free_fall.hpp"
#include "foam-cases/bake/bake_quality.hpp"
#include "foam-cases/bake/direction_choice.hpp"
#include "samara/core/body/body.hpp"
#include "samara/core/physics/fluid.hpp"
#include "samara/scene/scene.hpp"

namespace samara {

/// Turbulence of the fluid far from the body.
struct Inflow {
    double intensity = 0.01;  ///< rms fluctuation relative to the flow's speed: nearly still, yet enough for
                              ///< k-epsilon to become turbulent
    /// Length of the large eddies, in units of L: epsilon = C_mu^(3/4) k^(3/2) / length. None: the eddy
    /// viscosity equals the fluid's viscosity.
    std::optional<double> length;
};

/// Returns the inflow of the paper's eq. 13: k = 3/2 U^2, an intensity of 1, and as length the edge of its
/// grid cells, which it does not state: here a quarter of L, as with 32 cells over 8 L.
inline Inflow paper_inflow() {
    return {1.0, 0.25};
}

/// One OpenFOAM case of a bake.
struct BakeCase : PlannedCase {
    std::string start_from;  ///< name of the case whose solution is the start; empty: undisturbed flow
};

/// The purpose of a folder of cases: a bake, perhaps with falls, or falls only.
enum class CaseType { bake, fall };

/// The cases of one body. Case axes: x_case = axes^T (x_body - centroid) / L.
struct BakePlan {
    CaseType type = CaseType::bake;
    BakeQuality quality;            ///< with meshes fitted to the body
    int subdivisions = 1;           ///< of the stored map
    double reference_length = 0.0;  ///< L (m)
    Matrix3d axes = Matrix3d::Identity();
    bool covers_scene = false;  ///< only directions that occur in a scene are solved, not all
    Inflow inflow;
    int ranks = 1;                                 ///< MPI processes for each case
    double main_reynolds_number = 0.0;             ///< the Reynolds number of most cases
    std::vector<double> further_reynolds_numbers;  ///< in the order of planning
    std::vector<BakeCase> cases;                   ///< none for the type `fall`
    std::vector<FreeFall> falls;                   ///< free falls, each on one of the meshes
    std::vector<double> cells;                     ///< estimated number of cells of each of all_meshes()
    double cpu_seconds = 0.0;                      ///< estimate for the meshes and all cases on one core

    /// Returns the main Reynolds number and the further ones.
    [[nodiscard]] std::vector<double> reynolds_numbers() const;

    /// Returns the meshes of the loads, of the turbulence, and of the falls.
    [[nodiscard]] std::vector<FlowMesh> all_meshes() const;
};

/// Returns the closure at a Reynolds number: `turbulent`, or laminar below laminar_reynolds_number.
Closure closure_at(double reynolds_number, Closure turbulent = Closure::k_epsilon);

/// Plans the cases of a quality around the main Reynolds number: the ends of the axes and the directions
/// between which tables are interpolated best (choose_directions), the first of them on the last mesh too, at
/// further Reynolds numbers and by other closures.
BakePlan plan_bake(const Body& body, const BakeQuality& quality, double reynolds_number,
                   const Inflow& inflow = {});

/// Plans cases between the tables' nodes, to test the tables with: `count` directions spread evenly over the
/// sphere by an additive recurrence (M. Roberts' R2 sequence), two of three at the main Reynolds number, the
/// others between it and a tenth of it; each from the coarsest mesh of the quality to the finest. The plan
/// depends only on the body, the quality and the Reynolds number; a larger one begins with the same cases.
BakePlan plan_probes(const Body& body, const BakeQuality& quality, double reynolds_number, int count);

/// The finest mesh of a direction's cases.
enum class Ladder { to_last_mesh, to_mesh_before };

/// Adds the cases of one direction on the meshes of the quality, from the coarsest to the finest, each
/// started from the one before: GROUP_INDEX_MESH, and, where the turbulence is of separate cases,
/// GROUP_INDEX_MESH_turbulence.
void add_ladder(const char* group, std::size_t index, const Vector3d& direction, double reynolds_number,
                BakePlan& plan, Ladder ladder = Ladder::to_last_mesh);

/// Adds a case at a further Reynolds number for a direction whose ladder is planned, on the mesh before the
/// last.
void add_further_reynolds_number(const Vector3d& direction, double reynolds_number, BakePlan& plan);

/// Adds cases with the quality's other closures for a direction whose ladder is planned, on the mesh before
/// the last; none where the flow is laminar.
void add_other_closures(const Vector3d& direction, BakePlan& plan);

/// Returns the subdivisions of the stored map: those of the quality at least, and a multiple of the
/// candidates', so that its nodes include them.
int stored_subdivisions(const Candidates& candidates, const BakeQuality& quality);

/// Returns the body's mass (kg): mass_asked_or_own(). Throws Error where there is neither a density nor a
/// mass.
double mass_of(const MassSpecification& asked, const Body& body);

/// Returns the terminal_speed() (m/s) of a body, at which it is baked. Throws Error where it has none.
double bake_speed(const Body& body, const Fluid& fluid, double mass, double gravity);

/// Rounds a Reynolds number to three significant digits.
double rounded_reynolds_number(double reynolds_number);

/// Returns a plan without cases, with the quality's meshes fitted to the body.
BakePlan plan_of_meshes(const Body& body, const BakeQuality& quality);

/// Estimates the CPU seconds of the whole plan.
void estimate_cost(BakePlan& plan);

/// Estimates the number of iterations of a case.
double estimated_iterations(const BakePlan& plan, const BakeCase& entry);

/// Estimate the CPU seconds of a mesh of so many cells, and of a case.
double estimated_mesh_seconds(double cells);
double estimated_seconds(const BakePlan& plan, const BakeCase& entry);

/// Estimates the number of cells of a mesh within about 20 %: those of the background, the refined shells
/// (with the volumes of a convex body's parallel bodies) and the layers.
double estimated_cells(const Body& body, const FlowMesh& mesh);

/// Return the plan's mesh of that name, and its estimated number of cells. Throw std::logic_error where the
/// plan has none.
FlowMesh mesh_of(const BakePlan& plan, const std::string& name);
double cells_of(const BakePlan& plan, const std::string& mesh);

/// Returns the content of plan.json, without the hashes of the inputs.
nlohmann::json plan_json(const BakePlan& plan);

/// Returns the type of the plan that plan_json() wrote.
CaseType type_of_plan(const nlohmann::json& json);

}  // namespace samara
