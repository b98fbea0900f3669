#pragma once

#include <vector>

#include "samara/motion/motion.hpp"

namespace samara {

/// Returns the unit vector that counts as down: gravity's direction, or -z of the world where there is no
/// gravity.
Vector3d down_direction(const Vector3d& gravity);

/// Returns the angle (rad, 0 to pi/2) between the body's shortest principal axis and gravity: 0 for a disc
/// that lies flat, pi/2 for one that falls edgewise. Which end of the axis points down does not matter.
/// Without gravity it is measured from the world's vertical.
double inclination(const Motion& motion, const BodyMotion& body, const Pose& pose);

/// Moments of a surface's area: its centroid (m) and the covariance (m^2) of its points about it.
struct SurfaceSpread {
    Vector3d centroid = Vector3d::Zero();
    Matrix3d covariance = Matrix3d::Zero();
};

/// Returns the centroid and covariance of a surface's area.
SurfaceSpread surface_spread(const Surface& surface);

/// Returns whether the surface's body has a shortest axis: false for a sphere or a cube, whose surface
/// spreads alike in all directions, to 1 % of its extent. Then the inclination is that of an axis chosen by
/// chance.
bool has_shortest_axis(const Surface& surface);

/// Returns the value below which `percent` (0 to 100) of the values lie, linear between the order statistics;
/// values must not be empty.
double percentile(std::vector<double> values, double percent);

/// Returns the percentile of values that ascend already; see percentile().
double percentile_of_sorted(const std::vector<double>& values, double percent);

/// Returns how deep a minimum of the inclination must be to count (rad), in a series of these inclinations: a
/// tenth of the range from the 5th to the 95th percentile, and at least one degree.
double required_prominence(const std::vector<double>& inclinations);

/// Returns the times (s, ascending) of the minima of the inclination: one for each swing through the flat
/// attitude.
/// A minimum counts where the inclination falls by `prominence` (rad) to it and rises by as much after it,
/// within the series: ripples of noise and the series' ends do not count. It is placed between the frames at
/// the vertex of the parabola through cos^2 of the inclination at the lowest frame and its two neighbours:
/// cos^2 is smooth where the folded angle has a corner. Needs about six frames for each swing.
std::vector<double> inclination_minima(const std::vector<double>& times,
                                       const std::vector<double>& inclinations, double prominence);

}  // namespace samara
