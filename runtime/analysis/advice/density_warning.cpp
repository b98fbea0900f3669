#include "samara/analysis/advice/density_warning.hpp"

#include <fmt/format.h>

namespace samara {
namespace {

// Chosen: the ready disc, at 0.55 of the density of its falls, swings a quarter less often and turns half as
// fast as full CFD has it (docs/studies/falls); what differs by a quarter is not known to.
constexpr double negligible = 1.25;

}  // namespace

std::string in_words(const IdentifiedDensities& densities) {
    const auto& [lowest, highest] = densities;
    if (lowest <= 0.0) return "unknown";
    return lowest == highest ? fmt::format("{:.3g}", lowest)
                             : fmt::format("{:.3g} to {:.3g}", lowest, highest);
}

DensityWarning density_warning(const SceneBody& scene_body, const Body& body, const Fluid& fluid) {
    if (!body.dynamic || scene_body.loads != Loads::table || scene_body.dynamic != Dynamic::of_body)
        return {};
    const MassSpecification mass = mass_asked_or_own(scene_body.mass, body);
    if (!mass.is_given()) return {};
    const double density = mass_properties(body, mass).mass / (body.moments.volume * fluid.density);
    const double ratio = beyond(body.dynamic->densities, density);
    if (ratio <= negligible) return {};
    return {ratio,
            fmt::format("{:.3g} times as dense as the fluid, with coefficients identified at {} times: "
                        "swings may be wrong; 'samara bake --density A --density-to B' spans "
                        "a range",
                        density, in_words(body.dynamic->densities))};
}

}  // namespace samara
