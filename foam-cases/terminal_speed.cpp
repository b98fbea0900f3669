#include "foam-cases/terminal_speed.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "foam-cases/bake_plan.hpp"
#include "samara/base/error.hpp"
#include "samara/body/octahedral_map.hpp"

namespace samara {

double largest_projected_area(const Body& body) {
    double largest = 0.0;
    const auto visit = [&](const Vector3d& direction) {
        largest = std::max(largest, projected_area(body.surface, direction));
    };
    const Matrix3d axes = principal_axes(body.moments);
    for (int i = 0; i < 3; ++i) visit(axes.col(i));
    constexpr int subdivisions = 4;
    constexpr int nodes = 2 * subdivisions + 1;
    for (int row = 0; row < nodes; ++row) {
        for (int column = 0; column < nodes; ++column) visit(octahedral_node(subdivisions, row, column));
    }
    return largest;
}

double mass_of(const MassSpecification& mass, const Body& body) {
    if (mass.mass) return *mass.mass;
    if (mass.density) return *mass.density * body.moments.volume;
    throw Error(fmt::format("{}: has neither a density nor a mass; give one", body.name));
}

double terminal_speed(const Body& body, const Fluid& fluid, double mass, double gravity) {
    const double buoyant_mass = fluid.density * body.moments.volume;
    if (std::abs(mass - buoyant_mass) <= 1e-6 * buoyant_mass) {
        throw Error(
            fmt::format("{}: the body weighs as much as the fluid it displaces ({:.6g} kg/m^3) and so has no "
                        "terminal speed to bake at; choose another density",
                        body.name, fluid.density));
    }
    if (!(gravity > 0.0)) {
        throw Error(fmt::format(
            "{}: without gravity the body has no terminal speed to bake at; choose another gravity",
            body.name));
    }
    const double force = std::abs(mass - buoyant_mass) * gravity;
    return std::sqrt(2.0 * force /
                     (terminal_drag_coefficient * fluid.density * largest_projected_area(body)));
}

double terminal_reynolds_number(const Body& body, const Fluid& fluid, double speed) {
    return rounded_reynolds_number(speed * reference_length(body.moments.surface_area) /
                                   fluid.kinematic_viscosity());
}

}  // namespace samara
