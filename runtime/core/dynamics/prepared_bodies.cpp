#include "samara/core/dynamics/prepared_bodies.hpp"

#include <algorithm>

namespace samara {

std::shared_ptr<const ImmersedBody> PreparedBodies::get(const Body& body, const BodyPhysics& physics,
                                                        const Fluid& fluid, const std::string& name) {
    const std::lock_guard lock(mutex_);
    const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
        return entry.fluid_density == fluid.density && entry.viscosity == fluid.viscosity &&
               entry.physics == physics;
    });
    if (found != entries_.end()) return found->body;
    auto prepared = std::make_shared<const ImmersedBody>(make_immersed_body(body, physics, fluid, name));
    if (entries_.size() == most_) entries_.erase(entries_.begin());
    entries_.push_back({physics, fluid.density, fluid.viscosity, prepared});
    return prepared;
}

}  // namespace samara
