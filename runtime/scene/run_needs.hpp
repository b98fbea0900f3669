#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "samara/core/simulation/loaded_body.hpp"
#include "samara/scene/scene.hpp"

namespace samara {

/// Approximate memory and disk to simulate a scene into a motion file and to measure that.
struct RunNeeds {
    double memory = 0.0;             ///< bytes, at the highest
    double disk = 0.0;               ///< bytes
    bool memory_for_copies = false;  ///< whether most of the memory is for copies and runs, not for frames
};

/// Estimates the needs of a scene in `runs` runs from its sizes alone. With its bodies, where they are
/// loaded, the hulls of copies of many sizes count too.
RunNeeds needs_of(const Scene& scene, int runs, const std::vector<LoadedBody>& loaded = {});

/// Returns the needs as text: "5.2 GB of memory and 5.4 GB of disk".
std::string in_words(const RunNeeds& needs);

/// Throws Error, which says how much and what to lower, where the machine has not the memory, or the folder
/// of `output` not the disk. `scene`: its name for the message.
void require_room(const RunNeeds& needs, const std::string& scene, const std::filesystem::path& output);

}  // namespace samara
