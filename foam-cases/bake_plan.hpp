#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "converter/case_plan.hpp"
#include "converter/free_fall.hpp"
#include "foam-cases/bake_quality.hpp"
#include "samara/body/body.hpp"

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

/// The cases around one body. Case axes: x_case = axes^T (x_body - centroid) / L.
struct BakePlan {
    BakeQuality quality;            ///< its meshes fitted to the body
    int subdivisions = 1;           ///< of the stored map
    int solved_subdivisions = 1;    ///< of the map whose directions are solved; divides `subdivisions`
    double reference_length = 0.0;  ///< L (m)
    Matrix3d axes = Matrix3d::Identity();
    bool covers_scene = false;  ///< the directions are those that a scene visits, not all
    Inflow inflow;
    int ranks = 1;                         ///< processes that share each case
    std::vector<double> reynolds_numbers;  ///< the main one first
    std::vector<BakeCase> cases;
    std::vector<FreeFall> falls;  ///< each on one of the meshes
    std::vector<double> cells;    ///< of each mesh, an estimate
    double cpu_seconds = 0.0;     ///< of the meshes and all cases on one core, an estimate
};

/// The largest Reynolds number at which the flow around a blunt body is still free of turbulence, so that the
/// k-epsilon model does not hold: some 300 for a sphere's wake (Johnson & Patel, J. Fluid Mech. 378, 1999).
/// Cases below it are laminar.
inline constexpr double laminar_reynolds_number = 300.0;

/// The closure of a case at the Reynolds number, where none is asked for: kEpsilon, or laminar.
std::string closure_at(double reynolds_number);

/// The cases that the quality asks for, around the main Reynolds number: the directions that the body's
/// symmetry leaves to solve on every mesh, and those of a coarser map for further Reynolds numbers and
/// closures.
BakePlan plan_bake(const Body& body, const BakeQuality& quality, double reynolds_number,
                   const Inflow& inflow = {});

/// Cases between the tables' nodes, to hold the tables against: `count` directions spread evenly over the
/// sphere by an additive recurrence (M. Roberts' R2 sequence), two of three at the main Reynolds number, the
/// others between it and a tenth of it; each from the coarsest mesh of the quality to the finest. Depends on
/// the body, the quality and the Reynolds number alone; more of them begin with the same ones.
BakePlan plan_probes(const Body& body, const BakeQuality& quality, double reynolds_number, int count);

/// Adds the cases of one direction on all meshes of the quality, from the coarsest to the finest, each
/// started from the one before: KIND_INDEX_MESH.
void add_ladder(const char* kind, std::size_t index, const Vector3d& direction, double reynolds_number,
                BakePlan& plan);

/// Adds the case of a direction that has its ladder at a further Reynolds number, on the mesh before the
/// last.
void add_further_reynolds_number(const Vector3d& direction, double reynolds_number, BakePlan& plan);

/// Adds the quality's other closures to such a direction, likewise; none where the flow is laminar.
void add_other_closures(const Vector3d& direction, BakePlan& plan);

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

/// The estimated number of cells of a mesh of the plan.
double cells_of(const BakePlan& plan, const std::string& mesh);

/// The content of plan.json, without the hashes of the inputs.
nlohmann::json plan_json(const BakePlan& plan);

}  // namespace samara
