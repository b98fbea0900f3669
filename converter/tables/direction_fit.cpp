#include "converter/tables/direction_fit.hpp"

#include "samara/core/base/turn.hpp"

namespace samara {
namespace {

std::variant<TurnedSample, ArcFit, ScatteredFit> fit_of(const Symmetry& symmetry,
                                                        const std::vector<Vector3d>& directions) {
    switch (symmetry.kind) {
        case Symmetry::Kind::spherical:
            return TurnedSample{directions.front()};
        case Symmetry::Kind::axial:
            return ArcFit(symmetry, directions);
        case Symmetry::Kind::finite:
            break;
    }
    return ScatteredFit(symmetry, directions);
}

Matrix3d turn_from(const TurnedSample& sample, const Vector3d& direction) {
    return turn_between(sample.direction, direction).toRotationMatrix();
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

}  // namespace samara
