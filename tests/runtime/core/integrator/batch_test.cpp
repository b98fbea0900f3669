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

constexpr std::array precisions = {Precision::double_precision, Precision::single_precision};

Batch started(const ImmersedBody& body, const std::vector<std::size_t>& bodies,
              Precision precision = Precision::double_precision) {
    Batch batch(body, bodies.size(), precision);
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
    std::vector<std::size_t> shuffled = bodies;
    std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(5));
    shuffled.resize(many * 3 / 8);
    for (const Precision precision : precisions) {
        Batch together = started(body, bodies, precision);
        together.advance(windy(), 0.0, h, 0, 24, 1);
        Batch others = started(body, shuffled, precision);
        std::uint64_t done = 0;
        for (const std::uint64_t steps : {1U, 7U, 16U}) {
            others.advance(windy(), 0.0, h, done, steps, 2);
            done += steps;
        }
        for (std::size_t place = 0; place < shuffled.size(); ++place) {
            ASSERT_TRUE(same_bits(others.state(place), together.state(shuffled[place])));
        }
        Batch alone = started(body, {shuffled[5]}, precision);
        alone.advance(windy(), 0.0, h, 0, 24);
        EXPECT_TRUE(same_bits(alone.state(0), others.state(5)));
    }
}

// Landing, sliding and resting far from the origin, of many sizes, from many times on.
TEST(Batch, TouchesTheGroundTheSameHoweverTimeIsCut) {
    constexpr std::uint64_t all = 6000;
    const ImmersedBody body = noisy_body();
    for (const Precision precision : precisions) {
        std::vector<BodyState> ends;
        for (const std::uint64_t steps : {all, std::uint64_t{7}}) {
            Batch batch = started(body, first(20), precision);
            std::vector<double> sizes;
            for (std::size_t i = 0; i < batch.size(); ++i) {
                sizes.push_back(0.8 + 0.02 * static_cast<double>(i));
            }
            batch.set_sizes(sizes, true);
            for (std::size_t i = 0; i < batch.size(); ++i) {
                BodyState state = start_of(i);
                state.position.x() += 500.0;
                batch.set_state(i, state);
                batch.set_first_step(i, i % 5);
            }
            for (std::uint64_t done = 0; done < all; done += steps) {
                batch.advance({.ground = 0.17}, 0.0, h, done, std::min(steps, all - done));
            }
            std::size_t resting = 0;
            for (std::size_t i = 0; i < batch.size(); ++i) {
                if (steps == all) ends.push_back(batch.state(i));
                EXPECT_TRUE(same_bits(batch.state(i), ends[i]));
                resting += batch.state(i).at_rest ? 1 : 0;
            }
            EXPECT_GT(resting, batch.size() / 2);
        }
    }
}

TEST(Batch, GoesOnFromAStateAsIfItHadNotStopped) {
    const ImmersedBody body = noisy_body();
    for (const Precision precision : precisions) {
        Batch through = started(body, first(20), precision);
        through.advance(windy(), 0.0, h, 0, 40);
        Batch before = started(body, first(20), precision);
        before.advance(windy(), 0.0, h, 0, 17);
        Batch after = started(body, first(20), precision);
        for (std::size_t i = 0; i < after.size(); ++i) after.set_state(i, before.state(i));
        after.advance(windy(), 0.0, h, 17, 23);
        for (std::size_t i = 0; i < after.size(); ++i) {
            EXPECT_TRUE(same_bits(after.state(i), through.state(i)));
        }
    }
}

struct Distance {
    double position = 0.0;  ///< m
    double angle = 0.0;
    double speed = 0.0;  ///< m/s
};
/// The largest distance of bodies from others, each `offset` away.
Distance largest_distance(const Batch& batch, const Batch& others, const Vector3d& offset) {
    Distance most;
    for (std::size_t i = 0; i < batch.size(); ++i) {
        const BodyState a = batch.state(i);
        const BodyState b = others.state(i);
        most.position = std::max(most.position, (a.position - b.position - offset).norm());
        most.angle = std::max(most.angle, a.orientation.angularDistance(b.orientation));
        most.speed = std::max(most.speed, (a.velocity - b.velocity).tail<3>().norm());
    }
    return most;
}

TEST(Batch, InSinglePrecisionStaysCloseToDouble) {
    for (const ImmersedBody& body :
         {noisy_body(), noisy_body(Turbulence::constant), noisy_body(Turbulence::none), noisy_lopsided_body(),
          noisy_patched_body(), coefficient_body()}) {
        Batch batch = started(body, first(200), Precision::single_precision);
        Batch doubles = started(body, first(200));
        const BatchReport report = batch.advance(windy(), 0.0, h, 0, 100);
        doubles.advance(windy(), 0.0, h, 0, 100);
        const Distance distance = largest_distance(batch, doubles, Vector3d::Zero());
        EXPECT_LT(distance.position, 1e-5);
        EXPECT_LT(distance.angle, 1e-3);
        EXPECT_GT(distance.position, 1e-12);
        EXPECT_GE(report.implicit_steps, 200U * 100U);
    }
}

TEST(Batch, InSinglePrecisionMovesTheSameFarFromTheOrigin) {
    const ImmersedBody body = noisy_body();
    const Vector3d offset(1000.0, -700.0, 300.0);
    Batch near = started(body, first(50), Precision::single_precision);
    Batch far = started(body, first(50), Precision::single_precision);
    for (std::size_t i = 0; i < far.size(); ++i) {
        BodyState state = start_of(i);
        state.position += offset;
        far.set_state(i, state);
    }
    near.advance(windy(), 0.0, h, 0, 500);
    far.advance(windy(), 0.0, h, 0, 500);
    const Distance distance = largest_distance(far, near, offset);
    EXPECT_LT(distance.position, 1e-9);
    EXPECT_EQ(distance.speed, 0.0);
}

TEST(Batch, InSinglePrecisionReachesTheTerminalSpeed) {
    const ImmersedBody body = noisy_body(Turbulence::none);
    Batch batch = started(body, first(16), Precision::single_precision);
    Batch doubles = started(body, first(16));
    for (Batch* each : {&batch, &doubles}) {
        for (std::size_t i = 0; i < each->size(); ++i) each->set_state(i, BodyState{});
        each->advance(Surroundings{}, 0.0, h, 0, 5000);
    }
    const BodyState settled = doubles.state(0);
    const double speed = settled.velocity.tail<3>().norm();
    EXPECT_NEAR(batch.state(0).velocity.tail<3>().norm(), speed, 1e-5 * speed);
}

TEST(Batch, GivesTheSameBytesOnEveryInstructionSet) {
    for (const Precision precision : precisions) {
        const ImmersedBody body = noisy_lopsided_body();
        std::vector<std::vector<BodyState>> ends;
        for (const auto target : hwy::SupportedAndGeneratedTargets()) {
            hwy::SetSupportedTargetsForTest(target);
            hwy::GetChosenTarget().Update(hwy::SupportedTargets());
            Batch batch = started(body, first(50), precision);
            batch.advance(windy(), 0.0, h, 0, 50);
            ends.emplace_back();
            for (std::size_t i = 0; i < batch.size(); ++i) ends.back().push_back(batch.state(i));
            Batch alone = started(body, {7}, precision);
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
}

}  // namespace
}  // namespace samara
