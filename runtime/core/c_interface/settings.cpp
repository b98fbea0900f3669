#include "samara/core/c_interface/settings.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "samara/core/base/numbers.hpp"
#include "samara/core/c_interface/guard.hpp"
#include "samara/core/c_interface/members.hpp"

namespace samara {
namespace {

constexpr int most_threads = 1024;
// The size up to the last member of version 1.
constexpr std::size_t first_settings_size = offsetof(samara_settings, ground) + sizeof(double);
constexpr std::size_t first_group_size = offsetof(samara_body_group, langevin) + sizeof(std::int32_t);
// The first member of a version lies where the struct of the one before ended, and not in its padding, which
// callers do not fill.
static_assert(offsetof(samara_settings, wind) % alignof(samara_settings) == 0);
static_assert(offsetof(samara_settings, bodies_collide) % alignof(samara_settings) == 0);
static_assert(offsetof(samara_settings, precision) % alignof(samara_settings) == 0);
static_assert(offsetof(samara_body_group, table_reynolds_number) % alignof(samara_body_group) == 0);
static_assert(offsetof(samara_body_group, patches) % alignof(samara_body_group) == 0);
static_assert(offsetof(samara_body_group, spread_start) % alignof(samara_body_group) == 0);
static_assert(offsetof(samara_body_group, area_density) % alignof(samara_body_group) == 0);

/// What a member holds for which 0 stands where the caller gives nothing.
std::optional<double> unless_zero(double number) {
    return number == 0.0 ? std::nullopt : std::optional(number);
}

MassSpecification read_mass(const samara_body_group& group) {
    MassSpecification mass;
    mass.density = unless_zero(group.density);
    mass.mass = unless_zero(group.mass);
    if (const auto grams = unless_zero(group.area_density)) mass.area_density = gram * *grams;
    if (group.has_center_of_mass != 0) mass.center_of_mass = vector(group.center_of_mass, "center_of_mass");
    for (const double value : group.inertia) finite(value, "inertia");
    const Matrix3d inertia = Eigen::Map<const Matrix3d>(group.inertia);
    if (!inertia.isZero(0.0)) mass.inertia = inertia;
    return mass;
}

CoefficientLoads read_coefficients(const samara_body_group& group) {
    CoefficientLoads coefficients;
    coefficients.drag_coefficient = group.drag_coefficient;
    coefficients.lift_coefficient = finite(group.lift_coefficient, "lift_coefficient");
    coefficients.reference_area = unless_zero(group.reference_area);
    const Vector3d normal = vector(group.normal, "normal");
    if (!normal.isZero(0.0)) coefficients.normal = normal;
    coefficients.center_of_pressure = vector(group.center_of_pressure, "center_of_pressure");
    return coefficients;
}

void read_turbulence(const samara_body_group& group, GivenGroup& body) {
    body.open.turbulence = group.turbulence == SAMARA_TURBULENCE_AS_LOADS;
    if (body.open.turbulence) {
        body.turbulence = usual_turbulence(body.loads);
    } else {
        body.turbulence = choice<Turbulence>(group.turbulence, SAMARA_TURBULENCE_TABLE, "turbulence");
    }
    body.turbulent_kinetic_energy = group.turbulent_kinetic_energy;
    body.dissipation_rate = group.dissipation_rate;
    body.langevin = choice<Langevin>(group.langevin, SAMARA_LANGEVIN_WAKE, "langevin");
}

void read_physics(const samara_body_group& group, GivenGroup& body) {
    body.mass = read_mass(group);
    body.open.loads = group.loads == SAMARA_LOADS_OF_BODY;
    if (!body.open.loads) body.loads = choice<Loads>(group.loads, SAMARA_LOADS_SURFACE, "loads");
    body.coefficients = read_coefficients(group);
    body.table_reynolds_number = unless_zero(group.table_reynolds_number);
    body.open.patches = group.patches == 0;
    if (!body.open.patches) body.patches = group.patches;
    body.added_mass = group.added_mass != 0;
    body.dynamic = choice<Dynamic>(group.dynamic_coefficients, SAMARA_DYNAMIC_NONE, "dynamic_coefficients");
    read_turbulence(group, body);
    require_rules(broken_rule(static_cast<const BodyPhysics&>(body)));
    if (body.coefficients.normal) body.coefficients.normal->normalize();
}

void read_start(const samara_body_group& group, Release& release) {
    release.position = vector(group.position, "position");
    release.orientation = orientation(group.orientation, "orientation");
    release.velocity = vector(group.velocity, "velocity");
    release.angular_velocity = vector(group.angular_velocity, "angular_velocity");
    release.start = group.start;
    release.count = static_cast<int>(std::min(group.count, std::uint32_t{most_copies} + 1));
    release.spread_position = vector(group.spread_position, "spread_position");
    release.spread_angle = group.spread_angle;
    release.spread_start = group.spread_start;
    release.smallest_size = group.smallest_size;
    release.largest_size = group.largest_size;
    require_rules(broken_rule(release));
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
    result.fluid.density = given.fluid_density;
    result.fluid.viscosity = given.fluid_viscosity;
    result.fluid.current = vector(given.current, "current");
    result.fluid.gust.amplitude = vector(given.gust_amplitude, "gust_amplitude");
    result.fluid.gust.period = given.gust_period;
    require_rules(broken_rule(result.fluid));
    result.gravity = vector(given.gravity, "gravity");
    if (given.has_ground != 0) result.ground = finite(given.ground, "ground");
    result.wind.function = given.wind;
    result.wind.function_context = given.wind_context;
    result.bodies_collide = given.bodies_collide != 0;
    if (given.precision > SAMARA_PRECISION_SINGLE) reject("precision", "is not one of SAMARA_PRECISION_...");
    result.precision = static_cast<Precision>(given.precision);
    if (!positive_number.holds(given.step)) reject("step", std::string(positive_number.words));
    result.step = given.step;
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
    group.loads = SAMARA_LOADS_OF_BODY;
    group.drag_coefficient = body.coefficients.drag_coefficient;
    group.lift_coefficient = body.coefficients.lift_coefficient;
    group.turbulence = SAMARA_TURBULENCE_AS_LOADS;
    group.langevin = SAMARA_LANGEVIN_WAKE;
    group.added_mass = 1;
    group.smallest_size = 1.0;
    group.largest_size = 1.0;
    group.dynamic_coefficients = SAMARA_DYNAMIC_OF_BODY;
    return group;
}

GivenGroup read_group(const samara_body_group& given) {
    const samara_body_group group = known_part(given, default_group(), first_group_size, "body_group");
    GivenGroup body;
    if (group.name != nullptr) body.name = plain_name(group.name, "name");
    read_start(group, body);
    read_physics(group, body);
    return body;
}

GivenGroup of_body(const Body& body, GivenGroup group) {
    choose_open_models(body, group.open, group);
    const std::string& name = group.name.empty() ? body.name : group.name;
    if (!mass_asked_or_own(group.mass, body).is_given()) {
        reject("density", "or mass is missing, and the body file has none; give one of them");
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
    const bool loads = group.loads == Loads::table;
    if (uses_body_tables(group.loads, group.turbulence) && !body.tables) {
        throw StatusError(SAMARA_MISSING_DATA,
                          fmt::format("body '{0}' holds no tables, which {1} needs; make them with 'samara "
                                      "bake', or set {1} otherwise",
                                      name, loads ? "loads" : "turbulence"));
    }
    return group;
}

}  // namespace samara
