#include <array>
#include <cmath>
#include <numbers>

#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/kernel/step_constants.hpp"

namespace samara {
namespace {

Triple<double> triple(const Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}

Square<double> square(const Matrix3d& m) {
    return {triple(m.row(0)), triple(m.row(1)), triple(m.row(2))};
}

/// Converts a matrix that is symmetric but for rounding.
Square<double> symmetric(const Matrix3d& m) {
    return square(0.5 * (m + m.transpose()));
}

void set_planes(const std::vector<double>& reynolds_numbers, DirectionTable<double>& table) {
    for (const double number : reynolds_numbers) {
        table.reynolds_numbers.push_back(number);
        table.logarithms.push_back(std::log(number));
    }
    for (std::size_t i = 1; i < reynolds_numbers.size(); ++i) {
        table.inverse_differences.push_back(1.0 / std::log(reynolds_numbers[i] / reynolds_numbers[i - 1]));
    }
}

/// Returns the table whose entry i has the numbers row(i).
template <std::size_t width, class Row>
DirectionTable<double> direction_table(const LoadTables& tables, const Row& row) {
    DirectionTable<double> result;
    result.width = static_cast<int>(width);
    result.side = tables.map_size();
    result.rotated = !tables.axes.isIdentity(0.0);
    result.to_map_axes = square(tables.axes.transpose());
    set_planes(tables.reynolds_numbers, result);
    for (std::size_t entry = 0; entry < tables.entries.size(); ++entry) {
        const std::array<double, width> numbers = row(entry);
        for (std::size_t i = 0; i < width; i += 4) {
            result.rows.push_back({numbers[i], numbers[i + 1], numbers[i + 2], numbers[i + 3]});
        }
    }
    return result;
}

/// Returns l: a power of two, near L.
double length_scale(const ImmersedBody& body) {
    return std::exp2(std::round(std::log2(body.length)));
}

DirectionTable<double> load_table(const ImmersedBody& body) {
    const double arm = body.length / length_scale(body);
    return direction_table<8>(*body.tables, [&](std::size_t i) {
        Vector3d moment = body.tables->entries[i].moment;
        for (const SteadyPatch& patch : body.patches) {
            if (!patch.force.empty()) moment -= patch.place.cross(patch.force[i]) / body.length;
        }
        const Vector3d f = body.dynamic.unsteady_factor * body.tables->entries[i].force;
        const Vector3d m = body.dynamic.unsteady_factor * arm * moment;
        return std::array<double, 8>{f.x(), f.y(), f.z(), 0.0, m.x(), m.y(), m.z(), 0.0};
    });
}

DirectionTable<double> patch_table(const ImmersedBody& body, const SteadyPatch& patch) {
    if (patch.force.empty()) return {};
    return direction_table<4>(*body.tables, [&](std::size_t i) {
        const Vector3d f = body.dynamic.unsteady_factor * patch.force[i];
        return std::array<double, 4>{f.x(), f.y(), f.z(), 0.0};
    });
}

DirectionTable<double> turbulence_table(const ImmersedBody& body) {
    const double scale = length_scale(body) / body.length;
    return direction_table<4>(*body.tables, [&](std::size_t i) {
        const LoadEntry& entry = body.tables->entries[i];
        return std::array<double, 4>{entry.turbulent_kinetic_energy, scale * entry.dissipation_rate, 0.0,
                                     0.0};
    });
}

/// Returns the area relative to A by direction: the projected one, or a given one everywhere.
DirectionTable<double> area_table(const ImmersedBody& body) {
    DirectionTable<double> table;
    table.width = 8;
    table.side = body.coefficients.reference_area ? 3 : 2 * projection_subdivisions + 1;
    table.to_map_axes = square(Matrix3d::Identity());
    table.reynolds_numbers = {1.0};
    table.logarithms = {0.0};
    const auto nodes = static_cast<std::size_t>(table.side) * static_cast<std::size_t>(table.side);
    for (std::size_t node = 0; node < nodes; ++node) {
        const double area =
            body.coefficients.reference_area ? *body.coefficients.reference_area : body.projected_areas[node];
        table.rows.push_back({area / body.reference_area, 0, 0, 0});
        table.rows.push_back({});
    }
    return table;
}

void set_inertia(const ImmersedBody& body, StepConstants& c) {
    const Matrix6d from_centroid = body.to_centroid.inverse();
    const Matrix6d inertia = from_centroid.transpose() * body.inertia * from_centroid;
    const double length = length_scale(body);
    const double mass = inertia.bottomRightCorner<3, 3>().trace() / 3.0;
    const Matrix3d angular = inertia.topLeftCorner<3, 3>() / (mass * length * length);
    const Matrix3d moving = inertia.bottomRightCorner<3, 3>() / mass;
    c.mass_scale = mass;
    c.inertia_angular = symmetric(angular);
    c.off_center = !body.center_of_buoyancy.isZero(0.0);
    c.coupled = !inertia.topRightCorner<3, 3>().isZero(0.0);
    c.inertia_coupling = square(inertia.topRightCorner<3, 3>() / (mass * length));
    c.directed_inertia = symmetric(moving - Matrix3d::Identity());
    c.inverse_angular = triple(angular.diagonal().cwiseInverse());
    c.inverse_linear = triple(moving.diagonal().cwiseInverse());
    c.weight = (body.mass - body.fluid_density * body.volume) / (mass * length);
    c.weight_moment = triple(-body.mass / (mass * length * length) * body.center_of_buoyancy);
    c.keeps_thickness = body.keeps_thickness;
    c.own_mass = body.mass / mass;
    const Matrix6d own = from_centroid.transpose() * own_inertia(body) * from_centroid;
    c.own_angular = symmetric(own.topLeftCorner<3, 3>() / (mass * length * length));
    c.own_coupling = square(own.topRightCorner<3, 3>() / (mass * length));
    c.tip_square = 0.25 * body.length * body.length / (length * length);
    c.munk_rate = body.rotation_scale * length;
}

double reynolds_factor(const ImmersedBody& body) {
    return body.length * length_scale(body) * body.fluid_density / body.viscosity;
}

/// Returns the tensor less its isotropic part.
Matrix3d directed(const Matrix3d& tensor) {
    return tensor - tensor.trace() / 3.0 * Matrix3d::Identity();
}

void set_transport(const ImmersedBody& body, double mass, double length, StepConstants& c) {
    const Matrix3d transport = body.fluid_density / mass * body.dynamic.transport;
    c.isotropic_transport = transport.trace() / 3.0;
    c.spin_lift_onset = body.dynamic.spin_lift_onset;
    c.directed_transport = symmetric(directed(transport));
    const double share = body.dynamic.rotational_transport / mass;
    c.transports_rotation = share != 0.0;
    c.transport_of_rotation = symmetric(share / (length * length) * body.added_inertia);
    c.coupling_transport = square(share / length * body.added_coupling);
}

/// Returns the difference by which the rotational drag of falls, in the mean over the axes, lies below the
/// least about the direction of motion (m^4).
Matrix3d lacking_roll_drag(const ImmersedBody& body) {
    if (body.roll_drag.isZero(0.0)) return Matrix3d::Zero();
    const double share = body.dynamic.rotational_drag.trace() / body.roll_drag.trace();
    return std::max(0.0, 1.0 - share) * body.roll_drag;
}

void set_loads(const ImmersedBody& body, StepConstants& c) {
    const double mass = c.mass_scale;
    const double length = length_scale(body);
    const double half_density = 0.5 * body.fluid_density;
    const DynamicCoefficients& dynamic = body.dynamic;
    const double steady_factor = half_density * body.reference_area * length / mass;
    c.loads = body.loads;
    c.steady_factor = steady_factor;
    c.reynolds_factor = reynolds_factor(body);
    c.half_length = dynamic.half_length / length;
    // The constants of the loads of the surface were chosen on whole falls, without a start of their own.
    c.wake_forms = body.loads != Loads::coefficients && !body.tables->stokes_throughout;
    c.squared_formation_length = symmetric(body.squared_formation_length / (length * length));
    c.settling_over_formation = wake_formation_lengths / dynamic.settling_length;
    c.has_spin_about_symmetry = !body.spin_about_symmetry.isZero(0.0);
    c.spin_about_symmetry = symmetric(body.spin_about_symmetry);
    c.drag_in_motion = symmetric(half_density * length / mass * dynamic.drag_in_motion);
    c.has_spin = !dynamic.drag_in_spin.isZero(0.0) || !dynamic.rotational_drag_in_spin.isZero(0.0);
    c.drag_in_spin = symmetric(half_density * length / mass * dynamic.drag_in_spin);
    c.rotational_drag = symmetric(half_density / (mass * length) * dynamic.rotational_drag);
    c.laminar_rotation = dynamic.laminar_rotational_drag * std::sqrt(1000.0 / c.reynolds_factor);
    const Matrix3d lacking = lacking_roll_drag(body);
    c.has_roll_drag = !lacking.isZero(0.0);
    c.lacking_roll_drag = symmetric(half_density / (mass * length) * lacking);
    c.rotational_drag_in_spin = symmetric(half_density / (mass * length) * dynamic.rotational_drag_in_spin);
    set_transport(body, mass, length, c);
    for (const SteadyPatch& patch : body.patches) {
        c.patches.push_back({triple(patch.place / length), patch.share, patch_table(body, patch)});
    }
    const double creeping = std::numbers::pi * body.viscosity * body.length / mass;
    const double ratio = body.length / length;
    c.creeping_rotation = creeping * ratio * ratio;
    if (body.loads != Loads::coefficients) {
        c.creeping_drag = 3.0 * creeping;
        c.potential_transport = symmetric(directed(body.added_mass - body.fluid_density * dynamic.transport) /
                                          (mass * steady_factor));
        c.creeping_fades = body.tables->stokes_throughout ? 0.0 : 1.0 / body.tables->reynolds_numbers.front();
        c.loads_by_direction = load_table(body);
    } else {
        c.drag_coefficient = body.coefficients.drag_coefficient;
        c.twice_lift_coefficient = 2.0 * body.coefficients.lift_coefficient;
        c.normal = triple(*body.coefficients.normal);
        c.center_of_pressure = triple(body.coefficients.center_of_pressure / length);
        c.loads_by_direction = area_table(body);
    }
}

}  // namespace

StepConstants step_constants(const ImmersedBody& body) {
    StepConstants c;
    c.length = length_scale(body);
    c.inverse_length = 1.0 / length_scale(body);
    c.inverse_eddy_length = 1.0 / body.length;
    c.center_of_buoyancy = triple(body.center_of_buoyancy);
    set_inertia(body, c);
    if (body.loads != Loads::none) set_loads(body, c);
    c.turbulence = body.turbulence;
    c.langevin = body.langevin == Langevin::wake && body.turbulence != Turbulence::table
                     ? Langevin::sampled_turbulence
                     : body.langevin;
    c.has_side_pressure =
        body.loads != Loads::none && body.turbulence == Turbulence::table && c.langevin == Langevin::wake;
    if (c.langevin == Langevin::wake) {
        c.wake_noise = body.tables->turbulence_mean == TurbulenceMean::shell ? wake_noise_of_shell
                                                                             : wake_noise_of_near_wake;
    }
    if (c.has_side_pressure) {
        const double pressure = c.wake_noise.side_pressure * static_cast<double>(c.steady_factor);
        c.side_pressure = symmetric(pressure / body.reference_area * body.projected_area_tensor);
    }
    c.turbulent_kinetic_energy = body.turbulent_kinetic_energy;
    c.dissipation_rate = body.dissipation_rate;
    if (body.turbulence == Turbulence::table) {
        c.reynolds_factor = reynolds_factor(body);
        c.turbulence_by_direction = turbulence_table(body);
    }
    return c;
}

}  // namespace samara
