#pragma once

#include <optional>

#include "samara/motion/measures.hpp"

namespace samara {

/// How a body turns round the vertical over the frames [begin, end) of a motion; nothing where it does not,
/// or less than two turns are seen: see measure(). Turning over is not looked at.
std::optional<Autorotation> autorotation_of(const Motion& motion, const BodyMotion& body, int run, int copy,
                                            int begin, int end);

}  // namespace samara
