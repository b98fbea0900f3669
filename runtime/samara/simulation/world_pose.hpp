#pragma once

#include "samara/dynamics/noise.hpp"
#include "samara/dynamics/step.hpp"
#include "samara/dynamics/surroundings.hpp"
#include "samara/motion/pose.hpp"
#include "samara/scene/scene.hpp"

namespace samara {

/// A state of the flow's frame in the world's, at a time (s).
Pose pose_of(const BodyState& state, const Surroundings& surroundings, double time);

/// The reverse of pose_of: a pose of the world in the flow's frame at a time (s). The seen fluid is at rest.
BodyState state_of(const Pose& pose, const Surroundings& surroundings, double time);

/// How one copy starts at scene_body.start: as the scene says or, where there are several, drawn around that
/// from `noise`. `center_of_mass`: m, shape axes.
BodyState initial_state(const SceneBody& scene_body, const Vector3d& center_of_mass,
                        const Surroundings& surroundings, const Noise& noise);

}  // namespace samara
