#include "samara/core/c_interface/settings.hpp"

#include <cstddef>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "samara/core/base/number_limits.hpp"
#include "samara/core/c_interface/guard.hpp"
#include "samara/core/c_interface/members.hpp"
#include "samara/core/surface/surface_patches.hpp"

namespace samara {
namespace {

constexpr std::uint32_t most_bodies_of_a_kind = 10'000'000;
constexpr int most_threads = 1024;
// Up to the last member that version 1 had.
constexpr std::size_t first_settings_size = offsetof(samara_settings, ground) + sizeof(double);
constexpr std::size_t first_kind_size = offsetof(samara_kind, langevin) + sizeof(std::int32_t);
// The first member of a version lies where the struct of the one before ended, and not in its padding, which
// callers do not fill.
static_assert(offsetof(samara_settings, wind) % alignof(samara_settings) == 0);
static_assert(offsetof(samara_settings, bodies_meet) % alignof(samara_settings) == 0);
static_assert(offsetof(samara_kind, table_reynolds_number) % alignof(samara_kind) == 0);
static_assert(offsetof(samara_kind, patches) % alignof(samara_kind) == 0);
static_assert(offsetof(samara_kind, spread_start) % alignof(samara_kind) == 0);

MassSpecification read_mass(const samara_kind& kind) {
    MassSpecification mass;
    if (non_negative(kind.density, "density") > 0.0) mass.density = kind.density;
    if (non_negative(kind.mass, "mass") > 0.0) mass.mass = kind.mass;
    if (mass.density && mass.mass) refuse("density", "and mass are both given; give one of the two");
    if (kind.has_center_of_mass != 0) mass.center_of_mass = vector(kind.center_of_mass, "center_of_mass");
    Matrix3d inertia = Eigen::Map<const Matrix3d>(kind.inertia);
    for (const double value : kind.inertia) finite(value, "inertia");
    if (!inertia.isZero(0.0)) {
        if ((inertia - inertia.transpose()).norm() > 1e-9 * inertia.norm())
            refuse("inertia", "must be symmetric");
        mass.inertia = inertia;
    }
    if (!mass.mass && (mass.center_of_mass || mass.inertia)) {
        refuse(mass.inertia ? "inertia" : "center_of_mass",
               mass.density ? "contradicts a uniform density; give mass instead of density"
                            : "stands alone; give mass with it");
    }
    return mass;
}

CoefficientLoads read_coefficients(const samara_kind& kind) {
    CoefficientLoads coefficients;
    coefficients.drag_coefficient = non_negative(kind.drag_coefficient, "drag_coefficient");
    coefficients.lift_coefficient = finite(kind.lift_coefficient, "lift_coefficient");
    if (non_negative(kind.reference_area, "reference_area") > 0.0) {
        coefficients.reference_area = kind.reference_area;
    }
    const Vector3d normal = vector(kind.normal, "normal");
    if (normal.norm() >= smallest_number) {
        coefficients.normal = normal.normalized();
    } else if (!normal.isZero(0.0)) {
        refuse("normal", "is too short to have a direction");
    }
    coefficients.center_of_pressure = vector(kind.center_of_pressure, "center_of_pressure");
    return coefficients;
}

void read_turbulence(const samara_kind& kind, GivenKind& body) {
    if (kind.turbulence == SAMARA_TURBULENCE_AS_LOADS) {
        body.turbulence = body.loads == Loads::table ? Turbulence::table : Turbulence::none;
    } else {
        body.turbulence = choice<Turbulence>(kind.turbulence, SAMARA_TURBULENCE_TABLE, "turbulence");
    }
    body.turbulent_kinetic_energy = non_negative(kind.turbulent_kinetic_energy, "turbulent_kinetic_energy");
    body.dissipation_rate = non_negative(kind.dissipation_rate, "dissipation_rate");
    if (body.turbulence == Turbulence::constant &&
        (kind.turbulent_kinetic_energy > 0.0) != (kind.dissipation_rate > 0.0)) {
        refuse("dissipation_rate", "and turbulent_kinetic_energy must be both zero or both above zero");
    }
    body.langevin = choice<Langevin>(kind.langevin, SAMARA_LANGEVIN_WAKE, "langevin");
}

/// What the equations hold, beside loads, coefficients and turbulence, which are read before.
void read_models(const samara_kind& kind, GivenKind& body) {
    body.added_mass = kind.added_mass != 0;
    if (kind.patches < 1 || kind.patches > most_surface_patches) {
        refuse("patches",
               fmt::format("is {}; it must lie between 1 and {}", kind.patches, most_surface_patches));
    }
    body.patches = kind.patches;
    body.dynamic = choice<Dynamic>(kind.dynamic_coefficients, SAMARA_DYNAMIC_NONE, "dynamic_coefficients");
    if (!(non_negative(kind.table_reynolds_number, "table_reynolds_number") > 0.0)) return;
    if (body.loads != Loads::table && body.turbulence != Turbulence::table) {
        refuse("table_reynolds_number", "is for loads or turbulence from the table");
    }
    body.table_reynolds_number = kind.table_reynolds_number;
}

void read_start(const samara_kind& kind, GivenKind& body) {
    body.position = vector(kind.position, "position");
    body.orientation = orientation(kind.orientation, "orientation");
    body.velocity = vector(kind.velocity, "velocity");
    body.angular_velocity = vector(kind.angular_velocity, "angular_velocity");
    body.start = non_negative(kind.start, "start");
    if (kind.count < 1 || kind.count > most_bodies_of_a_kind) {
        refuse("count", fmt::format("must lie between 1 and {}", most_bodies_of_a_kind));
    }
    body.count = static_cast<int>(kind.count);
    body.spread_position = vector(kind.spread_position, "spread_position");
    body.spread_angle = non_negative(kind.spread_angle, "spread_angle");
    if (body.spread_angle > std::numbers::pi) refuse("spread_angle", "must lie between 0 and pi");
    body.spread_start = non_negative(kind.spread_start, "spread_start");
    body.smallest_size = positive(kind.smallest_size, "smallest_size");
    body.largest_size = positive(kind.largest_size, "largest_size");
    if (body.largest_size < body.smallest_size) {
        refuse("largest_size",
               fmt::format("is {:g}, below smallest_size, {:g}", body.largest_size, body.smallest_size));
    }
    if (body.count == 1 && body.largest_size != body.smallest_size) {
        refuse("largest_size", "differs from smallest_size, but count is 1: give both the size of that body");
    }
    if (body.count == 1 && body.spreads()) {
        refuse("count",
               "is 1, but spread_position, spread_angle or spread_start is not 0: they are of several");
    }
}

}  // namespace

samara_settings default_settings() {
    const Fluid water;
    const FlightSettings standard;
    samara_settings settings{};
    settings.size = sizeof settings;
    settings.fluid_density = water.density;
    settings.fluid_viscosity = water.viscosity;
    settings.gust_period = water.gust.period;
    for (int i = 0; i < 3; ++i) settings.gravity[i] = standard.gravity[i];
    settings.step = standard.step;
    settings.seed = standard.seed;
    settings.threads = standard.threads;
    return settings;
}

FlightSettings read_settings(const samara_settings& settings) {
    const samara_settings given = known_part(settings, default_settings(), first_settings_size, "settings");
    FlightSettings result;
    result.fluid.density = positive(given.fluid_density, "fluid_density");
    result.fluid.viscosity = positive(given.fluid_viscosity, "fluid_viscosity");
    result.fluid.current = vector(given.current, "current");
    result.fluid.gust.amplitude = vector(given.gust_amplitude, "gust_amplitude");
    result.fluid.gust.period = positive(given.gust_period, "gust_period");
    result.gravity = vector(given.gravity, "gravity");
    if (given.has_ground != 0) result.ground = finite(given.ground, "ground");
    result.wind.function = given.wind;
    result.wind.function_context = given.wind_context;
    result.bodies_meet = given.bodies_meet != 0;
    result.step = positive(given.step, "step");
    result.seed = given.seed;
    result.first_run = given.run;
    if (given.threads < 0 || given.threads > most_threads) {
        refuse("threads", fmt::format("must lie between 0 and {}", most_threads));
    }
    result.threads = given.threads;
    return result;
}

samara_kind default_kind() {
    const GivenKind body;
    samara_kind kind{};
    kind.size = sizeof kind;
    kind.count = 1;
    kind.orientation[0] = 1.0;
    kind.loads = SAMARA_LOADS_TABLE;
    kind.drag_coefficient = body.coefficients.drag_coefficient;
    kind.lift_coefficient = body.coefficients.lift_coefficient;
    kind.turbulence = SAMARA_TURBULENCE_AS_LOADS;
    kind.langevin = SAMARA_LANGEVIN_WAKE;
    kind.added_mass = 1;
    kind.patches = 1;
    kind.smallest_size = 1.0;
    kind.largest_size = 1.0;
    kind.dynamic_coefficients = SAMARA_DYNAMIC_OF_BODY;
    return kind;
}

GivenKind read_kind(const samara_kind& given) {
    const samara_kind kind = known_part(given, default_kind(), first_kind_size, "kind");
    GivenKind body;
    if (kind.name != nullptr) body.name = plain_name(kind.name, "name");
    body.mass = read_mass(kind);
    read_start(kind, body);
    body.loads = choice<Loads>(kind.loads, SAMARA_LOADS_SURFACE, "loads");
    body.coefficients = read_coefficients(kind);
    read_turbulence(kind, body);
    read_models(kind, body);
    return body;
}

void require_data(const Body& body, const GivenKind& kind) {
    const std::string& name = kind.name.empty() ? body.name : kind.name;
    if (!mass_asked_or_own(kind.mass, body).is_given()) {
        refuse("density", "or mass is missing, and the body file has none; give one of the two");
    }
    if (kind.added_mass && !body.kirchhoff) {
        throw Fault(SAMARA_MISSING_DATA,
                    fmt::format("body '{}' holds no added mass; add it with 'samara kirchhoff', or set "
                                "added_mass to 0",
                                name));
    }
    if (kind.loads == Loads::surface && !body.surface_loads) {
        throw Fault(SAMARA_MISSING_DATA,
                    fmt::format("body '{}' holds no surface loads; add them with 'samara kirchhoff FILE -o "
                                "FILE', or set loads otherwise",
                                name));
    }
    if (kind.loads == Loads::surface && kind.turbulence == Turbulence::table) {
        refuse("turbulence", "is from the table, and the loads are not; set it otherwise");
    }
    const bool loads = kind.loads == Loads::table;
    if ((loads || kind.turbulence == Turbulence::table) && !body.tables) {
        throw Fault(
            SAMARA_MISSING_DATA,
            fmt::format("body '{0}' holds no tables, which {1} asks for; make them with 'samara bake', or "
                        "set {1} otherwise",
                        name, loads ? "loads" : "turbulence"));
    }
}

}  // namespace samara
