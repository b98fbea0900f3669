#pragma once

#include <string>

#include "samara/motion/motion.hpp"

namespace samara {

/// Returns a motion with frames at another `frame_rate` (1/s), from the first frame's time to the last that
/// is within the recording. Between the motion's frames poses come from smoothly_interpolated(); frames at
/// the same time (to 1e-9 of a frame) are the same. Where a body touches the ground between two frames its
/// velocity jumps, and the smooth pose there does not. Throws Error where the rate is not positive, or gives
/// more than two thousand million frames.
Motion resampled(const Motion& motion, double frame_rate);

/// Returns the motion `factor` times slower: its times and those of its obstacles are multiplied by it, the
/// velocities and the frame rate divided, so that the same frames are farther apart.
Motion slowed(Motion motion, double factor);

/// Returns a motion of one frame, at `time` (s), between two frames as resampled() has it. Throws Error where
/// the motion has begun later or ended before.
Motion still_at(const Motion& motion, double time);

/// Returns a run of a motion as a loop of `period` (s): each copy's path is cut into pieces of that duration,
/// which play side by side as copies of their own, so that each piece ends at the pose at which the next
/// begins. The rest of the motion after the last whole piece is left out. Where all bodies had left the
/// picture by the end, and were outside of it at the start, the loop has no seam. The copies of piece k
/// follow those of piece k - 1. Throws Error where the period is not a whole number of frames or longer than
/// the motion, and where an obstacle moves.
Motion looped(const Motion& motion, int run, double period);

/// Rotation of a body from one frame to the next.
struct FastRotation {
    std::string body;          ///< the body that rotates farthest
    double revolutions = 0.0;  ///< angle in revolutions
};

/// Returns the largest rotation from frame to frame in a run, by the angular velocities at the frames. Above
/// half a revolution programs that interpolate between two poses see a body rotate the other way round, or
/// not at all.
FastRotation fastest_rotation(const Motion& motion, int run);

}  // namespace samara
