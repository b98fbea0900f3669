#include "converter/tables/sphere_interpolation.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace samara {
namespace {

/// Large enough to reproduce polynomials to 1e-4, small enough to keep rounding at 1e-9.
constexpr double polynomial_variance = 1e2;

/// The kernel r^3 plus the Legendre polynomials of degree 0 to 2, each of which is a sum over all spherical
/// harmonics of its degree (addition theorem), so that no direction is preferred.
double kernel(const Vector3d& a, const Vector3d& b) {
    const double distance = (a - b).norm();
    const double cosine = a.dot(b);
    const double polynomials = 1.0 + 3.0 * cosine + 2.5 * (3.0 * cosine * cosine - 1.0);
    return distance * distance * distance + polynomial_variance * polynomials;
}

template <typename Entry>
Eigen::MatrixXd between(const std::vector<Vector3d>& points, const Entry& entry) {
    const auto count = static_cast<Eigen::Index>(points.size());
    Eigen::MatrixXd matrix(count, count);
    for (Eigen::Index i = 0; i < count; ++i) {
        for (Eigen::Index j = 0; j <= i; ++j) {
            const double value =
                entry(points[static_cast<std::size_t>(i)], points[static_cast<std::size_t>(j)]);
            matrix(i, j) = matrix(j, i) = value;
        }
    }
    return matrix;
}

template <typename Entry>
Eigen::VectorXd towards(const std::vector<Vector3d>& points, const Vector3d& direction, const Entry& entry) {
    Eigen::VectorXd values(static_cast<Eigen::Index>(points.size()));
    Eigen::Index i = 0;
    for (const Vector3d& point : points) values[i++] = entry(point, direction);
    return values;
}

double chord(const Vector3d& a, const Vector3d& b) {
    return (a - b).norm();
}

}  // namespace

SphereInterpolation::SphereInterpolation(std::vector<Vector3d> points)
    : points_(std::move(points)), distances_(between(points_, chord)) {
    const Eigen::MatrixXd matrix = between(points_, kernel);
    inverse_ = matrix.ldlt().solve(Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols()));
}

Eigen::VectorXd SphereInterpolation::weights(const Vector3d& direction) const {
    return inverse_ * towards(points_, direction, kernel);
}

Eigen::VectorXd SphereInterpolation::weights_without(const std::vector<std::size_t>& left_out) const {
    const auto count = static_cast<Eigen::Index>(left_out.size());
    Eigen::MatrixXd block(count, count);
    Eigen::MatrixXd rows(count, inverse_.cols());
    for (Eigen::Index i = 0; i < count; ++i) {
        rows.row(i) = inverse_.row(static_cast<Eigen::Index>(left_out[static_cast<std::size_t>(i)]));
        for (Eigen::Index j = 0; j < count; ++j) {
            block(i, j) = rows(i, static_cast<Eigen::Index>(left_out[static_cast<std::size_t>(j)]));
        }
    }
    Eigen::VectorXd weights = -block.ldlt().solve(rows).row(0).transpose();
    for (const std::size_t point : left_out) weights[static_cast<Eigen::Index>(point)] = 0.0;
    return weights;
}

double SphereInterpolation::spread(const Vector3d& direction, const Eigen::VectorXd& weights) const {
    // The variance by the covariance 2 - r; where the weights sum to one the 2 cancels.
    const double level = 1.0 - weights.sum();
    const double square = 2.0 * weights.dot(towards(points_, direction, chord)) -
                          weights.dot(distances_ * weights) + 2.0 * level * level;
    return std::sqrt(std::max(square, 0.0));
}

}  // namespace samara
