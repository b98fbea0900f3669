#pragma once

#include <string>
#include <vector>

#include "samara/core/simulation/loaded_body.hpp"
#include "samara/scene/scene.hpp"

namespace samara {

/// The bodies of a scene, in its order, each with the added mass that the scene asks for: what several have
/// in common is read, meshed and solved once. `folder`: of baked bodies, NAME.body.h5 for each body of the
/// scene; empty: the scene's own shapes. Bodies whose loads the scene leaves to their files are made to fly
/// by those of their surface, in still fluid, where these hold no tables. Throws Error where one cannot be
/// had, or was baked from another shape.
std::vector<LoadedBody> load_scene_bodies(Scene& scene, const std::string& folder);

}  // namespace samara
