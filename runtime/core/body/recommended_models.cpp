#include "samara/core/body/recommended_models.hpp"

#include <fmt/format.h>

#include "samara/core/body/body.hpp"
#include "samara/core/surface/surface_patches.hpp"

namespace samara {
namespace {

/// Returns the models of a body whose file recommends none.
RecommendedModels usual_models(const Body& body) {
    if (body.tables || !body.surface_loads) return {};
    return {.loads = Loads::surface};
}

}  // namespace

std::string error_of(const RecommendedModels& models) {
    if (models.loads != Loads::table && models.loads != Loads::surface) {
        return "recommends loads that are neither of tables nor of the surface";
    }
    if (models.patches < 1 || models.patches > most_surface_patches) {
        return fmt::format("recommends {} patches, which must lie between 1 and {}", models.patches,
                           most_surface_patches);
    }
    return models.turbulence != Turbulence::constant ? ""
                                                     : "recommends turbulence that its loads do not have";
}

void choose_open_models(const Body& body, const OpenModels& open, BodyPhysics& physics) {
    const RecommendedModels best = body.recommended.value_or(usual_models(body));
    if (open.loads) physics.loads = physics.table_reynolds_number ? Loads::table : best.loads;
    const bool as_recommended = physics.loads == best.loads;
    if (open.patches && as_recommended) physics.patches = best.patches;
    if (!open.turbulence) return;
    physics.turbulence = as_recommended ? best.turbulence : usual_turbulence(physics.loads);
}

}  // namespace samara
