#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "samara/analysis/comparison/comparison.hpp"
#include "samara/motion/motion.hpp"

namespace samara {

/// Returns the data of a picture of one body of a motion, as draw_picture() takes it: "strip" or "phase" of
/// one copy in one run, or "landing" of all, for which `run` and `copy` are ignored. Lengths in m, times in
/// s, angles in rad, world axes. Throws Error where the body has no such picture. `body` belongs to `motion`;
/// run and copy must exist.
nlohmann::json motion_picture(const std::string& picture, const Motion& motion, const BodyMotion& body,
                              int run, int copy);

/// Returns the data of the picture of a comparison, as draw_picture() takes it: for the time that both falls
/// cover, 24 swings of the reference at most, the paths (m) and inclinations (rad) of one fall of each and of
/// up to 19 more, and over the window the spectra of the swings and the shares of time by inclination.
/// `motion` and `reference`: the names in its title.
nlohmann::json comparison_picture(const Comparison& comparison, const std::string& motion,
                                  const std::string& reference);

}  // namespace samara
