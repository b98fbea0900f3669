#pragma once

#include <cstdint>

#include "samara/core/physics/pose.hpp"

namespace samara {

struct ImmersedBody;

/// Standard errors of a body's tables along its path: sums over poses.
struct TableErrorsOnPath {
    double force = 0.0;                            ///< sum of the force's errors relative to the force
    double turbulent_kinetic_energy = 0.0;         ///< sum of k's errors relative to k
    std::uint64_t forces = 0;                      ///< poses that the sums are over: without those at rest
    std::uint64_t turbulent_kinetic_energies = 0;  ///< how many of them were summed
    std::uint64_t poses = 0;                       ///< poses of a body with tables that moves in the flow
    std::uint64_t strayed = 0;  ///< those poses whose direction the tables were not planned for

    /// Adds the sums of another path.
    void add(const TableErrorsOnPath& other);
    [[nodiscard]] double mean_force() const;                     ///< 0 where there is none
    [[nodiscard]] double mean_turbulent_kinetic_energy() const;  ///< 0 where there is none
    [[nodiscard]] double share_strayed() const;                  ///< 0 where there is none
};

/// Returns the tables' errors of one pose (in the flow's frame), looked up at the velocity of the centroid
/// relative to the mean current: of the force where loads come from tables, of k where turbulence does; zero
/// for a body at rest or tables without errors.
TableErrorsOnPath table_errors_on_path(const ImmersedBody& body, const Pose& in_flow) noexcept;

}  // namespace samara
