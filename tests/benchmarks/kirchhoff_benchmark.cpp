// Time and error of the Kirchhoff tensor of the 1:2:4 ellipsoid, against Lamb's exact values.

#include <benchmark/benchmark.h>

#include "samara/kirchhoff/kirchhoff_solver.hpp"
#include "samara/kirchhoff/panels/curved_collocation.hpp"
#include "samara/kirchhoff/solvers/tensor_error.hpp"
#include "support/known_bodies.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

void kirchhoff_tensor_of_ellipsoid(benchmark::State& state) {
    const Surface surface = test::ellipsoid({0.01, 0.02, 0.04}, static_cast<int>(state.range(0)));
    const VolumeMoments moments = test::moments_of(surface);
    KirchhoffTensor tensor;
    while (state.KeepRunning()) {
        tensor = kirchhoff_tensor(surface, moments);
        benchmark::DoNotOptimize(tensor);
    }
    const Body exact = test::rubber_ellipsoid();
    state.counters["triangles"] = static_cast<double>(surface.triangle_count());
    state.counters["error"] = relative_tensor_error(tensor.matrix, exact.kirchhoff->matrix,
                                                    {exact.moments.volume, exact.moments.surface_area});
    state.counters["estimate"] = tensor.error_estimate;
}

BENCHMARK(kirchhoff_tensor_of_ellipsoid)->DenseRange(2, 4)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Curved triangles, in units of the middle semi-axis.
void curved_collocation_of_ellipsoid(benchmark::State& state) {
    const Surface surface = test::curved_ellipsoid({0.5, 1.0, 2.0}, static_cast<int>(state.range(0)));
    BoundaryElementResult result;
    while (state.KeepRunning()) {
        result = solve_curved_collocation(surface, {});
        benchmark::DoNotOptimize(result);
    }
    const Body exact = test::rubber_ellipsoid();
    constexpr double unit = 0.02;  // m
    Vector6d powers;
    powers << Vector3d::Constant(unit), Vector3d::Ones();
    const Matrix6d tensor = unit * unit * unit * powers.asDiagonal() * result.tensor * powers.asDiagonal();
    state.counters["triangles"] = static_cast<double>(surface.triangle_count());
    state.counters["error"] = relative_tensor_error(tensor, exact.kirchhoff->matrix,
                                                    {exact.moments.volume, exact.moments.surface_area});
    state.counters["memory"] = static_cast<double>(result.memory);
}

BENCHMARK(curved_collocation_of_ellipsoid)->DenseRange(1, 4)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace samara
