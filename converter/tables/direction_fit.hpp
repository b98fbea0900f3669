#pragma once

#include <cstddef>
#include <variant>
#include <vector>

#include "converter/tables/direction_sampling.hpp"
#include "converter/tables/sphere_interpolation.hpp"
#include "converter/tables/symmetric_loads.hpp"

namespace samara {

/// DirectionFit of a body of revolution: interpolates over the polar angle from the body's axis.
class ArcFit {
  public:
    ArcFit(const Symmetry& symmetry, const std::vector<Vector3d>& directions);

    [[nodiscard]] LoadEntry at(const std::vector<LoadEntry>& samples, const Vector3d& direction) const;
    [[nodiscard]] LoadEntry without(const std::vector<LoadEntry>& samples, std::size_t sample) const;
    [[nodiscard]] LoadEntryError error_at(const std::vector<LoadEntryError>& errors,
                                          const Vector3d& direction) const;
    [[nodiscard]] double spread(const Vector3d& direction) const;
    [[nodiscard]] double spread_without(std::size_t sample) const;

  private:
    /// A direction by its polar angle (rad), from 0 to the arc's end, and a right-handed frame: the axis
    /// (reversed beyond a mirror), the perpendicular direction, and the normal of both.
    struct Place {
        double angle;
        Matrix3d frame;
    };

    /// The place of a sample or its image on the line of polar angles, which the symmetry continues beyond
    /// both ends of the arc.
    struct Knot {
        double angle;
        std::size_t sample;
        bool over_pole;  ///< reflected at the pole an odd number of times
        bool over_end;   ///< reflected at the arc's other end an odd number of times
    };

    /// The interval of an angle: between the knot `before` and the next, at `fraction` from 0 to 1.
    struct Interval {
        std::size_t before;
        double fraction;
        double length;  ///< rad
    };

    [[nodiscard]] Place place_of(const Vector3d& direction) const;
    [[nodiscard]] Interval interval_of(double angle) const;
    [[nodiscard]] LoadEntry entry_at(const std::vector<LoadEntry>& samples, double angle) const;
    template <typename Number>
    [[nodiscard]] double number_at(const std::vector<LoadEntry>& in_frames, const Interval& interval,
                                   bool odd_at_pole, bool odd_at_mirror, Number number) const;
    [[nodiscard]] double spread_at(double angle) const;
    [[nodiscard]] ArcFit lacking(std::size_t sample) const;
    void set_knots();

    AxialArc arc_;
    std::vector<Place> places_;          ///< of the samples
    std::vector<std::size_t> included_;  ///< indices of the samples in use
    std::vector<Knot> knots_;            ///< ascending
};

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
    /// A point of the interpolation: the image of the direction of `sample` under `element`.
    struct Image {
        std::size_t sample;
        Matrix3d element;
    };

    [[nodiscard]] Eigen::VectorXd weights(const Vector3d& direction) const;
    [[nodiscard]] LoadEntry sum(const std::vector<LoadEntry>& samples, const Eigen::VectorXd& weights) const;
    /// Returns the points that are images of a sample, its own direction first.
    [[nodiscard]] std::vector<std::size_t> points_of(std::size_t sample) const;

    std::vector<Image> images_;
    double tolerance_;
    SphereInterpolation interpolation_;
};

/// DirectionFit of a sphere: its one sample, rotated into any direction; only the drag of the force is kept.
struct RotatedSample {
    Vector3d direction;
};

/// A function of the direction (map axes) that has the body's symmetry and passes through samples. Values
/// are entries in map axes whose k and epsilon may be any two scalars (table_filling.hpp takes their
/// logarithms). Between the samples and their images under the symmetry:
///  - finite: SphereInterpolation;
///  - axial: force along and perpendicular to the axis, moment and scalars over the polar angle, by monotone
///  cubics that keep their parity at the axis and at the mirror (M. Steffen, A simple method for monotonic
///    interpolation in one dimension, Astronomy and Astrophysics 239, 1990);
///  - spherical: the first sample, rotated.
/// `samples` are in the order of the directions, already passed through keep_symmetric_part.
class DirectionFit {
  public:
    /// Fits the directions of the samples: unit vectors, at least one, no two images of each other.
    DirectionFit(const Symmetry& symmetry, const std::vector<Vector3d>& directions);

    /// Returns the value in a direction; in that of a sample's image exactly that image.
    [[nodiscard]] LoadEntry at(const std::vector<LoadEntry>& samples, const Vector3d& direction) const;

    /// Returns the value in the direction of a sample by the other samples; zero where there is no other.
    [[nodiscard]] LoadEntry without(const std::vector<LoadEntry>& samples, std::size_t sample) const;

    /// Returns the samples' standard errors in a direction: the root mean square over the samples, weighted
    /// by the magnitude of their weights in the value there.
    [[nodiscard]] LoadEntryError error_at(const std::vector<LoadEntryError>& errors,
                                          const Vector3d& direction) const;

    /// Returns a measure of the distance of a direction from the samples, 0 at their images, to which the
    /// error of the value is taken to be proportional. Between scattered samples it is
    /// SphereInterpolation::spread, which varies with the square root of the samples' distance; on an arc it
    /// varies with the distance itself, as the error at a kink does.
    [[nodiscard]] double spread(const Vector3d& direction) const;

    /// Returns spread() of a sample's direction from the other samples; 1 where there is no other.
    [[nodiscard]] double spread_without(std::size_t sample) const;

    /// Whether all directions are images of each other, so that nothing is interpolated.
    [[nodiscard]] bool is_spherical() const;

  private:
    std::variant<RotatedSample, ArcFit, ScatteredFit> fit_;
};

}  // namespace samara
