#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "samara/motion/motion.hpp"

namespace samara {

/// Name under which an uncertainty says whether the regime itself depends on the cause (1) or not (0).
inline constexpr const char* regime_key = "regime";

/// Returns the uncertainties of the metrics of a reference for a cause: the whole difference to another
/// solution of the same scene that differs in the cause alone (another mesh, another closure), and its
/// standard error. For each of baked_metrics that is defined for the body; the difference is 1 where only one
/// of the two has the metric, and for the regime where the two differ. Sorted by metric. Both are measured
/// over the last two thirds of the shorter fall. Throws Error where the two are not of the same scene, hold
/// several bodies, or cannot be compared.
std::vector<MetricUncertainty> uncertainty_beside(const std::filesystem::path& reference,
                                                  const std::filesystem::path& other,
                                                  const std::string& cause);

/// Returns the uncertainty of a metric by all causes together, relative to the metric: the sum of the
/// differences, and no less than the largest of their standard errors, since chance hides smaller
/// differences, and one fall's chance is in all of them. 0 where nothing is known. `metric`: its key in the
/// catalogue, or regime_key.
double uncertainty_of(const BodyMotion& body, const std::string& metric);

}  // namespace samara
