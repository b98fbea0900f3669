#pragma once

#include <optional>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// kg. Interfaces take a mass by area in g/m^2, as paper is sold.
inline constexpr double gram = 1e-3;

/// A body's mass: of uniform density, of uniform mass by area, or given by its total, its centre and its
/// inertia.
struct MassSpecification {
    std::optional<double> density = {};  ///< kg/m^3
    std::optional<double> mass = {};     ///< kg
    /// kg/m^2 of one of a sheet's two sides, for which half of the surface stands. Copies of other sizes then
    /// keep the sheet's thickness: their mass grows with the square of the size.
    std::optional<double> area_density = {};
    std::optional<Vector3d> center_of_mass = {};  ///< m, shape axes; default: the centroid of the volume
    std::optional<Matrix3d> inertia =
        {};  ///< kg m^2 about the centre of mass, shape axes; default: as if uniform

    /// Returns whether a density, a mass or a mass by area is given.
    [[nodiscard]] bool is_given() const { return given() > 0; }
    /// Returns how many of the three are given: one where the mass is well specified.
    [[nodiscard]] int given() const {
        return static_cast<int>(density.has_value()) + static_cast<int>(mass.has_value()) +
               static_cast<int>(area_density.has_value());
    }

    /// Compares member by member.
    bool operator==(const MassSpecification&) const = default;
};

}  // namespace samara
