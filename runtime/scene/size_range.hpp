#pragma once

#include "samara/core/flight/loaded_body.hpp"
#include "samara/scene/scene.hpp"

namespace samara {

/// Throws Error, which names the scene and the sizes that can be had, where copies of a body of a scene are
/// so large or small that they would fall at more than twice the highest or less than half the lowest
/// Reynolds number of its tables: by terminal_speed(), of each size. A body that reads them at one alone is
/// let be.
void require_sizes_in_tables(const Scene& scene, const SceneBody& scene_body, const LoadedBody& loaded);

}  // namespace samara
