#pragma once

#include "samara/core/dynamics/surroundings.hpp"
#include "samara/core/physics/obstacle.hpp"

namespace samara::test {

/// A rectangle of two triangles about the origin in the plane z = 0: an open sheet.
Surface sheet(double length, double width);

/// Returns a rectangle of 2 n^2 triangles about the origin in the plane z = 0: an open sheet.
Surface sheet_of_many(double length, double width, int n);

/// Returns an obstacle that stands still.
Obstacle obstacle(const Surface& surface, const ObstaclePlace& place = {}, double friction = 0.5);

/// Surroundings with these obstacles, without ground, and with the usual gravity.
Surroundings with_obstacles(const std::vector<Obstacle>& obstacles);

}  // namespace samara::test
