#include "foam-cases/bake/bake_quality.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "samara/core/base/error.hpp"

namespace samara {
namespace {

// Meshes for trials and previews, and of loads with resolved boundary layers: each halves the cells of the
// one before along the surface and in most of the wake. About 6,000 and 19,000 cells around an ellipsoid of
// 1:2:4.
FlowMesh coarse_mesh() {
    return {"mesh_coarse", 10, 2.0, 4, 2, {{0.4, 4}, {1.2, 3}, {3.0, 2}, {5.0, 1}}};
}

FlowMesh medium_mesh() {
    return {"mesh_medium", 10, 1.0, 4, 3, {{0.2, 4}, {0.6, 3}, {1.5, 2}, {3.0, 1}}};
}

// Beyond the medium mesh, loads need a fine wake, not a finer surface (docs/studies/closures).
FlowMesh wake_mesh() {
    return {"mesh_wake", 10, 1.0, 4, 0, {{0.3, 4}, {1.2, 3}, {2.5, 2}, {5.0, 1}}};
}

FlowMesh fine_wake_mesh() {
    return {"mesh_fine_wake", 10, 1.0, 5, 0, {{0.15, 5}, {0.6, 4}, {2.0, 3}, {4.0, 2}, {6.0, 1}}};
}

// Meshes of one layout whose cells are 1.4 times smaller from one to the next, equally fine over the near
// wake, as k and epsilon need it (docs/studies/turbulence): about 15,000, 42,000, 120,000 and 330,000 cells.
FlowMesh uniform_mesh(int background_cells) {
    return {fmt::format("mesh_uniform_{}", background_cells), 10, 20.0 / background_cells, 4, 3,
            {{1.0, 4}, {2.2, 3}, {3.5, 2}, {5.0, 1}}};
}

BakeQuality smoke_quality() {
    BakeQuality quality;
    quality.name = "smoke";
    quality.meshes = {coarse_mesh()};
    quality.directions = 6;
    quality.directions_without_symmetry = 6;
    quality.table_subdivisions = 2;
    quality.stationarity = 0.05;
    quality.most_iterations = 200;
    return quality;
}

BakeQuality preview_quality() {
    BakeQuality quality;
    quality.name = "preview";
    quality.meshes = {coarse_mesh(), medium_mesh()};
    quality.stationarity = 0.01;
    return quality;
}

BakeQuality standard_quality() {
    BakeQuality quality;
    quality.name = "standard";
    quality.stationarity = 0.01;
    quality.meshes = {uniform_mesh(10), uniform_mesh(14), uniform_mesh(20)};
    quality.directions_without_symmetry = 28;
    quality.further_reynolds_numbers = {0.1, 0.3};
    quality.falls = 2;
    return quality;
}

BakeQuality high_quality() {
    BakeQuality quality;
    quality.name = "high";
    quality.least_iterations = 200;
    quality.meshes = {uniform_mesh(10), uniform_mesh(14), uniform_mesh(20), uniform_mesh(28)};
    quality.directions = 28;
    quality.directions_without_symmetry = 28;
    quality.table_subdivisions = 12;
    quality.further_reynolds_numbers = {0.1, 0.3, 3.0};
    quality.falls = 2;
    quality.fall_cells = 60'000;
    quality.other_closures = {{Closure::realizable_k_epsilon, Closure::realizable_k_epsilon},
                              {Closure::k_omega_sst, Closure::k_omega_sst}};
    return quality;
}

// The first layer (in L) that stays below y+ = 2 on a sphere up to Re 1e5 (docs/studies/closures).
constexpr double thinnest_layer = 1.0 / 1800.0;

// Returns the mesh with layers of which the first is about `first_layer` thick. Each is 1.4 times as thick as
// the one below; the last has half the thickness of the cells beyond it.
FlowMesh with_thin_layers(FlowMesh mesh, double first_layer) {
    const double last_layer = 0.5 * mesh.background_cell / std::ldexp(1.0, mesh.surface_level);
    const double steps = std::log(last_layer / first_layer) / std::log(1.4);
    mesh.layers = std::max(1, 1 + static_cast<int>(std::lround(steps)));
    mesh.resolves_boundary_layer = true;
    return mesh;
}

std::vector<FlowMesh> copies_for_turbulence(std::vector<FlowMesh> meshes) {
    for (FlowMesh& mesh : meshes) mesh.name += "_turbulence";
    return meshes;
}

void require_closure_of(Closure closure, const char* what) {
    if (closure == Closure::k_epsilon || closure == Closure::k_omega_sst ||
        closure == Closure::k_omega_sst_lm)
        return;
    throw Error(fmt::format("the {} cannot be solved by {}; choose kEpsilon, kOmegaSST or kOmegaSSTLM", what,
                            name_of(closure)));
}

}  // namespace

int FlowMesh::background_cells() const {
    return static_cast<int>(std::lround(2.0 * box_half_width / background_cell));
}

BakeQuality with_falls_by(Closure closure, BakeQuality quality) {
    require_closure_of(closure, "falls");
    quality.fall_closure = closure;
    return quality;
}

BakeQuality with_loads_by(Closure closure, BakeQuality quality) {
    if (closure == Closure::k_epsilon) return quality;
    require_closure_of(closure, "loads");
    quality.loads_closure = quality.fall_closure = closure;
    quality.turbulence_meshes = copies_for_turbulence(quality.meshes);
    const std::vector<FlowMesh> of_loads = {coarse_mesh(), medium_mesh(), wake_mesh(), fine_wake_mesh()};
    for (std::size_t i = 0; i < quality.meshes.size(); ++i) {
        quality.meshes[i] = with_thin_layers(of_loads.at(i), thinnest_layer);
    }
    // Without transition, or with it; and without any closure.
    const Closure other = closure == Closure::k_omega_sst ? Closure::k_omega_sst_lm : Closure::k_omega_sst;
    if (!quality.other_closures.empty()) {
        quality.other_closures = {{other, Closure::realizable_k_epsilon},
                                  {Closure::laminar, Closure::k_omega_sst}};
    }
    return quality;
}

BakeQuality with_turbulence_by(Closure closure, BakeQuality quality) {
    const std::vector<std::string> names = turbulence_closures();
    if (std::ranges::find(names, name_of(closure)) == names.end()) {
        throw Error(fmt::format("k and epsilon cannot be solved by {}; choose one of {}", name_of(closure),
                                fmt::join(names, ", ")));
    }
    quality.turbulence_closure = closure;
    if (quality.turbulence_meshes.empty() && closure != quality.loads_closure) {
        quality.turbulence_meshes = copies_for_turbulence(quality.meshes);
    }
    for (Closures& other : quality.other_closures) {
        if (other.turbulence == closure) other.turbulence = Closure::k_epsilon;
    }
    return quality;
}

std::vector<std::string> turbulence_closures() {
    std::vector<std::string> names;
    for (const Closure closure :
         {Closure::k_epsilon, Closure::realizable_k_epsilon, Closure::rng_k_epsilon, Closure::k_omega_sst}) {
        names.emplace_back(name_of(closure));
    }
    return names;
}

std::vector<FlowMesh> meshes_of_falls(double reynolds_number, bool resolves_boundary_layer) {
    // y+ of a given thickness grows about as Re^0.9; L/470 gives less than 2 at Re 2e4.
    const double first_layer = std::min(1.0, std::pow(2e4 / reynolds_number, 0.9)) / 470.0;
    std::vector<FlowMesh> meshes;
    for (int cells = 8; cells <= 64; ++cells) {
        const FlowMesh mesh = {fmt::format("mesh_{}", cells),           10, 20.0 / cells, 4, 3,
                               {{0.3, 4}, {1.2, 3}, {2.5, 2}, {5.0, 1}}};
        meshes.push_back(resolves_boundary_layer ? with_thin_layers(mesh, first_layer) : mesh);
    }
    return meshes;
}

std::vector<std::string> bake_quality_names() {
    return {"smoke", "preview", "standard", "high"};
}

BakeQuality bake_quality(const std::string& name) {
    for (const auto make : {smoke_quality, preview_quality, standard_quality, high_quality}) {
        if (BakeQuality quality = make(); quality.name == name) return quality;
    }
    throw Error(
        fmt::format("unknown quality '{}'; choose one of {}", name, fmt::join(bake_quality_names(), ", ")));
}

std::optional<FallErrors> errors_on_held_out_falls(const std::string& quality) {
    if (quality == "surface") return FallErrors{0.24, 0.80};
    if (quality == "preview") return FallErrors{0.52, 0.72};
    if (quality == "standard") return FallErrors{0.05, 0.25};
    return {};
}

Closure usual_loads_closure(const std::string& quality) {
    return quality == "standard" || quality == "high" ? Closure::k_omega_sst_lm : Closure::k_epsilon;
}

}  // namespace samara
