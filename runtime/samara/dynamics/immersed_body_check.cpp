#include "samara/dynamics/immersed_body_check.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>

#include <fmt/format.h>

#include "samara/base/error.hpp"

namespace samara {
namespace {

/// The checks of one body, whose name leads every message.
class Door {
  public:
    explicit Door(std::string_view name) : name_(name) {}

    void require(bool holds, std::string_view member, std::string_view must) const {
        if (!holds) throw Error(fmt::format("body '{}': {} must be {}", name_, member, must));
    }
    void positive(double value, std::string_view member) const {
        require(value > 0.0 && std::isfinite(value), member, fmt::format("a positive number, not {}", value));
    }
    void non_negative(double value, std::string_view member) const {
        require(value >= 0.0 && std::isfinite(value), member,
                fmt::format("zero or a positive number, not {}", value));
    }
    void finite(double value, std::string_view member) const {
        require(std::isfinite(value), member, fmt::format("a finite number, not {}", value));
    }
    template <typename Derived>
    void finite(const Eigen::MatrixBase<Derived>& values, std::string_view member) const {
        require(values.allFinite(), member, "of finite numbers");
    }

  private:
    std::string_view name_;
};

void check_surface(const Door& door, const Surface& surface) {
    door.require(!surface.corners.empty(), "surface", "of one triangle at least");
    for (const Vector3d& vertex : surface.vertices) door.finite(vertex, "surface.vertices");
    const auto count = static_cast<std::int64_t>(surface.vertices.size());
    for (const auto& triangle : surface.corners) {
        for (const auto corner : triangle) {
            door.require(corner >= 0 && corner < count, "surface.corners", "numbers of vertices");
        }
    }
}

void check_mass(const Door& door, const MassSpecification& mass) {
    door.require(mass.density.has_value() || mass.mass.has_value(), "density or mass", "given");
    if (mass.density) door.positive(*mass.density, "density");
    if (mass.mass) door.positive(*mass.mass, "mass");
    if (mass.center_of_mass) door.finite(*mass.center_of_mass, "center_of_mass");
    if (!mass.inertia) return;
    door.finite(*mass.inertia, "inertia");
    const Matrix3d& inertia = *mass.inertia;
    door.require((inertia - inertia.transpose()).norm() <= 1e-9 * inertia.norm(), "inertia", "symmetric");
}

void check_tables(const Door& door, const LoadTables& tables) {
    door.positive(tables.reference_length, "tables.reference_length");
    door.require(tables.subdivisions >= 1, "tables.subdivisions", "one at least");
    door.finite(tables.axes, "tables.axes");
    const std::vector<double>& numbers = tables.reynolds_numbers;
    door.require(!numbers.empty(), "tables.reynolds_numbers", "one number at least");
    for (const double number : numbers) door.positive(number, "tables.reynolds_numbers");
    door.require(std::adjacent_find(numbers.begin(), numbers.end(), std::greater_equal<>()) == numbers.end(),
                 "tables.reynolds_numbers", "in ascending order");
    const auto side = static_cast<std::size_t>(tables.map_size());
    const std::size_t needed = numbers.size() * side * side;
    door.require(tables.entries.size() == needed, "tables.entries",
                 fmt::format("{} for {} Reynolds numbers and {} x {} directions, not {}", needed,
                             numbers.size(), side, side, tables.entries.size()));
    for (std::size_t i = 0; i < needed; ++i) {
        const LoadEntry& entry = tables.entries[i];
        const bool sound = entry.force.allFinite() && entry.moment.allFinite() &&
                           std::isfinite(entry.turbulent_kinetic_energy) &&
                           std::isfinite(entry.dissipation_rate);
        if (!sound) door.require(false, fmt::format("tables.entries[{}]", i), "of finite numbers");
    }
}

void check_coefficients(const Door& door, const CoefficientLoads& coefficients) {
    door.non_negative(coefficients.drag_coefficient, "drag_coefficient");
    door.finite(coefficients.lift_coefficient, "lift_coefficient");
    if (coefficients.reference_area) door.positive(*coefficients.reference_area, "reference_area");
    if (coefficients.normal) {
        door.require(std::abs(coefficients.normal->norm() - 1.0) <= 1e-6, "normal", "a unit vector");
    }
    door.finite(coefficients.center_of_pressure, "center_of_pressure");
}

void check_turbulence(const Door& door, const SceneBody& scene_body) {
    door.non_negative(scene_body.turbulent_kinetic_energy, "turbulent_kinetic_energy");
    door.non_negative(scene_body.dissipation_rate, "dissipation_rate");
    door.require(scene_body.turbulent_kinetic_energy == 0.0 || scene_body.dissipation_rate > 0.0,
                 "dissipation_rate", "above zero where turbulent_kinetic_energy is");
}

}  // namespace

void require_sound(const Body& body, const SceneBody& scene_body, const Fluid& fluid) {
    const Door door(scene_body.name);
    door.positive(fluid.density, "fluid.density");
    door.positive(fluid.viscosity, "fluid.viscosity");
    check_surface(door, body.surface);
    door.positive(body.moments.volume, "moments.volume");
    door.positive(body.moments.surface_area, "moments.surface_area");
    door.finite(body.moments.centroid, "moments.centroid");
    door.finite(body.moments.second_moments, "moments.second_moments");
    check_mass(door, scene_body.mass);
    if (body.kirchhoff && scene_body.added_mass) door.finite(body.kirchhoff->matrix, "kirchhoff.matrix");
    if (body.tables && (scene_body.loads == Loads::table || scene_body.turbulence == Turbulence::table)) {
        check_tables(door, *body.tables);
    }
    check_coefficients(door, scene_body.coefficients);
    check_turbulence(door, scene_body);
    if (scene_body.table_reynolds_number) {
        door.positive(*scene_body.table_reynolds_number, "table_reynolds_number");
    }
    if (!body.dynamic || scene_body.loads != Loads::table || scene_body.dynamic != Dynamic::of_body) return;
    const std::string fault = fault_of(body.dynamic->values);
    if (!fault.empty()) throw Error(fmt::format("body '{}': dynamic.{}", scene_body.name, fault));
}

}  // namespace samara
