#pragma once

#include <optional>
#include <string>
#include <vector>

#include "samara/motion/motion.hpp"

namespace samara {

/// Consecutive copies of a body, counted from 0.
struct CopyRange {
    int first = 0;  ///< number of the first copy
    int last = 0;   ///< number of the last copy, first or more
};

/// Returns the motion with the bodies and obstacles of these names alone, in the motion's order; without
/// names with all. Where `copies` are given, each body has these copies alone, which it must have. Names that
/// the motion does not have are ignored.
Motion selected(Motion motion, const std::vector<std::string>& names, const std::optional<CopyRange>& copies);

}  // namespace samara
