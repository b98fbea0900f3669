#include "samara/export/fast_turn.hpp"

#include <numbers>

namespace samara {

FastTurn fastest_turn(const Motion& motion, int run) {
    FastTurn fastest;
    for (const BodyMotion& body : motion.bodies) {
        for (int frame = 0; frame < motion.frames(); ++frame) {
            for (int copy = 0; copy < body.copies; ++copy) {
                const double rate = motion.pose(body, run, frame, copy).angular_velocity.norm();
                const double turns = rate / (2.0 * std::numbers::pi * motion.frame_rate);
                if (turns > fastest.turns) fastest = {body.name, turns};
            }
        }
    }
    return fastest;
}

}  // namespace samara
