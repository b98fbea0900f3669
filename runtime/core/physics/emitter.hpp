#pragma once

#include <array>
#include <vector>

#include "samara/core/physics/obstacle.hpp"

namespace samara {

/// A mesh that bodies leave, at points that are drawn uniformly over its area.
struct Emitter {
    Obstacle mesh;              ///< its surface and keys; bodies do not touch it
    double offset = 0.0;        ///< m: the distance outside of the face at which a body's origin starts
    double speed = 0.0;         ///< m/s, along the face's normal, added to the mesh's own velocity
    std::vector<double> areas;  ///< m^2: the summed area up to and with each triangle
};

/// Makes an emitter with its areas. Throws Error where its keys are out of order or jump, since bodies that
/// leave the mesh have its velocity.
Emitter make_emitter(Obstacle mesh, double offset, double speed);

/// The start of a body at an emitter.
struct Emission {
    ObstaclePlace place;        ///< the chosen point of the mesh, offset; in the mesh's orientation
    Vector3d velocity;          ///< m/s, world: the mesh's velocity there, and the emitter's speed
    Vector3d angular_velocity;  ///< rad/s, world: of the mesh
};

/// Returns the start of a body that leaves the emitter at a time (s, of the world), for three numbers that
/// are uniform in (0, 1).
Emission emission(const Emitter& emitter, double time, const std::array<double, 3>& numbers);

}  // namespace samara
