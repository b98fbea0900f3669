#include "samara/core/flight/terminal_speed.hpp"

#include <algorithm>
#include <cmath>

#include "samara/core/surface/octahedral_map.hpp"

namespace samara {

double largest_projected_area(const Body& body) {
    double largest = 0.0;
    const auto visit = [&](const Vector3d& direction) {
        largest = std::max(largest, projected_area(body.surface, direction));
    };
    const Matrix3d axes = principal_axes(body.moments);
    for (int i = 0; i < 3; ++i) visit(axes.col(i));
    constexpr int subdivisions = 4;
    for (const Vector3d& direction : octahedral_nodes(subdivisions)) visit(direction);
    return largest;
}

double terminal_speed(const Body& body, const Fluid& fluid, double mass, double gravity) {
    constexpr double neutral_mass = 1e-6;  // over the displaced fluid's
    const double buoyant_mass = fluid.density * body.moments.volume;
    const double excess = std::abs(mass - buoyant_mass);
    if (excess <= neutral_mass * buoyant_mass || !(gravity > 0.0)) return 0.0;
    return std::sqrt(2.0 * excess * gravity /
                     (terminal_drag_coefficient * fluid.density * largest_projected_area(body)));
}

}  // namespace samara
