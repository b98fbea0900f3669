#include "converter/tables/reynolds_fit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "converter/tables/direction_sampling.hpp"
#include "converter/tables/standard_error.hpp"
#include "converter/tables/symmetric_loads.hpp"
#include "samara/core/base/error.hpp"

namespace samara {
namespace {

std::vector<Vector3d> directions_of(const std::vector<DirectionSample>& samples) {
    std::vector<Vector3d> directions;
    directions.reserve(samples.size());
    for (const DirectionSample& sample : samples) directions.push_back(sample.direction);
    return directions;
}

bool all_turbulent(const std::vector<DirectionSample>& samples) {
    const auto turbulent = std::count_if(samples.begin(), samples.end(), [](const DirectionSample& sample) {
        return is_turbulent(sample.entry);
    });
    if (turbulent != 0 && turbulent != static_cast<std::ptrdiff_t>(samples.size())) {
        throw Error("laminar and turbulent cases are mixed");
    }
    return turbulent != 0;
}

/// The mean square of leave-one-out errors.
class MeanSquare {
  public:
    void add(double squares, int components, double spread) {
        if (components == 0) return;
        sum_ += squares / (components * spread * spread);
        ++count_;
    }
    [[nodiscard]] double widened_root() const {
        // One value says nothing about the next: it is taken as it is.
        if (count_ < 2) return std::sqrt(sum_);
        return student_widening(count_) * std::sqrt(sum_ / count_);
    }
    /// Returns widened_root() of a quantity whose errors are large in few directions, where a wake detaches:
    /// of the mean square plus its own standard error among as many normal numbers.
    [[nodiscard]] double upper_root() const {
        return count_ < 2 ? widened_root() : widened_root() * std::sqrt(1.0 + std::sqrt(2.0 / count_));
    }

  private:
    double sum_ = 0.0;
    int count_ = 0;
};

double hypot_scaled(double scale, double spread, double other) {
    return std::hypot(scale * spread, other);
}

// With few samples only a large difference is significant
// (docs/explanation/steady-loads.md#from-cases-to-tables).
bool halves_the_variance(double error, double other) {
    return error * error < 0.5 * other * other;
}

}  // namespace

bool is_turbulent(const LoadEntry& entry) {
    return entry.turbulent_kinetic_energy > 0.0 && entry.dissipation_rate > 0.0;
}

LoadEntry in_fit_units(const LoadEntry& entry) {
    return {entry.force, entry.moment, std::sqrt(entry.turbulent_kinetic_energy),
            std::sqrt(entry.dissipation_rate)};
}

LoadEntry from_fit_units(const LoadEntry& entry, const LoadEntry& least) {
    const auto squared = [](double root, double bound) { return std::pow(std::max(root, bound), 2.0); };
    return {entry.force, entry.moment,
            squared(entry.turbulent_kinetic_energy, least.turbulent_kinetic_energy),
            squared(entry.dissipation_rate, least.dissipation_rate)};
}

ReynoldsFit::ReynoldsFit(const Symmetry& symmetry, const std::vector<DirectionSample>& samples,
                         const ReynoldsFit* main)
    : fit_(symmetry, directions_of(samples)), main_(main), turbulent_(all_turbulent(samples)) {
    set_values(samples);
    if (!fit_.is_spherical()) scale_ = left_out(symmetry, samples);
}

ReynoldsFit::ReynoldsFit(const Symmetry& symmetry, const std::vector<DirectionSample>& samples,
                         std::optional<SurfaceTrend> trend)
    : ReynoldsFit(symmetry, samples, static_cast<const ReynoldsFit*>(nullptr)) {
    if (!trend) return;
    trend_ = std::move(trend);
    const ErrorMetrics alone = scale_;
    force_has_trend_ = moment_has_trend_ = true;
    set_values(samples);
    const ErrorMetrics with = left_out(symmetry, samples);
    force_has_trend_ = halves_the_variance(with.force, alone.force);
    moment_has_trend_ = halves_the_variance(with.moment, alone.moment);
    set_values(samples);
    scale_ = left_out(symmetry, samples);
}

void ReynoldsFit::set_values(const std::vector<DirectionSample>& samples) {
    values_.clear();
    for (const DirectionSample& sample : samples) {
        values_.push_back(plus(in_fit_units(sample.entry), -1.0, base_at(sample.direction)));
    }
    const auto half_of_least = [&](double LoadEntry::*scalar) {
        double least = samples.front().entry.*scalar;
        for (const DirectionSample& sample : samples) least = std::min(least, sample.entry.*scalar);
        return 0.5 * std::sqrt(least);
    };
    least_.turbulent_kinetic_energy = half_of_least(&LoadEntry::turbulent_kinetic_energy);
    least_.dissipation_rate = half_of_least(&LoadEntry::dissipation_rate);
}

LoadEntry ReynoldsFit::base_at(const Vector3d& direction) const {
    if (main_ != nullptr) return main_->in_fit_units_at(direction);
    LoadEntry trend;
    if (!force_has_trend_ && !moment_has_trend_) return trend;
    const LoadEntry both = trend_->at(direction);
    if (force_has_trend_) trend.force = both.force;
    if (moment_has_trend_) trend.moment = both.moment;
    return trend;
}

LoadEntry ReynoldsFit::in_fit_units_at(const Vector3d& direction) const {
    return plus(fit_.at(values_, direction), 1.0, base_at(direction));
}

LoadEntry ReynoldsFit::at(const Vector3d& direction) const {
    const LoadEntry entry = in_fit_units_at(direction);
    if (!turbulent_) return {entry.force, entry.moment, 0.0, 0.0};
    return from_fit_units(entry, least_);
}

ErrorMetrics ReynoldsFit::left_out(const Symmetry& symmetry,
                                   const std::vector<DirectionSample>& samples) const {
    MeanSquare force;
    MeanSquare moment;
    MeanSquare turbulent_kinetic_energy;
    MeanSquare dissipation_rate;
    for (std::size_t i = 0; i < values_.size(); ++i) {
        const LoadEntry error = plus(values_[i], -1.0, fit_.without(values_, i));
        const double spread = fit_.spread_without(i);
        const AllowedComponents allowed = allowed_components(symmetry, samples[i].direction);
        force.add(error.force.squaredNorm(), allowed.force, spread);
        moment.add(error.moment.squaredNorm(), allowed.moment, spread);
        turbulent_kinetic_energy.add(error.turbulent_kinetic_energy * error.turbulent_kinetic_energy, 1,
                                     spread);
        dissipation_rate.add(error.dissipation_rate * error.dissipation_rate, 1, spread);
    }
    return {force.widened_root(), moment.widened_root(), turbulent_kinetic_energy.upper_root(),
            dissipation_rate.upper_root()};
}

ErrorMetrics ReynoldsFit::interpolation_error(const Vector3d& direction) const {
    const double spread = fit_.spread(direction);
    const ErrorMetrics other = main_ == nullptr ? ErrorMetrics{} : main_->interpolation_error(direction);
    return {hypot_scaled(scale_.force, spread, other.force),
            hypot_scaled(scale_.moment, spread, other.moment),
            hypot_scaled(scale_.turbulent_kinetic_energy, spread, other.turbulent_kinetic_energy),
            hypot_scaled(scale_.dissipation_rate, spread, other.dissipation_rate)};
}

SurfaceTrend::SurfaceTrend(const SurfaceLoads& loads, const Symmetry& symmetry, double reynolds_number)
    : tables_(as_tables(loads, 1.0, {}, {.turbulent_kinetic_energy = 0.0})),
      reynolds_number_(reynolds_number) {
    for (const Matrix3d& element : elements_in_map_axes(symmetry)) {
        elements_.push_back(symmetry.axes * element);
    }
}

LoadEntry SurfaceTrend::at(const Vector3d& direction) const {
    LoadEntry mean;
    const double part = 1.0 / static_cast<double>(elements_.size());
    for (const Matrix3d& element : elements_) {
        const LoadEntry image = look_up(tables_, element * direction, reynolds_number_);
        mean = plus(mean, part, transformed(image, element.transpose()));
    }
    return mean;
}

}  // namespace samara
