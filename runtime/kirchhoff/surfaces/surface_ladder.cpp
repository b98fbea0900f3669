#include "samara/kirchhoff/surfaces/surface_ladder.hpp"

#include <utility>

#include "samara/kirchhoff/surfaces/coarsened_surface.hpp"
#include "samara/kirchhoff/surfaces/rebuilt_surface.hpp"
#include "samara/kirchhoff/surfaces/surface_projection.hpp"

namespace samara {
namespace {

constexpr std::size_t fewest_triangles = 60;

}  // namespace

SurfaceLadder::SurfaceLadder(const Surface& surface, int threads)
    : threads_(threads), is_rebuilt_(surface.order() == 1) {
    Creases creases = find_creases(surface);
    Surface curved = surface.order() == 2 ? surface : rebuilt_surface(surface, creases, threads);
    rungs_.emplace(0, CreasedSurface{std::move(curved), std::move(creases)});
}

int SurfaceLadder::lowest() const {
    int index = 0;
    for (std::size_t count = base().surface.triangle_count(); count / 2 >= fewest_triangles; count /= 2)
        --index;
    return index;
}

const CreasedSurface& SurfaceLadder::rung(int index) {
    if (const auto known = rungs_.find(index); known != rungs_.end()) return known->second;
    if (index > 0) return rungs_.emplace(index, refined(rung(index - 1))).first->second;
    const CreasedSurface& finer = rung(index + 1);
    CreasedSurface coarse = coarsened(finer, finer.surface.triangle_count() / 2);
    coarse.surface = is_rebuilt_ ? rebuilt_surface(coarse.surface, coarse.creases, threads_)
                                 : drawn_onto(coarse.surface, base().surface, threads_);
    return rungs_.emplace(index, std::move(coarse)).first->second;
}

}  // namespace samara
