#include "samara/core/dynamics/dynamic_coefficients.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "support/known_bodies.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

TEST(DynamicCoefficients, RotationalDragOfASphereIsZeroAndOfAnEllipsoidFollowsItsAxes) {
    const Body sphere = test::exact_sphere(0.1);
    const Matrix3d none = rotational_drag_tensor(sphere.surface, sphere.moments.centroid);
    EXPECT_LT(none.norm(), 3e-4 * std::pow(0.1, 4));  // flat triangles are not quite tangent to the sphere
    const Body ellipsoid = test::rubber_ellipsoid();
    const Matrix3d tensor = rotational_drag_tensor(ellipsoid.surface, ellipsoid.moments.centroid);
    EXPECT_GT(tensor(1, 1), tensor(0, 0));  // about y the long axis sweeps broadside
    EXPECT_GT(tensor(0, 0), 0.0);
    EXPECT_LT((tensor - Matrix3d(tensor.diagonal().asDiagonal())).norm(), 1e-9 * tensor.norm());
}

TEST(DynamicCoefficients, OfAnyBodyByDefaultAreSoundAndAlignedWithItsAxes) {
    for (const Body& body : {test::rubber_ellipsoid(), test::exact_sphere(0.1)}) {
        const DynamicCoefficients values = default_dynamic_coefficients(body);
        EXPECT_EQ(error_of(values), "");
        EXPECT_NE(values.origin.find("default"), std::string::npos);
        for (const TensorOfMotion& tensor : tensors_of_motion) {
            const Matrix3d& t = values.*tensor.member;
            EXPECT_LT((t - Matrix3d(t.diagonal().asDiagonal())).norm(), 1e-9 * t.norm() + 1e-20)
                << tensor.name;
        }
        EXPECT_GT(values.drag_in_motion.diagonal().minCoeff(), 0.0);
        EXPECT_GE(values.transport.diagonal().minCoeff(), 0.0);
    }
    EXPECT_NEAR(default_dynamic_coefficients(test::rubber_ellipsoid()).half_length, 0.04, 1e-9);
}

TEST(DynamicCoefficients, ByDefaultGrowWithTheBodyAsTheirUnitsSay) {
    const auto power_of = [](std::string_view unit) { return unit[2] - '0'; };  // m^2 to m^5
    const Body small = test::rubber_ellipsoid();
    Body large = small;
    for (Vector3d& vertex : large.surface.vertices) vertex *= 3.0;
    large.moments = test::moments_of(large.surface);
    large.kirchhoff->matrix.topLeftCorner<3, 3>() *= std::pow(3.0, 5);
    large.kirchhoff->matrix.bottomRightCorner<3, 3>() *= std::pow(3.0, 3);
    const DynamicCoefficients of_small = default_dynamic_coefficients(small);
    const DynamicCoefficients of_large = default_dynamic_coefficients(large);
    EXPECT_NEAR(of_large.half_length / of_small.half_length, 3.0, 1e-12);
    for (const NumberOfMotion& number : numbers_of_motion) {
        EXPECT_EQ(of_large.*number.member, of_small.*number.member) << number.name;
    }
    for (const TensorOfMotion& tensor : tensors_of_motion) {
        const Matrix3d expected = std::pow(3.0, power_of(tensor.unit)) * of_small.*tensor.member;
        EXPECT_LE((of_large.*tensor.member - expected).norm(), 1e-9 * expected.norm()) << tensor.name;
    }
}

TEST(DynamicCoefficients, ForLoadsByCoefficientsAreRotationalDragAlone) {
    const DynamicCoefficients values = rotational_drag_alone(test::rubber_ellipsoid());
    EXPECT_EQ(error_of(values), "");
    EXPECT_EQ(values.rotational_transport, 0.0);
    for (const TensorOfMotion& tensor : tensors_of_motion) {
        const bool is_there = tensor.member == &DynamicCoefficients::rotational_drag;
        EXPECT_EQ((values.*tensor.member).isZero(0.0), !is_there) << tensor.name;
    }
}

}  // namespace
}  // namespace samara
