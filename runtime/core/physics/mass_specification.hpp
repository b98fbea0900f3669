#pragma once

#include <optional>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// A body's mass: of uniform density, or given by its total, its centre and its inertia.
struct MassSpecification {
    std::optional<double> density;           ///< kg/m^3
    std::optional<double> mass;              ///< kg
    std::optional<Vector3d> center_of_mass;  ///< m, shape axes; default: the centroid of the volume
    std::optional<Matrix3d> inertia;  ///< kg m^2 about the centre of mass, shape axes; default: as if uniform

    /// Returns whether a density or a mass is given.
    [[nodiscard]] bool is_given() const { return density.has_value() || mass.has_value(); }

    /// Compares member by member.
    bool operator==(const MassSpecification&) const = default;
};

}  // namespace samara
