#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "converter/falls/fall_identification.hpp"

namespace samara {

/// The identification in SI units: prediction_error, segments, coefficients and falls, each fall with its
/// figures by full CFD (solved) and by the runtime (flown).
nlohmann::json identification_as_json(const Identification& identification);
nlohmann::json flown_fall_as_json(const FlownFall& fall);

/// The same for people: lines, each ended.
std::string identification_as_text(const Identification& identification);
std::string flown_fall_as_text(const FlownFall& fall);

}  // namespace samara
