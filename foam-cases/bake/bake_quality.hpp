#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "converter/cases/case_plan.hpp"

namespace samara {

/// The parameters of the mesh around a body; lengths in units of L.
struct FlowMesh {
    std::string name = "mesh";  ///< of its folder
    int box_half_width = 10;
    double background_cell = 1.0;  ///< edge length
    int surface_level = 4;         ///< each level halves the edges of the background cells
    int layers = 3;                ///< number of cell layers along the surface
    std::vector<std::pair<double, int>> refinement_shells;  ///< (distance from the body, level), outwards
    /// Whether the layers are thin enough to resolve the boundary layer; else a wall function models it.
    bool resolves_boundary_layer = false;

    /// Returns the number of background cells along each edge of the box.
    [[nodiscard]] int background_cells() const;
};

/// The closures of a direction's loads, and of its k and epsilon.
struct Closures {
    Closure loads;
    Closure turbulence;
};

/// The quality where none is asked for.
inline constexpr const char* usual_quality = "standard";

/// Mean errors of falls, relative.
struct FallErrors {
    double descent;
    double worst_metric;  ///< of descent, frequency, amplitude and rms angular speed; another regime counts 1
};

/// Returns the errors of bakes of a quality on the nine held-out falls (docs/explanation/accuracy.md), or, of
/// the quality "surface", of bodies without a bake; nothing of qualities that were not flown there.
std::optional<FallErrors> errors_on_held_out_falls(const std::string& quality);

/// The settings of --quality. All directions are solved on every mesh but the last and a share of them on the
/// last too, coarsest first, each from the solution of the same direction on the mesh before: this start is
/// cheap, settles slow changes, and depends on no other direction. The solution on the last mesh goes into
/// the table, and its difference from the mesh before gives the mesh error; other directions have the
/// solution on the mesh before plus the interpolated change by the last mesh (fill_tables). Loads and
/// turbulence are of one case, or of two with separate closures and meshes (with_loads_by).
struct BakeQuality {
    std::string name;
    std::vector<FlowMesh> meshes;  ///< for the loads of a compact body; a long one gets a wider box
    /// Meshes for k and epsilon, as many as `meshes`; empty where the loads' cases give k and epsilon too.
    std::vector<FlowMesh> turbulence_meshes;
    /// The mesh of the falls (add_falls), as those of samara validate have it.
    std::vector<FlowMesh> fall_meshes;
    Closure loads_closure = Closure::k_epsilon;       ///< for loads, where the flow is not laminar
    Closure turbulence_closure = Closure::k_epsilon;  ///< for k and epsilon, likewise
    Closure fall_closure = Closure::k_epsilon;        ///< for falls, where the flow is not laminar
    int directions = 16;  ///< at most; fewer where the symmetry leaves fewer candidates
    /// The same of bodies of which the symmetry makes fewer than four directions equivalent (one mirror,
    /// none).
    int directions_without_symmetry = 16;
    /// The share of `directions` that are solved on the last mesh, where there is more than one, and for
    /// what follows.
    double share_of_few = 0.4;
    int table_subdivisions = 8;  ///< of the stored map, at least; its nodes include the solved ones
    /// Further Reynolds numbers relative to the main one, solved in few directions on the mesh before the
    /// last, from the main one's solution there.
    std::vector<double> further_reynolds_numbers;
    /// Other closures, solved likewise: their spread is the closure's error.
    std::vector<Closures> other_closures;
    int falls = 0;                ///< number of free falls from which the dynamic coefficients are identified
    double fall_cells = 20'000;   ///< approximate number of cells of their mesh
    double fall_step = 1.0;       ///< relative to the automatic step of a fall
    double stationarity = 0.005;  ///< tolerance of the tail (body-flow/stationarity.py)
    int least_iterations = 100;   ///< for k-epsilon; half as many from a solution on another mesh
    int most_iterations = 800;    ///< of each attempt
};

/// Returns the quality with another closure for the loads, on meshes whose layers resolve the boundary layer;
/// k and epsilon stay those of k-epsilon on the original meshes. The falls use the closure of the loads.
/// Throws Error for a closure that solves for no omega, unless it is k_epsilon, which changes nothing.
BakeQuality with_loads_by(Closure closure, BakeQuality quality);

/// Returns the quality with another closure for k and epsilon: in cases of their own, unless the loads'
/// closure is the same and gives them. Throws Error for a closure that `turbulence_closures` does not name.
BakeQuality with_turbulence_by(Closure closure, BakeQuality quality);

/// Returns OpenFOAM's words for the closures that k and epsilon can be solved by.
std::vector<std::string> turbulence_closures();

/// Returns the quality with another closure for the falls than for the loads. Throws Error as with_loads_by
/// does.
BakeQuality with_falls_by(Closure closure, BakeQuality quality);

/// Returns meshes for falls, coarsest first: one layout with decreasing cell size, equal on all sides of the
/// body, since any side may face the wake. Their layers resolve the boundary layer at the Reynolds number
/// U L/nu, or leave it to wall functions.
std::vector<FlowMesh> meshes_of_falls(double reynolds_number, bool resolves_boundary_layer);

/// Returns the quality of that name, with k-epsilon for everything; throws Error where there is none.
BakeQuality bake_quality(const std::string& name);

/// Returns the default closure of a quality's loads: kOmegaSSTLM, which agrees best with measurements and
/// falls (docs/studies/closures, docs/studies/falls), or k-epsilon for the two qualities for trials and
/// previews.
Closure usual_loads_closure(const std::string& quality);

/// Returns the names of the qualities, cheapest first.
std::vector<std::string> bake_quality_names();

}  // namespace samara
