#include "samara/kirchhoff/surface_flow.hpp"

#include "samara/core/surface/curved_surface.hpp"
#include "samara/core/surface/welded_surface.hpp"
#include "samara/kirchhoff/operators/hypersingular.hpp"
#include "samara/kirchhoff/surfaces/surface_ladder.hpp"

namespace samara {
namespace {

// The potential's matrix is factorised: of so many triangles within a second.
constexpr std::size_t most_triangles = 2600;

Surface solvable_surface(const Surface& given, const VolumeMoments& moments, int threads) {
    const double length = reference_length(moments.surface_area);
    Surface surface = welded(given);
    for (Vector3d& vertex : surface.vertices) vertex = (vertex - moments.centroid) / length;
    if (surface.triangle_count() > most_triangles || too_many_near_pairs(surface)) {
        SurfaceLadder ladder(surface, threads);
        int rung = 0;
        while (rung > ladder.lowest() && ladder.rung(rung).surface.triangle_count() > most_triangles) --rung;
        surface = ladder.rung(rung).surface;
    }
    return without_edge_nodes(surface);
}

}  // namespace

SurfaceLoads surface_loads(const Surface& surface, const VolumeMoments& moments, int threads) {
    SurfaceLoads loads;
    loads.surface = solvable_surface(surface, moments, threads);
    const SixColumns potentials = unit_potentials(loads.surface, threads);
    loads.potentials.reserve(loads.surface.vertices.size());
    for (Eigen::Index vertex = 0; vertex < potentials.rows(); ++vertex) {
        loads.potentials.push_back(potentials.row(vertex).tail<3>());
    }
    return loads;
}

}  // namespace samara
