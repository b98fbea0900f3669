#pragma once

#include <filesystem>
#include <string>

#include "samara/core/body/body.hpp"
#include "samara/core/physics/body_physics.hpp"
#include "samara/core/physics/fluid.hpp"

namespace samara {

/// How whoever is told may change the size of a body: by the option --scale, by `scale` in the scene, or, of
/// a body file, by meshing its shape again.
enum class ScaleRemedy { option, scene_key, mesh_again };

/// The remedy for a body of a scene that is read from this file.
ScaleRemedy scale_remedy_in_scene(const std::filesystem::path& shape);

/// What makes the size of a body look as if it were in another unit, such as "is 40 m long: is its shape in
/// millimetres? then give --scale 0.001"; empty for sizes from 0.1 mm to 5 m.
std::string size_warnings(const Body& body, ScaleRemedy remedy);

/// The same of a body that falls: also of a Reynolds number above 2e7 at the estimated terminal speed, and of
/// a mean density below 10 kg/m^3 or above that of any metal. One line, to stand behind the body's name.
/// Throws nothing: what is beyond all bounds is refused elsewhere.
std::string unit_warnings(const Body& body, const MassSpecification& asked, const Fluid& fluid,
                          double gravity, ScaleRemedy remedy);

}  // namespace samara
