#pragma once

#include "samara/motion/motion.hpp"

namespace samara {

/// A run of a motion as a loop of `period` (s): each copy's way is cut into pieces of that length, which play
/// side by side as copies of their own, so that what one piece ends with is what the next begins with. What
/// the last piece leaves of the motion is left out. Where all bodies had left the picture by the end, and
/// were outside of it at the start, the loop has no seam. The copies of piece k follow those of piece k - 1.
/// Throws Error where the period is not a whole number of frames or longer than the motion, and where an
/// obstacle moves.
Motion looped(const Motion& motion, int run, double period);

}  // namespace samara
