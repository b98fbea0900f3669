#include "converter/table_filling.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "converter/direction_sampling.hpp"
#include "samara/base/error.hpp"
#include "samara/body/octahedral_map.hpp"

namespace samara {
namespace {

const DirectionSample& sample_in(const Symmetry& symmetry, const std::vector<DirectionSample>& samples,
                                 const Vector3d& direction) {
    const auto found = std::find_if(samples.begin(), samples.end(), [&](const DirectionSample& sample) {
        return (sample.direction - direction).norm() < direction_tolerance(symmetry);
    });
    if (found == samples.end()) {
        throw Error(fmt::format("no case in the direction ({:.6g}, {:.6g}, {:.6g}), which the table needs",
                                direction.x(), direction.y(), direction.z()));
    }
    return *found;
}

FilledMap fill_finite(const Symmetry& symmetry, int subdivisions,
                      const std::vector<DirectionSample>& samples) {
    FilledMap map;
    for (const NodeImage& image : node_images(symmetry, subdivisions)) {
        const DirectionSample& sample = sample_in(symmetry, samples, image.source);
        map.entries.push_back(transformed(sample.entry, image.element));
        map.errors.push_back(transformed_error(sample.error, image.element));
    }
    return map;
}

/// A right-handed frame whose first axis is `first` and whose third is perpendicular to `second`.
Matrix3d frame(const Vector3d& first, const Vector3d& second) {
    Matrix3d axes;
    axes.col(0) = first;
    axes.col(2) = first.cross(second).normalized();
    axes.col(1) = axes.col(2).cross(first);
    return axes;
}

/// What a map of quantities over the polar angle does at its ends: even ones have no slope there, odd ones
/// are zero.
enum class Parity { even, odd };

/// Steffen's slope (per step) at a point between the differences to its two neighbours.
double monotone_slope(double before, double after) {
    if (before * after <= 0.0) return 0.0;
    const double mean = 0.5 * (before + after);
    return std::copysign(std::min({2.0 * std::abs(before), 2.0 * std::abs(after), std::abs(mean)}), mean);
}

/// The values at even steps of an angle as a function of the place counted in steps.
double interpolated(const std::vector<double>& values, Parity at_start, Parity at_end, double place) {
    const auto last = static_cast<int>(values.size()) - 1;
    const auto value = [&](int i) {
        if (i < 0) return (at_start == Parity::even ? 1.0 : -1.0) * values[static_cast<std::size_t>(-i)];
        if (i <= last) return values[static_cast<std::size_t>(i)];
        return (at_end == Parity::even ? 1.0 : -1.0) * values[static_cast<std::size_t>(2 * last - i)];
    };
    const auto slope = [&](int i) {
        return monotone_slope(value(i) - value(i - 1), value(i + 1) - value(i));
    };
    const int step = std::clamp(static_cast<int>(place), 0, last - 1);
    const double t = std::clamp(place - step, 0.0, 1.0);
    const double s = 1.0 - t;
    return s * s * (1.0 + 2.0 * t) * value(step) + t * t * (1.0 + 2.0 * s) * value(step + 1) +
           s * t * (s * slope(step) - t * slope(step + 1));
}

/// The loads of a body of revolution over the polar angle. Vectors are in the frame of the axis, the
/// direction across it towards the motion, and the normal of both.
struct ArcLoads {
    AxialArc arc;
    std::vector<LoadEntry> entries;
    std::vector<LoadEntryError> errors;

    /// One of an entry's numbers, picked by `number`, at a place on the arc.
    template <typename Number>
    double at(double place, Parity at_pole, Parity at_mirror, Number number) const {
        std::vector<double> values;
        for (const LoadEntry& entry : entries) values.push_back(number(entry));
        return interpolated(values, at_pole, arc.mirrored ? at_mirror : at_pole, place);
    }

    LoadEntry entry(double place) const {
        LoadEntry result;
        const auto even = Parity::even;
        const auto odd = Parity::odd;
        result.force[0] = at(place, even, odd, [](const LoadEntry& e) { return e.force[0]; });
        result.force[1] = at(place, odd, even, [](const LoadEntry& e) { return e.force[1]; });
        result.moment[2] = at(place, odd, odd, [](const LoadEntry& e) { return e.moment[2]; });
        result.turbulent_kinetic_energy =
            at(place, even, even, [](const LoadEntry& e) { return e.turbulent_kinetic_energy; });
        result.dissipation_rate =
            at(place, even, even, [](const LoadEntry& e) { return e.dissipation_rate; });
        return result;
    }

    LoadEntryError error(double place) const {
        const auto step = static_cast<std::size_t>(std::clamp(static_cast<int>(place), 0, arc.steps - 1));
        const double t = place - static_cast<double>(step);
        const LoadEntryError& before = errors[step];
        const LoadEntryError& after = errors[step + 1];
        LoadEntryError result;
        result.force = (1.0 - t) * before.force + t * after.force;
        result.moment = (1.0 - t) * before.moment + t * after.moment;
        result.turbulent_kinetic_energy =
            std::lerp(before.turbulent_kinetic_energy, after.turbulent_kinetic_energy, t);
        result.dissipation_rate = std::lerp(before.dissipation_rate, after.dissipation_rate, t);
        return result;
    }
};

ArcLoads arc_loads(const Symmetry& symmetry, int subdivisions, const std::vector<DirectionSample>& samples) {
    ArcLoads loads{axial_arc(symmetry, subdivisions), {}, {}};
    const Matrix3d to_frame = frame(loads.arc.axis, loads.arc.across).transpose();
    for (int step = 0; step <= loads.arc.steps; ++step) {
        const DirectionSample& sample = sample_in(symmetry, samples, loads.arc.direction(step));
        loads.entries.push_back(transformed(sample.entry, to_frame));
        loads.errors.push_back(transformed_error(sample.error, to_frame));
    }
    return loads;
}

void fill_axial_node(const ArcLoads& loads, const Vector3d& node, FilledMap& map) {
    const AxialArc& arc = loads.arc;
    // Beyond the mirror the loads are those of its near side, seen along the axis turned round.
    const double along = arc.axis.dot(node);
    const Vector3d axis = arc.mirrored && along < 0.0 ? Vector3d(-arc.axis) : arc.axis;
    const Vector3d normal = axis.cross(node);
    const double angle = std::atan2(normal.norm(), axis.dot(node));
    const Matrix3d axes = frame(axis, normal.norm() > 1e-9 ? node : arc.across);
    const double place = std::min(angle / arc.step_angle(), static_cast<double>(arc.steps));
    map.entries.push_back(transformed(loads.entry(place), axes));
    map.errors.push_back(transformed_error(loads.error(place), axes));
}

FilledMap fill_axial(const Symmetry& symmetry, int subdivisions,
                     const std::vector<DirectionSample>& samples) {
    const ArcLoads loads = arc_loads(symmetry, subdivisions, samples);
    FilledMap map;
    for (int row = 0; row <= 2 * subdivisions; ++row) {
        for (int column = 0; column <= 2 * subdivisions; ++column) {
            fill_axial_node(loads, octahedral_node(subdivisions, row, column), map);
        }
    }
    return map;
}

FilledMap fill_spherical(const Symmetry& symmetry, int subdivisions,
                         const std::vector<DirectionSample>& samples) {
    const Vector3d solved = required_directions(symmetry, subdivisions).front();
    const DirectionSample& sample = sample_in(symmetry, samples, solved);
    FilledMap map;
    for (int row = 0; row <= 2 * subdivisions; ++row) {
        for (int column = 0; column <= 2 * subdivisions; ++column) {
            const Vector3d node = octahedral_node(subdivisions, row, column);
            const Matrix3d turn = Eigen::Quaterniond::FromTwoVectors(solved, node).toRotationMatrix();
            map.entries.push_back(transformed(sample.entry, turn));
            map.errors.push_back(transformed_error(sample.error, turn));
            // Exactly along the direction, whatever the turn's rounding.
            map.entries.back().force = sample.entry.force.dot(solved) * node;
        }
    }
    return map;
}

}  // namespace

FilledMap fill_map(const Symmetry& symmetry, int subdivisions, const std::vector<DirectionSample>& samples) {
    switch (symmetry.kind) {
        case Symmetry::Kind::spherical:
            return fill_spherical(symmetry, subdivisions, samples);
        case Symmetry::Kind::axial:
            return fill_axial(symmetry, subdivisions, samples);
        case Symmetry::Kind::finite:
            break;
    }
    return fill_finite(symmetry, subdivisions, samples);
}

}  // namespace samara
