#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "samara/core/simulation/loaded_body.hpp"
#include "samara/scene/launch_ranges.hpp"
#include "samara/scene/scene.hpp"
#include "samara/scene/search_goals.hpp"

namespace samara {

/// What a search tries, and on what.
struct MotionSearch {
    std::size_t body = 0;      ///< number of the scene's body that is to reach the goals
    SearchGoals goals = {};    ///< one at least
    LaunchRanges launch = {};  ///< ranges of the body's launch
    int tries = 1;             ///< seeds: the scene's own and those after it
    int threads = 0;           ///< 0: all cores; the result does not depend on it
};

/// One simulation of a search.
struct SearchTry {
    std::uint64_t seed = 0;
    Launch launch;      ///< drawn for the seed
    GoalMiss miss;      ///< of the copy that came nearest
    std::string error;  ///< why it could not be simulated, such as a start inside an obstacle; else empty
};

/// Returns whether another seed may give a body another fall: where its start, its emission, its turbulence
/// or gusts without a seed of their own are random, or any of these of a body that it may touch.
bool depends_on_seed(const Scene& scene, std::size_t body);

/// Returns the scene as a try simulates it: with its seed and its launch.
Scene scene_of_try(const Scene& scene, std::size_t body, const SearchTry& one);

/// Simulates a scene with many seeds and launches. Returns the tries by their scores, the lowest first, of
/// equals the first seed; at the end those that could not be simulated. Throws Error where none could, with
/// the first one's reason. `progress` is called with the share done.
std::vector<SearchTry> search_motion(const Scene& scene, const std::vector<LoadedBody>& loaded,
                                     const MotionSearch& search,
                                     const std::function<void(double)>& progress = {});

}  // namespace samara
