#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "samara/analysis/comparison/comparison.hpp"

namespace samara {

/// A comparison as a JSON object in SI units and radians; docs/output.md lists its keys. What is not known is
/// null.
nlohmann::json as_json(const Comparison& comparison);

/// The same for people: a table and a few lines, each ended; angles in degrees.
std::string as_text(const Comparison& comparison);

/// A figure with its error as people write it, "0.1832 +- 0.0012": the error to two digits, the figure to the
/// error's last; without an error, to four digits. `scale`: what both are multiplied by.
std::string with_error(const Estimate& estimate, double scale = 1.0);

}  // namespace samara
