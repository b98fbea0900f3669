#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "samara/motion/measures.hpp"

namespace samara {

/// The measures as a JSON object in SI units and radians: window [begin, end] s, mean_velocity [x, y, z] m/s,
/// descent_speed m/s, mean_inclination and inclination_amplitude rad, frequency Hz (null where there is
/// none), rms_angular_speed rad/s, swings, turnovers, regime.
nlohmann::json as_json(const Measures& measures);

/// What a motion holds, as a JSON object: kind "motion", start and duration (s), frames, frame_rate (1/s),
/// runs, gravity (m/s^2), seed, scene (its text), and bodies: for each its name, copies, triangles,
/// center_of_mass (m, shape axes), body_hash, models, and its measures over all runs and copies:
/// mean_velocity, descent_speed, descent_speed_deviation, inclination_amplitude, frequency,
/// rms_angular_speed, regime, regime_share.
nlohmann::json describe_motion(const Motion& motion);

/// The same for people: a few lines, the last one ended too; without the scene's text.
std::string describe_motion_text(const Motion& motion);

}  // namespace samara
