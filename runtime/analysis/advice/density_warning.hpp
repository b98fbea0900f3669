#pragma once

#include <string>

#include "samara/core/body/body.hpp"
#include "samara/core/physics/fluid.hpp"
#include "samara/scene/scene.hpp"

namespace samara {

/// "1.5", "1.5 to 11.4", or "unknown".
std::string in_words(const IdentifiedDensities& densities);

/// Of a body whose density is far from those of the falls that its coefficients come from.
struct DensityWarning {
    double ratio = 1.0;  ///< how far outside it is, as `beyond` says
    std::string text;    ///< one line to stand behind the body's name; empty where there is no doubt
};

/// The doubt about a body of a scene; none of one that flies without identified coefficients, or whose weight
/// is not known.
DensityWarning density_warning(const SceneBody& scene_body, const Body& body, const Fluid& fluid);

}  // namespace samara
