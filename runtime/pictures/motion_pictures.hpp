#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "samara/motion/motion.hpp"

namespace samara {

/// What a picture of one body of a motion shows, as draw_picture() takes it: "strip" or "phase" of one copy
/// in one run, or "landing" of all, whose `run` and `copy` count for nothing. Lengths in m, times in s,
/// angles in rad, world axes. Throws Error where the body has no such picture. `body` belongs to `motion`;
/// run and copy must exist.
nlohmann::json motion_picture(const std::string& picture, const Motion& motion, const BodyMotion& body,
                              int run, int copy);

}  // namespace samara
