// The wake that forms behind a body (docs/theory, "A wake that forms"): until it has, the flow is potential;
// once it has, the loads are those of a tow.

#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "dynamics/moving_load_terms.hpp"
#include "internal/dynamics/equations_of_motion.hpp"
#include "internal/dynamics/loads.hpp"
#include "internal/dynamics/step.hpp"
#include "support/known_bodies.hpp"
#include "support/random_bodies.hpp"

namespace samara {
namespace {

const Vector3d offset(0.002, 0.001, -0.004);

Vector6d acceleration_of(const ImmersedBody& body, const BodyState& state) {
    return EquationsOfMotion(body, Vector3d::Zero(), state.seen_fluid).rate(motion_vector(state)).head<6>();
}

/// Moving without turning, askew to its axes, with so much of a wake.
BodyState towed(const Vector3d& velocity, double formed) {
    BodyState state;
    state.orientation = Quaterniond(Eigen::AngleAxisd(0.7, Vector3d(1.0, -2.0, 0.5).normalized()));
    state.velocity.tail<3>() = state.orientation.conjugate() * velocity;
    state.formed_wake = formed * velocity.normalized();
    return state;
}

TEST(WakeFormation, NoneLeavesTheMomentOfPotentialFlowAndTheTowsForce) {
    const ImmersedBody body = test::lopsided_body();
    const Vector3d velocity(0.1, 0.05, -0.2);
    const BodyState state = towed(velocity, 0.0);
    const Vector3d w = state.velocity.tail<3>();
    Vector6d expected;
    expected << (body.added_mass * w).cross(w), test::loads_at(body, state.velocity).tail<3>();
    EXPECT_LT((body.inertia * acceleration_of(body, state) - expected).norm(), 1e-12 * expected.norm());
}

TEST(WakeFormation, ThatIsWholeGivesTheTow) {
    for (const ImmersedBody& body : {test::lopsided_body(offset), test::blunt_ellipsoid(offset)}) {
        const Vector3d velocity(0.1, 0.05, -0.2);
        const BodyState state = towed(velocity, 1.0);
        const Vector6d of_centroid = body.to_centroid * state.velocity;
        const Vector3d w = of_centroid.tail<3>();
        Vector6d expected = test::loads_at(body, of_centroid);
        expected.head<3>() += (body.added_mass * w).cross(w);
        expected = body.to_centroid.transpose() * expected;
        EXPECT_LT((body.inertia * acceleration_of(body, state) - expected).norm(), 1e-12 * expected.norm());
    }
}

TEST(WakeFormation, GoesOnAsAnExponentialOfTheWayOverTheExtentAlongIt) {
    SceneBody given = test::scene_body(1e9);  // goes on as it was thrown
    Body shape = test::rubber_ellipsoid();
    shape.tables = test::blunt_tables(shape, 4);
    const ImmersedBody body = make_immersed_body(shape, given, Fluid{});
    const double speed = 0.5;
    for (const auto& [direction, extent] : {std::pair{Vector3d(1.0, 0.0, 0.0), 0.02},
                                            {Vector3d(0.0, 1.0, 0.0), 0.04},
                                            {Vector3d(0.0, 0.0, 1.0), 0.08}}) {
        const double way = wake_formation_ways * extent;
        for (const double ways : {0.2, 1.0, 3.0}) {
            BodyState state;
            state.velocity.tail<3>() = speed * direction;
            constexpr int steps = 200;
            const double time = ways * way / speed;
            for (int i = 0; i < steps; ++i)
                state = implicit_step(body, Vector3d::Zero(), time / steps, state);
            EXPECT_LT((state.formed_wake - (1.0 - std::exp(-ways)) * direction).norm(), 1e-4)
                << extent << " m, " << ways;
        }
    }
}

TEST(WakeFormation, IsLostByAWayThatTurnsBackAndFormsAnew) {
    Body shape = test::rubber_ellipsoid();
    shape.tables = test::blunt_tables(shape, 4);
    const ImmersedBody body = make_immersed_body(shape, test::scene_body(1e9), Fluid{});
    BodyState state = towed({0.5, 0.0, 0.0}, 1.0);
    state.velocity.tail<3>() *= -1.0;
    const Vector3d back = state.orientation * state.velocity.tail<3>().normalized();
    double least = 1.0;
    for (int i = 0; i < 1000; ++i) {
        const double missing = (state.formed_wake - back).norm();
        state = implicit_step(body, Vector3d::Zero(), 0.002, state);
        ASSERT_LT((state.formed_wake - back).norm(), missing);
        least = std::min(least, state.formed_wake.norm());
    }
    EXPECT_LT(least, 0.02);
    EXPECT_GT(state.formed_wake.dot(back), 0.99);
}

TEST(WakeFormation, IsOfTheWayAndNotOfTheBodysTurning) {
    // A body that turns as it goes straight on keeps its wake; one whose path curves has less.
    Body shape = test::rubber_ellipsoid();
    shape.tables = test::blunt_tables(shape, 4);
    const ImmersedBody body = make_immersed_body(shape, test::scene_body(1e9), Fluid{});
    BodyState turning = towed({0.5, 0.0, 0.0}, 1.0);
    turning.velocity.head<3>() = Vector3d(0.0, 0.0, 8.0);
    for (int i = 0; i < 500; ++i) turning = implicit_step(body, Vector3d::Zero(), 0.001, turning);
    EXPECT_NEAR(turning.formed_wake.norm(), 1.0, 1e-3);

    BodyState curving = towed({0.5, 0.0, 0.0}, 1.0);
    for (int i = 0; i < 500; ++i) {
        // Across its way: it goes around a circle of 10 cm.
        const Vector3d across = Vector3d::UnitZ().cross(curving.orientation * curving.velocity.tail<3>());
        curving = implicit_step(body, 5.0 * across, 0.001, curving);
    }
    EXPECT_LT(curving.formed_wake.norm(), 0.9);
}

TEST(WakeFormation, IsAlwaysAShare) {
    test::RandomBodies random(5);
    for (int i = 0; i < 2000; ++i) {
        const ImmersedBody body = random.body();
        BodyState state = random.state();
        const double h = random.magnitude(1e-6, 1.0);
        for (int step = 0; step < 5; ++step) {
            state = implicit_step(body, Vector3d::Zero(), h, state);
            ASSERT_LE(state.formed_wake.norm(), 1.0 + 1e-12) << "body " << i;
        }
    }
}

TEST(WakeFormation, IsOfTheWayThroughAStream) {
    const ImmersedBody body = test::lopsided_body(offset);
    const Vector3d stream(0.12, -0.21, 0.17);
    BodyState still = test::tumbling_state(0.2, 5.0);
    BodyState carried = still;
    carried.velocity.tail<3>() += carried.orientation.conjugate() * stream;
    carried.seen_fluid.velocity = stream;
    for (int i = 0; i < 100; ++i) {
        still = implicit_step(body, Vector3d(0.0, 0.0, -9.81), 0.002, still);
        carried = implicit_step(body, Vector3d(0.0, 0.0, -9.81), 0.002, carried);
    }
    EXPECT_GT(still.formed_wake.norm(), 0.2);
    EXPECT_LT((still.formed_wake - carried.formed_wake).norm(), 1e-10);
}

TEST(WakeFormation, IsNotAskedForByLoadsThatKnowNone) {
    Body shape = test::rubber_ellipsoid();
    SceneBody given = test::scene_body(1200.0);
    given.loads = Loads::coefficients;
    const ImmersedBody body = make_immersed_body(shape, given, Fluid{});
    const Vector3d velocity(0.1, 0.05, -0.2);
    EXPECT_EQ(acceleration_of(body, towed(velocity, 0.0)), acceleration_of(body, towed(velocity, 1.0)));
}

}  // namespace
}  // namespace samara
