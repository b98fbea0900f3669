#pragma once

#include <optional>
#include <string>

#include "samara/core/body/contact_points.hpp"
#include "samara/core/collision/contact_set.hpp"
#include "samara/core/collision/obstacle_set.hpp"

namespace samara {

/// The place of a body in the world, by its centre of mass.
struct BodyPlace {
    Vector3d position;  ///< m
    Quaterniond orientation;
};

/// Adds to `near` the points of a body that may touch obstacles within a step of `time_step` (s) from `time`
/// (s) on. `velocity`: (omega, v) in body axes, relative to the ground. `margin`: m, the farthest that the
/// body may come. A corner of the body counts above the face that it would reach; edges that cross a face's
/// end, and other protruding parts of a face, count where the two face each other. Never throws or allocates.
void add_obstacles(const ObstacleSet& obstacles, const ContactPoints& points, const BodyPlace& body,
                   const Vector6d& velocity, double time, double time_step, double margin,
                   ContactSet& near) noexcept;

/// An overlap of a body with an obstacle.
struct Overlap {
    std::string obstacle;  ///< its name
    Vector3d position;     ///< m, world: of a face that it crosses, or of its middle
};
/// Returns the first obstacle that a body overlaps at a time (s) by more than a millionth of its size, or
/// lies inside of; nothing where there is none.
std::optional<Overlap> first_overlap(const ObstacleSet& obstacles, const ContactPoints& points,
                                     const BodyPlace& body, double time);

/// Returns whether a body may touch an obstacle on its path between two places, or within `margin` (m) of it.
bool passes_near(const ObstacleSet& obstacles, const ContactPoints& points, const BodyPlace& before,
                 const BodyPlace& after, double margin) noexcept;

/// Corrects the place `after` at the time `end` of a body that was at `before` at the time `begin` (s), so
/// that its path, straight and by the shortest rotation as each obstacle sees it, passes through no face: an
/// overlap that a rotation caused is removed, a body that arrives stays where it touches, and an obstacle
/// that arrives takes the body along. Then removes the remaining small overlaps. Never throws or allocates.
void keep_out(const ObstacleSet& obstacles, const ContactPoints& points, double begin, double end,
              const BodyPlace& before, BodyPlace& after) noexcept;

}  // namespace samara
