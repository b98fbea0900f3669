#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "foam-cases/farm/case_farm.hpp"

namespace samara {

/// Makes each solved fall whose momenta do not balance (is_unbalanced) start again at the next solve_cases(),
/// with half the step, unless it was tried more than once already. Returns a line for each, with the reason.
/// Throws Error where the record of a fall cannot be read.
std::vector<std::string> restart_unbalanced_falls(const std::filesystem::path& folder, const BakePlan& plan);

/// Solves as solve_cases() does, and then those falls again, once, whose momenta do not balance, with half
/// the step.
std::vector<LeftOutCase> solve_until_balanced(const std::filesystem::path& folder, const BakePlan& plan,
                                              const FarmOptions& options,
                                              const std::filesystem::path& foam_cases);

}  // namespace samara
