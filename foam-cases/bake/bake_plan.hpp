#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "converter/cases/case_plan.hpp"
#include "converter/falls/free_fall.hpp"
#include "foam-cases/bake/bake_quality.hpp"
#include "samara/core/body/body.hpp"
#include "samara/core/physics/fluid.hpp"
#include "samara/scene/scene.hpp"

namespace samara {

/// Turbulence of the fluid far from the body.
struct Inflow {
    double intensity =
        0.01;  ///< rms fluctuation over the flow's speed: next to still, yet k-epsilon wakes up
    /// Of the large eddies, over L: epsilon = C_mu^(3/4) k^(3/2) / length. None: the eddy viscosity is the
    /// fluid's own.
    std::optional<double> length;
};

/// The paper's eq. 13: k = 3/2 U^2, that is an intensity of 1, and the edge of its grid's cells as length,
/// which it does not give: here a quarter of L, as of 32 cells over 8 L.
inline Inflow paper_inflow() {
    return {1.0, 0.25};
}

/// One OpenFOAM case of a bake.
struct BakeCase : PlannedCase {
    std::string start_from;  ///< the case whose solution it starts from; empty: from the undisturbed flow
};

/// Whose cases a folder holds: those of a bake, perhaps with falls, or one fall alone.
enum class CaseType { bake, fall };

/// The cases around one body. Case axes: x_case = axes^T (x_body - centroid) / L.
struct BakePlan {
    CaseType type = CaseType::bake;
    BakeQuality quality;            ///< its meshes fitted to the body
    int subdivisions = 1;           ///< of the stored map
    int solved_subdivisions = 1;    ///< of the map whose directions are solved; divides `subdivisions`
    double reference_length = 0.0;  ///< L (m)
    Matrix3d axes = Matrix3d::Identity();
    bool covers_scene = false;  ///< the directions are those that a scene visits, not all
    Inflow inflow;
    int ranks = 1;                                 ///< processes that share each case
    double main_reynolds_number = 0.0;             ///< that of most cases
    std::vector<double> further_reynolds_numbers;  ///< in the order in which they were planned
    std::vector<BakeCase> cases;                   ///< none where the kind is a fall
    std::vector<FreeFall> falls;                   ///< each on one of the meshes
    std::vector<double> cells;                     ///< of each of all_meshes, an estimate
    double cpu_seconds = 0.0;                      ///< of the meshes and all cases on one core, an estimate

    /// The main Reynolds number and the further ones.
    [[nodiscard]] std::vector<double> reynolds_numbers() const;

    /// The meshes of the loads, then those of the turbulence.
    [[nodiscard]] std::vector<FlowMesh> all_meshes() const;
};

/// The closure at the Reynolds number: `turbulent`, or laminar below laminar_reynolds_number.
Closure closure_at(double reynolds_number, Closure turbulent = Closure::k_epsilon);

/// The cases that the quality asks for, around the main Reynolds number: the directions that the body's
/// symmetry leaves to solve, a share of them on the last mesh too, and those of a coarser map for further
/// Reynolds numbers and closures.
BakePlan plan_bake(const Body& body, const BakeQuality& quality, double reynolds_number,
                   const Inflow& inflow = {});

/// Cases between the tables' nodes, to hold the tables against: `count` directions spread evenly over the
/// sphere by an additive recurrence (M. Roberts' R2 sequence), two of three at the main Reynolds number, the
/// others between it and a tenth of it; each from the coarsest mesh of the quality to the finest. Depends on
/// the body, the quality and the Reynolds number alone; more of them begin with the same ones.
BakePlan plan_probes(const Body& body, const BakeQuality& quality, double reynolds_number, int count);

/// How far a direction's cases go.
enum class Ladder { to_last_mesh, to_mesh_before };

/// Adds the cases of one direction on the meshes of the quality, from the coarsest to the finest, each
/// started from the one before: KIND_INDEX_MESH, and, where the turbulence is of cases of its own,
/// KIND_INDEX_MESH_turbulence.
void add_ladder(const char* kind, std::size_t index, const Vector3d& direction, double reynolds_number,
                BakePlan& plan, Ladder ladder = Ladder::to_last_mesh);

/// Adds the case of a direction that has its ladder at a further Reynolds number, on the mesh before the
/// last.
void add_further_reynolds_number(const Vector3d& direction, double reynolds_number, BakePlan& plan);

/// Adds the quality's other closures to such a direction, likewise; none where the flow is laminar.
void add_other_closures(const Vector3d& direction, BakePlan& plan);

/// The body's mass (kg): mass_asked_or_own(). Throws Error where there is neither a density nor a mass.
double mass_of(const MassSpecification& asked, const Body& body);

/// The terminal_speed() (m/s) of a body, to bake at. Throws Error where it has none.
double bake_speed(const Body& body, const Fluid& fluid, double mass, double gravity);

/// Three figures of a Reynolds number, which is known no better.
double rounded_reynolds_number(double reynolds_number);

/// A plan without cases on the quality's meshes, fitted to the body.
BakePlan plan_of_meshes(const Body& body, const BakeQuality& quality);

/// Works out the CPU seconds of all that is planned.
void estimate_cost(BakePlan& plan);

/// How many iterations the case will take, an estimate.
double estimated_iterations(const BakePlan& plan, const BakeCase& entry);

/// CPU seconds that the case will take, an estimate.
double estimated_seconds(const BakePlan& plan, const BakeCase& entry);

/// How many cells the mesh will have, within some 20 %: those of the background, the refined shells (their
/// volumes as of a convex body's parallel bodies) and the layers.
double estimated_cells(const Body& body, const FlowMesh& mesh);

/// The mesh of that name of the plan, and its estimated number of cells. Throw std::logic_error where the
/// plan has none.
FlowMesh mesh_of(const BakePlan& plan, const std::string& name);
double cells_of(const BakePlan& plan, const std::string& mesh);

/// The content of plan.json, without the hashes of the inputs.
nlohmann::json plan_json(const BakePlan& plan);

/// The kind of the plan that plan_json wrote.
CaseType type_of_plan(const nlohmann::json& json);

}  // namespace samara
