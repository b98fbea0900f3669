// What drags a rotation about the direction of motion (docs/explanation/moving-loads.md).

#include <random>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "core/dynamics/moving_load_terms.hpp"
#include "samara/core/dynamics/dynamic_coefficients.hpp"
#include "samara/core/dynamics/loads.hpp"
#include "support/known_bodies.hpp"
#include "support/reference_step.hpp"

namespace samara {
namespace {

using namespace test;

/// The lopsided body with so much of the usual rotational drag.
ImmersedBody with_rotational_drag(double share) {
    ImmersedBody body = lopsided_body();
    body.dynamic.rotational_drag = share * body.roll_drag;
    prepare(body);
    return body;
}

/// The same loads but for the drag about the direction of motion.
ImmersedBody without_roll_drag(ImmersedBody body) {
    body.roll_drag.setZero();
    prepare(body);
    return body;
}

Vector6d added_by_roll_drag(const ImmersedBody& body, const Vector6d& motion) {
    return loads_at(body, motion) - loads_at(without_roll_drag(body), motion);
}

TEST(RollDrag, IsWhatTheRotationalDragOfFallsLacksOfTheUsualOneAboutTheWay) {
    const Body shape = lopsided_shape();
    const Matrix3d usual =
        usual_rotational_drag * rotational_drag_tensor(shape.surface, shape.moments.centroid);
    std::mt19937 generator(1);
    for (const double share : {0.0, 0.25, 0.9}) {
        const ImmersedBody body = with_rotational_drag(share);
        EXPECT_LT((body.roll_drag - usual).norm(), 1e-14 * usual.norm());
        for (int i = 0; i < 100; ++i) {
            const Vector6d motion = random_motion(generator, i);
            const Vector3d omega = motion.head<3>();
            const Vector3d velocity = motion.tail<3>();
            const Vector3d way = velocity.normalized();
            const Vector3d expected = -0.5 * body.fluid_density * velocity.norm() * (1.0 - share) *
                                      way.dot(usual * way) * omega.dot(way) * way;
            const Vector6d added = added_by_roll_drag(body, motion);
            const double rounding = 1e-12 * loads_at(body, motion).head<3>().norm();
            EXPECT_LT((added.head<3>() - expected).norm(), 1e-10 * expected.norm() + rounding);
            EXPECT_LT(added.tail<3>().norm(), 1e-12 * loads_at(body, motion).tail<3>().norm());
        }
    }
}

TEST(RollDrag, IsNoneWhereTheMeanRotationalDragIsTheUsualOneOrMore) {
    std::mt19937 generator(2);
    for (const double share : {1.0, 1.7}) {
        const ImmersedBody body = with_rotational_drag(share);
        for (int i = 0; i < 20; ++i) {
            EXPECT_TRUE(added_by_roll_drag(body, random_motion(generator, i)).isZero(0.0));
        }
    }
}

TEST(RollDrag, IsNoneInAFallInAPlane) {
    const ImmersedBody body = with_rotational_drag(0.0);
    std::mt19937 generator(3);
    for (int i = 0; i < 100; ++i) {
        const Vector6d any = random_motion(generator, i);
        const Vector3d velocity = any.tail<3>();
        const Vector3d omega = velocity.cross(any.head<3>());
        const Vector6d motion = motion_of(omega, velocity);
        EXPECT_LT(added_by_roll_drag(body, motion).norm(), 1e-12 * loads_at(body, motion).norm());
    }
}

TEST(RollDrag, VanishesAsABodyTurnsOnTheSpot) {
    const ImmersedBody body = with_rotational_drag(0.0);
    const Vector3d omega(0.0, 0.0, 20.0);
    const Vector6d on_the_spot = loads_at(body, motion_of(omega, Vector3d::Zero()));
    for (const Vector3d& way : {Vector3d(1.0, 0.0, 0.0), Vector3d(0.0, 0.6, 0.8)}) {
        const Vector6d slow = loads_at(body, motion_of(omega, 1e-9 * way));
        EXPECT_LT((slow - on_the_spot).head<3>().norm(), 1e-6 * on_the_spot.head<3>().norm());
    }
}

TEST(RollDrag, NeverMakesEnergy) {
    const ImmersedBody body = with_rotational_drag(0.0);
    std::mt19937 generator(4);
    for (int i = 0; i < 300; ++i) {
        const Matrix6d matrix = load_matrix(body, random_motion(generator, i));
        const Vector6d eigenvalues =
            Eigen::SelfAdjointEigenSolver<Matrix6d>(0.5 * (matrix + matrix.transpose())).eigenvalues();
        EXPECT_GE(eigenvalues.minCoeff(), -1e-13 * eigenvalues.maxCoeff());
    }
}

TEST(RollDrag, IsThereByTheLoadsOfTheSurfaceToo) {
    SceneBody by_surface = scene_body(1200.0);
    by_surface.loads = Loads::surface;
    const ImmersedBody body = make_immersed_body(lopsided_shape(), by_surface, Fluid{});
    const Vector6d rolling = motion_of(Vector3d(0.0, 0.0, 20.0), Vector3d(0.0, 0.0, 0.2));
    EXPECT_LT(rolling.dot(added_by_roll_drag(body, rolling)), 0.0);
}

TEST(RollDrag, IsNoneOfBodiesWithoutCoefficientsOfFalls) {
    Body shape = lopsided_shape();
    shape.dynamic.reset();
    SceneBody without = scene_body(1200.0);
    without.dynamic = Dynamic::none;
    std::mt19937 generator(5);
    for (const SceneBody& given : {scene_body(1200.0), without}) {
        const ImmersedBody body = make_immersed_body(shape, given, Fluid{});
        for (int i = 0; i < 20; ++i) {
            EXPECT_TRUE(added_by_roll_drag(body, random_motion(generator, i)).isZero(0.0));
        }
    }
}

}  // namespace
}  // namespace samara
