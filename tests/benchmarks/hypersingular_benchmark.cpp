// Time, error and memory of the hypersingular method: the 1:2:4 ellipsoid against Lamb's exact values, a
// sheet against its known broadside added mass, and large meshes by compressed matrices.

#include <cmath>
#include <numbers>

#include <benchmark/benchmark.h>

#include "samara/kirchhoff/operators/hypersingular.hpp"
#include "samara/kirchhoff/solvers/tensor_error.hpp"
#include "support/known_bodies.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

/// x -> sin(pi x) / 2 in the plane: nodes drawn to the edges.
Surface sheet_graded_to_its_edges(double thickness, int n) {
    Surface surface = test::box({1.0, 1.0, thickness}, n);
    for (Vector3d& vertex : surface.vertices) {
        vertex.x() = 0.5 * std::sin(std::numbers::pi * vertex.x());
        vertex.y() = 0.5 * std::sin(std::numbers::pi * vertex.y());
    }
    return surface;
}

void report(benchmark::State& state, const Surface& surface, const BoundaryElementResult& result) {
    state.counters["triangles"] = static_cast<double>(surface.triangle_count());
    state.counters["iterations"] = static_cast<double>(result.iterations);
    state.counters["megabytes"] = 1e-6 * static_cast<double>(result.memory);
}

/// Argument: 20 x 4^level triangles; from 2000 on compressed.
void hypersingular_ellipsoid(benchmark::State& state) {
    const Surface surface = test::ellipsoid({1.0, 2.0, 4.0}, static_cast<int>(state.range(0)));
    BoundaryElementResult result;
    while (state.KeepRunning()) result = solve_hypersingular(surface, {});
    const Body exact = test::rubber_ellipsoid();  // in centimetres' size
    Vector6d scale;
    scale << Vector3d::Constant(1e-2), Vector3d::Ones();
    const Matrix6d tensor = 1e-6 * scale.asDiagonal() * result.tensor * scale.asDiagonal();
    state.counters["error"] = relative_tensor_error(tensor, exact.kirchhoff->matrix,
                                                    {exact.moments.volume, exact.moments.surface_area});
    report(state, surface, result);
}

/// Argument: divisions of an edge. Thickness 1e-3 of the edge; C = 0.5790 is the limit of no thickness.
void hypersingular_sheet(benchmark::State& state) {
    const Surface surface = sheet_graded_to_its_edges(1e-3, static_cast<int>(state.range(0)));
    BoundaryElementResult result;
    while (state.KeepRunning()) result = solve_hypersingular(surface, {});
    state.counters["error"] = std::abs(result.tensor(5, 5) / (0.5790 * std::numbers::pi / 4.0) - 1.0);
    report(state, surface, result);
}

BENCHMARK(hypersingular_ellipsoid)->DenseRange(2, 6)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(hypersingular_sheet)->Arg(8)->Arg(16)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace samara
