#include "support/known_bodies.hpp"

#include <numbers>

#include "samara/core/surface/octahedral_map.hpp"
#include "support/test_shapes.hpp"

namespace samara::test {
namespace {

Body exact_body(const Surface& surface, const Vector3d& added_mass, const Vector3d& added_inertia,
                double volume, const Vector3d& semi_axes) {
    Body body;
    body.name = "exact";
    body.surface = surface;
    body.moments = moments_of(surface);
    body.moments.volume = volume;
    body.moments.second_moments = volume / 5.0 * semi_axes.cwiseAbs2().asDiagonal();
    body.kirchhoff.emplace();
    body.kirchhoff->matrix.diagonal() << added_inertia, added_mass;
    return body;
}

ImmersedBody immersed_off_center(const Body& body, const Vector3d& offset) {
    SceneBody given = scene_body(1200.0);
    given.mass = {
        .density = {}, .mass = 1200.0 * body.moments.volume, .center_of_mass = offset, .inertia = {}};
    return make_immersed_body(body, given, Fluid{});
}

}  // namespace

Body rubber_ellipsoid() {
    const Vector3d semi_axes(0.01, 0.02, 0.04);
    return exact_body(
        ellipsoid(semi_axes, 3), 1e-6 * Vector3d(50.87072167736, 13.34287626884, 4.241425456327),
        1e-10 * Vector3d(19.46017908431, 111.0440372296, 13.6118310185), 33.51032163829e-6, semi_axes);
}

Body exact_sphere(double radius) {
    const double volume = 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
    Body body = exact_body(ellipsoid(Vector3d::Constant(radius), 3), Vector3d::Constant(volume / 2.0),
                           Vector3d::Zero(), volume, Vector3d::Constant(radius));
    body.moments.surface_area = 4.0 * std::numbers::pi * radius * radius;
    return body;
}

LoadTables blunt_tables(const Body& body, int subdivisions) {
    LoadTables tables;
    tables.reference_length = reference_length(body.moments.surface_area);
    tables.subdivisions = subdivisions;
    tables.reynolds_numbers = {1e3, 1e5};
    const double length = tables.reference_length;
    const double area = std::numbers::pi * length * length / 4.0;
    const Matrix3d added_mass = body.kirchhoff->matrix.bottomRightCorner<3, 3>();
    for (const double factor : {1.0, 0.8}) {
        for (const Vector3d& d : octahedral_nodes(subdivisions)) {
            LoadEntry entry;
            entry.force = -factor * Vector3d(1.6, 1.0, 0.4).cwiseProduct(d);
            const Vector3d kirchhoff = (added_mass * d).cross(d) / (0.5 * area * length);
            entry.moment = factor * (0.5 * kirchhoff + 0.03 * d);
            entry.turbulent_kinetic_energy = factor * (0.01 + 0.01 * d.x() * d.x());
            entry.dissipation_rate = 0.008 * factor;
            tables.entries.push_back(entry);
        }
    }
    tables.errors.resize(tables.entries.size());
    tables.quality = "invented";
    return tables;
}

SceneBody scene_body(double density) {
    SceneBody scene_body;
    scene_body.name = "body";
    scene_body.mass.density = density;
    scene_body.loads = Loads::table;
    scene_body.turbulence = Turbulence::none;
    return scene_body;
}

ImmersedBody blunt_ellipsoid(const Vector3d& offset) {
    Body body = rubber_ellipsoid();
    body.tables = blunt_tables(body, 4);
    return immersed_off_center(body, offset);
}

Body lopsided_shape() {
    Body body = rubber_ellipsoid();
    Matrix6d& tensor = body.kirchhoff->matrix;
    tensor.topRightCorner<3, 3>() << 3.0, 1.0, -2.0, 1.5, -4.0, 2.0, 0.5, -1.0, 2.5;
    tensor.topRightCorner<3, 3>() *= 1e-8;
    tensor.bottomLeftCorner<3, 3>() = tensor.topRightCorner<3, 3>().transpose();
    body.tables = blunt_tables(body, 4);
    body.surface_loads = made_up_surface_loads(body.surface, body.moments);
    DynamicCoefficients dynamic;
    dynamic.transport << 40.0, 5.0, -3.0, 5.0, 11.0, 2.0, -3.0, 2.0, -4.0;
    dynamic.transport *= 1e-6;
    dynamic.rotational_transport = 0.7;
    dynamic.drag_in_motion << 3.0, 0.4, 0.2, 0.4, 1.0, -0.1, 0.2, -0.1, 0.7;
    dynamic.drag_in_motion *= 1e-3;
    dynamic.rotational_drag << 0.5, 0.1, 0.0, 0.1, 1.5, -0.2, 0.0, -0.2, 0.3;
    dynamic.rotational_drag *= 1e-6;
    dynamic.drag_in_spin << 1.0, -0.2, 0.3, -0.2, 2.0, 0.5, 0.3, 0.5, 1.5;
    dynamic.drag_in_spin *= 1e-3;
    dynamic.rotational_drag_in_spin << 0.9, 0.2, -0.1, 0.2, 0.4, 0.1, -0.1, 0.1, 0.6;
    dynamic.rotational_drag_in_spin *= 1e-6;
    dynamic.half_length = 0.04;
    body.dynamic = {.values = dynamic, .standard_errors = {}, .densities = {}};
    return body;
}

ImmersedBody lopsided_body(const Vector3d& offset) {
    return immersed_off_center(lopsided_shape(), offset);
}

Body scaled(Body body, double size) {
    const double volume = size * size * size;
    for (Vector3d& vertex : body.surface.vertices) vertex *= size;
    body.moments.volume *= volume;
    body.moments.centroid *= size;
    body.moments.second_moments *= size * size * volume;
    body.moments.surface_area *= size * size;
    Matrix6d& tensor = body.kirchhoff->matrix;
    tensor.topLeftCorner<3, 3>() *= size * size * volume;
    tensor.topRightCorner<3, 3>() *= size * volume;
    tensor.bottomLeftCorner<3, 3>() *= size * volume;
    tensor.bottomRightCorner<3, 3>() *= volume;
    return body;
}

ImmersedBody ideal_ellipsoid() {
    SceneBody given = scene_body(1200.0);
    given.loads = Loads::none;
    return make_immersed_body(rubber_ellipsoid(), given, Fluid{});
}

ImmersedBody smooth_ellipsoid() {
    SceneBody given = scene_body(0.0);
    given.loads = Loads::coefficients;
    given.coefficients = {.drag_coefficient = 0.8,
                          .lift_coefficient = 0.4,
                          .reference_area = 1e-3,
                          .normal = Vector3d::UnitX(),
                          .center_of_pressure = Vector3d(0.0, 0.003, -0.002)};
    given.mass = {
        .density = {}, .mass = 0.04, .center_of_mass = Vector3d(0.002, 0.001, -0.004), .inertia = {}};
    return make_immersed_body(rubber_ellipsoid(), given, Fluid{});
}

BodyState tumbling_state(double speed, double rate) {
    BodyState state;
    state.orientation = Quaterniond(0.8, 0.3, -0.4, 0.33).normalized();
    state.velocity << rate * Vector3d(0.6, -0.7, 0.4), speed * Vector3d(0.5, -0.3, 0.8);
    return state;
}

}  // namespace samara::test
