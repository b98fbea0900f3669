#pragma once

#include <cstddef>
#include <variant>
#include <vector>

#include "converter/tables/arc_fit.hpp"
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

/// DirectionFit of a sphere: its one sample, turned into any direction; of the force the drag alone.
struct TurnedSample {
    Vector3d direction;
};

/// A function of the direction (map axes) that has the body's symmetry and passes through samples. Values
/// are entries in map axes whose k and epsilon may be any two scalars (table_filling.hpp takes their
/// logarithms). Between the samples and their images under the symmetry:
///  - finite: SphereInterpolation;
///  - axial: force along the axis and across it, moment and scalars over the polar angle, by monotone cubics
///    that keep their parity at the axis and at the mirror (M. Steffen, A simple method for monotonic
///    interpolation in one dimension, Astronomy and Astrophysics 239, 1990);
///  - spherical: the first sample, turned.
/// `samples` are in the order of the directions, already passed through keep_symmetric_part.
class DirectionFit {
  public:
    /// The samples' directions: unit vectors, one at least, no two images of each other.
    DirectionFit(const Symmetry& symmetry, const std::vector<Vector3d>& directions);

    /// The value in a direction; in that of a sample's image exactly that image.
    [[nodiscard]] LoadEntry at(const std::vector<LoadEntry>& samples, const Vector3d& direction) const;

    /// The value in the direction of a sample by the other samples; all zero where there is no other.
    [[nodiscard]] LoadEntry without(const std::vector<LoadEntry>& samples, std::size_t sample) const;

    /// The samples' standard errors as they stand in a direction: the root of their mean squares over the
    /// samples that make the value there, by the size of their weights.
    [[nodiscard]] LoadEntryError error_at(const std::vector<LoadEntryError>& errors,
                                          const Vector3d& direction) const;

    /// How far a direction is from the samples, 0 at their images: what the value's error there is taken to
    /// be proportional to. Between scattered samples SphereInterpolation::spread, which falls with the square
    /// root of the samples' distance; on an arc the distance itself, as the error at a kink does.
    [[nodiscard]] double spread(const Vector3d& direction) const;

    /// The same for a sample's direction and the other samples; 1 where there is no other.
    [[nodiscard]] double spread_without(std::size_t sample) const;

    /// Whether any direction is an image of any other: then nothing is interpolated.
    [[nodiscard]] bool is_spherical() const;

  private:
    std::variant<TurnedSample, ArcFit, ScatteredFit> fit_;
};

}  // namespace samara
