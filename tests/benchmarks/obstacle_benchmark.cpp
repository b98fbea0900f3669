// Time of one step of a block that slides: on level ground, on a sheet of two or of many faces, and past one.

#include <benchmark/benchmark.h>

#include "samara/core/integrator/step.hpp"
#include "support/ground_bodies.hpp"
#include "support/obstacles.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

/// Gravity drives the block along the plane z = 0; it starts `height` (m) over it and again after 250 steps.
void slide(benchmark::State& state, Surroundings surroundings, double height) {
    const ImmersedBody block = test::uniform_body(test::box({0.04, 0.03, 0.01}, 2), 700.0,
                                                  {.density = 1.2, .viscosity = 1.8e-5}, Loads::none);
    surroundings.gravity = {7.0, 0.0, height > 0.01 ? 0.0 : -7.0};
    const Noise noise(1, "block", 0, 0);
    BodyState body_state;
    std::uint64_t step = 0;
    while (state.KeepRunning()) {
        if (step % 250 == 0) {
            body_state = BodyState();
            body_state.position = {-0.4, 0.0, height};
        }
        body_state = advance(block, surroundings, 0.0, 0.002, body_state, noise, step++).state;
        benchmark::DoNotOptimize(body_state);
    }
    state.SetItemsProcessed(state.iterations());
}

void slide_on_ground(benchmark::State& state) {
    slide(state, {.ground = 0.0}, 0.005);
}
/// Twice the square of the argument is the number of faces.
void slide_on_sheet(benchmark::State& state) {
    const auto n = static_cast<int>(state.range(0));
    slide(state, test::with_obstacles({test::obstacle(test::sheet_of_many(2.0, 2.0, n))}), 0.005);
}
void pass_over_sheet(benchmark::State& state) {
    slide(state, test::with_obstacles({test::obstacle(test::sheet(2.0, 2.0))}), 0.5);
}
void pass_over_nothing(benchmark::State& state) {
    slide(state, {}, 0.5);
}

BENCHMARK(slide_on_ground);
BENCHMARK(slide_on_sheet)->Arg(1)->Arg(20)->Arg(200);
BENCHMARK(pass_over_sheet);
BENCHMARK(pass_over_nothing);

}  // namespace
}  // namespace samara
