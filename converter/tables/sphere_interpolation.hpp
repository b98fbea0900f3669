#pragma once

#include <vector>

#include <Eigen/Core>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// Smooth interpolation of scattered samples on the unit sphere: kriging with the polyharmonic kernel r^3 of
/// the chord r between two directions, and polynomials of degree 0 to 2 in the direction with a large prior
/// variance (100 in the kernel's units). The value in a direction is a weighted sum of the samples, exact at
/// the points. The kernel depends on distances only, so that rotated or mirrored points and samples give the
/// rotated or mirrored result. G. Wahba, Spline Models for Observational Data (1990), chapters 1 and 2.
class SphereInterpolation {
  public:
    /// `points`: unit vectors, all different, at least one. Takes time with the cube of their number.
    explicit SphereInterpolation(std::vector<Vector3d> points);

    /// Returns the weight of each point's sample in the value in a direction (a unit vector).
    [[nodiscard]] Eigen::VectorXd weights(const Vector3d& direction) const;

    /// Returns the weights in the direction of points[left_out.front()] of the interpolation without the
    /// points of `left_out`, whose weights are 0. S. Rippa, An algorithm for selecting a good value for the
    /// parameter c in radial basis function interpolation, Advances in Computational Mathematics 11 (1999),
    /// by blocks.
    [[nodiscard]] Eigen::VectorXd weights_without(const std::vector<std::size_t>& left_out) const;

    /// Returns a measure of the distance of a direction from the points for a weighted sum of their samples:
    /// the standard deviation of the sum's error if the quantity were a random walk whose squared increments
    /// have the mean r, with a mean value uncertain by the difference of opposite ends. About the square root
    /// of the distance to the points; zero at the points.
    [[nodiscard]] double spread(const Vector3d& direction, const Eigen::VectorXd& weights) const;

    [[nodiscard]] const std::vector<Vector3d>& points() const { return points_; }

  private:
    std::vector<Vector3d> points_;
    Eigen::MatrixXd inverse_;    ///< of the kernel between the points
    Eigen::MatrixXd distances_;  ///< chords
};

}  // namespace samara
