#include "samara/scene/terminal_speed.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/dynamics/loads.hpp"
#include "samara/core/surface/octahedral_map.hpp"

namespace samara {

double largest_projected_area(const Body& body) {
    std::vector<Vector3d> areas(body.surface.triangle_count());
    for (std::size_t t = 0; t < areas.size(); ++t) areas[t] = area_vector(body.surface, t);
    double largest = 0.0;
    const auto visit = [&](const Vector3d& direction) {
        double area = 0.0;
        for (const Vector3d& triangle : areas) area += std::abs(triangle.dot(direction));
        largest = std::max(largest, 0.5 * area);
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

void require_sizes_in_tables(const Scene& scene, const SceneBody& scene_body, const LoadedBody& loaded) {
    if (!scene_body.spreads_size() || scene_body.table_reynolds_number) return;
    const auto body = loaded.prepared->get(*loaded.body, scene_body, scene.fluid, scene_body.name, false);
    if (!body->tables) return;
    const double speed = terminal_speed(*loaded.body, scene.fluid, body->mass, scene.gravity.norm());
    if (!(speed > 0.0)) return;
    const double lowest = body->tables->reynolds_numbers.front();
    const double highest = body->tables->reynolds_numbers.back();
    // The terminal speed goes with the root of the mass by area, the Reynolds number with that times the
    // size.
    const double own = reynolds_number(*body, speed);
    const double power = body->keeps_thickness ? 1.0 : 1.5;
    const auto size_at = [&](double reynolds) { return std::pow(reynolds / own, 1.0 / power); };
    const double least = size_at(0.5 * lowest);
    const double most = size_at(2.0 * highest);
    const bool too_large = scene_body.largest_size > most;
    if (!too_large && scene_body.smallest_size >= least) return;
    const double size = too_large ? scene_body.largest_size : scene_body.smallest_size;
    throw Error(fmt::format(
        "{}: body '{}': with spread.size {:g} it falls at a Reynolds number of about {:.3g}, but its tables "
        "range from {:.3g} to {:.3g}; keep the sizes within {:.3g} and {:.3g}, or bake this scene",
        scene.file.string(), scene_body.name, size, own * std::pow(size, power), lowest, highest, least,
        most));
}

}  // namespace samara
