#include "samara/core/integrator/batch.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <numeric>
#include <random>

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "support/compared_states.hpp"
#include "support/known_bodies.hpp"

namespace samara {
namespace {

constexpr double h = 0.002;

ImmersedBody noisy_body(Turbulence turbulence = Turbulence::table) {
    ImmersedBody body = test::blunt_ellipsoid(Vector3d(0.001, -0.002, 0.003));
    body.turbulence = turbulence;
    body.turbulent_kinetic_energy = 0.003;
    body.dissipation_rate = 0.02;
    prepare(body);
    return body;
}

/// With every term of the loads.
ImmersedBody noisy_lopsided_body(Turbulence turbulence = Turbulence::table) {
    ImmersedBody body = test::lopsided_body(Vector3d(0.001, -0.002, 0.003));
    body.turbulence = turbulence;
    prepare(body);
    return body;
}

/// The same body with its surface in patches.
ImmersedBody noisy_patched_body() {
    SceneBody given = test::scene_body(1200.0);
    given.patches = 6;
    return make_immersed_body(test::lopsided_shape(), given, Fluid{});
}

ImmersedBody coefficient_body() {
    Body shape = test::rubber_ellipsoid();
    SceneBody given = test::scene_body(1200.0);
    given.loads = Loads::coefficients;
    given.coefficients.lift_coefficient = 0.8;
    given.coefficients.center_of_pressure = Vector3d(0.001, 0.002, 0.0);
    return make_immersed_body(shape, given, Fluid{});
}

BodyState start_of(std::size_t i) {
    BodyState state =
        test::tumbling_state(0.05 + 0.001 * static_cast<double>(i % 200), 0.1 * static_cast<double>(i % 97));
    state.position = Vector3d(0.01 * static_cast<double>(i), -0.1, 0.2);
    return state;
}

Noise noise_of(std::size_t i) {
    return {7, "leaf", static_cast<std::uint32_t>(i % 3), static_cast<std::uint32_t>(i)};
}

Batch started(const ImmersedBody& body, const std::vector<std::size_t>& bodies) {
    Batch batch(body, bodies.size());
    for (std::size_t place = 0; place < bodies.size(); ++place) {
        batch.set_state(place, start_of(bodies[place]));
        batch.set_noise(place, noise_of(bodies[place]));
    }
    return batch;
}

std::vector<std::size_t> first(std::size_t count) {
    std::vector<std::size_t> bodies(count);
    std::iota(bodies.begin(), bodies.end(), 0);
    return bodies;
}

bool same_bits(const BodyState& a, const BodyState& b) {
    using Bits = std::array<std::uint64_t, 29>;
    return std::bit_cast<Bits>(test::numbers_of(a)) == std::bit_cast<Bits>(test::numbers_of(b));
}

Surroundings windy() {
    Surroundings surroundings;
    surroundings.current = Vector3d(0.3, 0.0, 0.0);
    surroundings.gust = {.amplitude = Vector3d(0.0, 0.2, 0.1), .period = 0.7};
    return surroundings;
}

TEST(Batch, MovesEachBodyAsAdvanceDoesToTheLastBit) {
    for (const ImmersedBody& body :
         {noisy_body(), noisy_body(Turbulence::constant), noisy_body(Turbulence::none), noisy_lopsided_body(),
          noisy_patched_body(), coefficient_body(), test::ideal_ellipsoid()}) {
        constexpr std::size_t count = 37;
        Batch batch = started(body, first(count));
        const BatchReport report = batch.advance(windy(), 0.5, h, 3, 50);
        Batch alone = started(body, first(1));
        alone.advance(windy(), 0.5, h, 3, 50);
        ASSERT_TRUE(same_bits(alone.state(0), batch.state(0)));
        std::uint64_t implicit_steps = 0;
        int most = 1;
        for (std::size_t i = 0; i < count; ++i) {
            BodyState state = start_of(i);
            for (std::uint64_t step = 0; step < 50; ++step) {
                const StepResult result = advance(body, windy(), 0.5, h, state, noise_of(i), 3 + step);
                state = result.state;
                implicit_steps += static_cast<std::uint64_t>(result.substeps);
                most = std::max(most, result.substeps);
            }
            ASSERT_TRUE(same_bits(batch.state(i), state)) << "body " << i;
        }
        EXPECT_EQ(report.implicit_steps, implicit_steps);
        EXPECT_EQ(report.most_substeps, most);
    }
}

// Enough for several threads to have several pieces each; under the thread sanitizer a step takes a hundred
// times as long.
#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
constexpr std::size_t many = 1700;
#else
constexpr std::size_t many = 3000;
#endif
#else
constexpr std::size_t many = 3000;
#endif

TEST(Batch, DoesNotDependOnOrderNeighboursThreadsOrTheCuttingOfTime) {
    const ImmersedBody body = noisy_body();
    const std::vector<std::size_t> bodies = first(many);
    Batch together = started(body, bodies);
    together.advance(windy(), 0.0, h, 0, 24, 1);

    std::vector<std::size_t> shuffled = bodies;
    std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(5));
    shuffled.resize(many * 3 / 8);
    Batch others = started(body, shuffled);
    std::uint64_t done = 0;
    for (const std::uint64_t steps : {1U, 7U, 16U}) {
        others.advance(windy(), 0.0, h, done, steps, 2);
        done += steps;
    }
    for (std::size_t place = 0; place < shuffled.size(); ++place) {
        ASSERT_TRUE(same_bits(others.state(place), together.state(shuffled[place])));
    }
}

TEST(Batch, GoesOnFromAStateAsIfItHadNotStopped) {
    const ImmersedBody body = noisy_body();
    Batch through = started(body, first(20));
    through.advance(windy(), 0.0, h, 0, 40);
    Batch before = started(body, first(20));
    before.advance(windy(), 0.0, h, 0, 17);
    Batch after = started(body, first(20));
    for (std::size_t i = 0; i < after.size(); ++i) after.set_state(i, before.state(i));
    after.advance(windy(), 0.0, h, 17, 23);
    for (std::size_t i = 0; i < after.size(); ++i) {
        EXPECT_TRUE(same_bits(after.state(i), through.state(i)));
    }
}

TEST(Batch, GivesTheSameBytesOnEveryInstructionSet) {
    const ImmersedBody body = noisy_lopsided_body();
    std::vector<std::vector<BodyState>> ends;
    for (const auto target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        Batch batch = started(body, first(50));
        batch.advance(windy(), 0.0, h, 0, 50);
        ends.emplace_back();
        for (std::size_t i = 0; i < batch.size(); ++i) ends.back().push_back(batch.state(i));
        Batch alone = started(body, {7});
        alone.advance(windy(), 0.0, h, 0, 50);
        EXPECT_TRUE(same_bits(alone.state(0), ends.back()[7]));
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    ASSERT_GT(ends.size(), 1U);
    for (const std::vector<BodyState>& end : ends) {
        for (std::size_t i = 0; i < end.size(); ++i) EXPECT_TRUE(same_bits(end[i], ends.front()[i]));
    }
}

}  // namespace
}  // namespace samara
