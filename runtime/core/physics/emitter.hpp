#pragma once

#include <array>
#include <vector>

#include "samara/core/physics/obstacle.hpp"

namespace samara {

/// A mesh that bodies leave, at points that are drawn uniformly over its area.
struct Emitter {
    Obstacle mesh;              ///< its surface and keys; bodies do not touch it
    double offset = 0.0;        ///< m: how far outside of the face a body's origin starts
    double speed = 0.0;         ///< m/s, along the face's normal, beside the mesh's own
    std::vector<double> areas;  ///< m^2: of each triangle and all before it
};

/// An emitter with its areas. Throws Error where its keys are out of order or jump: what leaves it has its
/// velocity.
Emitter make_emitter(Obstacle mesh, double offset, double speed);

/// How something leaves an emitter.
struct Emission {
    ObstaclePlace place;        ///< of the emitter's point, offset; its axes are the mesh's
    Vector3d velocity;          ///< m/s, world: of the mesh there, and the emitter's speed
    Vector3d angular_velocity;  ///< rad/s, world: of the mesh
};

/// What leaves the emitter at a time (s, of the world) for three numbers that are uniform in (0, 1).
Emission emission(const Emitter& emitter, double time, const std::array<double, 3>& numbers);

}  // namespace samara
