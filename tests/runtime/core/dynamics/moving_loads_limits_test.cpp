// Loads of a rotating body, at their limits: on the spot, at rest, in a steady translation, in a rotating
// fluid, in other axes.

#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/dynamics/moving_load_terms.hpp"
#include "samara/core/dynamics/loads.hpp"
#include "support/known_bodies.hpp"
#include "support/reference_step.hpp"

namespace samara {
namespace {

using namespace test;

TEST(MovingLoads, OfASpinningBallWithoutAddedMassDoNotBendItsPath) {
    SceneBody given = test::scene_body(1200.0);
    given.added_mass = false;
    Body ball = test::exact_sphere(0.02);
    ball.dynamic = test::lopsided_shape().dynamic;
    ball.tables = test::blunt_tables(ball, 2);
    for (LoadEntry& entry : ball.tables->entries) {
        entry.force.setZero();
        entry.moment.setZero();
    }
    const ImmersedBody body = make_immersed_body(ball, given, Fluid{});
    std::mt19937 generator(10);
    for (int i = 0; i < 50; ++i) {
        const Vector6d motion = motion_of(random_vector(generator), random_vector(generator));
        const Vector3d force = loads_at(body, motion).tail<3>();
        // What is left are the drags in motion, which act along C_m A v and C_s A v.
        const Motion m(body, motion);
        const Vector6d drags = drag_in_motion(m) + drag_in_spin(m);
        EXPECT_LT((force - drags.tail<3>() - creeping_drag(m).tail<3>()).norm(), 1e-12 * force.norm());
    }
}

TEST(MovingLoads, DragInMotionSetsInWithTheSquareOfTheTipSpeedAndIsHalfThereAtTheOnset) {
    ImmersedBody body = bare(test::lopsided_body(), false);
    body.dynamic.drag_in_motion = 1e-3 * Matrix3d::Identity();
    prepare(body);
    const Vector3d velocity(0.1, -0.2, 0.2);
    const double speed = velocity.norm();
    /// The drag over rho/2 H C_m A v.
    const auto share_at = [&](double square) {  // of (Q/|v|)^2
        const double tip = std::sqrt(square) * speed;
        const Vector3d omega = tip / body.dynamic.half_length * Vector3d(2.0, 1.0, 0.5).normalized();
        const double full = 0.5 * body.fluid_density * std::hypot(speed, tip) * 1e-3 * speed;
        return -loads_at(body, motion_of(omega, velocity)).tail<3>().dot(velocity) / speed / full;
    };
    EXPECT_NEAR(share_at(motion_onset), 0.5, 1e-12);
    EXPECT_NEAR(share_at(1e-6) / (1e-6 / motion_onset), 1.0, 1e-4);
    EXPECT_NEAR(share_at(1e-8) / (1e-8 / motion_onset), 1.0, 1e-6);
    EXPECT_NEAR(share_at(1e4), 1.0, 1e-5);
    EXPECT_EQ(share_at(0.0), 0.0);
}

TEST(MovingLoads, DragInMotionIsOfTheBodysOwnTurning) {
    ImmersedBody body = bare(test::lopsided_body(), false);
    body.dynamic.drag_in_motion = 1e-3 * Matrix3d::Identity();
    prepare(body);
    const Vector3d velocity(0.1, -0.2, 0.2);
    const Vector6d relative = motion_of(Vector3d(3.0, -1.0, 2.0), velocity);
    // The body rotates by `own` in a rotating fluid, so that its rotation relative to the fluid is always the
    // same.
    const auto drag_at = [&](const Vector3d& own) {
        const Vector3d seen = own - relative.head<3>();
        const Vector6d motion = motion_of(own, velocity);
        const LoadMatrices loads = load_matrices(body, motion, seen);
        const Vector6d load = loads.relative.leftCols<3>() * seen - loads.whole * motion;
        return load.tail<3>().dot(velocity.normalized());
    };
    EXPECT_EQ(drag_at(Vector3d::Zero()), 0.0);
    const Vector3d at_onset(std::sqrt(motion_onset) * velocity.norm() / body.dynamic.half_length, 0.0, 0.0);
    EXPECT_NEAR(drag_at(at_onset) / drag_at(1e9 * at_onset), 0.5, 1e-12);
}

TEST(MovingLoads, ArePassiveInAFluidThatTurns) {
    const ImmersedBody body = test::lopsided_body();
    const Vector3d velocity(0.1, -0.2, 0.2);
    for (const Vector3d& own :
         {Vector3d(Vector3d::Zero()), Vector3d(3.0, -1.0, 2.0), Vector3d(1e3, 0.0, 0.0)}) {
        for (const Vector6d& wake_fluctuation :
             {Vector6d(Vector6d::Zero()), motion_of(Vector3d(1.0, 2.0, 3.0), Vector3d::Zero()),
              motion_of(Vector3d::Zero(), velocity)}) {
            const Vector6d motion = motion_of(own, wake_fluctuation.tail<3>());
            const LoadMatrices loads = load_matrices(body, motion, own - wake_fluctuation.head<3>());
            EXPECT_TRUE(loads.whole.allFinite());
            EXPECT_LT(loads.relative.norm(), 1e3);
            EXPECT_GE((wake_fluctuation.transpose() * loads.relative * wake_fluctuation).value(), 0.0);
            // Transport and wake do no work on the body, whatever the fluid does.
            const Matrix6d transports = loads.whole - loads.relative;
            EXPECT_LT((transports + transports.transpose()).norm(), 1e-12 * (loads.whole.norm() + 1e-12));
        }
    }
}

TEST(MovingLoads, KeepTheTablesMomentUntilTheBodyDoesLittleButTurn) {
    // A body whose moment is along its force, about which it rotates: no arm, and so no change of the local
    // velocity.
    ImmersedBody body = bare(test::blunt_ellipsoid(), true);
    for (LoadEntry& entry : body.tables->entries) entry.moment = 0.1 * entry.force;
    body.dynamic.transport = body.added_mass / body.fluid_density;
    prepare(body);
    const Vector3d velocity(0.1, -0.2, 0.2);
    const auto tow = tabulated(body, velocity);
    const Vector3d force = tow.first;
    const Vector3d moment = tow.second;
    const auto share_at = [&](double square) {  // of (|v|/Q)^2
        const double rate = velocity.norm() / std::sqrt(square) / body.dynamic.half_length;
        const Motion m(body, motion_of(rate * force.normalized(), velocity));
        const Vector6d rest = transport(m) + creeping_turn(m);
        return (loads_at(body, motion_of(m.omega, m.v)) - rest).head<3>().dot(moment) / moment.squaredNorm();
    };
    EXPECT_NEAR(share_at(1e6), 1.0, 1e-6);
    EXPECT_NEAR(share_at(1.0), 1.0 / (1.0 + motion_onset), 1e-9);
    EXPECT_NEAR(share_at(motion_onset), 0.5, 1e-9);
    EXPECT_NEAR(share_at(1e-4 * motion_onset) / 1e-4, 1.0, 1e-3);
}

TEST(MovingLoads, TendToThoseOfSteadyTranslationAsTheBodyStopsTurning) {
    const ImmersedBody body = test::lopsided_body();
    const Vector3d velocity(0.1, -0.2, 0.2);
    const Vector6d tow = loads_at(body, motion_of(Vector3d::Zero(), velocity));
    double before = INFINITY;
    for (const double rate : {1e-1, 1e-3, 1e-6, 1e-9, 1e-200}) {
        const Vector6d loads = loads_at(body, motion_of(rate * Vector3d(0.3, -1.0, 0.5), velocity));
        const double difference = (loads - tow).norm() / tow.norm();
        EXPECT_LE(difference, std::max(before * 0.1, 1e-13)) << rate;
        before = difference;
    }
}

TEST(MovingLoads, OfABodyThatTurnsOnTheSpotAreFiniteAndThoseOfTheTurningAlone) {
    const ImmersedBody body = test::lopsided_body();
    for (const double rate : {1e-3, 1.0, 1e3}) {
        const Vector3d omega = rate * Vector3d(0.3, -1.0, 0.5);
        const Motion m(body, motion_of(omega, Vector3d::Zero()));
        const Vector6d expected =
            rotational_transport(m) + rotational_drag(m) + rotational_drag_in_spin(m) + creeping_turn(m);
        for (const double speed : {0.0, 1e-200, 1e-30}) {
            const Vector6d loads = loads_at(body, motion_of(omega, speed * Vector3d(0.5, 0.3, -0.4)));
            ASSERT_TRUE(loads.allFinite());
            EXPECT_LT((loads - expected).head<3>().norm(), 1e-12 * expected.head<3>().norm());
            EXPECT_LT((loads - expected).tail<3>().norm(), 1e-12 * expected.tail<3>().norm());
        }
    }
}

TEST(MovingLoads, AreFiniteAndVanishAtRest) {
    for (const ImmersedBody& body : {test::blunt_ellipsoid(), test::lopsided_body()}) {
        const Matrix6d at_rest = load_matrix(body, Vector6d::Zero());
        EXPECT_TRUE(at_rest.allFinite());
        for (const double faint : {1e-300, 1e-160, 1e-80, 1e-20}) {
            EXPECT_TRUE(load_matrix(body, Vector6d::Constant(faint)).allFinite()) << faint;
        }
        EXPECT_LT((load_matrix(body, Vector6d::Constant(1e-12)) - at_rest).norm(), 1e-9);
    }
}

/// The same shape in other axes: x' = R x.
Body turned(Body body, const Matrix3d& r) {
    for (Vector3d& vertex : body.surface.vertices) vertex = r * vertex;
    body.moments.centroid = r * body.moments.centroid;
    const auto turn = [&r](Matrix3d& tensor) { tensor = (r * tensor * r.transpose()).eval(); };
    turn(body.moments.second_moments);
    Matrix6d both = Matrix6d::Zero();
    both << r, Matrix3d::Zero(), Matrix3d::Zero(), r;
    body.kirchhoff->matrix = (both * body.kirchhoff->matrix * both.transpose()).eval();
    body.tables->axes = (r * body.tables->axes).eval();
    for (LoadEntry& entry : body.tables->entries) {
        entry.force = r * entry.force;
        entry.moment = r * entry.moment;
    }
    for (const TensorOfMotion& tensor : tensors_of_motion) turn(body.dynamic->values.*tensor.member);
    return body;
}

TEST(MovingLoads, MoveABodyTheSameWayInWhateverAxesItIsGiven) {
    const Matrix3d r = Quaterniond(0.3, -0.5, 0.7, 0.4).normalized().toRotationMatrix();
    const Vector3d offset(0.001, 0.002, -0.003);
    const auto immersed = [](const Body& shape, const Vector3d& center) {
        SceneBody given = test::scene_body(0.0);
        given.mass = {.density = {}, .mass = 0.04, .center_of_mass = center, .inertia = {}};
        return make_immersed_body(shape, given, Fluid{});
    };
    const Body shape = test::lopsided_shape();
    const ImmersedBody one = immersed(shape, offset);
    const ImmersedBody other = immersed(turned(shape, r), r * offset);
    const BodyState start = test::tumbling_state(0.2, 8.0);
    BodyState state = start;
    BodyState in_other = start;
    in_other.orientation = start.orientation * Quaterniond(r).inverse();
    in_other.velocity << r * start.velocity.head<3>(), r * start.velocity.tail<3>();
    for (int i = 0; i < 100; ++i) {
        state = reference_step(one, Vector3d(0.0, 0.0, -9.81), 0.002, state).state;
        in_other = reference_step(other, Vector3d(0.0, 0.0, -9.81), 0.002, in_other).state;
    }
    EXPECT_GT((state.position - start.position).norm(), 0.01);
    EXPECT_LT((state.position - in_other.position).norm(), 1e-10);
    const Vector3d omega = r.transpose() * in_other.velocity.head<3>();
    EXPECT_LT((omega - state.velocity.head<3>()).norm(), 1e-7);

    std::mt19937 generator(7);
    for (int i = 0; i < 100; ++i) {
        const Vector6d motion = random_motion(generator, i);
        const Vector6d loads = loads_at(one, motion);
        const Vector6d turned_loads = loads_at(other, motion_of(r * motion.head<3>(), r * motion.tail<3>()));
        EXPECT_LT((r.transpose() * turned_loads.head<3>() - loads.head<3>()).norm(),
                  1e-11 * loads.head<3>().norm());
        EXPECT_LT((r.transpose() * turned_loads.tail<3>() - loads.tail<3>()).norm(),
                  1e-11 * loads.tail<3>().norm());
    }
}

}  // namespace
}  // namespace samara
