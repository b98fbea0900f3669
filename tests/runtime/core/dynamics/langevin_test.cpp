#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "samara/core/dynamics/loads.hpp"
#include "samara/core/integrator/step.hpp"
#include "support/known_bodies.hpp"
#include "support/reference_step.hpp"

namespace samara {
namespace {

constexpr TurbulenceLevel level = {.turbulent_kinetic_energy = 0.03, .dissipation_rate = 0.09};
constexpr double seen_rate = 0.75 * 2.1 * 3.0;  // a = 3/4 C_k epsilon/k

TEST(SampledTurbulence, HasTheVarianceOfTheTurbulenceWhateverTheStep) {
    const ImmersedBody body = test::ideal_ellipsoid();
    const Noise noise(3, "variance", 0, 0);
    for (const double step_by_time_scale : {0.1, 1.0, 10.0}) {
        const double h = step_by_time_scale / seen_rate;
        SampledTurbulence seen;
        double velocity = 0.0;
        double rotation = 0.0;
        constexpr int steps = 400'000;
        for (int step = -200; step < steps; ++step) {
            seen = advance_sampled_turbulence(body, level, seen, h, noise,
                                              static_cast<std::uint64_t>(step) + 200U);
            if (step < 0) continue;
            velocity += seen.velocity.squaredNorm() / 3.0 / steps;
            rotation += seen.angular_velocity.squaredNorm() / 3.0 / steps;
        }
        const double variance = 2.0 / 3.0 * level.turbulent_kinetic_energy;
        EXPECT_NEAR(velocity / variance, 1.0, 0.01) << "a h = " << step_by_time_scale;
        EXPECT_NEAR(rotation * body.length * body.length / variance, 1.0, 0.01);
    }
}

TEST(SampledTurbulence, ForgetsAtTheRateOfTheTurbulence) {
    const ImmersedBody body = test::ideal_ellipsoid();
    const Noise noise(4, "correlation", 0, 0);
    const double h = 0.2 / seen_rate;
    constexpr int steps = 400'000;
    constexpr int lag = 5;  // one correlation time
    SampledTurbulence seen;
    std::vector<Vector3d> history;
    for (int step = 0; step < steps; ++step) {
        seen = advance_sampled_turbulence(body, level, seen, h, noise, static_cast<std::uint64_t>(step));
        history.push_back(seen.velocity);
    }
    double product = 0.0;
    double square = 0.0;
    Matrix3d covariance = Matrix3d::Zero();
    for (std::size_t i = lag; i < history.size(); ++i) {
        product += history[i].dot(history[i - lag]);
        square += history[i].squaredNorm();
        covariance += history[i] * history[i].transpose() / steps;
    }
    EXPECT_NEAR(product / square, std::exp(-1.0), 0.01);
    // Isotropic: no component is favoured or tied to another.
    const double variance = covariance.trace() / 3.0;
    EXPECT_LT((covariance / variance - Matrix3d::Identity()).cwiseAbs().maxCoeff(), 0.03);
}

/// The correlation of the velocity with itself `lag` steps later, over a long simulation.
double correlation(const ImmersedBody& body, double h, std::size_t lag, int steps) {
    const Noise noise(6, "correlation time", 0, 0);
    std::vector<Vector3d> last(lag, Vector3d::Zero());
    SampledTurbulence seen;
    double product = 0.0;
    double square = 0.0;
    for (std::size_t step = 0; step < static_cast<std::size_t>(steps); ++step) {
        seen = advance_sampled_turbulence(body, level, seen, h, noise, step);
        Vector3d& before = last[step % lag];
        product += seen.velocity.dot(before);
        square += seen.velocity.squaredNorm();
        before = seen.velocity;
    }
    return product / square;
}

TEST(SampledTurbulence, HasTheCorrelationTimeOfTheTurbulenceWhateverTheStep) {
    const ImmersedBody body = test::ideal_ellipsoid();
    for (const auto& [step_by_time_scale, lag] : {std::pair(0.25, 4), {0.5, 2}, {1.0, 1}, {2.0, 1}}) {
        const double h = step_by_time_scale / seen_rate;
        const double measured =
            -lag * h / std::log(correlation(body, h, static_cast<std::size_t>(lag), 1'500'000));
        EXPECT_NEAR(measured * seen_rate, 1.0, 0.01) << "a h = " << step_by_time_scale;
    }
    // Of a step of ten correlation times nothing is left but e^-10.
    EXPECT_NEAR(correlation(body, 10.0 / seen_rate, 1, 400'000), std::exp(-10.0), 0.005);
}

TEST(SampledTurbulence, IsIsotropicInTheWorldAroundASpinningBody) {
    ImmersedBody body = test::ideal_ellipsoid();
    body.turbulence = Turbulence::constant;
    body.turbulent_kinetic_energy = level.turbulent_kinetic_energy;
    body.dissipation_rate = level.dissipation_rate;
    prepare(body);
    const Noise noise(7, "spinning", 0, 0);
    BodyState state = test::tumbling_state(0.0, 3.0);
    Matrix3d velocity = Matrix3d::Zero();
    Matrix3d rotation = Matrix3d::Zero();
    constexpr std::uint64_t steps = 100'000;
    for (std::uint64_t step = 0; step < steps; ++step) {
        state = advance(body, {.gravity = Vector3d::Zero()}, 0.0, 0.4, state, noise, step).state;
        velocity += state.sampled_turbulence.velocity * state.sampled_turbulence.velocity.transpose() / steps;
        rotation += state.sampled_turbulence.angular_velocity *
                    state.sampled_turbulence.angular_velocity.transpose() / steps;
    }
    const double variance = 2.0 / 3.0 * level.turbulent_kinetic_energy;
    EXPECT_LT((velocity / variance - Matrix3d::Identity()).cwiseAbs().maxCoeff(), 0.02);
    const Matrix3d scaled = body.length * body.length / variance * rotation;
    EXPECT_LT((scaled - Matrix3d::Identity()).cwiseAbs().maxCoeff(), 0.02);
}

TEST(SampledTurbulence, RotatesTheFasterTheSmallerTheBody) {
    // The fluid rotates over the body's length: half the length, twice the rotation.
    ImmersedBody body = test::ideal_ellipsoid();
    const Noise noise(8, "length", 0, 0);
    const SampledTurbulence large = advance_sampled_turbulence(body, level, {}, 0.1, noise, 0);
    body.length *= 0.5;
    prepare(body);
    const SampledTurbulence small = advance_sampled_turbulence(body, level, {}, 0.1, noise, 0);
    EXPECT_LT((small.angular_velocity - 2.0 * large.angular_velocity).norm(),
              1e-12 * small.angular_velocity.norm());
    EXPECT_EQ(small.velocity, large.velocity);
}

TEST(SampledTurbulence, IsStillWithoutTurbulence) {
    const ImmersedBody body = test::ideal_ellipsoid();
    const SampledTurbulence before{Vector3d(1, 2, 3), Vector3d(4, 5, 6)};
    const SampledTurbulence after = advance_sampled_turbulence(body, {}, before, 0.1, Noise(1, "", 0, 0), 0);
    EXPECT_EQ(after.velocity, Vector3d::Zero());
    EXPECT_EQ(after.angular_velocity, Vector3d::Zero());
}

TEST(BodyVelocity, DriftsAndDiffusesAsEquationEightSays) {
    const ImmersedBody body = test::ideal_ellipsoid();
    const Noise noise(5, "eq8", 0, 0);
    const double rate = (0.5 + 0.75 * 2.1) * 3.0;
    const double h = 1.0 / rate;
    Vector6d velocity = Vector6d::Zero();
    double mean_square = 0.0;
    constexpr int steps = 400'000;
    for (int step = 0; step < steps; ++step) {
        velocity = advance_body_velocity(body, level, velocity, h, noise, static_cast<std::uint64_t>(step));
        mean_square += velocity.tail<3>().squaredNorm() / 3.0 / steps;
    }
    // The balance of drift and diffusion: C_k epsilon / (2 rate), 0.506 k at C_k = 2.1.
    EXPECT_NEAR(mean_square / (2.1 * level.dissipation_rate / (2.0 * rate)), 1.0, 0.01);
    EXPECT_NEAR(mean_square / level.turbulent_kinetic_energy, 0.506, 0.01);
}

TEST(BodyVelocity, ForgetsAtTheRateOfEquationEight) {
    const ImmersedBody body = test::ideal_ellipsoid();
    const Noise noise(9, "eq8 time", 0, 0);
    const double rate = (0.5 + 0.75 * 2.1) * 3.0;
    for (const double step_by_time_scale : {0.5, 1.0, 2.0}) {
        const double h = step_by_time_scale / rate;
        Vector6d velocity = Vector6d::Zero();
        double product = 0.0;
        Matrix3d covariance = Matrix3d::Zero();
        constexpr std::uint64_t steps = 1'000'000;
        for (std::uint64_t step = 0; step < steps; ++step) {
            const Vector6d next = advance_body_velocity(body, level, velocity, h, noise, step);
            product += next.tail<3>().dot(velocity.tail<3>());
            velocity = next;
            covariance += velocity.tail<3>() * velocity.tail<3>().transpose();
        }
        EXPECT_NEAR(-std::log(product / covariance.trace()) / step_by_time_scale, 1.0, 0.01)
            << "rate h = " << step_by_time_scale;
        const double variance = covariance.trace() / 3.0;
        EXPECT_LT((covariance / variance - Matrix3d::Identity()).cwiseAbs().maxCoeff(), 0.02);
    }
}

TEST(BodyVelocity, ItsRotationDiffusesOverTheBodysLength) {
    // C_k epsilon t / L^2 for each component after the time t, from rest, whatever the steps.
    const ImmersedBody body = test::ideal_ellipsoid();
    const double time = 0.4;
    for (const std::uint64_t steps : {1U, 8U}) {
        double mean_square = 0.0;
        constexpr std::uint32_t copies = 60'000;
        for (std::uint32_t copy = 0; copy < copies; ++copy) {
            const Noise noise(10, "eq8 rotation", 0, copy);
            Vector6d velocity = Vector6d::Zero();
            for (std::uint64_t step = 0; step < steps; ++step) {
                velocity = advance_body_velocity(body, level, velocity, time / static_cast<double>(steps),
                                                 noise, step);
            }
            mean_square += velocity.head<3>().squaredNorm() / 3.0 / copies;
        }
        const double expected = 2.1 * level.dissipation_rate * time / (body.length * body.length);
        EXPECT_NEAR(mean_square / expected, 1.0, 0.015) << steps << " steps";
    }
}

TEST(TurbulenceLevel, OfATableScalesWithTheSpeed) {
    ImmersedBody body = test::blunt_ellipsoid();
    body.turbulence = Turbulence::table;
    prepare(body);
    // Above the table's Reynolds numbers, where its values are held.
    const TurbulenceLevel slow = turbulence_level(body, Vector3d(0, 10, 0));
    const TurbulenceLevel fast = turbulence_level(body, Vector3d(0, 20, 0));
    EXPECT_NEAR(slow.turbulent_kinetic_energy, 0.8 * 0.01 * 100.0, 1e-12);
    EXPECT_NEAR(slow.dissipation_rate, 0.8 * 0.008 * 1000.0 / body.length, 1e-9);
    EXPECT_NEAR(fast.turbulent_kinetic_energy / slow.turbulent_kinetic_energy, 4.0, 1e-12);
    EXPECT_NEAR(fast.dissipation_rate / slow.dissipation_rate, 8.0, 1e-12);
    EXPECT_EQ(turbulence_level(body, Vector3d::Zero()).turbulent_kinetic_energy, 0.0);
}

}  // namespace
}  // namespace samara
