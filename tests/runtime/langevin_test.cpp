#include "samara/dynamics/langevin.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "support/known_bodies.hpp"

namespace samara {
namespace {

constexpr TurbulenceLevel level = {.turbulent_kinetic_energy = 0.03, .dissipation_rate = 0.09};
constexpr double seen_rate = 0.75 * 2.1 * 3.0;  // a = 3/4 C_k epsilon/k

TEST(SeenFluid, HasTheVarianceOfTheTurbulenceWhateverTheStep) {
    const ImmersedBody body = test::ideal_ellipsoid();
    const Noise noise(3, "variance", 0, 0);
    for (const double step_by_time_scale : {0.1, 1.0, 10.0}) {
        const double h = step_by_time_scale / seen_rate;
        SeenFluid seen;
        double velocity = 0.0;
        double rotation = 0.0;
        constexpr int steps = 400'000;
        for (int step = -200; step < steps; ++step) {
            seen = advance_seen_fluid(body, level, seen, h, noise, static_cast<std::uint64_t>(step + 200));
            if (step < 0) continue;
            velocity += seen.velocity.squaredNorm() / 3.0 / steps;
            rotation += seen.angular_velocity.squaredNorm() / 3.0 / steps;
        }
        const double variance = 2.0 / 3.0 * level.turbulent_kinetic_energy;
        EXPECT_NEAR(velocity / variance, 1.0, 0.01) << "a h = " << step_by_time_scale;
        EXPECT_NEAR(rotation * body.length * body.length / variance, 1.0, 0.01);
    }
}

TEST(SeenFluid, ForgetsAtTheRateOfTheTurbulence) {
    const ImmersedBody body = test::ideal_ellipsoid();
    const Noise noise(4, "correlation", 0, 0);
    const double h = 0.2 / seen_rate;
    constexpr int steps = 400'000;
    constexpr int lag = 5;  // one correlation time
    SeenFluid seen;
    std::vector<Vector3d> history;
    for (int step = 0; step < steps; ++step) {
        seen = advance_seen_fluid(body, level, seen, h, noise, static_cast<std::uint64_t>(step));
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

TEST(SeenFluid, IsStillWithoutTurbulence) {
    const ImmersedBody body = test::ideal_ellipsoid();
    const SeenFluid before{Vector3d(1, 2, 3), Vector3d(4, 5, 6)};
    const SeenFluid after = advance_seen_fluid(body, {}, before, 0.1, Noise(1, "", 0, 0), 0);
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
