#pragma once

#include <filesystem>

#include "samara/motion/motion.hpp"

namespace samara {

/// Throws Error, which names the file to be written and the body or obstacle, where a time, a length, a place
/// or a velocity of a run is beyond 1e37 (SI units): animation tools hold floats, which end at 3.4e38.
void require_float_range(const std::filesystem::path& file, const Motion& motion, int run);

}  // namespace samara
