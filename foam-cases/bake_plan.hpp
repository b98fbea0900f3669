#pragma once

#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "samara/body/body.hpp"

namespace samara {

/// How the mesh around a body is made; lengths over L.
struct FlowMesh {
    int box_half_width = 10;
    int background_cells = 20;                              ///< along each edge of the box
    int surface_level = 4;                                  ///< each level halves the background cells
    int layers = 3;                                         ///< of cells along the surface
    std::vector<std::pair<double, int>> refinement_shells;  ///< (distance from the body, level), outwards
};

/// What --quality stands for.
struct BakeQuality {
    std::string name;
    int least_subdivisions = 2;  ///< of the map of directions, whatever the cost
    int most_subdivisions = 8;
    int most_cases =
        16;  ///< more subdivisions than the least are taken while the cases are no more than this
    double background_cell = 1.0;  ///< edge over L
    FlowMesh mesh;                 ///< for a compact body; a long one gets a wider box
    int iterations = 200;
    int averaged_iterations = 50;  ///< the last of them
};

/// The quality of that name; throws Error where there is none.
BakeQuality bake_quality(const std::string& name);

/// The names that bake_quality knows.
std::vector<std::string> bake_quality_names();

/// One OpenFOAM case.
struct BakeCase {
    std::string name;           ///< also its folder's
    Vector3d direction;         ///< of the body's velocity relative to the fluid, unit vector, case axes
    double reynolds_number;     ///< U L / nu
    std::string mesh = "mesh";  ///< the folder of the mesh that it is solved on
};

/// The cases around one body. Case axes: x_case = axes^T (x_body - centroid) / L.
struct BakePlan {
    BakeQuality quality;  ///< its mesh fitted to the body
    int subdivisions = 1;
    double reference_length = 0.0;  ///< L (m)
    Matrix3d axes = Matrix3d::Identity();
    std::vector<BakeCase> cases;
    double cells = 0.0;        ///< of the mesh, an estimate
    double cpu_seconds = 0.0;  ///< of the mesh and all cases on one core, an estimate
};

/// The cases that the quality asks for: the directions that the body's symmetry leaves to solve, each at the
/// Reynolds number.
BakePlan plan_bake(const Body& body, const BakeQuality& quality, double reynolds_number);

/// How many cells the mesh will have, within some 20 %: those of the background, the refined shells (their
/// volumes as of a convex body's parallel bodies) and the layers.
double estimated_cells(const Body& body, const FlowMesh& mesh);

/// The content of plan.json, without the hashes of the inputs.
nlohmann::json plan_json(const BakePlan& plan);

}  // namespace samara
