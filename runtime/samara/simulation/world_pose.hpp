#pragma once

#include <cstddef>

#include "samara/dynamics/immersed_body.hpp"
#include "samara/dynamics/noise.hpp"
#include "samara/dynamics/step.hpp"
#include "samara/dynamics/surroundings.hpp"
#include "samara/motion/pose.hpp"
#include "samara/scene/scene.hpp"

namespace samara {

/// The pose of a state, in the flow's frame as the state itself. Poses between two steps are interpolated
/// there, where a body that the flow carries along stands still.
Pose flow_pose(const BodyState& state);

/// A pose of the flow's frame in the world's, at a time (s).
Pose in_world(const Pose& in_flow, const Surroundings& surroundings, double time);

/// The reverse of in_world.
Pose in_flow(const Pose& in_world, const Surroundings& surroundings, double time);

/// The state of a pose in the flow's frame. The seen fluid is at rest.
BodyState state_of(const Pose& in_flow);

/// How one copy starts at scene_body.start: as the scene says or, where there are several, drawn around that
/// from `noise`. `center_of_mass`: m, shape axes.
BodyState initial_state(const SceneBody& scene_body, const Vector3d& center_of_mass,
                        const Surroundings& surroundings, const Noise& noise);

/// Throws Error, which calls the body by `name` and says how deep, where the lowest point of copy number
/// `copy` (of `copies`) starts below the ground of the surroundings. `start`: s.
void require_above_ground(const ImmersedBody& body, const std::string& name, const Surroundings& surroundings,
                          double start, const BodyState& state, std::size_t copy, std::size_t copies);

}  // namespace samara
