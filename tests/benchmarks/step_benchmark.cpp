// Time of one step of the runtime.

#include <memory>

#include <benchmark/benchmark.h>

#include "samara/core/integrator/batch.hpp"
#include "samara/core/integrator/step.hpp"
#include "support/known_bodies.hpp"

namespace samara {
namespace {

const Vector3d earth(0.0, 0.0, -9.81);

/// An ellipsoid, advanced step by step; `noisy`: with table turbulence.
void fall(benchmark::State& state, ImmersedBody body, bool noisy, const Vector3d& gravity) {
    if (noisy) body.turbulence = Turbulence::table;
    prepare(body);
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
// Full tensors of every kind, the wake's too, and the centre of mass off the centroid.
void step_with_tables_and_every_term(benchmark::State& state) {
    fall(state, test::lopsided_body(Vector3d(0.001, -0.002, 0.003)), false, earth);
}
// Without gravity: nothing would slow the fall, and the steps would be cut ever finer.
void step_without_loads(benchmark::State& state) {
    fall(state, test::ideal_ellipsoid(), false, Vector3d::Zero());
}

/// The same body where it lies on the ground.
void step_at_rest(benchmark::State& state) {
    const ImmersedBody body = test::blunt_ellipsoid();
    const Surroundings surroundings{.ground = 0.0};
    const Noise noise(1, "rubber", 0, 0);
    BodyState body_state;
    body_state.position.z() = 2.0 * body.contact_points.bounding_radius;
    std::uint64_t step = 0;
    while (!body_state.at_rest) {
        body_state = advance(body, surroundings, 0.0, 0.002, body_state, noise, step++).state;
    }
    while (state.KeepRunning()) {
        body_state = advance(body, surroundings, 0.0, 0.002, body_state, noise, step++).state;
        benchmark::DoNotOptimize(body_state);
    }
    state.SetItemsProcessed(state.iterations());
}

/// Items a second are body-steps; `threads`: 1 or all cores.
void batch(benchmark::State& state, int threads, Precision precision = Precision::double_precision) {
    ImmersedBody body = test::blunt_ellipsoid();
    body.turbulence = Turbulence::table;
    prepare(body);
    const auto count = static_cast<std::size_t>(state.range(0));
    Batch bodies(body, count, precision);
    for (std::size_t i = 0; i < count; ++i) {
        bodies.set_state(i, test::tumbling_state(0.1, 0.001 * static_cast<double>(i % 1000)));
        bodies.set_noise(i, Noise(1, "leaf", 0, static_cast<std::uint32_t>(i)));
    }
    std::uint64_t step = 0;
    constexpr std::uint64_t steps = 8;
    std::uint64_t implicit_steps = 0;
    while (state.KeepRunning()) {
        implicit_steps += bodies.advance(Surroundings{}, 0.0, 0.002, step, steps, threads).implicit_steps;
        step += steps;
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(step * count));
    state.counters["substeps"] = static_cast<double>(implicit_steps) / static_cast<double>(step * count);
}
void batch_on_one_core(benchmark::State& state) {
    batch(state, 1);
}
void single_batch_on_one_core(benchmark::State& state) {
    batch(state, 1, Precision::single_precision);
}
void batch_on_all_cores(benchmark::State& state) {
    batch(state, 0);
}

/// 1024 bodies side by side in a wind with everything: items a second are body-steps.
void windy_batch(benchmark::State& state, const Wind& wind, bool sized = false) {
    ImmersedBody body = test::blunt_ellipsoid();
    body.turbulence = Turbulence::table;
    prepare(body);
    Surroundings surroundings;
    if (wind.is_field()) surroundings.wind = std::make_shared<const WindField>(wind, Vector3d::Zero());
    constexpr std::size_t count = 1024;
    Batch bodies(body, count);
    std::vector<double> sizes;
    for (std::size_t i = 0; sized && i < count; ++i) {
        sizes.push_back(0.7 + 0.7 * static_cast<double>(i) / count);
    }
    if (sized) bodies.set_sizes(sizes, false);
    for (std::size_t i = 0; i < count; ++i) {
        bodies.set_state(i, test::tumbling_state(0.1, 0.001 * static_cast<double>(i)));
        bodies.set_noise(i, Noise(1, "leaf", 0, static_cast<std::uint32_t>(i)));
    }
    std::uint64_t step = 0;
    while (state.KeepRunning()) {
        bodies.advance(surroundings, 0.0, 0.002, step, 8);
        step += 8;
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(step * count));
}
void in_no_wind(benchmark::State& state) {
    windy_batch(state, {});
}
void in_no_wind_of_many_sizes(benchmark::State& state) {
    windy_batch(state, {}, true);
}
void in_a_wind_with_profile(benchmark::State& state) {
    Wind wind;
    wind.velocity = Vector3d(0.1, 0.0, 0.0);
    wind.profile = WindProfile{.ground = -100.0};
    windy_batch(state, wind);
}
void in_a_wind_with_vortex_and_fan(benchmark::State& state) {
    Wind wind;
    wind.vortices.push_back({.circulation = 0.1, .core = 0.5});
    wind.fans.push_back({.position = Vector3d(-1.0, 0.0, 0.0), .speed = 0.1});
    windy_batch(state, wind);
}
void in_a_wind_with_gusts(benchmark::State& state) {
    Wind wind;
    wind.gusts = WindGusts{.rms = 0.02, .length = 1.0};
    windy_batch(state, wind);
}
void in_a_wind_from_a_file(benchmark::State& state) {
    auto grid = std::make_shared<WindGrid>();
    grid->origin = Vector3d::Constant(-16.0);
    grid->nodes = {33, 33, 33};
    grid->frames = 10;
    for (std::size_t i = 0; i < grid->size(); ++i) {
        grid->velocities.push_back(static_cast<float>(0.02 * std::sin(0.1 * static_cast<double>(i))));
    }
    Wind wind;
    wind.file = WindFile{.grid = grid, .repeats = true};
    windy_batch(state, wind);
}

/// A million leaves of ten kinds (densities): a frame of 1/60 s in one step of each.
void million_leaves(benchmark::State& state) {
    constexpr std::size_t kinds = 10;
    constexpr std::size_t leaves = 1'000'000 / kinds;
    std::vector<ImmersedBody> bodies;
    for (std::size_t kind = 0; kind < kinds; ++kind) {
        Body shape = test::rubber_ellipsoid();
        shape.tables = test::blunt_tables(shape, 4);
        SceneBody given = test::scene_body(1050.0 + 50.0 * static_cast<double>(kind));
        given.turbulence = Turbulence::table;
        bodies.push_back(make_immersed_body(shape, given, Fluid{}));
    }
    std::vector<Batch> batches;
    for (std::size_t kind = 0; kind < kinds; ++kind) {
        batches.emplace_back(bodies[kind], leaves);
        for (std::size_t i = 0; i < leaves; ++i) {
            batches[kind].set_state(i, test::tumbling_state(0.1, 0.001 * static_cast<double>(i % 1000)));
            batches[kind].set_noise(
                i, Noise(1, "leaf", static_cast<std::uint32_t>(kind), static_cast<std::uint32_t>(i)));
        }
    }
    std::uint64_t step = 0;
    std::uint64_t implicit_steps = 0;
    while (state.KeepRunning()) {
        for (Batch& batch : batches) {
            implicit_steps += batch.advance(Surroundings{}, 0.0, 1.0 / 60.0, step, 1, 0).implicit_steps;
        }
        ++step;
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(step));
    state.counters["substeps"] = static_cast<double>(implicit_steps) / static_cast<double>(step) / 1e6;
}

BENCHMARK(million_leaves)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(batch_on_one_core)
    ->Arg(1)
    ->Arg(8)
    ->Arg(4096)
    ->Arg(1'000'000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(single_batch_on_one_core)
    ->Arg(1)
    ->Arg(8)
    ->Arg(4096)
    ->Arg(1'000'000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(batch_on_all_cores)->Arg(1'000'000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(in_no_wind);
BENCHMARK(in_no_wind_of_many_sizes);
BENCHMARK(in_a_wind_with_profile);
BENCHMARK(in_a_wind_with_vortex_and_fan);
BENCHMARK(in_a_wind_with_gusts);
BENCHMARK(in_a_wind_from_a_file);
BENCHMARK(step_with_tables_and_noise);
BENCHMARK(step_with_tables);
BENCHMARK(step_with_tables_and_every_term);
BENCHMARK(step_without_loads);
BENCHMARK(step_at_rest);

}  // namespace
}  // namespace samara
