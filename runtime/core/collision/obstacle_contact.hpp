#pragma once

#include <optional>
#include <string>

#include "samara/core/body/contact_points.hpp"
#include "samara/core/collision/contact_set.hpp"
#include "samara/core/collision/obstacle_set.hpp"

namespace samara {

/// Where a body is in the world, by its centre of mass.
struct BodyPlace {
    Vector3d position;  ///< m
    Quaterniond orientation;
};

/// Adds to `near` the points of a body that obstacles may meet within a step of `time_step` (s) from `time`
/// (s) on. `velocity`: (omega, v) in body axes, relative to the ground. `margin`: m, as far as the body may
/// come. A corner of the body counts above the face that it would arrive at; an edge that crosses a face's
/// end, and what else of a face stands out, where they face each other. Never throws or allocates.
void add_obstacles(const ObstacleSet& obstacles, const ContactPoints& points, const BodyPlace& body,
                   const Vector6d& velocity, double time, double time_step, double margin,
                   ContactSet& near) noexcept;

/// Where a body overlaps an obstacle.
struct Overlap {
    std::string obstacle;  ///< its name
    Vector3d position;     ///< m, world: of a face that it crosses, or of its middle
};
/// The first obstacle that a body overlaps at a time (s), by more than a millionth of its size, or lies
/// inside.
std::optional<Overlap> first_overlap(const ObstacleSet& obstacles, const ContactPoints& points,
                                     const BodyPlace& body, double time);

/// Whether a body may touch an obstacle on its way between two places, or within `margin` (m) of it.
bool passes_near(const ObstacleSet& obstacles, const ContactPoints& points, const BodyPlace& before,
                 const BodyPlace& after, double margin) noexcept;

/// Mends the place `after` at the time `end` of a body that was at `before` at the time `begin` (s), so that
/// on its way, straight and by the shortest turn as each obstacle sees it, it passed no face: what a turn
/// brought a little into one is lifted out, and a body that arrives stays where it touches. An obstacle that
/// arrives takes it along. Then lifts it out of what little it still overlaps. Never throws or allocates.
void keep_out(const ObstacleSet& obstacles, const ContactPoints& points, double begin, double end,
              const BodyPlace& before, BodyPlace& after) noexcept;

}  // namespace samara
