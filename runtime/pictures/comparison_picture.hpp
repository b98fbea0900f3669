#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "samara/analysis/comparison/comparison.hpp"

namespace samara {

/// What the picture of a comparison shows, as draw_picture() takes it: until what both falls cover, 24 swings
/// of the reference at most, the paths (m) and inclinations (rad) of one fall of each and of up to 19 more,
/// and over the window the spectra of the swings and the shares of time by inclination. `motion` and
/// `reference`: the names that stand in its head.
nlohmann::json comparison_picture(const Comparison& comparison, const std::string& motion,
                                  const std::string& reference);

}  // namespace samara
