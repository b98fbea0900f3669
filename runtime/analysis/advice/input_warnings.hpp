#pragma once

#include <filesystem>
#include <string>

#include "samara/core/body/body.hpp"
#include "samara/core/physics/body_physics.hpp"
#include "samara/core/physics/fluid.hpp"
#include "samara/scene/scene.hpp"

namespace samara {

/// How the reader of a warning can change the size of a body: by the option --scale, by `scale` in the scene,
/// or, for a body file, by meshing its shape again.
enum class ScaleRemedy { option, scene_key, mesh_again };

/// Returns the remedy for a body of a scene that is read from this file.
ScaleRemedy scale_remedy_in_scene(const std::filesystem::path& shape);

/// Returns a warning where the size of a body suggests that it is in another unit, such as "is 40 m long: is
/// its shape in millimetres? then give --scale 0.001"; empty for sizes from 0.1 mm to 5 m.
std::string size_warnings(const Body& body, ScaleRemedy remedy);

/// Returns size_warnings() and those of a body that falls: of a Reynolds number above 2e7 at the estimated
/// terminal speed, and of a mean density below 10 kg/m^3 or above that of any metal. One line, to stand
/// behind the body's name; empty where there are none. Throws nothing: values beyond all bounds are rejected
/// elsewhere.
std::string unit_warnings(const Body& body, const MassSpecification& asked, const Fluid& fluid,
                          double gravity, ScaleRemedy remedy);

/// Lowest Reynolds number (U L/nu) at which the boundary layer of a smooth body may be turbulent before it
/// separates: the drag coefficient of a sphere falls from 0.5 at 2e5 to 0.1 at 3.8e5 (Achenbach, J. Fluid
/// Mech. 54, 565, 1972).
inline constexpr double drag_crisis_reynolds_number = 2e5;

/// Returns a warning, to stand behind a body's name, where tables reach the drag crisis of smooth bodies;
/// empty below it.
std::string drag_crisis_warning(double highest_reynolds_number);

/// Returns the densities as text: "1.5", "1.5 to 11.4", or "unknown".
std::string in_words(const IdentifiedDensities& densities);

/// Warning of a body whose density is far from those of the falls that its coefficients come from.
struct DensityWarning {
    double ratio = 1.0;  ///< factor by which the density is outside the range, by beyond()
    std::string text;    ///< one line to stand behind the body's name; empty without a warning
};

/// Returns the density warning of a body of a scene; an empty one for a body that does not use identified
/// coefficients, or whose mass is not known.
DensityWarning density_warning(const SceneBody& scene_body, const Body& body, const Fluid& fluid);

}  // namespace samara
