#include "samara/core/dynamics/immersed_body_check.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/body/mass_check.hpp"
#include "samara/core/surface/surface_patches.hpp"

namespace samara {
namespace {

/// The checks of one body, whose name leads every message.
class NamedChecks {
  public:
    explicit NamedChecks(std::string_view name) : name_(name) {}

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

void check_surface(const NamedChecks& checks, const Surface& surface) {
    checks.require(!surface.corners.empty(), "surface", "of one triangle at least");
    for (const Vector3d& vertex : surface.vertices) checks.finite(vertex, "surface.vertices");
    const auto count = static_cast<std::int64_t>(surface.vertices.size());
    for (const auto& triangle : surface.corners) {
        for (const auto corner : triangle) {
            checks.require(corner >= 0 && corner < count, "surface.corners", "numbers of vertices");
        }
    }
}

void check_tables(const NamedChecks& checks, const LoadTables& tables) {
    checks.positive(tables.reference_length, "tables.reference_length");
    checks.require(tables.subdivisions >= 1, "tables.subdivisions", "one at least");
    checks.finite(tables.axes, "tables.axes");
    const std::vector<double>& numbers = tables.reynolds_numbers;
    checks.require(!numbers.empty(), "tables.reynolds_numbers", "one number at least");
    for (const double number : numbers) checks.positive(number, "tables.reynolds_numbers");
    checks.require(
        std::adjacent_find(numbers.begin(), numbers.end(), std::greater_equal<>()) == numbers.end(),
        "tables.reynolds_numbers", "in ascending order");
    const auto side = static_cast<std::size_t>(tables.map_size());
    const std::size_t needed = numbers.size() * side * side;
    checks.require(tables.entries.size() == needed, "tables.entries",
                   fmt::format("{} for {} Reynolds numbers and {} x {} directions, not {}", needed,
                               numbers.size(), side, side, tables.entries.size()));
    for (std::size_t i = 0; i < needed; ++i) {
        const LoadEntry& entry = tables.entries[i];
        const bool sound = entry.force.allFinite() && entry.moment.allFinite() &&
                           std::isfinite(entry.turbulent_kinetic_energy) &&
                           std::isfinite(entry.dissipation_rate);
        if (!sound) checks.require(false, fmt::format("tables.entries[{}]", i), "of finite numbers");
    }
}

void check_coefficients(const NamedChecks& checks, const CoefficientLoads& coefficients) {
    checks.non_negative(coefficients.drag_coefficient, "drag_coefficient");
    checks.finite(coefficients.lift_coefficient, "lift_coefficient");
    if (coefficients.reference_area) checks.positive(*coefficients.reference_area, "reference_area");
    if (coefficients.normal) {
        checks.require(std::abs(coefficients.normal->norm() - 1.0) <= 1e-6, "normal", "a unit vector");
    }
    checks.finite(coefficients.center_of_pressure, "center_of_pressure");
}

void check_turbulence(const NamedChecks& checks, const BodyPhysics& physics) {
    checks.non_negative(physics.turbulent_kinetic_energy, "turbulent_kinetic_energy");
    checks.non_negative(physics.dissipation_rate, "dissipation_rate");
    checks.require(physics.turbulent_kinetic_energy == 0.0 || physics.dissipation_rate > 0.0,
                   "dissipation_rate", "above zero where turbulent_kinetic_energy is");
}

}  // namespace

void require_sound(const Body& body, const BodyPhysics& physics, const Fluid& fluid,
                   const std::string& name) {
    const NamedChecks checks(name);
    checks.positive(fluid.density, "fluid.density");
    checks.positive(fluid.viscosity, "fluid.viscosity");
    check_surface(checks, body.surface);
    checks.positive(body.moments.volume, "moments.volume");
    checks.positive(body.moments.surface_area, "moments.surface_area");
    checks.finite(body.moments.centroid, "moments.centroid");
    checks.finite(body.moments.second_moments, "moments.second_moments");
    const MassSpecification mass = mass_asked_or_own(physics.mass, body);
    if (!mass.is_given()) {
        throw Error(fmt::format(
            "body '{}': density is missing, and its body file says no mass either; give density or mass",
            name));
    }
    if (const std::string fault = fault_of(mass); !fault.empty()) {
        throw Error(fmt::format("body '{}': {}", name, fault));
    }
    if (body.kirchhoff && physics.added_mass) checks.finite(body.kirchhoff->matrix, "kirchhoff.matrix");
    if (body.tables && (physics.loads == Loads::table || physics.turbulence == Turbulence::table)) {
        check_tables(checks, *body.tables);
    }
    check_coefficients(checks, physics.coefficients);
    check_turbulence(checks, physics);
    if (physics.table_reynolds_number) {
        checks.positive(*physics.table_reynolds_number, "table_reynolds_number");
    }
    checks.require(physics.patches >= 1 && physics.patches <= most_surface_patches, "patches",
                   fmt::format("between 1 and {}", most_surface_patches));
    if (!body.dynamic || physics.loads != Loads::table || physics.dynamic != Dynamic::of_body) return;
    const std::string fault = fault_of(body.dynamic->values);
    if (!fault.empty()) throw Error(fmt::format("body '{}': dynamic.{}", name, fault));
}

}  // namespace samara
