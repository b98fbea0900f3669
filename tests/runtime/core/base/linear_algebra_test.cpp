// Eigenvalues of symmetric matrices.

#include "samara/core/base/linear_algebra.hpp"

#include <Eigen/QR>
#include <gtest/gtest.h>

namespace samara {
namespace {

TEST(SymmetricMatrix, TurnedDiagonalHasItsEntriesAndAxes) {
    const Matrix3d turn =
        Quaterniond(Eigen::AngleAxisd(0.7, Vector3d(1.0, 2.0, -1.0).normalized())).toRotationMatrix();
    const Vector3d entries(3.0, -1.0, 2.0);
    const PrincipalValues found = principal_values(turn * entries.asDiagonal() * turn.transpose());
    EXPECT_LT((found.values - Vector3d(-1.0, 2.0, 3.0)).norm(), 1e-14);
    EXPECT_NEAR(std::abs(found.directions.col(2).dot(turn.col(0))), 1.0, 1e-14);
    EXPECT_NEAR(std::abs(found.directions.col(0).dot(turn.col(1))), 1.0, 1e-14);
}

TEST(SymmetricMatrix, AgainstAMetricTheyAreTheFactorsOfIt) {
    Matrix6d metric = Matrix6d::Identity();
    metric.topRightCorner<3, 3>() = 0.2 * skew(Vector3d(1.0, 2.0, 3.0));
    metric.bottomLeftCorner<3, 3>() = metric.topRightCorner<3, 3>().transpose();
    EXPECT_LT((eigenvalues_of(Matrix6d(2.5 * metric), metric) - Vector6d::Constant(2.5)).norm(), 1e-13);
    const Vector6d entries = (Vector6d() << 5.0, 4.0, 3.0, 2.0, 1.0, 0.5).finished();
    EXPECT_LT((eigenvalues_of(Matrix6d(entries.asDiagonal())) - entries.reverse()).norm(), 1e-14);
    EXPECT_LT((eigenvalues_of(Matrix6d(entries.asDiagonal()), Matrix6d(2.0 * Matrix6d::Identity())) -
               0.5 * entries.reverse())
                  .norm(),
              1e-14);
}

TEST(SymmetricMatrix, NearestSemidefiniteHasNothingOfNegativeEigenvaluesAndAllOfTheOthers) {
    const Vector6d entries = (Vector6d() << 5.0, -0.3, 3.0, 2.0, -0.1, 0.5).finished();
    Matrix6d turn = Matrix6d::Random();
    turn = Eigen::HouseholderQR<Matrix6d>(turn).householderQ();
    const Matrix6d mixed = turn * entries.asDiagonal() * turn.transpose();
    const Matrix6d expected = turn * entries.cwiseMax(0.0).asDiagonal() * turn.transpose();
    EXPECT_LT((nearest_semidefinite(mixed) - expected).norm(), 1e-13);
    const Matrix6d sound = expected + Matrix6d::Identity();
    EXPECT_EQ(nearest_semidefinite(sound), sound);
}

}  // namespace
}  // namespace samara
