#include "samara/c_interface/prepared_bodies.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace samara {
namespace {

constexpr std::size_t most_entries = 16;

template <typename Numbers>
std::string text_of(const Numbers& numbers) {
    return fmt::format("{}", fmt::join(numbers.data(), numbers.data() + numbers.size(), " "));
}

/// All that the C interface can set and make_immersed_body takes from it, exactly.
std::string key_of(const SceneBody& kind, const Fluid& fluid) {
    const MassSpecification& mass = kind.mass;
    const CoefficientLoads& coefficients = kind.coefficients;
    return fmt::format(
        "{} {} {} {} | {} {} {} {} {} {} | {} {} {} {} | {} {} {} | {} {}", mass.density.value_or(0.0),
        mass.mass.value_or(0.0), mass.center_of_mass ? text_of(*mass.center_of_mass) : "-",
        mass.inertia ? text_of(*mass.inertia) : "-", static_cast<int>(kind.loads),
        coefficients.drag_coefficient, coefficients.lift_coefficient,
        coefficients.reference_area.value_or(0.0), coefficients.normal ? text_of(*coefficients.normal) : "-",
        text_of(coefficients.center_of_pressure), static_cast<int>(kind.turbulence),
        kind.turbulent_kinetic_energy, kind.dissipation_rate, static_cast<int>(kind.langevin),
        kind.added_mass, static_cast<int>(kind.dynamic), kind.table_reynolds_number.value_or(0.0),
        fluid.density, fluid.viscosity);
}

}  // namespace

std::shared_ptr<const ImmersedBody> PreparedBodies::get(const Body& body, const SceneBody& kind,
                                                        const Fluid& fluid) {
    const std::string key = key_of(kind, fluid);
    const std::lock_guard lock(mutex_);
    const auto found =
        std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.key == key; });
    if (found != entries_.end()) return found->body;
    auto prepared = std::make_shared<const ImmersedBody>(make_immersed_body(body, kind, fluid));
    if (entries_.size() == most_entries) entries_.erase(entries_.begin());
    entries_.push_back({key, prepared});
    return prepared;
}

}  // namespace samara
