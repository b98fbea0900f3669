#include "foam-cases/falls/motion_error.hpp"

#include <algorithm>
#include <cmath>

#include "converter/tables/direction_fit.hpp"
#include "converter/tables/symmetric_loads.hpp"
#include "samara/analysis/metrics/fall_metrics.hpp"
#include "samara/core/base/numbers.hpp"
#include "samara/core/kernel/noise.hpp"
#include "samara/core/surface/octahedral_map.hpp"

namespace samara {
namespace {

/// Draws a random deviation of an entry by its standard errors, of k and epsilon by their logarithms.
LoadEntry deviate(const LoadEntry& entry, const LoadEntryError& error, const Noise& noise,
                  std::size_t direction) {
    const auto of_vectors = [&](std::size_t number) {
        const auto normals = noise.normals(3 * direction + number, NoiseStream::table_error);
        return Vector3d(normals[0], normals[1], normals[2]);
    };
    const auto scalars = noise.normals(3 * direction + 2, NoiseStream::table_error);
    const auto logarithm = [](double value, double of_error) {
        return value > 0.0 ? std::log1p(of_error / value) : 0.0;
    };
    return {error.force.cwiseProduct(of_vectors(0)), error.moment.cwiseProduct(of_vectors(1)),
            scalars[0] * logarithm(entry.turbulent_kinetic_energy, error.turbulent_kinetic_energy),
            scalars[1] * logarithm(entry.dissipation_rate, error.dissipation_rate)};
}

/// Draws the deviations in the unsolved directions, with zero in the solved ones; map axes.
std::vector<DirectionSample> drawn_samples(const LoadTables& tables, const Symmetry& symmetry,
                                           const UncertainTables& uncertain, std::uint32_t draw) {
    LoadTables sampling = tables;
    sampling.errors = uncertain.sampling_errors;
    const Noise noise(1, "table", draw, 0);
    const Matrix3d to_map = tables.axes.transpose();
    std::vector<DirectionSample> samples;
    for (const Vector3d& direction : uncertain.solved) samples.push_back({direction, {}, {}});
    for (std::size_t i = 0; i < uncertain.unsolved.size(); ++i) {
        const Vector3d& direction = uncertain.unsolved[i];
        const Vector3d in_body = tables.axes * direction;
        const LoadEntry entry = look_up(tables, in_body, uncertain.reynolds_number);
        const LoadEntryError error =
            transformed_error(look_up_error(sampling, in_body, uncertain.reynolds_number), to_map);
        samples.push_back({direction, deviate(entry, error, noise, i), {}});
    }
    keep_symmetric_part(symmetry, samples);
    return samples;
}

/// Returns the negligible difference of a metric, in its SI unit.
double negligible(const CataloguedMetric& entry, const SampledFalls& simulation, double length) {
    const auto descent = simulation.mean(Metric::descent_speed);
    if (entry.metric != Metric::rms_angular_speed || !descent) return entry.allowed.always;
    return degree * std::abs(descent->value) / length;
}

/// Returns the largest error relative to what the tolerance allows.
double largest_share(const MotionError& error, double tolerance, double MotionError::OfMetric::*member) {
    double largest = 0.0;
    for (const Metric metric : baked_metrics) {
        const auto& one = error.metrics[metric];
        if (!one) continue;
        const double allowed = std::max(catalogued(metric).allowed.share * tolerance, one->always_allowed);
        largest = std::max(largest, (*one).*member / allowed);
    }
    return largest;
}

double variance_of(const std::vector<double>& values, double about) {
    double sum = 0.0;
    for (const double value : values) sum += (value - about) * (value - about);
    return sum / static_cast<double>(values.size());
}

}  // namespace

double MotionError::worst(double tolerance) const {
    return largest_share(*this, tolerance, &OfMetric::of_table);
}

double MotionError::worst_chance(double tolerance) const {
    return largest_share(*this, tolerance, &OfMetric::of_chance);
}

LoadTables drawn_tables(const LoadTables& tables, const Symmetry& symmetry, const UncertainTables& uncertain,
                        std::uint32_t draw) {
    const std::vector<DirectionSample> samples = drawn_samples(tables, symmetry, uncertain, draw);
    std::vector<Vector3d> directions;
    std::vector<LoadEntry> deviations;
    for (const DirectionSample& sample : samples) {
        directions.push_back(sample.direction);
        deviations.push_back(sample.entry);
    }
    const DirectionFit fit(symmetry, directions);
    LoadTables drawn = tables;
    const std::vector<Vector3d> nodes = octahedral_nodes(tables.subdivisions);
    for (std::size_t node = 0; node < nodes.size(); ++node) {
        const LoadEntry deviation = transformed(fit.at(deviations, nodes[node]), tables.axes);
        for (std::size_t at = node; at < drawn.entries.size(); at += nodes.size()) {
            LoadEntry& entry = drawn.entries[at];
            entry.force += deviation.force;
            entry.moment += deviation.moment;
            entry.turbulent_kinetic_energy *= std::exp(deviation.turbulent_kinetic_energy);
            entry.dissipation_rate *= std::exp(deviation.dissipation_rate);
        }
    }
    return drawn;
}

SampledFalls simulate_for_bake(const Scene& scene, std::size_t body, const Body& of_body, int falls) {
    return sample_falls(scene, body, LoadedBody{of_body, ""}, {.falls = falls, .most_steps = INFINITY});
}

MotionError motion_error(const Scene& scene, std::size_t body, const Body& of_body,
                         const UncertainTables& uncertain, const SampledFalls& simulation, int falls,
                         int draws) {
    MotionError result;
    PerMetric<std::vector<double>> drawn;
    if (!uncertain.unsolved.empty()) {
        Body other = of_body;
        for (int draw = 0; draw < draws; ++draw) {
            other.tables =
                drawn_tables(*of_body.tables, of_body.symmetry, uncertain, static_cast<std::uint32_t>(draw));
            const SampledFalls drawn_falls = simulate_for_bake(scene, body, other, falls);
            for (const Metric metric : baked_metrics) {
                if (const auto mean = drawn_falls.mean(metric)) drawn[metric].push_back(mean->value);
            }
        }
    }
    for (const Metric metric : baked_metrics) {
        const CataloguedMetric& entry = catalogued(metric);
        const auto mean = simulation.mean(metric);
        if (!mean || !(std::abs(mean->value) > 0.0) || !tells(entry.subject, of_body)) continue;
        const double value = mean->value;
        const double chance = mean->error.value_or(0.0);
        const double length = reference_length(of_body.moments.surface_area);
        MotionError::OfMetric error{0.0, chance / std::abs(value),
                                    negligible(entry, simulation, length) / std::abs(value)};
        if (2 * drawn[metric].size() > static_cast<std::size_t>(draws)) {
            // Both ensembles of a difference contribute chance, which a few draws do not show completely.
            const double of_chance = 2.0 * chance * chance;
            const double of_table = std::max(variance_of(drawn[metric], value) - of_chance, 0.0) +
                                    of_chance * std::sqrt(2.0 / static_cast<double>(draws));
            error.of_table = std::sqrt(of_table) / std::abs(value);
        }
        result.metrics[metric] = error;
    }
    return result;
}

}  // namespace samara
