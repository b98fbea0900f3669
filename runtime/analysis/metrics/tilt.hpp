#pragma once

#include <vector>

#include "samara/motion/measures.hpp"

namespace samara {

/// Angle of the body in the vertical plane in which it swings most, and its rate: the axes of a phase
/// portrait.
struct Tilt {
    std::vector<double> times;  ///< s
    std::vector<double> angle;  ///< rad, -pi/2 to pi/2: of the shortest axis' upper end from the vertical, as
                                ///< seen in the plane; of a body that swings in it alone the inclination
                                ///< with a sign
    std::vector<double> rate;   ///< rad/s: its derivative, from the angular velocity
    std::vector<bool> continues;  ///< whether the curve goes on from the frame before: not where the body
                                  ///< turns over, so that its other end is the upper one
};

/// Returns the tilt over the fall (fall_of()) of one copy in one run. The plane is upright and holds the
/// horizontal direction in which the shortest axis' upper end swings most over the fall. Without gravity the
/// down direction is -z.
Tilt tilt_of(const Motion& motion, const BodyMotion& body, int run, int copy);

}  // namespace samara
