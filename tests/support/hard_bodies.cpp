#include "support/hard_bodies.hpp"

#include "samara/core/surface/octahedral_map.hpp"
#include "support/exact_bodies.hpp"
#include "support/known_bodies.hpp"
#include "support/test_shapes.hpp"

namespace samara::test {
namespace {

constexpr double rubber = 1200.0;  // kg/m^3
constexpr double copper = 8960.0;
constexpr double paper = 750.0;

}  // namespace

Fluid water() {
    return *fluid_preset("water");
}

Fluid air() {
    return *fluid_preset("air");
}

Body baked_ellipsoid(const Vector3d& semi_axes) {
    const ExactEllipsoid exact = exact_ellipsoid(semi_axes);
    Body body;
    body.name = "ellipsoid";
    body.surface = ellipsoid(semi_axes, 2);
    body.moments = exact_moments(exact);
    body.kirchhoff.emplace();
    body.kirchhoff->matrix = exact_tensor(exact);
    body.tables = blunt_tables(body, 4);
    return body;
}

Body baked_sphere(double radius, int subdivisions) {
    Body body = exact_sphere(radius);
    body.tables = blunt_tables(body, subdivisions);
    body.tables->reynolds_numbers = {1.0, 1e5};
    const std::vector<Vector3d> nodes = octahedral_nodes(subdivisions);
    for (std::size_t i = 0; i < body.tables->entries.size(); ++i) {
        body.tables->entries[i].force = -0.5 * nodes[i % nodes.size()];
        body.tables->entries[i].moment.setZero();
    }
    return body;
}

Body paper_sheet() {
    Body body;
    body.name = "paper sheet";
    body.surface = box({1e-4, 0.21, 0.297}, 8);
    body.moments = moments_of(body.surface);
    body.kirchhoff.emplace();
    body.kirchhoff->matrix.diagonal() << 7.87e-11, 3.01e-5, 1.24e-5, 6.96e-3, 9.42e-9, 6.61e-9;
    body.tables = blunt_tables(body, 4);
    return body;
}

ImmersedBody immersed(const Body& body, double density, const Fluid& fluid, Loads loads,
                      const Vector3d& offset) {
    SceneBody given = scene_body(density);
    given.loads = loads;
    if (loads != Loads::table) given.turbulence = Turbulence::none;
    given.mass = {.density = {},
                  .mass = density * body.moments.volume,
                  .center_of_mass = body.moments.centroid + offset,
                  .inertia = {}};
    return make_immersed_body(body, given, fluid);
}

std::vector<NamedBody> five_bodies(Loads loads) {
    const Body ellipsoid = baked_ellipsoid({0.01, 0.02, 0.04});
    const Body bubble = baked_ellipsoid({0.002, 0.003, 0.004});
    const Body coin = baked_ellipsoid({0.001, 0.0125, 0.0125});
    return {{"rubber ellipsoid", immersed(ellipsoid, rubber, water(), loads)},
            {"paper sheet", immersed(paper_sheet(), paper, air(), loads)},
            {"air bubble", immersed(bubble, air().density, water(), loads)},
            {"neutral ellipsoid", immersed(ellipsoid, water().density, water(), loads)},
            {"copper coin", immersed(coin, copper, water(), loads)}};
}

}  // namespace samara::test
