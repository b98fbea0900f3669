#include "samara/analysis/advice/input_warnings.hpp"

#include <optional>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "samara/core/body/body_file.hpp"
#include "samara/scene/terminal_speed.hpp"

namespace samara {
namespace {

constexpr double longest = 5.0;            // m
constexpr double shortest = 1e-4;          // m: what is smaller is dust
constexpr double most_reynolds = 2e7;      // a ball of steel of 1 m sinks at 1e7
constexpr double least_density = 10.0;     // kg/m^3: foams begin there
constexpr double largest_density = 22600;  // kg/m^3: osmium's
constexpr double gram_in_cubic_centimetre = 1000.0;

double length_of(const Body& body) {
    Eigen::AlignedBox3d box;
    for (const Vector3d& vertex : body.surface.vertices) box.extend(vertex);
    return box.sizes().maxCoeff();
}

const char* in_words(ScaleRemedy remedy) {
    switch (remedy) {
        case ScaleRemedy::option:
            return "give --scale 0.001";
        case ScaleRemedy::scene_key:
            return "write scale = 0.001 beside its shape";
        default:
            return "mesh its shape again with 'samara mesh --scale 0.001'";
    }
}

std::string length_warning(double length, const std::optional<double>& reynolds_number, ScaleRemedy remedy) {
    if (length < shortest) {
        return fmt::format("{:.2g} m long: check that its shape is in metres and scaled only once", length);
    }
    const bool fast = reynolds_number && *reynolds_number > most_reynolds;
    if (length <= longest && !fast) return {};
    return fmt::format(
        "{:.3g} m long{}: if its shape is in millimetres, {}", length,
        fast ? fmt::format(" and falls at a Reynolds number of about {:.1g}", *reynolds_number) : "",
        in_words(remedy));
}

std::string density_warning(double density) {
    if (density > largest_density) {
        return fmt::format(
            "a density of {:.3g} kg/m^3, above that of any metal: check that its mass is in kg and its shape "
            "in metres",
            density);
    }
    if (density >= least_density) return {};
    return fmt::format("a density of {:.3g} kg/m^3: if it is in g/cm^3, give {:.4g}", density,
                       density * gram_in_cubic_centimetre);
}

// Chosen: the ready disc, at 0.55 of the density of its falls, swings a quarter less often and rotates half
// as fast as full CFD has it (docs/studies/falls); what differs by a quarter is not known to.
constexpr double negligible = 1.25;

}  // namespace

ScaleRemedy scale_remedy_in_scene(const std::filesystem::path& shape) {
    return is_body_file_name(shape) ? ScaleRemedy::mesh_again : ScaleRemedy::scene_key;
}

std::string size_warnings(const Body& body, ScaleRemedy remedy) {
    return length_warning(length_of(body), std::nullopt, remedy);
}

std::string unit_warnings(const Body& body, const MassSpecification& asked, const Fluid& fluid,
                          double gravity, ScaleRemedy remedy) {
    const double volume = body.moments.volume;
    const MassSpecification mass = mass_asked_or_own(asked, body);
    if (!mass.is_given()) return {};
    const double density = mass_properties(body, mass).mass / volume;
    const double reynolds_number = terminal_speed(body, fluid, density * volume, gravity) *
                                   reference_length(body.moments.surface_area) / fluid.kinematic_viscosity();
    std::vector<std::string> warnings;
    for (std::string warning :
         {length_warning(length_of(body), reynolds_number, remedy), density_warning(density)}) {
        if (!warning.empty()) warnings.push_back(std::move(warning));
    }
    return fmt::format("{}", fmt::join(warnings, "; and "));
}

std::string drag_crisis_warning(double highest_reynolds_number) {
    if (highest_reynolds_number < drag_crisis_reynolds_number) return {};
    return fmt::format(
        "Reynolds number {:.3g} is within or above the drag crisis of smooth bodies (a sphere's drag falls "
        "from "
        "0.5 to 0.1 between 2e5 and 4e5: Achenbach 1972), which these closures do not reproduce: k-epsilon "
        "has no "
        "laminar boundary layer, and kOmegaSSTLM was compared with measurements up to 1e5; bodies whose flow "
        "separates at sharp edges have no such crisis",
        highest_reynolds_number);
}

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
            fmt::format("{:.3g} times as dense as the fluid, but its coefficients were identified at {} "
                        "times: swings may be wrong; 'samara bake --density A --density-to B' covers a range",
                        density, in_words(body.dynamic->densities))};
}

}  // namespace samara
