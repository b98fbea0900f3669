#pragma once

#include <string>
#include <vector>

#include "samara/analysis/comparison/comparison.hpp"

namespace samara {

/// What to know before trusting a comparison, a sentence each without a full stop: falls of different length,
/// runs that repeat one another, other starts, other shapes, too few frames or swings.
std::vector<std::string> comparison_notes(const FallChoice& motion, const FallChoice& reference,
                                          const Comparison& comparison);

}  // namespace samara
