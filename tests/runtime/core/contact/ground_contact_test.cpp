#include "samara/core/contact/ground_contact.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "support/compared_states.hpp"
#include "support/ground_bodies.hpp"
#include "support/known_bodies.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

const Fluid water = *fluid_preset("water");
constexpr double degree = std::numbers::pi / 180.0;

Surroundings ground_at_zero(const Vector3d& current = Vector3d::Zero()) {
    Surroundings surroundings;
    surroundings.current = current;
    surroundings.ground = 0.0;
    return surroundings;
}

Quaterniond turned(double degrees, const Vector3d& axis) {
    return Quaterniond(Eigen::AngleAxisd(degrees * degree, axis.normalized()));
}

const ImmersedBody& cube() {
    static const ImmersedBody body = test::uniform_body(test::box({0.02, 0.02, 0.02}, 2), 1500.0, water);
    return body;
}

const ImmersedBody& ball() {
    static const ImmersedBody body =
        test::uniform_body(test::ellipsoid(Vector3d::Constant(0.01), 3), 1500.0, water);
    return body;
}

/// The world's velocity of a state in a uniform current.
Vector3d world_velocity(const BodyState& state, const Vector3d& current) {
    return state.orientation * state.velocity.tail<3>() + current;
}

TEST(ContactPoints, AreTheCornersOfABox) {
    const ContactPoints points = contact_points(test::box({2.0, 4.0, 6.0}, 3), Vector3d(0.5, 0.0, 0.0));
    EXPECT_TRUE(points.round.empty());
    EXPECT_NEAR(points.bounding_radius, std::sqrt(1.5 * 1.5 + 4.0 + 9.0), 1e-12);
    EXPECT_NEAR(reach(points, Vector3d::UnitX()), 0.5, 1e-12);
    EXPECT_NEAR(reach(points, -Vector3d::UnitX()), 1.5, 1e-12);
    EXPECT_NEAR(reach(points, Vector3d::UnitZ()), 3.0, 1e-12);
    EXPECT_LE(points.corners.size(), 12U);
}

TEST(ContactPoints, OfASphereLieUnderItsCentreWhateverItsTurn) {
    const ContactPoints points = contact_points(test::icosphere(3), Vector3d::Zero());
    EXPECT_TRUE(points.corners.empty());
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    double height_error = 0.0;
    double arm = 0.0;
    for (int i = 0; i < 1000; ++i) {
        const Vector3d down = Vector3d(normal(random), normal(random), normal(random)).normalized();
        const Vector3d lowest = lowest_round_point(points, down);
        height_error = std::max(height_error, std::abs(lowest.dot(down) - 1.0));
        arm = std::max(arm, lowest.cross(down).norm());
    }
    EXPECT_LT(height_error, 0.01);
    EXPECT_LT(arm, 0.015);  // its mesh alone would give 0.07
}

TEST(ContactPoints, AreBoundedInNumberAndStayOnTheHull) {
    const Surface disc = test::disc(1.0, 0.1);
    const ContactPoints points = contact_points(disc, Vector3d::Zero());
    EXPECT_LE(points.corners.size(), most_corners);
    for (const Vector3d& corner : points.corners) {
        EXPECT_NEAR(corner.head<2>().norm(), 1.0, 1e-12);
        EXPECT_NEAR(std::abs(corner.z()), 0.05, 1e-12);
    }
    EXPECT_NEAR(reach(points, Vector3d::UnitZ()), 0.05, 1e-12);
}

TEST(GroundContact, LeavesABodyAboveTheGroundAlone) {
    const BodyState before = test::above_ground(cube(), turned(20, Vector3d(1, 2, 3)), 1.0);
    BodyState state = before;
    state.velocity << 1, 2, 3, 0.4, 0.5, -0.6;
    BodyState touched = state;
    touch_ground(cube(), {}, 0.01, before, touched);
    EXPECT_EQ(touched.velocity, state.velocity);
    EXPECT_EQ(touched.position, state.position);
}

TEST(GroundContact, NeverAddsEnergyRelativeToTheGround) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    const auto vector = [&] { return Vector3d(normal(random), normal(random), normal(random)); };
    const ImmersedBody plate = test::uniform_body(test::box({0.04, 0.03, 0.001}, 4), 2700.0, water);
    const ImmersedBody offset = test::blunt_ellipsoid(Vector3d(0.002, 0.004, -0.003));
    int hits = 0;
    for (int i = 0; i < 5000; ++i) {
        const ImmersedBody& body = i % 3 == 0 ? plate : i % 3 == 1 ? cube() : offset;
        const Ground ground{
            .height = 0.0, .velocity = i % 2 == 0 ? Vector3d::Zero() : vector(), .travel = {}};
        BodyState state = test::above_ground(
            body, Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized(),
            1e-3 * normal(random));
        state.velocity << 10.0 * vector(), vector();
        const double step = std::pow(10.0, -4.0 + 3.0 * (i % 100) / 99.0);
        const auto energy = [&](const BodyState& of) {
            Vector6d relative = of.velocity;
            relative.tail<3>() -= of.orientation.conjugate() * ground.velocity;
            return 0.5 * relative.dot(body.inertia * relative);
        };
        BodyState touched = state;
        touch_ground(body, ground, step, state, touched);
        hits += touched.velocity != state.velocity ? 1 : 0;
        ASSERT_LE(energy(touched), energy(state) * (1.0 + 1e-12)) << "hit " << i;
        ASSERT_GE(test::lowest_point(body, touched), -1e-12) << "hit " << i;
        ASSERT_EQ(touched.orientation.coeffs(), state.orientation.coeffs());
    }
    EXPECT_GT(hits, 2000);
}

TEST(GroundContact, AHitWithoutFrictionalLoadLosesTheApproachAlone) {
    // A ball that drops straight: it stays where it fell, and does not bounce.
    BodyState state = test::above_ground(ball(), Quaterniond::Identity(), 0.0);
    state.velocity << 0, 0, 0, 0, 0, -0.3;
    const BodyState before = state;
    touch_ground(ball(), {}, 0.001, before, state);
    EXPECT_NEAR(state.velocity[5], 0.0, 1e-9);
    EXPECT_LT(state.velocity.head<3>().norm(), 0.05);
}

TEST(GroundContact, ASlidingCubeIsBrakedByTheFrictionOfItsWeight) {
    // Slid along the ground in a fluid without drag: a = mu (m - rho V) g / (m + m_a).
    const ImmersedBody body =
        test::uniform_body(test::box({0.02, 0.02, 0.02}, 2), 1500.0, water, Loads::none);
    BodyState state = test::above_ground(body, Quaterniond::Identity(), 0.0);
    state.velocity << 0, 0, 0, 0.5, 0, 0;
    const BodyState end = test::flown(body, ground_at_zero(), state, 0.05, 1e-4);
    const double weight = (body.mass - body.fluid_density * body.volume) * 9.81;
    const double deceleration = ground_friction * weight / body.inertia(3, 3);
    EXPECT_NEAR(end.velocity[3], 0.5 - 0.05 * deceleration, 0.02 * 0.05 * deceleration);
}

TEST(GroundContact, FrictionHoldsABodyAgainstAWeakCurrentAndGivesWayToAStrongOne) {
    for (const double step : {0.002, 1.0 / 60.0, 1.0 / 24.0}) {
        for (const double speed : {0.05, 0.6}) {
            const Vector3d current(speed, 0.0, 0.0);
            BodyState state = test::above_ground(cube(), Quaterniond::Identity(), 0.0);
            state.velocity.tail<3>() = -current;
            const BodyState end = test::flown(cube(), ground_at_zero(current), state, 4.0, step);
            const double way = end.position.x() + std::round(4.0 / step) * step * speed;
            if (speed < 0.1) {
                EXPECT_LT(std::abs(way), 1e-12) << "step " << step;
            } else {
                EXPECT_GT(way, 0.2) << "step " << step;
            }
        }
    }
}

TEST(GroundContact, ABallRollsWithACurrentAndStopsWithoutOne) {
    const Vector3d current(0.2, 0.0, 0.0);
    BodyState state = test::above_ground(ball(), Quaterniond::Identity(), 0.0);
    state.velocity.tail<3>() = -current;
    state = test::flown(ball(), ground_at_zero(current), state, 4.0, 0.002);
    const Vector3d velocity = world_velocity(state, current);
    const Vector3d turning = state.orientation * state.velocity.head<3>();
    EXPECT_GT(velocity.x(), 0.1);
    EXPECT_NEAR(turning.y() * 0.01 / velocity.x(), 1.0, 0.02);  // without slipping

    state.velocity.tail<3>() += state.orientation.conjugate() * current;  // into still water
    state.position.z() = 0.0;
    const BodyState end = test::flown(ball(), ground_at_zero(), state, 10.0, 0.002);
    EXPECT_EQ(end.velocity.norm(), 0.0);
    EXPECT_GT(end.position.x() - state.position.x(), 0.02);
}

TEST(GroundContact, ABuoyantBodyLeavesTheGround) {
    const ImmersedBody cork = test::uniform_body(test::box({0.02, 0.02, 0.02}, 2), 500.0, water);
    const BodyState start = test::above_ground(cork, Quaterniond::Identity(), 0.0);
    const BodyState end = test::flown(cork, ground_at_zero(), start, 1.0, 0.002);
    EXPECT_GT(end.position.z(), 0.1);
}

TEST(GroundContact, MovesWithTheFlowsFrameToRounding) {
    // The same fall in still water and carried by a current along the ground that never touches it: only the
    // ground's velocity differs, and a body in the air does not feel it.
    const Vector3d current(0.3, -0.1, 0.0);
    const BodyState start = test::above_ground(cube(), turned(20, Vector3d(1, 2, 3)), 1.0);
    const BodyState still = test::flown(cube(), ground_at_zero(), start, 0.5, 0.002);
    const BodyState carried = test::flown(cube(), ground_at_zero(current), start, 0.5, 0.002);
    EXPECT_EQ(still.position, carried.position);
    EXPECT_EQ(still.velocity, carried.velocity);
}

TEST(GroundContact, InABatchIsThatOfABodyAloneToTheLastBit) {
    Surroundings surroundings = ground_at_zero(Vector3d(0.05, 0.02, 0.0));
    surroundings.gust = {.amplitude = Vector3d(0.1, 0.0, 0.02), .period = 0.7};
    std::vector<BodyState> starts;
    for (int i = 0; i < 37; ++i) {
        starts.push_back(test::above_ground(cube(), turned(10.0 * i, Vector3d(1, 2, 3)), 0.01 * i));
        starts.back().velocity << 1.0, 2.0, 3.0, 0.1, 0.0, -0.2;
    }
    test::expect_batch_as_alone(cube(), surroundings, starts, 2);
}

}  // namespace
}  // namespace samara
