#include "samara/core/dynamics/immersed_body.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/body/body_check.hpp"
#include "samara/core/dynamics/dynamic_coefficients.hpp"
#include "samara/core/surface/octahedral_map.hpp"
#include "samara/core/surface/surface_patches.hpp"

namespace samara {
namespace {

double rotation_scale(const Matrix6d& inertia, const Matrix3d& added_mass) {
    const Vector3d masses = eigenvalues_of(added_mass);
    const Matrix3d rotational = inertia.topLeftCorner<3, 3>();
    const double smallest = eigenvalues_of(rotational).x();
    return std::sqrt((masses.z() - masses.x()) / smallest);
}

void require_tables(const Body& body, const BodyPhysics& physics, const std::string& name) {
    if (body.tables || !uses_body_tables(physics.loads, physics.turbulence)) return;
    throw Error(
        fmt::format("body '{0}': {1} = \"table\", but its file holds no tables; make them with 'samara bake "
                    "SCENE -o DIR' and simulate with --bodies DIR, or set {1} otherwise",
                    name, physics.loads == Loads::table ? "loads" : "turbulence"));
}

void require_surface_loads(const Body& body, const BodyPhysics& physics, const std::string& name) {
    if (physics.loads != Loads::surface || body.surface_loads) return;
    throw Error(
        fmt::format("body '{}': loads = \"surface\", but its file holds no surface loads; add them "
                    "with 'samara kirchhoff FILE -o FILE', or set loads otherwise",
                    name));
}

/// Returns the tables that the steps read: those of the body file, or those made of its surface loads.
std::optional<LoadTables> tables_of(const Body& body, const BodyPhysics& physics, double length) {
    std::optional<LoadTables> tables;
    if (physics.loads == Loads::surface) tables = as_tables(*body.surface_loads, length);
    if (uses_body_tables(physics.loads, physics.turbulence)) tables = body.tables;
    if (!tables || !physics.table_reynolds_number) return tables;
    return at_reynolds_number(*tables, *physics.table_reynolds_number);
}

/// Returns projected_area() in all directions of the map, with each triangle's area vector computed once.
std::vector<double> projected_areas(const Surface& surface) {
    Eigen::MatrixX3d area_vectors(static_cast<Eigen::Index>(surface.triangle_count()), 3);
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        area_vectors.row(static_cast<Eigen::Index>(t)) = area_vector(surface, t).transpose();
    }
    std::vector<double> areas;
    for (const Vector3d& direction : octahedral_nodes(projection_subdivisions)) {
        areas.push_back(0.5 * (area_vectors * direction).cwiseAbs().sum());
    }
    return areas;
}

// Returns the square of wake_formation_lengths times the extent along a direction: that of the ellipsoid with
// the body's second moments.
Matrix3d squared_formation_length(const VolumeMoments& moments) {
    const PrincipalValues principal = principal_values(moments.second_moments);
    const Vector3d squared_extents = (20.0 / moments.volume * principal.values).cwiseMax(0.0);
    const Vector3d squares = wake_formation_lengths * wake_formation_lengths * squared_extents;
    return principal.directions * squares.asDiagonal() * principal.directions.transpose();
}

// Second moments are equal within this, relative to the larger.
constexpr double alike = 0.02;

// Returns ImmersedBody::spin_about_symmetry: about the principal axes across which the other two moments are
// equal.
Matrix3d spin_about_symmetry(const VolumeMoments& moments) {
    const PrincipalValues principal = principal_values(moments.second_moments);
    Vector3d spun_axes;
    for (Eigen::Index i = 0; i < 3; ++i) {
        const double a = principal.values[(i + 1) % 3];
        const double b = principal.values[(i + 2) % 3];
        spun_axes[i] = std::abs(a - b) <= alike * std::max(a, b) ? 1.0 : 0.0;
    }
    return principal.directions * spun_axes.asDiagonal() * principal.directions.transpose();
}

/// Removes the transport of a momentum that the scene leaves out.
DynamicCoefficients without_momentum(DynamicCoefficients coefficients, const BodyPhysics& physics) {
    if (physics.added_mass) return coefficients;
    coefficients.transport.setZero();
    coefficients.rotational_transport = 0.0;
    return coefficients;
}

DynamicCoefficients dynamic_coefficients_of(const Body& body, const BodyPhysics& physics) {
    if (physics.loads == Loads::none) return {};
    if (physics.dynamic == Dynamic::none) return no_dynamic_coefficients(body);
    if (physics.loads == Loads::coefficients) return rotational_drag_alone(body);
    if (physics.loads == Loads::surface) return without_momentum(surface_dynamic_coefficients(body), physics);
    const bool own = physics.dynamic == Dynamic::of_body && body.dynamic;
    DynamicCoefficients coefficients = own ? body.dynamic->values : default_dynamic_coefficients(body);
    if (!own && body.dynamic) coefficients.origin = "dynamic coefficients by default";
    return without_momentum(std::move(coefficients), physics);
}

/// Returns ImmersedBody::roll_drag.
Matrix3d roll_drag_of(const Body& body, const BodyPhysics& physics) {
    const bool is_steady = physics.loads == Loads::table || physics.loads == Loads::surface;
    if (!is_steady || physics.dynamic == Dynamic::none) return Matrix3d::Zero();
    return usual_rotational_drag * rotational_drag_tensor(body.surface, body.moments.centroid);
}

/// Returns rho_f K_fluid; zero where the scene leaves it out.
Matrix6d fluid_inertia_of(const Body& body, const BodyPhysics& physics, const Fluid& fluid,
                          const std::string& name) {
    if (!physics.added_mass) return Matrix6d::Zero();
    if (!body.kirchhoff) {
        throw Error(fmt::format(
            "body '{}': its file holds no Kirchhoff tensor; add it with 'samara kirchhoff', or set "
            "added_mass = false",
            name));
    }
    return fluid.density * body.kirchhoff->matrix;
}

}  // namespace

Matrix6d own_inertia(const ImmersedBody& body) {
    Matrix6d inertia = Matrix6d::Zero();
    inertia.topLeftCorner<3, 3>() = body.own_inertia;
    inertia.bottomRightCorner<3, 3>() = body.mass * Matrix3d::Identity();
    return inertia;
}

void prepare(ImmersedBody& body) {
    body.inverse_inertia = body.inertia.inverse();
    body.constants = step_constants(body);
}

ImmersedBody make_immersed_body(const Body& body, const BodyPhysics& physics, const Fluid& fluid,
                                const std::string& name, bool touches) {
    const Matrix6d fluid_inertia = fluid_inertia_of(body, physics, fluid, name);
    require_tables(body, physics, name);
    require_surface_loads(body, physics, name);
    require_sound(body, physics, fluid, name);
    const MassProperties mass = mass_properties(body, mass_asked_or_own(physics.mass, body));

    ImmersedBody result;
    result.name = name;
    result.mass = mass.mass;
    result.keeps_thickness = mass_asked_or_own(physics.mass, body).area_density.has_value();
    result.volume = body.moments.volume;
    result.fluid_density = fluid.density;
    result.viscosity = fluid.viscosity;
    result.center_of_mass = mass.center_of_mass;
    result.center_of_buoyancy = body.moments.centroid - mass.center_of_mass;
    result.to_centroid.block<3, 3>(3, 0) = -skew(result.center_of_buoyancy);
    result.own_inertia = mass.inertia;
    result.added_mass = fluid_inertia.bottomRightCorner<3, 3>();
    result.added_inertia = fluid_inertia.topLeftCorner<3, 3>();
    result.added_coupling = fluid_inertia.topRightCorner<3, 3>();
    result.inertia =
        own_inertia(result) + result.to_centroid.transpose() * fluid_inertia * result.to_centroid;
    if (Eigen::LLT<Matrix6d>(result.inertia).info() != Eigen::Success) {
        throw Error(
            fmt::format("body '{}': the sum of its inertia and its added inertia is not positive definite; "
                        "compute the Kirchhoff tensor with more triangles",
                        name));
    }
    if (touches) result.contact_points = contact_points(body.surface, mass.center_of_mass);
    result.rotation_scale = rotation_scale(result.inertia, result.added_mass);
    result.length = reference_length(body.moments.surface_area);
    result.reference_area = std::numbers::pi * result.length * result.length / 4.0;
    result.projected_area_tensor = projected_area_tensor(body);
    result.squared_formation_length = squared_formation_length(body.moments);
    result.spin_about_symmetry = spin_about_symmetry(body.moments);

    result.loads = physics.loads;
    result.coefficients = physics.coefficients;
    if (!result.coefficients.normal) result.coefficients.normal = principal_axes(body.moments).col(0);
    if (result.loads == Loads::coefficients && !physics.coefficients.reference_area) {
        result.projected_areas = projected_areas(body.surface);
    }
    result.dynamic = dynamic_coefficients_of(body, physics);
    result.roll_drag = roll_drag_of(body, physics);
    result.turbulence = physics.turbulence;
    result.turbulent_kinetic_energy = physics.turbulent_kinetic_energy;
    result.dissipation_rate = physics.dissipation_rate;
    result.langevin = physics.langevin;
    result.tables = tables_of(body, physics, result.length);
    if (physics.patches > 1) {
        const bool tabled = result.loads != Loads::coefficients && result.tables.has_value();
        DividedSurface divided = tabled ? divided_surface(body, *result.tables, physics.patches)
                                        : divided_surface(body, physics.patches);
        result.dynamic = within_patches(std::move(result.dynamic), divided);
        result.roll_drag = within_patches(result.roll_drag, divided);
        result.patches = std::move(divided.patches);
    }
    prepare(result);
    return result;
}

namespace {

/// Checks of one body, whose name leads every message.
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
        require(values.allFinite(), member, "finite");
    }

  private:
    std::string_view name_;
};

void check_surface(const NamedChecks& checks, const Surface& surface) {
    checks.require(!surface.corners.empty(), "surface", "a surface of at least one triangle");
    for (const Vector3d& vertex : surface.vertices) checks.finite(vertex, "surface.vertices");
    const auto count = static_cast<std::int64_t>(surface.vertices.size());
    for (const auto& triangle : surface.corners) {
        for (const auto corner : triangle) {
            checks.require(corner >= 0 && corner < count, "surface.corners", "indices of vertices");
        }
    }
}

void check_tables(const NamedChecks& checks, const LoadTables& tables) {
    checks.positive(tables.reference_length, "tables.reference_length");
    checks.require(tables.subdivisions >= 1, "tables.subdivisions", "at least one");
    checks.finite(tables.axes, "tables.axes");
    const std::vector<double>& numbers = tables.reynolds_numbers;
    checks.require(!numbers.empty(), "tables.reynolds_numbers", "at least one number");
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
        if (!sound) checks.require(false, fmt::format("tables.entries[{}]", i), "finite");
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
                   "dissipation_rate", "above zero if turbulent_kinetic_energy is");
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
            "body '{}': has no density, and its body file has no mass; give density, mass or area_density",
            name));
    }
    if (const std::string error = error_of(mass); !error.empty()) {
        throw Error(fmt::format("body '{}': {}", name, error));
    }
    if (body.kirchhoff && physics.added_mass) checks.finite(body.kirchhoff->matrix, "kirchhoff.matrix");
    if (body.tables && uses_body_tables(physics.loads, physics.turbulence)) {
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
    const std::string error = error_of(body.dynamic->values);
    if (!error.empty()) throw Error(fmt::format("body '{}': dynamic.{}", name, error));
}

std::shared_ptr<const ImmersedBody> PreparedBodies::get(const Body& body, const BodyPhysics& physics,
                                                        const Fluid& fluid, const std::string& name,
                                                        bool touches) {
    const std::lock_guard lock(mutex_);
    const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
        return entry.fluid_density == fluid.density && entry.viscosity == fluid.viscosity &&
               entry.physics == physics && entry.touches >= touches;
    });
    if (found != entries_.end()) return found->body;
    auto prepared =
        std::make_shared<const ImmersedBody>(make_immersed_body(body, physics, fluid, name, touches));
    if (entries_.size() == most_) entries_.erase(entries_.begin());
    entries_.push_back({physics, fluid.density, fluid.viscosity, touches, prepared});
    return prepared;
}

}  // namespace samara
