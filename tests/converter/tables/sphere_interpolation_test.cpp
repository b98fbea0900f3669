#include "converter/tables/sphere_interpolation.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "converter/tables/direction_sampling.hpp"
#include "symmetry_groups.hpp"
#include "table_cases.hpp"

namespace samara {
namespace {

using Function = double (*)(const Vector3d&);

std::vector<Vector3d> nodes(int subdivisions) {
    return required_directions(Symmetry{}, subdivisions);
}

double value_at(const SphereInterpolation& interpolation, Function function, const Vector3d& direction) {
    const Eigen::VectorXd weights = interpolation.weights(direction);
    double sum = 0.0;
    Eigen::Index i = 0;
    for (const Vector3d& point : interpolation.points()) sum += weights[i++] * function(point);
    return sum;
}

double largest_error(const SphereInterpolation& interpolation, Function function) {
    constexpr int count = 300;
    double largest = 0.0;
    for (int i = 0; i < count; ++i) {
        const Vector3d direction = test::spiral_direction(i, count);
        const double error = value_at(interpolation, function, direction) - function(direction);
        largest = std::max(largest, std::abs(error));
    }
    return largest;
}

double smooth(const Vector3d& d) {
    return std::exp(d.x()) * std::cos(2.0 * d.y() - d.z());
}

TEST(SphereInterpolation, PassesThroughItsPoints) {
    for (const int n : {1, 2, 4, 8}) {
        const SphereInterpolation interpolation(nodes(n));
        for (const Vector3d& point : interpolation.points()) {
            EXPECT_NEAR(value_at(interpolation, smooth, point), smooth(point), 1e-7);
        }
    }
}

TEST(SphereInterpolation, FollowsPolynomialsOfSecondDegree) {
    const Function quadratic = [](const Vector3d& d) {
        return 0.7 - 0.2 * d.x() + d.x() * d.y() - 0.5 * d.z() * d.z();
    };
    EXPECT_LT(largest_error(SphereInterpolation(nodes(2)), quadratic), 1e-4);
    EXPECT_LT(largest_error(SphereInterpolation(nodes(8)), quadratic), 1e-4);
}

TEST(SphereInterpolation, ConvergesToASmoothFunctionWithThirdOrder) {
    const double coarse = largest_error(SphereInterpolation(nodes(3)), smooth);
    const double fine = largest_error(SphereInterpolation(nodes(9)), smooth);
    EXPECT_LT(coarse, 0.2);
    EXPECT_GT(std::log(coarse / fine) / std::log(3.0), 2.8);
}

TEST(SphereInterpolation, RotatesWithItsPoints) {
    const Matrix3d turn = test::some_rotation();
    std::vector<Vector3d> turned;
    for (const Vector3d& point : nodes(3)) turned.emplace_back(-turn * point);
    const SphereInterpolation before(nodes(3));
    const SphereInterpolation after(turned);
    const Vector3d direction = Vector3d(0.3, -0.5, 0.2).normalized();
    EXPECT_LT((before.weights(direction) - after.weights(-turn * direction)).norm(), 1e-8);
}

TEST(SphereInterpolation, WithoutSomePointsIsThatOfTheOthers) {
    const std::vector<Vector3d> all = nodes(4);
    const SphereInterpolation interpolation(all);
    const std::vector<std::size_t> left_out = {5, 17, 40};
    const Eigen::VectorXd found = interpolation.weights_without(left_out);
    std::vector<Vector3d> others;
    std::vector<double> weights;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (i == 5 || i == 17 || i == 40) {
            EXPECT_EQ(found[static_cast<Eigen::Index>(i)], 0.0);
            continue;
        }
        others.push_back(all[i]);
        weights.push_back(found[static_cast<Eigen::Index>(i)]);
    }
    const Eigen::VectorXd expected = SphereInterpolation(others).weights(all[5]);
    for (std::size_t i = 0; i < weights.size(); ++i) {
        EXPECT_NEAR(weights[i], expected[static_cast<Eigen::Index>(i)], 1e-7);
    }
}

TEST(SphereInterpolation, HasASpreadThatGrowsAsTheRootOfTheDistance) {
    const SphereInterpolation coarse(nodes(2));
    const SphereInterpolation fine(nodes(8));
    const auto spread = [](const SphereInterpolation& interpolation, const Vector3d& direction) {
        return interpolation.spread(direction, interpolation.weights(direction));
    };
    EXPECT_NEAR(spread(coarse, Vector3d::UnitX()), 0.0, 1e-3);
    EXPECT_NEAR(spread(fine, Vector3d::UnitX()), 0.0, 1e-3);
    const auto between = [](int n) { return Vector3d(2.0 * n - 1.0, 1.0, 0.0).normalized(); };
    const double ratio = spread(coarse, between(2)) / spread(fine, between(8));
    EXPECT_GT(ratio, 1.6);
    EXPECT_LT(ratio, 2.4);
}

}  // namespace
}  // namespace samara
