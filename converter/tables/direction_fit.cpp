#include "converter/tables/direction_fit.hpp"

#include <optional>

#include "converter/tables/direction_sampling.hpp"
#include "samara/core/base/linear_algebra.hpp"

namespace samara {
namespace {

std::variant<TurnedSample, ArcFit, ScatteredFit> fit_of(const Symmetry& symmetry,
                                                        const std::vector<Vector3d>& directions) {
    switch (symmetry.type) {
        case Symmetry::Type::spherical:
            return TurnedSample{directions.front()};
        case Symmetry::Type::axial:
            return ArcFit(symmetry, directions);
        case Symmetry::Type::finite:
            break;
    }
    return ScatteredFit(symmetry, directions);
}

Matrix3d turn_from(const TurnedSample& sample, const Vector3d& direction) {
    return rotation_between(sample.direction, direction).toRotationMatrix();
}

LoadEntry turned(const TurnedSample& sample, const LoadEntry& entry, const Vector3d& direction) {
    LoadEntry result = transformed(entry, turn_from(sample, direction));
    // Exactly along the direction, whatever the turn's rounding.
    result.force = entry.force.dot(sample.direction) * direction;
    return result;
}

}  // namespace

DirectionFit::DirectionFit(const Symmetry& symmetry, const std::vector<Vector3d>& directions)
    : fit_(fit_of(symmetry, directions)) {}

bool DirectionFit::is_spherical() const {
    return std::holds_alternative<TurnedSample>(fit_);
}

LoadEntry DirectionFit::at(const std::vector<LoadEntry>& samples, const Vector3d& direction) const {
    if (const auto* sample = std::get_if<TurnedSample>(&fit_)) {
        return turned(*sample, samples.front(), direction);
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
    if (const auto* sample = std::get_if<TurnedSample>(&fit_)) {
        return transformed_error(errors.front(), turn_from(*sample, direction));
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

/// The point nearest to a direction, where it is the same direction.
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
