// Falls with noise: the same mean at any step, no spin that grows, and the same bits in any order.

#include <cmath>
#include <cstdint>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "samara/core/integrator/batch.hpp"
#include "support/hard_bodies.hpp"
#include "support/known_bodies.hpp"
#include "support/reference_step.hpp"
#include "support/stability_row.hpp"

namespace samara {
namespace {

const Surroundings still_water{.gravity = Vector3d(0.0, 0.0, -9.81)};

/// The mean speed along z of many copies with table turbulence, after a first part of the simulation.
double mean_climb(const ImmersedBody& body, double h, double duration, std::size_t copies) {
    Batch batch(body, copies);
    for (std::size_t i = 0; i < copies; ++i) {
        batch.set_noise(i, Noise(5, "descent", 0, static_cast<std::uint32_t>(i)));
        BodyState state;
        state.orientation =
            Quaterniond(Eigen::AngleAxisd(0.01 * static_cast<double>(i), Vector3d(1, 2, 3).normalized()));
        batch.set_state(i, state);
    }
    const auto steps = static_cast<std::uint64_t>(std::lround(duration / h));
    const std::uint64_t settling = steps / 4;
    const auto height = [&] {
        double sum = 0.0;
        for (std::size_t i = 0; i < copies; ++i) sum += batch.state(i).position.z();
        return sum / static_cast<double>(copies);
    };
    batch.advance(still_water, 0.0, h, 0, settling, 0);
    const double before = height();
    batch.advance(still_water, 0.0, h, settling, steps - settling, 0);
    return (height() - before) / (h * static_cast<double>(steps - settling));
}

void expect_same_descent(const std::string& subject, ImmersedBody body, double bound) {
    body.turbulence = Turbulence::table;
    prepare(body);
    const double fine = mean_climb(body, 1.0 / 240.0, 12.0, 512);
    for (const int rate : {60, 24}) {
        const double coarse = mean_climb(body, 1.0 / rate, 12.0, 512);
        test::expect_row({subject + ", noise", "1/" + std::to_string(rate) + " against 1/240 s",
                          "difference of the mean speed", bound, std::abs(coarse / fine - 1.0)});
    }
}

TEST(Noise, TheMeanDescentOfAnEllipsoidIsThatOfAFineStep) {
    expect_same_descent("rubber ellipsoid in water",
                        test::immersed(test::baked_ellipsoid({0.01, 0.02, 0.04}), 1200.0, test::water()),
                        0.02);
}

TEST(Noise, TheMeanDescentOfASheetIsThatOfAFineStep) {
    expect_same_descent("paper sheet in air", test::immersed(test::paper_sheet(), 750.0, test::air()), 0.02);
}

TEST(Noise, TheMeanClimbOfABubbleIsThatOfAFineStep) {
    expect_same_descent("air bubble of 1 mm in water",
                        test::immersed(test::baked_sphere(0.0005), 1.204, test::water()), 0.05);
}

TEST(Noise, ABallFallsInItsTurbulenceAsItDoesInStillFluid) {
    // The table's drag is that of the turbulent flow; rotation by turbulence adds none. The map is fine,
    // since between the nodes of a coarse one a sphere's drag is some 8 % low, and only the noisy ball gets
    // there.
    ImmersedBody ball = test::immersed(test::baked_sphere(0.02, 16), 1300.0, test::water());
    const double quiet = mean_climb(ball, 1.0 / 60.0, 12.0, 1);
    ball.turbulence = Turbulence::table;
    prepare(ball);
    const double noisy = mean_climb(ball, 1.0 / 60.0, 12.0, 512);
    test::expect_row({"ball of 4 cm in water, noise against none", "1/60 s", "difference of the mean speed",
                      0.05, std::abs(noisy / quiet - 1.0)});
}

/// The root of the mean square of |omega| over a part of a simulation, whose steps are counted from the
/// first.
double rms_rotation(const ImmersedBody& body, BodyState& state, std::uint64_t first, std::uint64_t steps) {
    const Noise noise(6, "turning", 0, 0);
    double sum = 0.0;
    for (std::uint64_t i = first; i < first + steps; ++i) {
        state = advance(body, still_water, 0.0, 1.0 / 60.0, state, noise, i).state;
        sum += state.velocity.head<3>().squaredNorm();
    }
    return std::sqrt(sum / static_cast<double>(steps));
}

TEST(Noise, DoesNotPumpTheSpinOverTenMinutes) {
    for (test::NamedBody& named : test::five_bodies(Loads::table)) {
        named.body.turbulence = Turbulence::table;
        prepare(named.body);
        BodyState state = test::tumbling_state(0.1, 3.0);
        rms_rotation(named.body, state, 0, 600);
        const double early = rms_rotation(named.body, state, 600, 6000);
        rms_rotation(named.body, state, 6600, 23'400);
        const double late = rms_rotation(named.body, state, 30'000, 6000);
        test::expect_row({named.name + ", noise", "1/60 s", "rms omega at 500-600 s over that at 10-110 s",
                          1.25, late / early});
    }
}

TEST(Noise, TheSeenFluidHasItsVarianceAndItsTimeAtAnyStep) {
    const ImmersedBody body = test::ideal_ellipsoid();
    const TurbulenceLevel level{.turbulent_kinetic_energy = 0.03, .dissipation_rate = 0.09};
    const double rate = 0.75 * 2.1 * level.dissipation_rate / level.turbulent_kinetic_energy;
    const Noise noise(8, "seen fluid", 0, 0);
    for (const double step_over_time : {0.3, 1.0, 3.0, 10.0}) {
        SampledTurbulence seen;
        double square = 0.0;
        double product = 0.0;
        constexpr std::uint64_t steps = 1'500'000;
        for (std::uint64_t step = 0; step < steps; ++step) {
            const Vector3d before = seen.velocity;
            seen = advance_sampled_turbulence(body, level, seen, step_over_time / rate, noise, step);
            square += seen.velocity.squaredNorm();
            product += seen.velocity.dot(before);
        }
        const double variance = square / (3.0 * static_cast<double>(steps));
        const std::string name = fmt::format("a h = {}", step_over_time);
        test::expect_row({"seen fluid", name, "error of the variance 2k/3", 0.01,
                          std::abs(variance / (2.0 / 3.0 * level.turbulent_kinetic_energy) - 1.0)});
        test::expect_row({"seen fluid", name, "error of the correlation over a step, exp(-a h)", 0.01,
                          std::abs(product / square - std::exp(-step_over_time))});
    }
}

/// How many of the copies' states differ in any bit.
double differing(const Batch& a, const Batch& b, const auto& place) {
    int count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const BodyState first = a.state(i);
        const BodyState second = b.state(place(i));
        const bool same = first.position == second.position && first.velocity == second.velocity &&
                          first.orientation.coeffs() == second.orientation.coeffs() &&
                          first.sampled_turbulence.velocity == second.sampled_turbulence.velocity;
        count += same ? 0 : 1;
    }
    return count;
}

TEST(Noise, TheSameBitsUnderThreadsOrderAndChunking) {
    ImmersedBody body = test::immersed(test::baked_ellipsoid({0.01, 0.02, 0.04}), 1200.0, test::water());
    body.turbulence = Turbulence::table;
    prepare(body);
    constexpr std::size_t copies = 300;
    const auto straight = [](std::size_t i) { return i; };
    const auto reversed = [](std::size_t i) { return copies - 1 - i; };
    const auto filled = [&](const auto& place) {
        Batch batch(body, copies);
        for (std::size_t i = 0; i < copies; ++i) {
            batch.set_noise(place(i), Noise(7, "copy", 0, static_cast<std::uint32_t>(i)));
            batch.set_state(place(i), test::tumbling_state(0.1 + 0.001 * static_cast<double>(i), 3.0));
        }
        return batch;
    };
    const double h = 1.0 / 24.0;
    Batch whole = filled(straight);
    whole.advance(still_water, 0.0, h, 0, 96, 1);
    Batch turned = filled(reversed);
    turned.advance(still_water, 0.0, h, 0, 96, 2);
    Batch cut = filled(straight);
    for (std::uint64_t done = 0; done < 96; done += 12) {
        cut.advance(still_water, 0.0, h, done, 12, 2);
    }
    test::expect_row({"300 ellipsoids, noise", "1/24 s", "states that differ by order and threads", 0.0,
                      differing(whole, turned, reversed)});
    test::expect_row({"300 ellipsoids, noise", "1/24 s", "states that differ by chunks of time", 0.0,
                      differing(whole, cut, straight)});
}

}  // namespace
}  // namespace samara
