#include "samara/core/physics/broken_rule.hpp"

#include <algorithm>
#include <initializer_list>
#include <numbers>
#include <string_view>

#include <fmt/format.h>

#include "samara/core/base/numbers.hpp"
#include "samara/core/physics/obstacle_motion.hpp"
#include "samara/core/surface/surface_patches.hpp"

namespace samara {
namespace {

using Broken = std::optional<BrokenRule>;

/// The first of several that is broken.
Broken first_of(std::initializer_list<Broken> rules) {
    const auto* const broken =
        std::ranges::find_if(rules, [](const Broken& rule) { return rule.has_value(); });
    return broken == rules.end() ? std::nullopt : *broken;
}

Broken broken_if(bool is_broken, const char* member, std::string_view what) {
    if (!is_broken) return std::nullopt;
    return BrokenRule{member, std::string(what)};
}

/// A number that is not given is in every range.
Broken outside(const NumberRange& range, const char* member, std::optional<double> number) {
    return broken_if(number && !range.holds(*number), member, range.words);
}

Broken outside(int most, const char* member, int count) {
    return broken_if(count < 1 || count > most, member,
                     fmt::format("must be a whole number from 1 to {}", most));
}

Broken jump_of(const Obstacle& obstacle) {
    double reach = 0.0;
    for (const Vector3d& vertex : obstacle.surface.vertices) reach = std::max(reach, vertex.norm());
    const auto& keys = obstacle.keys;
    for (std::size_t i = 1; i < keys.size(); ++i) {
        const ObstacleMotion motion = motion_of(obstacle, keys[i - 1].time);
        const double fastest = motion.velocity.norm() + reach * motion.angular_velocity.norm();
        if (fastest <= most_key_speed) continue;
        return BrokenRule{"keys", fmt::format("are too fast: from {:g} s to {:g} s the mesh moves at {:.3g} "
                                              "m/s, above the limit of {:g}; increase the time between them",
                                              keys[i - 1].time, keys[i].time, fastest, most_key_speed)};
    }
    return std::nullopt;
}

}  // namespace

Broken broken_rule(const Fluid& fluid) {
    return first_of({outside(positive_number, "fluid.density", fluid.density),
                     outside(positive_number, "fluid.viscosity", fluid.viscosity),
                     outside(positive_number, "fluid.gust.period", fluid.gust.period)});
}

Broken broken_rule(const MassSpecification& mass) {
    const bool is_askew =
        mass.inertia && (*mass.inertia - mass.inertia->transpose()).norm() > 1e-9 * mass.inertia->norm();
    return first_of({outside(positive_number, "density", mass.density),
                     outside(positive_number, "mass", mass.mass),
                     outside(positive_number, "area_density", mass.area_density),
                     broken_if(is_askew, "inertia", "must be symmetric"),
                     broken_if(mass.given() > 1, mass.area_density ? "area_density" : "density",
                               mass.area_density ? "excludes density and mass; give one of the three"
                                                 : "excludes mass; give one of the two"),
                     broken_if(!mass.mass && (mass.center_of_mass || mass.inertia),
                               mass.inertia ? "inertia" : "center_of_mass",
                               mass.is_given() ? "contradicts a uniform density; give mass instead"
                                               : "needs mass; give mass too")});
}

Broken broken_rule(const BodyPhysics& physics) {
    const CoefficientLoads& coefficients = physics.coefficients;
    const auto& normal = coefficients.normal;
    const double energy = physics.turbulent_kinetic_energy;
    const double dissipation = physics.dissipation_rate;
    return first_of(
        {broken_rule(physics.mass),
         outside(non_negative_number, "drag_coefficient", coefficients.drag_coefficient),
         outside(positive_number, "reference_area", coefficients.reference_area),
         broken_if(normal && normal->norm() < smallest_number, "normal", "must not be the zero vector"),
         outside(most_surface_patches, "patches", physics.patches),
         outside(non_negative_number, "turbulent_kinetic_energy", energy),
         outside(non_negative_number, "dissipation_rate", dissipation),
         broken_if(physics.turbulence == Turbulence::constant && (energy > 0.0) != (dissipation > 0.0),
                   "dissipation_rate", "and turbulent_kinetic_energy must be both zero or both above zero"),
         outside(positive_number, "table_reynolds_number", physics.table_reynolds_number),
         broken_if(
             physics.table_reynolds_number && !uses_body_tables(physics.loads, physics.turbulence),
             "table_reynolds_number",
             "applies only to loads or turbulence by table; remove it or set one of them to \"table\"")});
}

Broken broken_rule(Precision precision, bool bodies_collide) {
    return broken_if(precision == Precision::single_precision && bodies_collide, "precision",
                     "must be \"double\" where bodies_collide is true; set one of them otherwise");
}

Broken broken_rule(const Release& release) {
    constexpr double most_size = 1e3;  // beyond it a unit is wrong
    const bool are_sizes = release.smallest_size >= 1.0 / most_size &&
                           release.smallest_size <= release.largest_size && release.largest_size <= most_size;
    return first_of(
        {outside(non_negative_number, "start", release.start), outside(most_copies, "count", release.count),
         outside({0.0, std::numbers::pi, "must lie between 0 and pi"}, "spread.angle", release.spread_angle),
         outside(non_negative_number, "spread.start", release.spread_start),
         broken_if(!are_sizes, "spread.size",
                   "must be the smallest and the largest size relative to the shape, within 0.001 and 1000, "
                   "such as 0.8 and 1.25"),
         broken_if(release.count == 1 && release.spreads(), "count",
                   "is 1, but a spread of places, rotations, starts or sizes needs several copies; give a "
                   "count above 1, or no spread")});
}

Broken broken_rule(const std::vector<ObstacleKey>& keys) {
    for (std::size_t i = 1; i < keys.size(); ++i) {
        if (keys[i].time > keys[i - 1].time) continue;
        return BrokenRule{
            "keys",
            fmt::format(
                "are out of order: the time of key {}, {} s, must be later than that of the previous key", i,
                keys[i].time)};
    }
    return std::nullopt;
}

Broken broken_rule(const Obstacle& obstacle) {
    if (const Broken broken = first_of(
            {outside(non_negative_number, "friction", obstacle.friction), broken_rule(obstacle.keys)})) {
        return broken;
    }
    return jump_of(obstacle);
}

}  // namespace samara
