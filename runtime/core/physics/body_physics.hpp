#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/physics/mass_specification.hpp"

namespace samara {

/// The source of the loads of a steady translation: none, drag and lift coefficients, the body's tables, or
/// the pressure of the potential flow over its surface (docs/explanation/loads-without-a-bake.md).
enum class Loads { none, coefficients, table, surface };
/// The source of the turbulence around a body: none, constants, or the tables that its loads are of.
enum class Turbulence { none, constant, table };
/// The variable of the Langevin equation: the fluctuating fluid around the body, as one stream; the body
/// itself (the paper's eq. 8); or the fluctuation of the relative velocity by which the body's own wake makes
/// its loads fluctuate (docs/studies/noise). Only tables know the last; constant turbulence, of the fluid
/// around, is a stream then.
enum class Langevin { sampled_turbulence, body_velocity, wake };
/// The source of the coefficients of the loads beyond those of a steady translation: the body file, with the
/// defaults where it has none; the defaults; none.
enum class Dynamic { of_body, by_default, none };

/// The names of Loads and Turbulence in files and texts, in their order.
inline constexpr std::array names_of_loads = {"none", "coefficients", "table", "surface"};
inline constexpr std::array names_of_turbulence = {"none", "constant", "table"};
constexpr const char* name_of(Loads loads) {
    return names_of_loads[static_cast<std::size_t>(loads)];
}
constexpr const char* name_of(Turbulence turbulence) {
    return names_of_turbulence[static_cast<std::size_t>(turbulence)];
}

/// Returns whether loads or turbulence are those of the body file's tables. Loads of the surface have a
/// turbulence of their own.
constexpr bool uses_body_tables(Loads loads, Turbulence turbulence) {
    return loads == Loads::table || (turbulence == Turbulence::table && loads != Loads::surface);
}

/// Returns the turbulence that goes with loads where nothing else is chosen: the wake's where they know it.
constexpr Turbulence usual_turbulence(Loads loads) {
    return loads == Loads::table || loads == Loads::surface ? Turbulence::table : Turbulence::none;
}

/// Coefficients of drag and lift (the paper's eq. 5); what is absent is taken from the body
/// (docs/explanation/steady-loads.md).
struct CoefficientLoads {
    double drag_coefficient = 1.0;         ///< C_d of eq. 5
    double lift_coefficient = 0.0;         ///< C_l of eq. 5
    std::optional<double> reference_area;  ///< m^2; default: the area projected along the direction of motion
    std::optional<Vector3d> normal;        ///< shape axes; default: the axis of the body's shortest extent
    Vector3d center_of_pressure = Vector3d::Zero();  ///< m from the centroid of the volume, shape axes

    /// Compares member by member.
    bool operator==(const CoefficientLoads&) const = default;
};

/// The physics of a body, independent of its start: with the shape and the fluid, all that its equations of
/// motion hold. New members must be listed in visit_members() below, on which the scene file, the C
/// interface, saved states and the sharing between equal bodies rest.
struct BodyPhysics {
    MassSpecification mass;                       ///< default: the body file's
    Loads loads = Loads::table;                   ///< where force and moment come from
    CoefficientLoads coefficients;                ///< where the loads are coefficients
    std::optional<double> table_reynolds_number;  ///< at which alone tables are read
    int patches = 1;                     ///< of the surface, each of which bears loads by its own velocity
    bool added_mass = true;              ///< whether the fluid's inertia is part of the body's
    Dynamic dynamic = Dynamic::of_body;  ///< whether the body's dynamic coefficients count
    Turbulence turbulence = Turbulence::table;  ///< default: usual_turbulence()
    double turbulent_kinetic_energy = 0.0;      ///< m^2/s^2, where turbulence is constant
    double dissipation_rate = 0.0;              ///< m^2/s^3, where turbulence is constant
    Langevin langevin = Langevin::wake;         ///< what the noise drives

    /// Compares member by member.
    bool operator==(const BodyPhysics&) const = default;
};

/// Calls visit(key, value) for every number and choice of a (const) BodyPhysics, by the keys of the scene
/// file. The compiler checks that none is left out: a structured binding names all members of a struct or
/// does not compile.
template <typename Physics, typename Visit>
void visit_members(Physics& physics, const Visit& visit) {
    auto& [mass, loads, coefficients, table_reynolds_number, patches, added_mass, dynamic, turbulence,
           turbulent_kinetic_energy, dissipation_rate, langevin] = physics;
    auto& [density, total_mass, area_density, center_of_mass, inertia] = mass;
    auto& [drag_coefficient, lift_coefficient, reference_area, normal, center_of_pressure] = coefficients;
    visit("density", density);
    visit("mass", total_mass);
    visit("area_density", area_density);
    visit("center_of_mass", center_of_mass);
    visit("inertia", inertia);
    visit("loads", loads);
    visit("drag_coefficient", drag_coefficient);
    visit("lift_coefficient", lift_coefficient);
    visit("reference_area", reference_area);
    visit("normal", normal);
    visit("center_of_pressure", center_of_pressure);
    visit("table_reynolds_number", table_reynolds_number);
    visit("patches", patches);
    visit("added_mass", added_mass);
    visit("dynamic_coefficients", dynamic);
    visit("turbulence", turbulence);
    visit("turbulent_kinetic_energy", turbulent_kinetic_energy);
    visit("dissipation_rate", dissipation_rate);
    visit("langevin", langevin);
}

}  // namespace samara
