#pragma once

#include <cstdint>

#include "samara/core/physics/pose.hpp"

namespace samara {

struct ImmersedBody;

/// The standard errors of a body's tables as it met them along its flight: sums over poses.
struct TableErrorsOnPath {
    double force = 0.0;                            ///< of the force, over the force
    double turbulent_kinetic_energy = 0.0;         ///< of k, over k
    std::uint64_t forces = 0;                      ///< poses that the sums are over: without those at rest
    std::uint64_t turbulent_kinetic_energies = 0;  ///< how many of them were summed
    std::uint64_t poses = 0;                       ///< of a moving body with tables
    std::uint64_t strayed = 0;  ///< those of them whose direction the tables were not planned for

    /// Adds what another flight met.
    void add(const TableErrorsOnPath& other);
    [[nodiscard]] double mean_force() const;                     ///< 0 where there is none
    [[nodiscard]] double mean_turbulent_kinetic_energy() const;  ///< 0 where there is none
    [[nodiscard]] double share_strayed() const;                  ///< 0 where there is none
};

/// What one pose (in the flow's frame) adds: the tables' errors looked up at the velocity of the centroid
/// relative to the mean current. Of the force where loads come from tables, of k where turbulence does;
/// nothing for a body at rest or tables without errors.
TableErrorsOnPath table_errors_on_path(const ImmersedBody& body, const Pose& in_flow) noexcept;

}  // namespace samara
