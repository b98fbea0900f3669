#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "samara/analysis/comparison/comparison.hpp"

namespace samara {

/// Returns a comparison as a JSON object in SI units and radians; docs/reference/output.md lists its keys.
/// Unknown values are null.
nlohmann::json as_json(const Comparison& comparison);

/// Returns a comparison as text: a table and a few lines, each ended; angles in degrees.
std::string as_text(const Comparison& comparison);

/// Returns an estimate with its error as text, "0.1832 +- 0.0012": the error to two digits, the value to the
/// error's last; without an error, to four digits. `scale`: factor for both.
std::string with_error(const Estimate& estimate, double scale = 1.0);

}  // namespace samara
