#include "samara/core/c_interface/settings.hpp"

#include <cstddef>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "samara/core/base/numbers.hpp"
#include "samara/core/c_interface/guard.hpp"
#include "samara/core/c_interface/members.hpp"
#include "samara/core/surface/surface_patches.hpp"

namespace samara {
namespace {

constexpr std::uint32_t most_bodies_of_a_group = 10'000'000;
constexpr int most_threads = 1024;
// The size up to the last member of version 1.
constexpr std::size_t first_settings_size = offsetof(samara_settings, ground) + sizeof(double);
constexpr std::size_t first_group_size = offsetof(samara_body_group, langevin) + sizeof(std::int32_t);
// The first member of a version lies where the struct of the one before ended, and not in its padding, which
// callers do not fill.
static_assert(offsetof(samara_settings, wind) % alignof(samara_settings) == 0);
static_assert(offsetof(samara_settings, bodies_collide) % alignof(samara_settings) == 0);
static_assert(offsetof(samara_body_group, table_reynolds_number) % alignof(samara_body_group) == 0);
static_assert(offsetof(samara_body_group, patches) % alignof(samara_body_group) == 0);
static_assert(offsetof(samara_body_group, spread_start) % alignof(samara_body_group) == 0);

MassSpecification read_mass(const samara_body_group& group) {
    MassSpecification mass;
    if (non_negative(group.density, "density") > 0.0) mass.density = group.density;
    if (non_negative(group.mass, "mass") > 0.0) mass.mass = group.mass;
    if (mass.density && mass.mass) reject("density", "and mass are both given; give one of the two");
    if (group.has_center_of_mass != 0) mass.center_of_mass = vector(group.center_of_mass, "center_of_mass");
    Matrix3d inertia = Eigen::Map<const Matrix3d>(group.inertia);
    for (const double value : group.inertia) finite(value, "inertia");
    if (!inertia.isZero(0.0)) {
        if ((inertia - inertia.transpose()).norm() > 1e-9 * inertia.norm())
            reject("inertia", "must be symmetric");
        mass.inertia = inertia;
    }
    if (!mass.mass && (mass.center_of_mass || mass.inertia)) {
        reject(mass.inertia ? "inertia" : "center_of_mass",
               mass.density ? "contradicts a uniform density; give mass instead of density"
                            : "stands alone; give mass with it");
    }
    return mass;
}

CoefficientLoads read_coefficients(const samara_body_group& group) {
    CoefficientLoads coefficients;
    coefficients.drag_coefficient = non_negative(group.drag_coefficient, "drag_coefficient");
    coefficients.lift_coefficient = finite(group.lift_coefficient, "lift_coefficient");
    if (non_negative(group.reference_area, "reference_area") > 0.0) {
        coefficients.reference_area = group.reference_area;
    }
    const Vector3d normal = vector(group.normal, "normal");
    if (normal.norm() >= smallest_number) {
        coefficients.normal = normal.normalized();
    } else if (!normal.isZero(0.0)) {
        reject("normal", "is too short to have a direction");
    }
    coefficients.center_of_pressure = vector(group.center_of_pressure, "center_of_pressure");
    return coefficients;
}

void read_turbulence(const samara_body_group& group, GivenGroup& body) {
    if (group.turbulence == SAMARA_TURBULENCE_AS_LOADS) {
        body.turbulence = body.loads == Loads::table ? Turbulence::table : Turbulence::none;
    } else {
        body.turbulence = choice<Turbulence>(group.turbulence, SAMARA_TURBULENCE_TABLE, "turbulence");
    }
    body.turbulent_kinetic_energy = non_negative(group.turbulent_kinetic_energy, "turbulent_kinetic_energy");
    body.dissipation_rate = non_negative(group.dissipation_rate, "dissipation_rate");
    if (body.turbulence == Turbulence::constant &&
        (group.turbulent_kinetic_energy > 0.0) != (group.dissipation_rate > 0.0)) {
        reject("dissipation_rate", "and turbulent_kinetic_energy must be both zero or both above zero");
    }
    body.langevin = choice<Langevin>(group.langevin, SAMARA_LANGEVIN_WAKE, "langevin");
}

/// Reads the models of the equations other than loads, coefficients and turbulence, which are read before.
void read_models(const samara_body_group& group, GivenGroup& body) {
    body.added_mass = group.added_mass != 0;
    if (group.patches < 1 || group.patches > most_surface_patches) {
        reject("patches",
               fmt::format("is {}; it must lie between 1 and {}", group.patches, most_surface_patches));
    }
    body.patches = group.patches;
    body.dynamic = choice<Dynamic>(group.dynamic_coefficients, SAMARA_DYNAMIC_NONE, "dynamic_coefficients");
    if (!(non_negative(group.table_reynolds_number, "table_reynolds_number") > 0.0)) return;
    if (body.loads != Loads::table && body.turbulence != Turbulence::table) {
        reject("table_reynolds_number", "is for loads or turbulence from the table");
    }
    body.table_reynolds_number = group.table_reynolds_number;
}

void read_start(const samara_body_group& group, GivenGroup& body) {
    body.position = vector(group.position, "position");
    body.orientation = orientation(group.orientation, "orientation");
    body.velocity = vector(group.velocity, "velocity");
    body.angular_velocity = vector(group.angular_velocity, "angular_velocity");
    body.start = non_negative(group.start, "start");
    if (group.count < 1 || group.count > most_bodies_of_a_group) {
        reject("count", fmt::format("must lie between 1 and {}", most_bodies_of_a_group));
    }
    body.count = static_cast<int>(group.count);
    body.spread_position = vector(group.spread_position, "spread_position");
    body.spread_angle = non_negative(group.spread_angle, "spread_angle");
    if (body.spread_angle > std::numbers::pi) reject("spread_angle", "must lie between 0 and pi");
    body.spread_start = non_negative(group.spread_start, "spread_start");
    body.smallest_size = positive(group.smallest_size, "smallest_size");
    body.largest_size = positive(group.largest_size, "largest_size");
    if (body.largest_size < body.smallest_size) {
        reject("largest_size",
               fmt::format("is {:g}, below smallest_size, {:g}", body.largest_size, body.smallest_size));
    }
    if (body.count == 1 && body.largest_size != body.smallest_size) {
        reject("largest_size", "differs from smallest_size, but count is 1: give both the size of that body");
    }
    if (body.count == 1 && body.spreads()) {
        reject("count",
               "is 1, but spread_position, spread_angle or spread_start is not 0: they are of several");
    }
}

}  // namespace

samara_settings default_settings() {
    const Fluid water;
    const SimulationSettings standard;
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

SimulationSettings read_settings(const samara_settings& settings) {
    const samara_settings given = known_part(settings, default_settings(), first_settings_size, "settings");
    SimulationSettings result;
    result.fluid.density = positive(given.fluid_density, "fluid_density");
    result.fluid.viscosity = positive(given.fluid_viscosity, "fluid_viscosity");
    result.fluid.current = vector(given.current, "current");
    result.fluid.gust.amplitude = vector(given.gust_amplitude, "gust_amplitude");
    result.fluid.gust.period = positive(given.gust_period, "gust_period");
    result.gravity = vector(given.gravity, "gravity");
    if (given.has_ground != 0) result.ground = finite(given.ground, "ground");
    result.wind.function = given.wind;
    result.wind.function_context = given.wind_context;
    result.bodies_collide = given.bodies_collide != 0;
    result.step = positive(given.step, "step");
    result.seed = given.seed;
    result.first_run = given.run;
    if (given.threads < 0 || given.threads > most_threads) {
        reject("threads", fmt::format("must lie between 0 and {}", most_threads));
    }
    result.threads = given.threads;
    return result;
}

samara_body_group default_group() {
    const GivenGroup body;
    samara_body_group group{};
    group.size = sizeof group;
    group.count = 1;
    group.orientation[0] = 1.0;
    group.loads = SAMARA_LOADS_TABLE;
    group.drag_coefficient = body.coefficients.drag_coefficient;
    group.lift_coefficient = body.coefficients.lift_coefficient;
    group.turbulence = SAMARA_TURBULENCE_AS_LOADS;
    group.langevin = SAMARA_LANGEVIN_WAKE;
    group.added_mass = 1;
    group.patches = 1;
    group.smallest_size = 1.0;
    group.largest_size = 1.0;
    group.dynamic_coefficients = SAMARA_DYNAMIC_OF_BODY;
    return group;
}

GivenGroup read_group(const samara_body_group& given) {
    const samara_body_group group = known_part(given, default_group(), first_group_size, "kind");
    GivenGroup body;
    if (group.name != nullptr) body.name = plain_name(group.name, "name");
    body.mass = read_mass(group);
    read_start(group, body);
    body.loads = choice<Loads>(group.loads, SAMARA_LOADS_SURFACE, "loads");
    body.coefficients = read_coefficients(group);
    read_turbulence(group, body);
    read_models(group, body);
    return body;
}

void require_data(const Body& body, const GivenGroup& group) {
    const std::string& name = group.name.empty() ? body.name : group.name;
    if (!mass_asked_or_own(group.mass, body).is_given()) {
        reject("density", "or mass is missing, and the body file has none; give one of the two");
    }
    if (group.added_mass && !body.kirchhoff) {
        throw StatusError(SAMARA_MISSING_DATA,
                          fmt::format("body '{}' holds no added mass; add it with 'samara kirchhoff', or set "
                                      "added_mass to 0",
                                      name));
    }
    if (group.loads == Loads::surface && !body.surface_loads) {
        throw StatusError(
            SAMARA_MISSING_DATA,
            fmt::format("body '{}' holds no surface loads; add them with 'samara kirchhoff FILE -o "
                        "FILE', or set loads otherwise",
                        name));
    }
    if (group.loads == Loads::surface && group.turbulence == Turbulence::table) {
        reject("turbulence", "is from the table, and the loads are not; set it otherwise");
    }
    const bool loads = group.loads == Loads::table;
    if ((loads || group.turbulence == Turbulence::table) && !body.tables) {
        throw StatusError(
            SAMARA_MISSING_DATA,
            fmt::format("body '{0}' holds no tables, which {1} asks for; make them with 'samara bake', or "
                        "set {1} otherwise",
                        name, loads ? "loads" : "turbulence"));
    }
}

}  // namespace samara
