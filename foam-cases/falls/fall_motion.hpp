#pragma once

#include "converter/falls/fall_record.hpp"
#include "internal/dynamics/step.hpp"
#include "samara/motion/motion.hpp"

namespace samara {

/// Gives the motion's one body the poses of a solved fall at the motion's times, interpolated from its steps.
/// `start`: of the fall, in the flow's frame, from `start_time` (s) on; until then the body is held. Frames
/// after the fall's last step are dropped, but for one within half a step of it. Throws Error where no frame
/// is left.
void take_fall(const FallRecord& record, const BodyState& start, double start_time,
               const Surroundings& surroundings, Motion& motion);

}  // namespace samara
