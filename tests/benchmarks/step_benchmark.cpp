// Time of one step of the runtime.

#include <benchmark/benchmark.h>

#include "samara/dynamics/step.hpp"
#include "support/known_bodies.hpp"

namespace samara {
namespace {

const Vector3d earth(0.0, 0.0, -9.81);

/// An ellipsoid, advanced step by step; `noisy`: with table turbulence.
void fall(benchmark::State& state, ImmersedBody body, bool noisy, const Vector3d& gravity) {
    if (noisy) body.turbulence = Turbulence::table;
    BodyState body_state = test::tumbling_state(0.1, 2.0);
    const Noise noise(1, "rubber", 0, 0);
    std::uint64_t step = 0;
    while (state.KeepRunning()) {
        body_state = advance(body, {.gravity = gravity}, 0.0, 0.002, body_state, noise, step++).state;
        benchmark::DoNotOptimize(body_state);
    }
    state.SetItemsProcessed(state.iterations());
}

void step_with_tables_and_noise(benchmark::State& state) {
    fall(state, test::blunt_ellipsoid(), true, earth);
}
void step_with_tables(benchmark::State& state) {
    fall(state, test::blunt_ellipsoid(), false, earth);
}
// Without gravity: nothing would slow the fall, and the steps would be cut ever finer.
void step_without_loads(benchmark::State& state) {
    fall(state, test::ideal_ellipsoid(), false, Vector3d::Zero());
}

BENCHMARK(step_with_tables_and_noise);
BENCHMARK(step_with_tables);
BENCHMARK(step_without_loads);

}  // namespace
}  // namespace samara
