#pragma once

#include <cstddef>
#include <vector>

#include "converter/tables/sphere_interpolation.hpp"
#include "converter/tables/symmetric_loads.hpp"

namespace samara {

/// DirectionFit of a body with a finite symmetry: SphereInterpolation between all images of the samples.
class ScatteredFit {
  public:
    ScatteredFit(const Symmetry& symmetry, const std::vector<Vector3d>& directions);

    [[nodiscard]] LoadEntry at(const std::vector<LoadEntry>& samples, const Vector3d& direction) const;
    [[nodiscard]] LoadEntry without(const std::vector<LoadEntry>& samples, std::size_t sample) const;
    [[nodiscard]] LoadEntryError error_at(const std::vector<LoadEntryError>& errors,
                                          const Vector3d& direction) const;
    [[nodiscard]] double spread(const Vector3d& direction) const;
    [[nodiscard]] double spread_without(std::size_t sample) const;

  private:
    /// A point of the interpolation: the direction of `sample` turned or mirrored by `element`.
    struct Image {
        std::size_t sample;
        Matrix3d element;
    };

    [[nodiscard]] Eigen::VectorXd weights(const Vector3d& direction) const;
    [[nodiscard]] LoadEntry sum(const std::vector<LoadEntry>& samples, const Eigen::VectorXd& weights) const;
    /// The points that are images of a sample, its own direction first.
    [[nodiscard]] std::vector<std::size_t> points_of(std::size_t sample) const;

    std::vector<Image> images_;
    double tolerance_;
    SphereInterpolation interpolation_;
};

}  // namespace samara
