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

/// The pose of a state, in the flow's frame as the state itself. Poses between two steps are interpolated
/// there, where a body that the flow carries along stands still.
Pose flow_pose(const BodyState& state);

/// A pose of the flow's frame in the world's, at a time (s).
Pose in_world(const Pose& in_flow, const Surroundings& surroundings, double time);

/// The reverse of in_world.
Pose in_flow(const Pose& in_world, const Surroundings& surroundings, double time);

/// A pose of the flow's frame whose velocity is made relative to the wind where the body is, at a time (s).
Pose in_wind(const Pose& in_flow, const ImmersedBody& body, const Surroundings& surroundings, double time);

/// The state of a pose in the flow's frame. The sampled turbulence is at rest.
BodyState state_of(const Pose& in_flow);

/// The pose in the world of a body that is held at one of the flow's frame until its start (s).
Pose held(const Pose& in_flow, const Surroundings& surroundings, double start);

/// interpolated() between a pose at the time `begin` and one `duration` (s) later; before and after them,
/// theirs.
Pose pose_between(const Pose& before, const Pose& after, double begin, double duration, double time);

/// The velocity (m/s, body axes) of the body's centroid at a pose of the flow's frame: relative to the
/// undisturbed flow.
Vector3d centroid_velocity(const Pose& in_flow, const ImmersedBody& body) noexcept;

/// How one copy starts: as its release says or, where there are several, drawn around it from `noise`.
struct CopyStart {
    Pose pose;                     ///< in the world, of the shape file's origin
    double size = 1.0;             ///< over the shape's lengths
    std::uint64_t first_step = 0;  ///< of the kind's grid, which begins at release.start
};
CopyStart start_of_copy(const Release& release, double time_step, const Noise& noise);

/// The state at `time` (s) of a copy that starts then. `center_of_mass`: m, shape axes.
BodyState initial_state(const CopyStart& start, const Vector3d& center_of_mass,
                        const Surroundings& surroundings, double time);
/// The same at release.start of a release of one copy.
BodyState initial_state(const Release& release, const Vector3d& center_of_mass,
                        const Surroundings& surroundings, const Noise& noise);

/// Throws Error, which calls the body by `name` and says how deep, where the lowest point of copy number
/// `copy` (of `copies`) starts below the ground of the surroundings. `start`: s.
void require_above_ground(const TouchingBody& body, const std::string& name, const Surroundings& surroundings,
                          double start, const BodyState& state, std::size_t copy, std::size_t copies);

/// The same where copy number `copy` starts inside an obstacle of the surroundings, or across a face of it.
void require_outside_obstacles(const TouchingBody& body, const std::string& name,
                               const Surroundings& surroundings, double start, const BodyState& state,
                               std::size_t copy, std::size_t copies);

}  // namespace samara
