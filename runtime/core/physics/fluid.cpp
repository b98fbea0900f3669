#include "samara/core/physics/fluid.hpp"

namespace samara {

std::optional<Fluid> fluid_preset(const std::string& name) {
    if (name == "water") return Fluid{.density = 998.2, .viscosity = 1.002e-3};
    if (name == "air") return Fluid{.density = 1.204, .viscosity = 1.825e-5};
    return std::nullopt;
}

}  // namespace samara
