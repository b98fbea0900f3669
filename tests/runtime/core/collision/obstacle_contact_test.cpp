// Bodies that touch obstacles: exact cases, and that nothing passes through.

#include "samara/core/collision/obstacle_contact.hpp"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "samara/core/collision/hull_separation.hpp"
#include "samara/core/contact/contact_impulses.hpp"
#include "support/compared_states.hpp"
#include "support/ground_bodies.hpp"
#include "support/obstacles.hpp"
#include "support/reference_step.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double gravity = 9.81;
const Fluid air = *fluid_preset("air");
const Fluid vacuum = {.density = 1e-9, .viscosity = 1e-9, .current = Vector3d::Zero(), .gust = {}};

Quaterniond turned(double degrees, const Vector3d& axis) {
    return Quaterniond(Eigen::AngleAxisd(degrees * degree, axis.normalized()));
}

const ImmersedBody& block() {
    static const ImmersedBody body =
        test::uniform_body(test::box({0.04, 0.03, 0.01}, 2), 700.0, vacuum, Loads::none);
    return body;
}

const ImmersedBody& ball() {
    static const ImmersedBody body =
        test::uniform_body(test::ellipsoid(Vector3d::Constant(0.01), 4), 2000.0, vacuum, Loads::none);
    return body;
}

const ImmersedBody& paper() {
    static const ImmersedBody body = test::uniform_body(test::box({0.1, 0.07, 0.0002}, 4), 700.0, air);
    return body;
}

/// A sheet through the origin that falls towards +x.
Obstacle slope(double degrees, double friction, const Surface& surface = test::sheet(20.0, 2.0)) {
    return test::obstacle(surface, {Vector3d::Zero(), turned(degrees, {0, 1, 0})}, friction);
}

/// At rest on the slope, its centre of mass at `height` over it.
BodyState on_slope(double degrees, double height, double x = -5.0) {
    BodyState state;
    state.orientation = turned(degrees, {0, 1, 0});
    state.position = state.orientation * Vector3d(x, 0.1, height);
    return state;
}

/// How far the body went down the slope of that angle.
double way_down(const BodyState& from, const BodyState& to, double degrees) {
    return (to.position - from.position).dot(turned(degrees, {0, 1, 0}) * Vector3d::UnitX());
}

/// The lowest point of the body (m) along a direction.
double lowest(const ImmersedBody& body, const BodyState& state, const Vector3d& up) {
    return state.position.dot(up) - reach(body.contact_points, state.orientation.conjugate() * -up);
}

TEST(HullSeparation, IsTheDistanceOfABoxFromAFaceAnEdgeAndACorner) {
    const ObstacleFaces faces(test::obstacle(test::sheet(2.0, 2.0)));
    const ContactPoints points = contact_points(test::box({0.2, 0.2, 0.2}, 1), Vector3d::Zero());
    const auto apart = [&](const Vector3d& place, const Quaterniond& turn) {
        const PlacedHull hull{&points, turn.toRotationMatrix(), place};
        double nearest = 1e9;
        faces.visit_near(Eigen::AlignedBox3d(Vector3d::Constant(-9.0), Vector3d::Constant(9.0)),
                         [&](const ObstacleTriangle& triangle) {
                             nearest = std::min(nearest, separation(hull, triangle, 100.0).gap);
                         });
        return nearest;
    };
    const Quaterniond straight = Quaterniond::Identity();
    EXPECT_NEAR(apart({0.3, 0.2, 0.5}, straight), 0.4, 1e-12);
    EXPECT_NEAR(apart({0.3, 0.2, -0.5}, straight), 0.4, 1e-12);
    EXPECT_NEAR(apart({1.5, 0.2, 0.0}, straight), 0.4, 1e-9);
    // Beside an edge the plane is a little askew, so that it stands a little nearer; where they touch it is
    // not.
    EXPECT_NEAR(apart({1.1, 0.2, 0.1}, straight), 0.0, 1e-12);
    EXPECT_NEAR(apart({1.103, 0.2, 0.104}, straight), 0.005, 2e-5);
    EXPECT_NEAR(apart({1.4, 0.2, 0.5}, straight), 0.5, 1e-6);
    EXPECT_NEAR(apart({1.4, 1.3, 0.3}, straight), std::sqrt(0.17), 2e-6);  // corners
    EXPECT_NEAR(apart({0.3, 0.2, 0.5}, turned(45, {1, 0, 0})), 0.5 - 0.1 * std::sqrt(2.0), 1e-9);
    EXPECT_NEAR(apart({0.3, 0.2, 0.09}, straight), -0.01, 1e-12);
}

TEST(HullSeparation, OfABallIsThatOfItsCentreLessItsRadius) {
    const ObstacleFaces faces(test::obstacle(test::sheet(2.0, 2.0)));
    const ContactPoints points = contact_points(test::icosphere(4), Vector3d::Zero());
    const PlacedHull hull{&points, Matrix3d::Identity(), Vector3d(2.5, 0.3, 1.0)};
    double nearest = 1e9;
    faces.visit_near(Eigen::AlignedBox3d(Vector3d::Constant(-9.0), Vector3d::Constant(9.0)),
                     [&](const ObstacleTriangle& triangle) {
                         nearest = std::min(nearest, separation(hull, triangle, 100.0).gap);
                     });
    EXPECT_NEAR(nearest, std::hypot(1.5, 1.0) - 1.0, 0.01);
}

TEST(FaceContacts, OfAStepOnAFlatSheetAreTheSameHoweverFinelyItIsCut) {
    const Surroundings whole = test::with_obstacles({test::obstacle(test::sheet(2.0, 2.0))});
    const Surroundings cut = test::with_obstacles({test::obstacle(test::sheet_of_many(2.0, 2.0, 23))});
    std::mt19937 random(1);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution(low, high)(random);
    };
    int found = 0;
    for (int i = 0; i < 500; ++i) {
        const double step = between(0.001, 0.04);
        const bool lies = i % 2 == 0;
        BodyPlace place{{between(-0.3, 0.3), between(-0.3, 0.3), 0.005}, turned(between(0, 360), {0, 0, 1})};
        if (!lies) {
            place.position.z() = between(0.0, 0.05);
            place.orientation = Quaterniond::UnitRandom();
        }
        Vector6d velocity = Vector6d::Zero();
        velocity.tail<3>() = place.orientation.conjugate() *
                             Vector3d(between(-3, 3), between(-3, 3), lies ? 0.0 : between(-1, 0));
        const double fall = -step * (place.orientation * velocity.tail<3>()).z();
        const auto gaps = [&](const Surroundings& surroundings) {
            ContactSet near(place.orientation.toRotationMatrix());
            add_obstacles(*surroundings.obstacles, block().contact_points, place, velocity, 0.0, step,
                          2.0 * step * velocity.norm(), near);
            std::map<std::array<double, 3>, double> gap_of;  // of the corners that reach the sheet
            for (const NearPoint& point : near) {
                EXPECT_NEAR((place.orientation * point.normal).z(), 1.0, 1e-9);
                if (point.gap > fall + 1e-9) continue;
                gap_of[{point.point.x(), point.point.y(), point.point.z()}] = point.gap;
            }
            return gap_of;
        };
        const auto of_whole = gaps(whole);
        const auto of_cut = gaps(cut);
        ASSERT_EQ(of_cut.size(), of_whole.size()) << "place " << i;
        for (const auto& [point, gap] : of_whole) {
            ASSERT_TRUE(of_cut.contains(point)) << "place " << i;
            EXPECT_NEAR(of_cut.at(point), gap, 1e-9);
        }
        found += static_cast<int>(of_whole.size());
    }
    EXPECT_GT(found, 1000);
}

TEST(ObstacleContact, ABlockSlidesDownASlopeWithWhatFrictionLeavesOfGravity) {
    constexpr double angle = 35.0;
    constexpr double friction = 0.4;
    const double acceleration = gravity * (std::sin(angle * degree) - friction * std::cos(angle * degree));
    const Vector3d up = turned(angle, {0, 1, 0}) * Vector3d::UnitZ();
    for (const int cuts : {1, 64}) {
        const Surroundings roof =
            test::with_obstacles({slope(angle, friction, test::sheet_of_many(20.0, 2.0, cuts))});
        for (const double x : {-5.0, -5.1, -5.2, -5.3}) {
            for (const double step : {0.001, 1.0 / 240.0, 1.0 / 24.0}) {
                if (x != -5.0 && step == 0.001) continue;  // the seams matter to long steps
                const BodyState start = on_slope(angle, 0.005, x);
                const double time = std::round(1.0 / step) * step;
                const BodyState end = test::flown(block(), roof, start, time, step);
                const double way = 0.5 * acceleration * time * time;
                EXPECT_NEAR(way_down(start, end, angle), way, 0.01 * way)
                    << "step " << step << ", cuts " << cuts << ", from " << x;
                EXPECT_NEAR(lowest(block(), end, up), 0.0, 1e-6)
                    << "step " << step << ", cuts " << cuts << ", from " << x;
            }
        }
    }
}

TEST(ObstacleContact, FrictionEnoughHoldsABlockOnASlopeAtRest) {
    for (const double step : {0.001, 1.0 / 24.0}) {
        const BodyState start = on_slope(25.0, 0.005);
        const BodyState end =
            test::flown(block(), test::with_obstacles({slope(25.0, 0.5)}), start, 5.0, step);
        EXPECT_TRUE(end.at_rest);
        EXPECT_LT((end.position - start.position).norm(), 1e-9);
    }
}

TEST(ObstacleContact, ABallRollsDownASlopeWithFiveSeventhsOfGravitysShare) {
    constexpr double angle = 15.0;
    // Rolling resistance takes what a lever of half a percent of the radius does.
    const double acceleration =
        5.0 / 7.0 * gravity * (std::sin(angle * degree) - rolling_resistance * std::cos(angle * degree));
    const double height = reach(ball().contact_points, -Vector3d::UnitZ());
    for (const double step : {0.0005, 0.001}) {
        const BodyState start = on_slope(angle, height);
        const BodyState end =
            test::flown(ball(), test::with_obstacles({slope(angle, 0.6)}), start, 1.0, step);
        EXPECT_NEAR(way_down(start, end, angle), 0.5 * acceleration, 6.0 * step * 0.5 * acceleration) << step;
    }
}

TEST(ObstacleContact, ACoinOnItsEdgeFallsOver) {
    const ImmersedBody coin = test::uniform_body(test::disc(0.012, 0.002), 7000.0, air);
    BodyState start;
    start.orientation = turned(80.0, {1, 0, 0});
    start.position.z() = reach(coin.contact_points, start.orientation.conjugate() * -Vector3d::UnitZ());
    const Surroundings table = test::with_obstacles(
        {test::obstacle(test::box({1.0, 1.0, 0.1}, 4), {Vector3d(0, 0, -0.05), turned(0, {0, 0, 1})})});
    const BodyState end = test::flown(coin, table, start, 4.0, 0.001);
    EXPECT_TRUE(end.at_rest);
    EXPECT_NEAR(std::abs((end.orientation * Vector3d::UnitZ()).z()), 1.0, 1e-6);
    EXPECT_NEAR(end.position.z(), 0.001, 1e-6);
}

TEST(ObstacleContact, ASheetThatFallsDoesNotPassAThinPlateAtAFilmsFrame) {
    const Surroundings plate = test::with_obstacles({test::obstacle(test::sheet(2.0, 2.0))});
    for (int i = 0; i < 40; ++i) {
        BodyState state;
        state.orientation = turned(37.0 * i, Vector3d(1.0, 0.3 * i, 0.2));
        state.position = {0.01 * i, -0.02, 0.06 + 0.03 * i};
        state.velocity << 0.5 * i, -3.0, 0.2 * i,
            state.orientation.conjugate() * Vector3d(0.1, 0.0, -0.5 * i);
        const Noise noise(1, "body", 0, 0);
        for (std::uint64_t k = 0; k < 240; ++k) {
            state = advance(paper(), plate, 0.0, 1.0 / 24.0, state, noise, k).state;
            if (state.position.head<2>().lpNorm<Eigen::Infinity>() > 0.9) break;
            ASSERT_GT(lowest(paper(), state, Vector3d::UnitZ()), -0.001) << i << " at step " << k;
        }
    }
}

TEST(ObstacleContact, ABodyOnAnObstacleRestsAsOnTheGroundToTheLastBit) {
    Surroundings ground;
    ground.ground = 0.0;
    const Surroundings sheet = test::with_obstacles({test::obstacle(test::sheet(1.0, 1.0))});
    BodyState start;
    start.position = {0.1, 0.05, 0.02};
    start.orientation = turned(12.0, {1, 1, 0});
    const ImmersedBody body = test::uniform_body(test::box({0.04, 0.03, 0.01}, 2), 700.0, air);
    for (const double step : {0.002, 1.0 / 24.0}) {
        const BodyState end = test::flown(body, sheet, start, 3.0, step);
        EXPECT_TRUE(end.at_rest) << step;
        EXPECT_NEAR(end.position.z(), test::flown(body, ground, start, 3.0, step).position.z(), 1e-5);
        const BodyState later = test::flown(body, sheet, end, 10.0, step);
        EXPECT_EQ(later.position, end.position);
        EXPECT_EQ(later.orientation.coeffs(), end.orientation.coeffs());
        EXPECT_EQ(advance(body, sheet, 0.0, step, end, Noise(1, "body", 0, 0), 7).substeps, 0);
    }
}

TEST(ObstacleContact, ABlockLiesOverATablesEdgeUntilItsCentreIsBeyondIt) {
    const Obstacle table =
        test::obstacle(test::box({1.0, 1.0, 0.1}, 1), {Vector3d(-0.5, 0.0, -0.05), turned(0, {0, 0, 1})});
    const ImmersedBody body = test::uniform_body(test::box({0.04, 0.03, 0.01}, 2), 700.0, air);
    for (const double over : {-0.002, 0.002}) {
        BodyState start;
        start.position = {over, 0.0, 0.005};
        const BodyState end = test::flown(body, test::with_obstacles({table}), start, 1.0, 0.002);
        EXPECT_EQ(end.at_rest, over < 0.0) << over;
        EXPECT_EQ(end.position.z() < -0.2, over > 0.0) << over;
    }
}

TEST(ObstacleContact, ABodyFallsPastATablesEdgeUntouched) {
    const Obstacle table =
        test::obstacle(test::box({1.0, 1.0, 0.1}, 3), {Vector3d(-0.5, 0.0, -0.05), turned(0, {0, 0, 1})});
    BodyState start;
    start.position = {0.025, 0.0, 0.3};
    for (const double step : {0.002, 1.0 / 24.0}) {
        const BodyState past = test::flown(block(), test::with_obstacles({table}), start, 0.5, step);
        const BodyState alone = test::flown(block(), Surroundings(), start, 0.5, step);
        EXPECT_EQ(past.position, alone.position) << step;
        EXPECT_EQ(past.velocity, alone.velocity) << step;
    }
}

TEST(ObstacleContact, AMovingObstacleLiftsABodyAndTurnsItAlong) {
    Obstacle hand = test::obstacle(test::box({0.3, 0.3, 0.02}, 2));
    hand.keys = {{{Vector3d(0, 0, -0.01), Quaterniond::Identity()}, 0.0},
                 {{Vector3d(0, 0, 0.49), turned(90, {0, 0, 1})}, 1.0}};
    const ImmersedBody body = test::uniform_body(test::box({0.04, 0.03, 0.01}, 2), 700.0, air);
    for (const double step : {0.002, 1.0 / 24.0}) {
        BodyState start;
        start.position = {0.02, 0.0, 0.0051};
        const Surroundings surroundings = test::with_obstacles({hand});
        const Noise noise(1, "body", 0, 0);
        BodyState end = start;
        const auto steps = static_cast<std::uint64_t>(std::llround(3.0 / step));
        for (std::uint64_t i = 0; i < steps; ++i) {
            end = advance(body, surroundings, 0.0, step, end, noise, i).state;
        }
        EXPECT_NEAR(end.position.z(), 0.505, 1e-3) << step;
        EXPECT_LT(end.velocity.norm(), 1e-6) << step;
        EXPECT_NEAR(end.position.y(), 0.02, 0.01) << step;
    }
}

TEST(ObstacleContact, AddsNoEnergyOnAFaceThatStandsStill) {
    const double weight = block().mass * gravity;
    const Surroundings roof = test::with_obstacles({slope(20.0, 0.5, test::sheet(20.0, 20.0))});
    for (int i = 0; i < 30; ++i) {
        BodyState state;
        state.orientation = turned(31.0 * i, Vector3d(1.0, 0.2 * i, -0.3));
        state.position = {-5.0, 0.02, 1.9};
        state.velocity << 0.5 * i, -5.0, 3.0, 0.3, 0.1 * i, -1.0;
        constexpr double step = 0.001;
        const auto energy = [&](const BodyState& of) {
            return kinetic_energy(block(), of) + weight * of.position.z();
        };
        const Noise noise(1, "body", 0, 0);
        for (std::uint64_t k = 0; k < 500; ++k) {
            const BodyState before = state;
            state = advance(block(), roof, 0.0, step, state, noise, k).state;
            // What lifting makes, as over the ground (GroundRest).
            ASSERT_LT(energy(state) - energy(before),
                      2.0 * step * weight * block().contact_points.bounding_radius)
                << i << " at step " << k;
        }
    }
}

TEST(ObstacleContact, InABatchIsThatOfABodyAloneToTheLastBitForAnyThreads) {
    Surroundings surroundings = test::with_obstacles(
        {slope(20.0, 0.3, test::sheet_of_many(0.5, 0.5, 8)),
         test::obstacle(test::box({0.1, 0.1, 0.1}, 2), {Vector3d(0.2, 0.0, -0.2), turned(30, {1, 1, 0})})});
    surroundings.current = {0.05, 0.02, 0.0};
    surroundings.gust = {.amplitude = Vector3d(0.1, 0.0, 0.02), .period = 0.7};
    surroundings.ground = -0.5;
    std::vector<BodyState> starts(37);
    for (std::size_t i = 0; i < starts.size(); ++i) {
        const auto number = static_cast<double>(i);
        starts[i].orientation = turned(10.0 * number, Vector3d(1, 2, 3));
        starts[i].position = {0.01 * number - 0.2, 0.0, 0.2 + 0.01 * number};
        starts[i].velocity << 1.0, 2.0, 3.0, 0.1, 0.0, -0.2;
    }
    for (const int threads : {1, 2}) test::expect_batch_as_alone(paper(), surroundings, starts, threads);
}

}  // namespace
}  // namespace samara
