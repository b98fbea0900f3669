#include "foam-cases/falls/motion_error.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "converter/tables/direction_sampling.hpp"
#include "converter/tables/symmetric_loads.hpp"
#include "support/hard_bodies.hpp"
#include "support/known_bodies.hpp"
#include "test_bodies.hpp"

namespace samara {
namespace {

constexpr double reynolds_number = 1e4;

/// The rubber ellipsoid with blunt tables and an ellipsoid's symmetry.
Body body_with_tables() {
    Body body = test::baked_ellipsoid({0.01, 0.02, 0.04});
    body.symmetry = test::ellipsoid({0.01, 0.02, 0.04}).symmetry;
    return body;
}

/// A fall without noise that is over before it could turn chaotic.
Scene short_scene() {
    Scene scene;
    scene.duration = 0.4;
    scene.fluid = test::water();
    SceneBody body = test::scene_body(1200.0);
    body.orientation = Quaterniond(0.8, 0.0, -0.55, 0.1).normalized();
    scene.bodies = {body};
    return scene;
}

/// Every direction of the tables uncertain by `error` in each component of force and moment.
UncertainTables all_uncertain(const Body& body, double error) {
    UncertainTables uncertain;
    LoadEntryError one;
    one.force.setConstant(error);
    one.moment.setConstant(error);
    uncertain.sampling_errors.assign(body.tables->entries.size(), one);
    uncertain.reynolds_number = reynolds_number;
    uncertain.unsolved = required_directions(body.symmetry, body.tables->subdivisions);
    return uncertain;
}

MotionError error_of(const Scene& scene, const UncertainTables& uncertain, int falls, int draws) {
    const Body body = body_with_tables();
    return motion_error(scene, 0, body, uncertain, simulate_for_bake(scene, 0, body, falls), falls, draws);
}

double descent_error(const MotionError& error) {
    return error.metrics[Metric::descent_speed]->of_table;
}

TEST(MotionError, VanishesForExactTables) {
    // One fall has no chance of its own; exact tables draw themselves.
    const MotionError error = error_of(short_scene(), all_uncertain(body_with_tables(), 0.0), 1, 4);
    for (const auto& measure : error.metrics) {
        if (measure) {
            EXPECT_EQ(measure->of_table, 0.0);
        }
    }
    EXPECT_EQ(error.worst(0.1), 0.0);
    EXPECT_EQ(error.worst_chance(0.1), 0.0);
}

TEST(MotionError, VanishesWhereEveryDirectionIsSolved) {
    UncertainTables uncertain = all_uncertain(body_with_tables(), 0.1);
    std::swap(uncertain.solved, uncertain.unsolved);
    EXPECT_EQ(error_of(short_scene(), uncertain, 3, 4).worst(0.1), 0.0);
}

TEST(MotionError, GrowsInProportionToSmallErrorsOfTheTables) {
    const Body body = body_with_tables();
    const double small = descent_error(error_of(short_scene(), all_uncertain(body, 0.002), 1, 8));
    const double large = descent_error(error_of(short_scene(), all_uncertain(body, 0.004), 1, 8));
    EXPECT_GT(small, 1e-5);
    EXPECT_NEAR(large / small, 2.0, 0.1);
}

TEST(MotionError, OfABallsSpeedIsHalfThatOfItsDrag) {
    // At the terminal speed drag and speed squared are one product. A ball's tables have one direction, so
    // that every draw changes all of them alike.
    constexpr double drag_error = 0.01;  // of a coefficient of 0.5: 2 %
    Scene scene = short_scene();
    scene.duration = 6.0;
    scene.bodies[0].mass.density = 1300.0;
    Body ball = test::baked_sphere(0.02, 8);
    ball.symmetry.type = Symmetry::Type::spherical;
    UncertainTables uncertain = all_uncertain(ball, 0.0);
    for (LoadEntryError& error : uncertain.sampling_errors) error.force.setConstant(drag_error);
    ASSERT_EQ(uncertain.unsolved.size(), 1U);
    constexpr int draws = 40;
    const MotionError error =
        motion_error(scene, 0, ball, uncertain, simulate_for_bake(scene, 0, ball, 1), 1, draws);
    // Neither its inclination nor its rotation is relevant.
    EXPECT_FALSE(error.metrics[Metric::inclination_amplitude]);
    EXPECT_FALSE(error.metrics[Metric::rms_angular_speed]);
    // 1 %, as far as that many draws can tell.
    EXPECT_NEAR(descent_error(error), 0.5 * drag_error / 0.5, 0.01 * 3.0 / std::sqrt(2.0 * draws));
}

TEST(MotionError, StatesWhatChanceMakesOfIt) {
    Scene scene = short_scene();
    scene.bodies[0].turbulence = Turbulence::table;
    const Body body = body_with_tables();
    const SampledFalls simulation = simulate_for_bake(scene, 0, body, 4);
    constexpr int draws = 3;
    const MotionError error = motion_error(scene, 0, body, all_uncertain(body, 0.0), simulation, 4, draws);
    const Estimate descent = *simulation.mean(Metric::descent_speed);
    const auto& of_descent = *error.metrics[Metric::descent_speed];
    ASSERT_GT(*descent.error, 0.0);
    EXPECT_DOUBLE_EQ(of_descent.of_chance, *descent.error / std::abs(descent.value));
    // Exact tables: what is left is what three draws cannot tell from chance.
    EXPECT_NEAR(of_descent.of_table, of_descent.of_chance * std::sqrt(2.0) * std::pow(2.0 / draws, 0.25),
                1e-12);
}

TEST(MotionError, TheWorstIsTheLargestShareOfWhatIsAllowed) {
    MotionError error;
    EXPECT_EQ(error.worst(0.1), 0.0);
    error.metrics[Metric::descent_speed] = {0.05, 0.01, 0.0};
    error.metrics[Metric::frequency] = {0.12, 0.05, 0.0};
    EXPECT_DOUBLE_EQ(error.worst(0.1), 0.6);  // 0.12 of 0.2
    EXPECT_DOUBLE_EQ(error.worst_chance(0.1), 0.25);
    // An amplitude of which a degree is all: allowed.
    error.metrics[Metric::inclination_amplitude] = {0.9, 0.0, 1.0};
    EXPECT_DOUBLE_EQ(error.worst(0.1), 0.9);
}

TEST(DrawnTables, AgreeWithTheTablesWhereCasesAreSolvedAndDifferElsewhereByTheirErrors) {
    const Body body = body_with_tables();
    const LoadTables& tables = *body.tables;
    constexpr double error = 0.02;
    UncertainTables uncertain = all_uncertain(body, error);
    for (std::size_t i = 0; i < uncertain.unsolved.size(); i += 2)
        uncertain.solved.push_back(uncertain.unsolved[i]);
    std::erase_if(uncertain.unsolved, [&](const Vector3d& direction) {
        return std::find(uncertain.solved.begin(), uncertain.solved.end(), direction) !=
               uncertain.solved.end();
    });
    ASSERT_GE(uncertain.unsolved.size(), 3U);
    double square = 0.0;
    double count = 0.0;
    for (std::uint32_t draw = 0; draw < 20; ++draw) {
        const LoadTables drawn = drawn_tables(tables, body.symmetry, uncertain, draw);
        const auto difference = [&](const Vector3d& direction) {
            return plus(look_up(drawn, direction, reynolds_number), -1.0,
                        look_up(tables, direction, reynolds_number));
        };
        for (const Vector3d& direction : uncertain.solved) {
            EXPECT_LT(difference(direction).force.norm() + difference(direction).moment.norm(), 1e-9);
        }
        for (const Vector3d& direction : uncertain.unsolved) {
            // A component that a mirror takes away is no part of it.
            for (int axis = 0; axis < 3; ++axis) {
                if (std::abs(direction[axis]) < 1e-9) {
                    EXPECT_NEAR(difference(direction).force[axis], 0.0, 1e-12);
                    continue;
                }
                square += std::pow(difference(direction).force[axis], 2);
                count += 1.0;
            }
        }
    }
    EXPECT_NEAR(std::sqrt(square / count), error, 4.0 * error / std::sqrt(2.0 * count));
}

TEST(DrawnTables, AreTheSameForTheSameNumber) {
    const Body body = body_with_tables();
    const UncertainTables uncertain = all_uncertain(body, 0.02);
    const auto force = [&](std::uint32_t draw) {
        return drawn_tables(*body.tables, body.symmetry, uncertain, draw).entries[5].force;
    };
    EXPECT_EQ(force(3), force(3));
    EXPECT_NE(force(3), force(4));
}

}  // namespace
}  // namespace samara
