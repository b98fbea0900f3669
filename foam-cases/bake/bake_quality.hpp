#pragma once

#include <string>
#include <utility>
#include <vector>

#include "converter/cases/case_plan.hpp"

namespace samara {

/// How the mesh around a body is made; lengths over L.
struct FlowMesh {
    std::string name = "mesh";  ///< of its folder
    int box_half_width = 10;
    double background_cell = 1.0;                           ///< edge
    int surface_level = 4;                                  ///< each level halves the background cells
    int layers = 3;                                         ///< of cells along the surface
    std::vector<std::pair<double, int>> refinement_shells;  ///< (distance from the body, level), outwards
    /// Whether the layers are so thin that they resolve the boundary layer, or a wall function stands for it.
    bool resolves_boundary_layer = false;

    /// Cells along each edge of the box.
    [[nodiscard]] int background_cells() const;
};

/// The models of a case's loads, and of its k and epsilon.
struct Closures {
    Closure loads;
    Closure turbulence;
};

/// What --quality stands for. All directions are solved on every mesh but the last, a share of them on that
/// too, coarsest first, each from the solution of the same direction on the mesh before: the start costs
/// little, settles what is slow, and depends on no other direction. The last mesh's solution is the table's,
/// the one's before it tells the mesh's error; where there is none, the table has that before it and what the
/// last changes between the others (fill_tables).
/// Loads and turbulence are of one case, or of two with models and meshes of their own (with_loads_by).
struct BakeQuality {
    std::string name;
    std::vector<FlowMesh> meshes;  ///< of the loads, for a compact body; a long one gets a wider box
    /// Of k and epsilon, as many; none where they are of the loads' cases.
    std::vector<FlowMesh> turbulence_meshes;
    std::vector<FlowMesh>
        fall_meshes;  ///< one, where falls have one of their own (add_falls): that of validate
    Closure loads_closure = Closure::k_epsilon;  ///< where the flow is not laminar
    Closure fall_closure = Closure::k_epsilon;   ///< of the falls, likewise
    int least_subdivisions = 2;  ///< of the map of directions that are solved, whatever the cost
    int most_subdivisions = 8;
    int most_directions = 16;  ///< multiples of the least subdivisions are taken up to so many directions
    double share_on_last_mesh = 0.4;  ///< of the directions, where there is a mesh before it
    int table_subdivisions = 8;       ///< of the stored map, at least; its nodes hold those that are solved
    /// Further Reynolds numbers, over the main one; solved in the directions of the map of the least
    /// subdivisions on the mesh before the last, from the main one's solution there.
    std::vector<double> further_reynolds_numbers;
    /// Other closures, solved likewise: the spread is the closure's error.
    std::vector<Closures> other_closures;
    int falls = 0;                ///< free falls that the dynamic coefficients are identified from
    std::size_t fall_mesh = 1;    ///< the mesh they are solved on, where that is one of the loads'
    double fall_cells = 20'000;   ///< about, of a mesh of their own
    double fall_step = 1.0;       ///< times the step that a fall gets of itself
    double stationarity = 0.005;  ///< tolerance of the tail (body-flow/stationarity.py)
    int least_iterations = 100;   ///< by k-epsilon; half as many from a solution on another mesh
    int most_iterations = 800;    ///< of each attempt
};

/// The same with the loads by another closure, on meshes whose layers resolve the boundary layer; k and
/// epsilon stay those of k-epsilon, on the meshes as they were. The falls are by the closure of the loads.
/// Throws Error for a closure that solves for no omega, unless it is k_epsilon, which changes nothing.
BakeQuality with_loads_by(Closure closure, BakeQuality quality);

/// The same with the falls by another closure than the loads. Throws Error as with_loads_by does.
BakeQuality with_falls_by(Closure closure, BakeQuality quality);

/// Meshes for falls whose layers resolve the boundary layer at the Reynolds number U L/nu, coarsest first:
/// one mesh in ever smaller cells, alike on all sides of a body that may turn any of them to its wake.
std::vector<FlowMesh> meshes_of_falls(double reynolds_number);

/// The quality of that name, all by k-epsilon; throws Error where there is none.
BakeQuality bake_quality(const std::string& name);

/// By what the loads of a quality are solved where nobody asks for another: kOmegaSSTLM, which measurements
/// and falls support (docs/studies/closures, docs/studies/falls), but for the two that are for trying and for
/// a first look.
Closure usual_loads_closure(const std::string& quality);

/// The names that bake_quality knows, cheapest first.
std::vector<std::string> bake_quality_names();

}  // namespace samara
