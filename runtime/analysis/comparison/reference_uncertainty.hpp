#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "samara/motion/motion.hpp"

namespace samara {

/// Below this name an uncertainty says whether the regime itself depends on the cause (1) or not (0).
inline constexpr const char* regime_key = "regime";

/// By how much the figures of a motion that serves as a reference may be wrong for a cause: the whole
/// difference to another solution of the same scene that differs in it alone (another mesh, another closure),
/// and the standard error of that. For each of baked_metrics that says something of the body; a difference of
/// 1 where one of the two has the figure and the other has not, and for the regime where it is another.
/// Sorted by figure. Both are measured over the last two thirds of the shorter fall. Throws Error where the
/// two are not of the same scene, hold several bodies, or cannot be compared.
std::vector<MetricUncertainty> uncertainty_beside(const std::filesystem::path& reference,
                                                  const std::filesystem::path& other,
                                                  const std::string& cause);

/// What all causes together make of a figure of the motion, over the figure: the sum of the differences, and
/// no less than the largest of their standard errors, for what chance hides is not claimed, and the same
/// fall's chance is in all of them. 0 where nothing is known.
/// `figure`: its key in the catalogue, or regime_key.
double uncertainty_of(const BodyMotion& body, const std::string& metric);

}  // namespace samara
