#pragma once

#include <string>

#include "samara/motion/motion.hpp"

namespace samara {

/// How far bodies turn from one frame to the next.
struct FastTurn {
    std::string body;    ///< the one that turns farthest
    double turns = 0.0;  ///< whole turns
};

/// The farthest turn from frame to frame in a run, by the angular velocities at the frames. Above half a turn
/// programs that interpolate between two poses see a body turn the other way, or not at all.
FastTurn fastest_turn(const Motion& motion, int run);

}  // namespace samara
