#pragma once

#include <cstddef>
#include <cstdint>

#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/dynamics/surroundings.hpp"
#include "samara/core/kernel/body_state.hpp"
#include "samara/core/kernel/noise.hpp"
#include "samara/core/physics/pose.hpp"
#include "samara/core/physics/release.hpp"

namespace samara {

struct SimulationSettings;

/// Returns the surroundings of the bodies of a simulation.
Surroundings surroundings_of(const SimulationSettings& settings);

/// Returns the pose of a state, in the flow's frame like the state itself. Poses between two steps are
/// interpolated there, where a body that the flow carries along stands still.
Pose flow_pose(const BodyState& state);

/// Returns a pose of the flow's frame in the world's, at a time (s).
Pose in_world(const Pose& in_flow, const Surroundings& surroundings, double time);

/// Returns a pose of the world's frame in the flow's, at a time (s).
Pose in_flow(const Pose& in_world, const Surroundings& surroundings, double time);

/// Returns a pose of the flow's frame whose velocity is relative to the wind at the body, at a time (s).
Pose in_wind(const Pose& in_flow, const ImmersedBody& body, const Surroundings& surroundings, double time);

/// Returns the state of a pose in the flow's frame, with the sampled turbulence at rest.
BodyState state_of(const Pose& in_flow);

/// Returns the pose in the world of a body that is held at one of the flow's frame until its start (s).
Pose held(const Pose& in_flow, const Surroundings& surroundings, double start);

/// Returns interpolated() between a pose at the time `begin` and one `duration` (s) later; before and after
/// them, theirs.
Pose pose_between(const Pose& before, const Pose& after, double begin, double duration, double time);

/// Returns the velocity (m/s, body axes) of the body's centroid at a pose of the flow's frame: relative to
/// the undisturbed flow.
Vector3d centroid_velocity(const Pose& in_flow, const ImmersedBody& body) noexcept;

/// The start of one copy: as its release says or, where there are several, drawn around it from `noise`.
struct CopyStart {
    Pose pose;                     ///< in the world, of the shape file's origin
    double size = 1.0;             ///< relative to the shape's lengths
    std::uint64_t first_step = 0;  ///< of the group's grid, which begins at release.start
};
CopyStart start_of_copy(const Release& release, double time_step, const Noise& noise);

/// Returns the state at `time` (s) of a copy that starts then. `center_of_mass`: m, shape axes.
BodyState initial_state(const CopyStart& start, const Vector3d& center_of_mass,
                        const Surroundings& surroundings, double time);
/// Returns the state at release.start of a release of one copy.
BodyState initial_state(const Release& release, const Vector3d& center_of_mass,
                        const Surroundings& surroundings, const Noise& noise);

/// Throws Error, which calls the body by `name` and says how deep, where the lowest point of copy number
/// `copy` (of `copies`) starts below the ground of the surroundings. `start`: s.
void require_above_ground(const TouchingBody& body, const std::string& name, const Surroundings& surroundings,
                          double start, const BodyState& state, std::size_t copy, std::size_t copies);

/// Throws Error, which calls the body by `name`, where copy number `copy` (of `copies`) starts inside an
/// obstacle of the surroundings, or across a face of it. `start`: s.
void require_outside_obstacles(const TouchingBody& body, const std::string& name,
                               const Surroundings& surroundings, double start, const BodyState& state,
                               std::size_t copy, std::size_t copies);

}  // namespace samara
