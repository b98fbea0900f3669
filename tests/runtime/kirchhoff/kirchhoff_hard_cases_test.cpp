// Bodies on which added mass is known to go wrong: thin, long, near each other, far away, tiny and huge.

#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samara/kirchhoff/kirchhoff_solver.hpp"
#include "samara/kirchhoff/solvers/tensor_error.hpp"
#include "support/ground_bodies.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

KirchhoffTensor tensor_of(const Surface& surface) {
    return kirchhoff_tensor(surface, test::moments_of(surface));
}

Surface moved(const Surface& surface, const Vector3d& shift) {
    return test::mapped(surface, Matrix3d::Identity(), shift);
}

double smallest_eigenvalue(const KirchhoffTensor& tensor) {
    return Eigen::SelfAdjointEigenSolver<Matrix6d>(tensor.matrix).eigenvalues().minCoeff();
}

/// Broadside added mass of a rectangular plate without thickness over pi/4 a^2 b, a <= b. Lattice
/// extrapolation, within 0.15 % of DNV-RP-C205, table A-2.
struct PlateCase {
    double length;
    double coefficient;
};

class ThinPlate : public testing::TestWithParam<double> {};

TEST_P(ThinPlate, BroadsideIsWithinOnePercentAndEdgewiseIsSmallAndPositive) {
    const double thickness = GetParam();
    for (const PlateCase& plate : {PlateCase{1.0, 0.5790}, PlateCase{2.0, 0.7569}}) {
        const KirchhoffTensor tensor = tensor_of(test::box({1.0, plate.length, thickness}, 10));
        const double broadside = plate.coefficient * std::numbers::pi / 4.0 * plate.length;
        EXPECT_NEAR(tensor.matrix(5, 5), broadside, 0.01 * broadside);
        EXPECT_GT(smallest_eigenvalue(tensor), 0.0);
        // Edgewise, a strip of the height t: of the order of t^2 a, with the logarithm of a / t.
        const double edgewise = tensor.matrix(3, 3);
        EXPECT_GT(edgewise, 2.0 * thickness * thickness * plate.length);
        EXPECT_LT(edgewise, 5.0 * thickness * thickness * plate.length);
    }
}

INSTANTIATE_TEST_SUITE_P(Kirchhoff, ThinPlate, testing::Values(1e-3, 1e-4));

TEST(KirchhoffHardCases, TwoPlatesAtAGapOfAHundredthMoveTheFluidBetweenThem) {
    // Kelvin's theorem: of all flows with the plates' normal velocity the potential one has the least energy,
    // so less than that of a block of the whole height with the fluid between the plates as a part of it.
    const Surface plate = test::box({1.0, 1.0, 1e-3}, 10);
    const double gap = 1e-2;
    const auto pair_of = [&](const Surface& one) {
        return tensor_of(test::together(
            {moved(one, {0, 0, 0.5 * (gap + 1e-3)}), moved(one, {0, 0, -0.5 * (gap + 1e-3)})}));
    };
    const KirchhoffTensor pair = pair_of(plate);
    EXPECT_GT(pair.matrix(5, 5), tensor_of(plate).matrix(5, 5));
    EXPECT_LT(pair.matrix(5, 5), tensor_of(test::box({1.0, 1.0, gap + 2e-3}, 10)).matrix(5, 5) + gap);
    EXPECT_GT(smallest_eigenvalue(pair), 0.0);
    const double finer = pair_of(test::box({1.0, 1.0, 1e-3}, 14)).matrix(5, 5);
    EXPECT_NEAR(pair.matrix(5, 5), finer, 0.01 * finer);
}

TEST(KirchhoffHardCases, TwoSpheresFarApartAddUp) {
    const double distance = 40.0;
    const Surface sphere = test::icosphere(2);
    const Matrix6d one = tensor_of(sphere).matrix;
    const Matrix6d both = tensor_of(test::together({moved(sphere, {-0.5 * distance, 0, 0}),
                                                    moved(sphere, {0.5 * distance, 0, 0})}))
                              .matrix;
    EXPECT_NEAR(both(3, 3), 2.0 * one(3, 3), 1e-3 * one(3, 3));
    EXPECT_NEAR(both(5, 5), 2.0 * one(5, 5), 1e-3 * one(5, 5));
    const double inertia = 2.0 * one(5, 5) * std::pow(0.5 * distance, 2);
    EXPECT_NEAR(both(1, 1), inertia, 2e-3 * inertia);
}

TEST(KirchhoffHardCases, ANeedleOfHundredToOneMovesLikeACylinder) {
    // Slender body theory: the displaced mass across, nothing much along.
    const KirchhoffTensor needle = tensor_of(test::ellipsoid({1.0, 0.01, 0.01}, 3));
    const double displaced = 4.0 / 3.0 * std::numbers::pi * 1e-4;
    EXPECT_NEAR(needle.matrix(4, 4), displaced, 0.02 * displaced);
    EXPECT_GT(needle.matrix(3, 3), 0.0);
    EXPECT_LT(needle.matrix(3, 3), 0.01 * displaced);
    EXPECT_GT(smallest_eigenvalue(needle), -1e-12 * displaced);
}

TEST(KirchhoffHardCases, SliversDoNotSpoilTheResult) {
    // A box whose faces have vertices a millionth of its size from others.
    Surface box = test::box({1.0, 1.0, 1.0}, 6);
    const Matrix6d expected = tensor_of(box).matrix;
    for (Vector3d& vertex : box.vertices) {
        if (std::abs(vertex.x()) < 0.49 && vertex.x() > 0.3) vertex.x() = 0.5 - 1e-4;
    }
    const KirchhoffTensor tensor = tensor_of(box);
    EXPECT_LT(relative_tensor_error(tensor.matrix, expected, {1.0, 6.0}), 0.02);
}

TEST(KirchhoffHardCases, ADiscOfThousandsOfSliversIsThatOfFewer) {
    const Matrix6d expected = tensor_of(test::disc(1.0, 0.1)).matrix;
    for (const int sides : {400, 1600}) {
        const KirchhoffTensor tensor = tensor_of(test::disc(1.0, 0.1, sides));
        EXPECT_LT(tensor.triangles, 6000) << sides;
        const double error = relative_tensor_error(tensor.matrix, expected, {0.31, 6.9});
        EXPECT_LT(error, 5e-3) << sides;
        EXPECT_LT(error, tensor.error_estimate) << sides;
    }
}

TEST(KirchhoffHardCases, ABodyOfAMicrometreAndOneOfAKilometreAreAlike) {
    const Surface surface = test::ellipsoid({1.0, 0.7, 0.4}, 2);
    const Matrix6d unit = tensor_of(surface).matrix;
    for (const double size : {1e-6, 1e3}) {
        const Matrix6d scaled = tensor_of(test::mapped(surface, size * Matrix3d::Identity())).matrix;
        EXPECT_NEAR(scaled(3, 3), unit(3, 3) * std::pow(size, 3), 1e-7 * unit(3, 3) * std::pow(size, 3));
        EXPECT_NEAR(scaled(0, 0), unit(0, 0) * std::pow(size, 5), 1e-7 * unit(0, 0) * std::pow(size, 5));
    }
}

TEST(KirchhoffHardCases, AFoldedSheetIsPositiveAndBetweenItsHalves) {
    // Two plates that share an edge at a right angle, as one closed body: a thin L.
    constexpr double t = 1e-3;
    Surface fold = test::box({1.0, 1.0, t}, 8);
    for (Vector3d& vertex : fold.vertices) {
        const double along = vertex.x();
        const double height = vertex.z();
        if (along < -1e-12) continue;
        vertex.x() = -height;
        vertex.z() = along > 1e-12 ? along : height;  // mitred at the fold
    }
    const KirchhoffTensor tensor = tensor_of(fold);
    EXPECT_GT(smallest_eigenvalue(tensor), 0.0);
    const double half = tensor_of(test::box({0.5, 1.0, t}, 8)).matrix(5, 5);
    EXPECT_GT(tensor.matrix(5, 5), 0.9 * half);
    EXPECT_LT(tensor.matrix(5, 5), 2.5 * half);
    EXPECT_NEAR(tensor.matrix(3, 3), tensor.matrix(5, 5), 0.05 * tensor.matrix(5, 5));
}

TEST(KirchhoffHardCases, NoMotionHasNegativeEnergyWhereOneMovesNoFluid) {
    // About its axis a disc moves none: what the error leaves of that is as often below zero as above.
    for (const double thickness : {0.1, 0.4, 0.6, 1.0}) {
        const KirchhoffTensor tensor = tensor_of(test::disc(1.0, thickness));
        EXPECT_GE(smallest_eigenvalue(tensor), -1e-13) << thickness;
        EXPECT_LT(tensor.matrix(2, 2), 0.05 * tensor.matrix(0, 0)) << thickness;
    }
}

}  // namespace
}  // namespace samara
