#pragma once

#include <optional>
#include <string>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// A uniform oscillating flow: amplitude sin(2 pi t / period), world axes.
struct Gust {
    Vector3d amplitude = Vector3d::Zero();  ///< m/s
    double period = 1.0;                    ///< s

    /// Compares member by member.
    bool operator==(const Gust&) const = default;
};

/// The fluid: incompressible and Newtonian, at rest but for a uniform current and gust.
struct Fluid {
    double density = 998.2;               ///< kg/m^3
    double viscosity = 1.002e-3;          ///< dynamic, Pa s
    Vector3d current = Vector3d::Zero();  ///< m/s, world axes
    Gust gust = {};                       ///< added to the current

    /// Returns the kinematic viscosity (m^2/s).
    [[nodiscard]] double kinematic_viscosity() const { return viscosity / density; }
    /// Compares member by member.
    bool operator==(const Fluid&) const = default;
};

/// Returns the fluid of that name ("water" or "air", at 20 degrees Celsius and 101325 Pa), or nothing.
inline std::optional<Fluid> fluid_preset(const std::string& name) {
    if (name == "water") return Fluid{.density = 998.2, .viscosity = 1.002e-3};
    if (name == "air") return Fluid{.density = 1.204, .viscosity = 1.825e-5};
    return std::nullopt;
}

/// The largest Reynolds number at which the flow around a blunt body is still free of turbulence, so that the
/// k-epsilon model does not hold: some 300 for a sphere's wake (Johnson & Patel, J. Fluid Mech. 378, 1999).
/// Cases below it are baked as laminar, and are simulated without turbulence.
inline constexpr double laminar_reynolds_number = 300.0;

}  // namespace samara
