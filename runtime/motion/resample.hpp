#pragma once

#include "samara/motion/motion.hpp"

namespace samara {

/// The same motion at other frames: `frame_rate` (1/s) of them, from the first frame's time to the last that
/// is within the recording. Between the motion's frames poses come from smoothly_interpolated(); frames at
/// the same time (to 1e-9 of a frame) are the same. Where a body meets the ground between two frames its
/// velocity jumps, and the smooth pose there does not. Throws Error where the rate is not positive, or gives
/// more than two thousand million frames.
Motion resampled(const Motion& motion, double frame_rate);

}  // namespace samara
