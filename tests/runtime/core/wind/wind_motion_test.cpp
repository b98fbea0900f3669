// What a wind does to a body, by statements that need little theory of its forces.
#include <cmath>
#include <memory>
#include <numbers>

#include <gtest/gtest.h>

#include "samara/core/integrator/batch.hpp"
#include "samara/core/integrator/step.hpp"
#include "support/compared_states.hpp"
#include "support/known_bodies.hpp"

namespace samara {
namespace {

using test::distance;
using test::numbers_of;

constexpr double pi = std::numbers::pi;
constexpr double h = 0.002;

Surroundings in(const Wind& wind, const Vector3d& gravity = Vector3d(0.0, 0.0, -9.81),
                const Vector3d& current = Vector3d::Zero()) {
    Surroundings surroundings;
    surroundings.gravity = gravity;
    surroundings.current = current;
    surroundings.wind = std::make_shared<const WindField>(wind, current);
    return surroundings;
}

BodyState flown(const ImmersedBody& body, const Surroundings& surroundings, const BodyState& start, int steps,
                double step = h) {
    const Noise noise(1, "leaf", 0, 0);
    BodyState state = start;
    for (int i = 0; i < steps; ++i) {
        state = advance(body, surroundings, 0.0, step, state, noise, static_cast<std::uint64_t>(i)).state;
    }
    return state;
}

Vector3d world_velocity(const BodyState& state) {
    return state.orientation * state.velocity.tail<3>();
}

ImmersedBody sphere(double density, Loads loads) {
    SceneBody given = test::scene_body(density);
    given.loads = loads;
    return make_immersed_body(test::exact_sphere(0.01), given, Fluid{});
}

ImmersedBody noisy_ellipsoid(Turbulence turbulence, Langevin langevin = Langevin::sampled_turbulence) {
    ImmersedBody body = test::lopsided_body(Vector3d(0.001, -0.002, 0.003));
    body.turbulence = turbulence;
    body.turbulent_kinetic_energy = 0.003;
    body.dissipation_rate = 0.02;
    body.langevin = langevin;
    prepare(body);
    return body;
}

Wind vortex(double circulation, double core, WindVortex::Core type = WindVortex::Core::rankine) {
    Wind wind;
    wind.vortices.push_back({.type = type, .circulation = circulation, .core = core});
    return wind;
}

Wind storm() {
    Wind wind = vortex(0.4, 0.3, WindVortex::Core::lamb_oseen);
    wind.velocity = Vector3d(0.3, 0.1, 0.0);
    wind.profile = WindProfile{.height = 2.0, .ground = -3.0};
    wind.gusts = WindGusts{.rms = 0.1, .length = 0.8};
    wind.fans.push_back({.position = Vector3d(-0.5, 0.0, 0.0), .diameter = 0.4, .speed = 0.5});
    return wind;
}

TEST(WindMotion, AWindWithoutVelocityGivesTheBytesOfNone) {
    Wind calm;
    calm.function = [](void*, double, std::size_t, const double*, double*) {};
    Surroundings still;
    still.current = Vector3d(0.3, -0.1, 0.2);
    for (const ImmersedBody& body : {noisy_ellipsoid(Turbulence::table), test::blunt_ellipsoid()}) {
        const BodyState start = test::tumbling_state(0.2, 3.0);
        const BodyState without = flown(body, still, start, 200);
        const BodyState with = flown(body, in(calm, still.gravity, still.current), start, 200);
        EXPECT_EQ(numbers_of(with), numbers_of(without));
    }
}

TEST(WindMotion, AUniformWindThatSwingsMovesABodyAsTheSameGust) {
    static const Gust gust = {.amplitude = Vector3d(0.2, 0.1, -0.15), .period = 0.4};
    Surroundings gusty;
    gusty.gust = gust;
    Wind wind;
    wind.function = [](void*, double time, std::size_t count, const double*, double* velocities) {
        for (std::size_t i = 0; i < count; ++i) {
            Eigen::Map<Vector3d>(velocities + 3 * i) =
                std::sin(2.0 * pi * time / gust.period) * gust.amplitude;
        }
    };
    for (const ImmersedBody& body : {test::blunt_ellipsoid(Vector3d(0.002, 0.001, -0.004)),
                                     test::lopsided_body(), sphere(300.0, Loads::none)}) {
        const BodyState start = test::tumbling_state(0.2, 5.0);
        constexpr int steps = 150;
        BodyState in_gust = flown(body, gusty, start, steps);
        in_gust.position += flow_displacement(gusty, steps * h);
        in_gust.velocity.tail<3>() += in_gust.orientation.conjugate() * flow_velocity(gusty, steps * h);
        const BodyState in_wind = flown(body, in(wind), start, steps);
        EXPECT_LT(distance(in_wind, in_gust), 2e-5);
        EXPECT_GT(distance(in_wind, flown(body, Surroundings{}, start, steps)), 1e-2);
    }
}

TEST(WindMotion, IsTheSameSeenFromAFrameThatMoves) {
    // A wind that drifts with a current is, in the frame of the current, a wind that stands still.
    const Vector3d current(0.7, -0.4, 0.2);
    Wind standing = vortex(0.5, 0.3, WindVortex::Core::lamb_oseen);
    standing.gusts = WindGusts{.rms = 0.2, .length = 0.5};
    Wind drifting = standing;
    drifting.vortices[0].velocity = current;
    for (const ImmersedBody& body :
         {noisy_ellipsoid(Turbulence::table), noisy_ellipsoid(Turbulence::table, Langevin::wake),
          noisy_ellipsoid(Turbulence::constant, Langevin::body_velocity)}) {
        BodyState start = test::tumbling_state(0.1, 2.0);
        start.position = Vector3d(0.2, 0.1, 0.0);
        const BodyState at_home = flown(body, in(standing), start, 200);
        const BodyState carried = flown(body, in(drifting, Vector3d(0.0, 0.0, -9.81), current), start, 200);
        EXPECT_LT(distance(at_home, carried), 1e-8);
    }
}

TEST(WindMotion, ANeutralBodyGoesRoundWithAVortexAHeavyOneOutwardsALightOneInwards) {
    const double circulation = 0.3;
    const Surroundings round = in(vortex(circulation, 0.05, WindVortex::Core::lamb_oseen), Vector3d::Zero());
    const double radius = 0.2;
    const double speed = circulation / (2.0 * pi * radius) * -std::expm1(-16.0);
    BodyState start;
    start.position = Vector3d(radius, 0.0, 0.0);
    start.velocity.tail<3>() = Vector3d(0.0, speed, 0.0);
    const int turn = static_cast<int>(std::lround(2.0 * pi * radius / speed / h));
    const double density = Fluid{}.density;
    const auto radius_after = [&](double of_body, Loads loads) {
        return flown(sphere(of_body, loads), round, start, turn).position.norm();
    };
    for (const Loads loads : {Loads::none, Loads::coefficients}) {
        const BodyState neutral = flown(sphere(density, loads), round, start, turn);
        EXPECT_LT((neutral.position - start.position).norm(), 0.01 * radius);
        EXPECT_NEAR(neutral.position.norm(), radius, 1e-4 * radius);
        EXPECT_GT(radius_after(2.0 * density, loads), 1.01 * radius);
        EXPECT_LT(radius_after(0.5 * density, loads), 0.99 * radius);
    }
}

TEST(WindMotion, ABodyTakesUpTheTurningOfTheAir) {
    // In the core the air rotates as a solid, with G/(2 pi core^2).
    const double circulation = 0.05;
    const Surroundings round = in(vortex(circulation, 0.1), Vector3d::Zero());
    const BodyState spun = flown(sphere(Fluid{}.density, Loads::coefficients), round, BodyState{}, 20'000);
    const double turning = circulation / (2.0 * pi * 0.01);
    EXPECT_NEAR(spun.velocity[2], turning, 0.05 * turning);
    EXPECT_LT(spun.position.norm(), 1e-9);
}

TEST(WindMotion, WhatFallsThroughShearRunsAheadOfTheWindBelow) {
    // (m + m_a) s V = drag of the relative velocity w: w = (m + m_a) s V^2/((m - rho V) g), while w is much
    // less than V.
    static const double shear = 0.2;
    Wind wind;
    wind.function = [](void*, double, std::size_t count, const double* places, double* velocities) {
        for (std::size_t i = 0; i < count; ++i) velocities[3 * i] = shear * places[3 * i + 2];
    };
    const ImmersedBody body = sphere(1500.0, Loads::coefficients);
    const Surroundings surroundings = in(wind);
    const BodyState falling = flown(body, surroundings, BodyState{}, 2000);
    const double fall = -world_velocity(falling).z();
    const double slip = world_velocity(falling).x() - shear * falling.position.z();
    const double displaced = body.fluid_density * body.volume;
    const double expected =
        (body.mass + 0.5 * displaced) * shear * fall * fall / ((body.mass - displaced) * 9.81);
    EXPECT_NEAR(slip, expected, 0.01 * expected);
    // And as fast as in still fluid.
    const double still = -world_velocity(flown(body, Surroundings{}, BodyState{}, 2000)).z();
    EXPECT_NEAR(fall, still, 1e-3 * still);
}

TEST(WindMotion, IsOfSecondOrderInTheStep) {
    const ImmersedBody body = test::smooth_ellipsoid();
    const Surroundings surroundings = in(storm());
    const BodyState start = test::tumbling_state(0.1, 1.0);
    const BodyState best = flown(body, surroundings, start, 6400, 0.4 / 6400);
    const double coarse = distance(flown(body, surroundings, start, 200, 0.4 / 200), best);
    const double fine = distance(flown(body, surroundings, start, 400, 0.4 / 400), best);
    EXPECT_GT(coarse / fine, 3.3);
    EXPECT_GT(distance(best, flown(body, Surroundings{}, start, 400, 0.4 / 400)), 1e-2);
}

TEST(WindMotion, SideBySideIsToTheLastBitThatOfEachAlone) {
    const Surroundings surroundings = in(storm(), Vector3d(0.0, 0.0, -9.81), Vector3d(0.1, 0.0, 0.0));
    for (const ImmersedBody& body : {noisy_ellipsoid(Turbulence::table), noisy_ellipsoid(Turbulence::none),
                                     noisy_ellipsoid(Turbulence::table, Langevin::wake),
                                     noisy_ellipsoid(Turbulence::constant, Langevin::body_velocity)}) {
        constexpr std::size_t count = 37;
        const auto start_of = [](std::size_t i) {
            BodyState state = test::tumbling_state(0.05, 0.1 * static_cast<double>(i));
            state.position = Vector3d(0.03 * static_cast<double>(i), -0.1, 0.2);
            return state;
        };
        const auto noise_of = [](std::size_t i) {
            return Noise(7, "leaf", 1, static_cast<std::uint32_t>(i));
        };
        SCOPED_TRACE(static_cast<int>(body.turbulence));
        Batch whole(body, count);
        Batch cut(body, count);
        for (std::size_t i = 0; i < count; ++i) {
            whole.set_state(i, start_of(i));
            whole.set_noise(i, noise_of(i));
            cut.set_state(i, start_of(i));
            cut.set_noise(i, noise_of(i));
        }
        whole.advance(surroundings, 0.5, h, 3, 50);
        cut.advance(surroundings, 0.5, h, 3, 17, 0);
        cut.advance(surroundings, 0.5, h, 20, 33, 0);
        for (std::size_t i = 0; i < count; ++i) {
            BodyState state = start_of(i);
            for (std::uint64_t step = 3; step < 53; ++step) {
                state = advance(body, surroundings, 0.5, h, state, noise_of(i), step).state;
            }
            ASSERT_EQ(numbers_of(whole.state(i)), numbers_of(state)) << "body " << i;
            ASSERT_EQ(numbers_of(cut.state(i)), numbers_of(state)) << "body " << i;
        }
    }
}

TEST(WindMotion, AFileOfOneVelocityIsACurrent) {
    const Vector3d velocity(0.5, -0.25, 0.125);
    auto grid = std::make_shared<WindGrid>();
    grid->nodes = {3, 4, 5};
    for (std::size_t i = 0; i < grid->size(); ++i) {
        grid->velocities.push_back(static_cast<float>(velocity[static_cast<Eigen::Index>(i % 3)]));
    }
    Wind wind;
    wind.file = WindFile{.grid = grid};
    const ImmersedBody body = noisy_ellipsoid(Turbulence::constant);
    BodyState start;
    start.position = Vector3d(0.3, 0.4, 1.7);
    const BodyState in_file = flown(body, in(wind), start, 500);
    Surroundings current = in(wind);
    current.wind = nullptr;
    current.current = velocity;
    // The flow's frame moves with the current, which in it is at rest.
    BodyState relative = start;
    relative.velocity.tail<3>() -= relative.orientation.conjugate() * velocity;
    const BodyState in_current = flown(body, current, relative, 500);
    const Vector3d drift = 500 * h * velocity;
    EXPECT_LT((in_file.position - in_current.position - drift).norm(), 1e-9 * drift.norm());
}

}  // namespace
}  // namespace samara
