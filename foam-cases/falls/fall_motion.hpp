#pragma once

#include <vector>

#include "converter/falls/fall_record.hpp"
#include "samara/core/dynamics/surroundings.hpp"
#include "samara/core/kernel/body_state.hpp"
#include "samara/motion/motion.hpp"

namespace samara {

/// A solved fall, and how it started in the flow's frame, at `start_time` (s): until then the body is held.
struct SolvedFall {
    FallRecord record;
    BodyState start;
    double start_time = 0.0;
};

/// Gives the motion's one body, a copy for each fall, their poses at the motion's times, interpolated from
/// the falls' steps. Frames after the last step of any are dropped, but for one within half a step of it.
/// Throws Error where no second frame is left.
void take_falls(const std::vector<SolvedFall>& falls, const Surroundings& surroundings, Motion& motion);

}  // namespace samara
