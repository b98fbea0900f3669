#include "converter/tables/direction_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "converter/tables/direction_sampling.hpp"
#include "samara/core/base/linear_algebra.hpp"

namespace samara {
namespace {

/// Angles (rad) that differ by less are equal.
constexpr double same_angle = 1e-6;

/// Returns a right-handed frame whose first axis is `first` and whose third is perpendicular to `second`.
Matrix3d frame(const Vector3d& first, const Vector3d& second) {
    Matrix3d axes;
    axes.col(0) = first;
    axes.col(2) = first.cross(second).normalized();
    axes.col(1) = axes.col(2).cross(first);
    return axes;
}

struct Point {
    double angle;
    double value;
};

/// Returns Steffen's slope at the middle of three points.
double monotone_slope(const Point& before, const Point& here, const Point& after) {
    const double left = here.angle - before.angle;
    const double right = after.angle - here.angle;
    const double to_here = (here.value - before.value) / left;
    const double from_here = (after.value - here.value) / right;
    if (to_here * from_here <= 0.0) return 0.0;
    const double parabola = (to_here * right + from_here * left) / (left + right);
    return std::copysign(std::min({2.0 * std::abs(to_here), 2.0 * std::abs(from_here), std::abs(parabola)}),
                         to_here);
}

/// Returns the cubic between points 1 and 2 of four at the fraction t of the interval.
double interpolated(const Point (&points)[4], double t) {
    const double length = points[2].angle - points[1].angle;
    const double s = 1.0 - t;
    return s * s * (1.0 + 2.0 * t) * points[1].value + t * t * (1.0 + 2.0 * s) * points[2].value +
           length * s * t *
               (s * monotone_slope(points[0], points[1], points[2]) -
                t * monotone_slope(points[1], points[2], points[3]));
}

}  // namespace

ArcFit::ArcFit(const Symmetry& symmetry, const std::vector<Vector3d>& directions)
    : arc_(axial_arc(symmetry, 1)), included_(directions.size()) {
    for (const Vector3d& direction : directions) places_.push_back(place_of(direction));
    std::iota(included_.begin(), included_.end(), std::size_t{0});
    set_knots();
}

ArcFit::Place ArcFit::place_of(const Vector3d& direction) const {
    // Beyond the mirror the loads are those of its near side, relative to the reversed axis.
    const double along = arc_.axis.dot(direction);
    const Vector3d axis = arc_.mirrored && along < 0.0 ? Vector3d(-arc_.axis) : arc_.axis;
    const Vector3d normal = axis.cross(direction);
    const double angle = std::atan2(normal.norm(), axis.dot(direction));
    return {angle, frame(axis, normal.norm() > 1e-9 ? direction : arc_.across)};
}

void ArcFit::set_knots() {
    const double end = arc_.step_angle() * arc_.steps;
    knots_.clear();
    // With these images there are two knots beyond any angle of the arc, however few the samples.
    for (const std::size_t sample : included_) {
        const double angle = places_[sample].angle;
        for (const int period : {0, -1, 1, -2, 2}) {
            const bool odd = period % 2 != 0;
            knots_.push_back({2.0 * period * end + angle, sample, odd, odd});
            knots_.push_back({2.0 * period * end - angle, sample, !odd, odd});
        }
    }
    std::stable_sort(knots_.begin(), knots_.end(),
                     [](const Knot& a, const Knot& b) { return a.angle < b.angle; });
    const auto last = std::unique(knots_.begin(), knots_.end(), [](const Knot& a, const Knot& b) {
        return b.angle - a.angle < same_angle;
    });
    knots_.erase(last, knots_.end());
}

ArcFit::Interval ArcFit::interval_of(double angle) const {
    const auto after = std::upper_bound(knots_.begin(), knots_.end(), angle,
                                        [](double a, const Knot& knot) { return a < knot.angle; });
    const auto before = static_cast<std::size_t>(after - knots_.begin()) - 1;
    const double length = after->angle - knots_[before].angle;
    return {before, (angle - knots_[before].angle) / length, length};
}

template <typename Number>
double ArcFit::number_at(const std::vector<LoadEntry>& in_frames, const Interval& interval, bool odd_at_pole,
                         bool odd_at_mirror, Number number) const {
    const bool odd_at_end = arc_.mirrored ? odd_at_mirror : odd_at_pole;
    Point points[4];
    for (std::size_t i = 0; i < 4; ++i) {
        const Knot& knot = knots_[interval.before + i - 1];
        const bool reversed = (odd_at_pole && knot.over_pole) != (odd_at_end && knot.over_end);
        const double value = number(in_frames[knot.sample]);
        points[i] = {knot.angle, reversed ? -value : value};
    }
    return interpolated(points, interval.fraction);
}

/// Returns the entry in the frame of the place at this angle.
LoadEntry ArcFit::entry_at(const std::vector<LoadEntry>& samples, double angle) const {
    std::vector<LoadEntry> in_frames;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        in_frames.push_back(transformed(samples[i], places_[i].frame.transpose()));
    }
    const Interval interval = interval_of(angle);
    const auto number = [&](bool odd_at_pole, bool odd_at_mirror, auto pick) {
        return number_at(in_frames, interval, odd_at_pole, odd_at_mirror, pick);
    };
    LoadEntry result;
    result.force[0] = number(false, true, [](const LoadEntry& e) { return e.force[0]; });
    result.force[1] = number(true, false, [](const LoadEntry& e) { return e.force[1]; });
    result.moment[2] = number(true, true, [](const LoadEntry& e) { return e.moment[2]; });
    result.turbulent_kinetic_energy =
        number(false, false, [](const LoadEntry& e) { return e.turbulent_kinetic_energy; });
    result.dissipation_rate = number(false, false, [](const LoadEntry& e) { return e.dissipation_rate; });
    return result;
}

LoadEntry ArcFit::at(const std::vector<LoadEntry>& samples, const Vector3d& direction) const {
    const Place place = place_of(direction);
    return transformed(entry_at(samples, place.angle), place.frame);
}

ArcFit ArcFit::lacking(std::size_t sample) const {
    ArcFit fit = *this;
    std::erase(fit.included_, sample);
    fit.set_knots();
    return fit;
}

LoadEntry ArcFit::without(const std::vector<LoadEntry>& samples, std::size_t sample) const {
    if (included_.size() < 2) return {};
    const Place& place = places_[sample];
    return transformed(lacking(sample).entry_at(samples, place.angle), place.frame);
}

LoadEntryError ArcFit::error_at(const std::vector<LoadEntryError>& errors, const Vector3d& direction) const {
    const Place place = place_of(direction);
    const Interval interval = interval_of(place.angle);
    const auto squares = [&](const Knot& knot) {
        return squared(transformed_error(errors[knot.sample], places_[knot.sample].frame.transpose()));
    };
    LoadEntryError sum = plus({}, 1.0 - interval.fraction, squares(knots_[interval.before]));
    sum = plus(sum, interval.fraction, squares(knots_[interval.before + 1]));
    return transformed_error(rooted(sum), place.frame);
}

/// Varies like the error of a cubic where the loads have a kink: with the distance between the knots, zero at
/// the knots.
double ArcFit::spread_at(double angle) const {
    const Interval interval = interval_of(angle);
    return std::sqrt(interval.fraction * (1.0 - interval.fraction)) * interval.length;
}

double ArcFit::spread(const Vector3d& direction) const {
    return spread_at(place_of(direction).angle);
}

double ArcFit::spread_without(std::size_t sample) const {
    return included_.size() < 2 ? 1.0 : lacking(sample).spread_at(places_[sample].angle);
}

namespace {

std::variant<RotatedSample, ArcFit, ScatteredFit> fit_of(const Symmetry& symmetry,
                                                         const std::vector<Vector3d>& directions) {
    switch (symmetry.type) {
        case Symmetry::Type::spherical:
            return RotatedSample{directions.front()};
        case Symmetry::Type::axial:
            return ArcFit(symmetry, directions);
        case Symmetry::Type::finite:
            break;
    }
    return ScatteredFit(symmetry, directions);
}

Matrix3d rotation_from(const RotatedSample& sample, const Vector3d& direction) {
    return rotation_between(sample.direction, direction).toRotationMatrix();
}

LoadEntry rotated(const RotatedSample& sample, const LoadEntry& entry, const Vector3d& direction) {
    LoadEntry result = transformed(entry, rotation_from(sample, direction));
    // Exactly along the direction, without the rotation's rounding.
    result.force = entry.force.dot(sample.direction) * direction;
    return result;
}

}  // namespace

DirectionFit::DirectionFit(const Symmetry& symmetry, const std::vector<Vector3d>& directions)
    : fit_(fit_of(symmetry, directions)) {}

bool DirectionFit::is_spherical() const {
    return std::holds_alternative<RotatedSample>(fit_);
}

LoadEntry DirectionFit::at(const std::vector<LoadEntry>& samples, const Vector3d& direction) const {
    if (const auto* sample = std::get_if<RotatedSample>(&fit_)) {
        return rotated(*sample, samples.front(), direction);
    }
    if (const auto* arc = std::get_if<ArcFit>(&fit_)) return arc->at(samples, direction);
    return std::get<ScatteredFit>(fit_).at(samples, direction);
}

LoadEntry DirectionFit::without(const std::vector<LoadEntry>& samples, std::size_t sample) const {
    if (const auto* arc = std::get_if<ArcFit>(&fit_)) return arc->without(samples, sample);
    if (const auto* scattered = std::get_if<ScatteredFit>(&fit_)) return scattered->without(samples, sample);
    return {};
}

LoadEntryError DirectionFit::error_at(const std::vector<LoadEntryError>& errors,
                                      const Vector3d& direction) const {
    if (const auto* sample = std::get_if<RotatedSample>(&fit_)) {
        return transformed_error(errors.front(), rotation_from(*sample, direction));
    }
    if (const auto* arc = std::get_if<ArcFit>(&fit_)) return arc->error_at(errors, direction);
    return std::get<ScatteredFit>(fit_).error_at(errors, direction);
}

double DirectionFit::spread(const Vector3d& direction) const {
    if (const auto* arc = std::get_if<ArcFit>(&fit_)) return arc->spread(direction);
    if (const auto* scattered = std::get_if<ScatteredFit>(&fit_)) return scattered->spread(direction);
    return 0.0;
}

double DirectionFit::spread_without(std::size_t sample) const {
    if (const auto* arc = std::get_if<ArcFit>(&fit_)) return arc->spread_without(sample);
    if (const auto* scattered = std::get_if<ScatteredFit>(&fit_)) return scattered->spread_without(sample);
    return 1.0;
}

namespace {

/// Returns the point nearest to a direction, within the tolerance.
std::optional<std::size_t> point_at(const std::vector<Vector3d>& points, const Vector3d& direction,
                                    double tolerance) {
    std::optional<std::size_t> nearest;
    double least = tolerance;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double distance = (points[i] - direction).norm();
        if (distance > least) continue;
        least = distance;
        nearest = i;
    }
    return nearest;
}

}  // namespace

ScatteredFit::ScatteredFit(const Symmetry& symmetry, const std::vector<Vector3d>& directions)
    : tolerance_(direction_tolerance(symmetry)), interpolation_([&] {
          const std::vector<Matrix3d> elements = elements_in_map_axes(symmetry);
          std::vector<Vector3d> points;
          for (std::size_t sample = 0; sample < directions.size(); ++sample) {
              for (const Matrix3d& element : elements) {
                  const Vector3d image = element * directions[sample];
                  if (point_at(points, image, 2.0 * tolerance_)) continue;
                  points.push_back(image);
                  images_.push_back({sample, element});
              }
          }
          return points;
      }()) {}

Eigen::VectorXd ScatteredFit::weights(const Vector3d& direction) const {
    const std::optional<std::size_t> point = point_at(interpolation_.points(), direction, tolerance_);
    if (!point) return interpolation_.weights(direction);
    return Eigen::VectorXd::Unit(static_cast<Eigen::Index>(images_.size()),
                                 static_cast<Eigen::Index>(*point));
}

LoadEntry ScatteredFit::sum(const std::vector<LoadEntry>& samples, const Eigen::VectorXd& weights) const {
    LoadEntry result;
    for (std::size_t i = 0; i < images_.size(); ++i) {
        const double weight = weights[static_cast<Eigen::Index>(i)];
        if (weight == 0.0) continue;
        result = plus(result, weight, transformed(samples[images_[i].sample], images_[i].element));
    }
    return result;
}

std::vector<std::size_t> ScatteredFit::points_of(std::size_t sample) const {
    std::vector<std::size_t> points;
    for (std::size_t i = 0; i < images_.size(); ++i) {
        if (images_[i].sample == sample) points.push_back(i);
    }
    return points;
}

LoadEntry ScatteredFit::at(const std::vector<LoadEntry>& samples, const Vector3d& direction) const {
    return sum(samples, weights(direction));
}

LoadEntry ScatteredFit::without(const std::vector<LoadEntry>& samples, std::size_t sample) const {
    const std::vector<std::size_t> points = points_of(sample);
    if (points.size() == images_.size()) return {};
    return sum(samples, interpolation_.weights_without(points));
}

LoadEntryError ScatteredFit::error_at(const std::vector<LoadEntryError>& errors,
                                      const Vector3d& direction) const {
    const Eigen::VectorXd parts = weights(direction).cwiseAbs();
    LoadEntryError squares;
    for (std::size_t i = 0; i < images_.size(); ++i) {
        const double part = parts[static_cast<Eigen::Index>(i)] / parts.sum();
        if (part == 0.0) continue;
        squares =
            plus(squares, part, squared(transformed_error(errors[images_[i].sample], images_[i].element)));
    }
    return rooted(squares);
}

double ScatteredFit::spread(const Vector3d& direction) const {
    return interpolation_.spread(direction, weights(direction));
}

double ScatteredFit::spread_without(std::size_t sample) const {
    const std::vector<std::size_t> points = points_of(sample);
    if (points.size() == images_.size()) return 1.0;
    return interpolation_.spread(interpolation_.points()[points.front()],
                                 interpolation_.weights_without(points));
}

}  // namespace samara
