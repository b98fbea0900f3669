#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "samara/analysis/metrics/ensemble.hpp"

namespace samara {

/// Returns measures as a JSON object in SI units and radians: window [begin, end] s, mean_velocity [x, y, z]
/// m/s, the catalogue's metrics that Measures holds (null where there is none), swings, turnovers, regime.
nlohmann::json as_json(const Measures& measures);

/// Returns the regimes of several falls as a JSON object: regime (the commonest), regime_share,
/// regime_confidence [from, to], regimes (counts by name).
nlohmann::json as_json(const RegimeCounts& regimes);

/// Returns the measures of a body's copies and runs as a JSON object in SI units and radians: samples,
/// mean_velocity [x, y, z], the catalogue's metrics that Measures holds, descent_speed_deviation and _error
/// (standard error of the mean), frequency_deviation, the regimes, path_spread, path_spread_growth (null
/// where nothing spreads), and landing (null where nothing landed): count, at_rest, mean [x, y, z], spread.
nlohmann::json as_json(const BodyMeasures& measures);

/// Returns the measures of a body's copies and runs as lines of text, each indented by two spaces and ended.
std::string as_text(const BodyMeasures& measures);

/// Returns a description of a motion as a JSON object: kind "motion", start and duration (s), frames,
/// frame_rate (1/s), runs, gravity (m/s^2), ground (m; null without one), seed, scene (its text), and bodies:
/// for each its name, copies, triangles, center_of_mass (m, shape axes), body_hash, models, and its measures
/// over all runs and copies. `measures`: one for each body; the motion's poses are not read.
nlohmann::json describe_motion(const Motion& motion, const std::vector<BodyMeasures>& measures);

/// Returns a description of a motion as a few lines of text, the last one ended too; without the scene's
/// text.
std::string describe_motion_text(const Motion& motion, const std::vector<BodyMeasures>& measures);

}  // namespace samara
