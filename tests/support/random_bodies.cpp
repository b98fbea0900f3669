#include "support/random_bodies.hpp"

#include <cmath>

#include "samara/core/surface/octahedral_map.hpp"
#include "support/hard_bodies.hpp"
#include "support/known_bodies.hpp"
#include "support/test_shapes.hpp"

namespace samara::test {

double RandomBodies::uniform(double lowest, double highest) {
    return std::uniform_real_distribution<double>(lowest, highest)(generator_);
}

double RandomBodies::magnitude(double lowest, double highest) {
    return std::exp(uniform(std::log(lowest), std::log(highest)));
}

Vector3d RandomBodies::vector() {
    const double x = uniform(-1.0, 1.0);
    const double y = uniform(-1.0, 1.0);
    return {x, y, uniform(-1.0, 1.0)};
}

template <int Size>
Eigen::Matrix<double, Size, Size> RandomBodies::positive_definite() {
    Eigen::Matrix<double, Size, Size> factor;
    for (double& entry : factor.reshaped()) entry = uniform(-1.0, 1.0);
    return factor * factor.transpose() + 1e-4 * Eigen::Matrix<double, Size, Size>::Identity();
}

Matrix3d RandomBodies::semidefinite(double scale) {
    switch (std::uniform_int_distribution<int>(0, 3)(generator_)) {
        case 0:
            return Matrix3d::Zero();
        case 1: {
            const Vector3d axis = vector();
            return scale * axis * axis.transpose();
        }
        default:
            return scale * positive_definite<3>();
    }
}

Matrix3d RandomBodies::symmetric(double scale) {
    if (uniform(0.0, 1.0) < 0.25) return Matrix3d::Zero();
    Matrix3d factor;
    for (double& entry : factor.reshaped()) entry = uniform(-1.0, 1.0);
    return scale * (factor + factor.transpose());
}

DynamicCoefficients RandomBodies::coefficients(double size) {
    const double area = size * size;
    DynamicCoefficients result;
    result.transport = symmetric(area * size * magnitude(0.01, 100.0));
    result.rotational_transport = uniform(-2.0, 2.0);
    result.drag_in_motion = semidefinite(area * magnitude(0.01, 100.0));
    result.rotational_drag = semidefinite(area * area * magnitude(0.01, 100.0));
    result.unsteady_factor = magnitude(0.3, 3.0);
    result.settling_length = 0.8 + 20.0 * result.unsteady_factor;
    result.drag_in_spin = semidefinite(area * magnitude(0.01, 100.0));
    result.rotational_drag_in_spin = semidefinite(area * area * magnitude(0.01, 100.0));
    result.half_length = size * magnitude(0.1, 10.0);
    result.laminar_rotational_drag = magnitude(0.01, 10.0);
    result.spin_lift_onset = magnitude(0.01, 10.0);
    return result;
}

LoadTables RandomBodies::tables(double length) {
    LoadTables result;
    result.reference_length = length;
    result.subdivisions = std::uniform_int_distribution<int>(1, 6)(generator_);
    result.axes = Quaterniond::FromTwoVectors(Vector3d::UnitX(), vector()).toRotationMatrix();
    const double first = magnitude(1.0, 1e4);
    result.reynolds_numbers = {first, first * magnitude(1.5, 1e3)};
    const bool jumps = uniform(0.0, 1.0) < 0.5;
    for (std::size_t i = 0; i < result.reynolds_numbers.size(); ++i) {
        for (const Vector3d& d : octahedral_nodes(result.subdivisions)) {
            LoadEntry entry;
            const double drag = jumps ? magnitude(0.01, 100.0) : 1.0 + 0.5 * d.x() * d.x();
            entry.force = -drag * (result.axes * d) + (jumps ? 10.0 : 0.3) * vector();
            entry.moment = (jumps ? 10.0 : 0.3) * vector();
            entry.turbulent_kinetic_energy = magnitude(1e-4, 1.0);
            entry.dissipation_rate = magnitude(1e-4, 1.0);
            result.entries.push_back(entry);
        }
    }
    result.errors.resize(result.entries.size());
    result.quality = "invented";
    return result;
}

ImmersedBody RandomBodies::body() {
    const double size = magnitude(1e-4, 1.0);
    static const Body shape = [] {
        Body sphere = exact_sphere(1.0);
        sphere.surface = icosphere(1);
        sphere.moments = moments_of(sphere.surface);
        return sphere;
    }();
    Body body = shape;
    for (Vector3d& vertex : body.surface.vertices) vertex *= size;
    body.moments = moments_of(body.surface);
    Vector6d lengths;
    lengths << Vector3d::Constant(size), Vector3d::Ones();
    body.kirchhoff->matrix = body.moments.volume * magnitude(1e-2, 1e2) *
                             (lengths.asDiagonal() * positive_definite<6>() * lengths.asDiagonal());
    body.tables = tables(reference_length(body.moments.surface_area));

    SceneBody given = scene_body(0.0);
    const double mass = water().density * magnitude(1e-3, 1e9) * body.moments.volume;
    // Of three masses on the axes: what principal moments a body can have.
    const Vector3d squares = vector().cwiseAbs2() + Vector3d::Constant(1e-3);
    const Matrix3d turned = Quaterniond::FromTwoVectors(Vector3d::UnitX(), vector()).toRotationMatrix();
    const Vector3d principal(squares.y() + squares.z(), squares.z() + squares.x(), squares.x() + squares.y());
    const Matrix3d inertia = mass * size * size * turned * principal.asDiagonal() * turned.transpose();
    given.mass = {.density = {},
                  .mass = mass,
                  .center_of_mass = Vector3d(magnitude(1e-3, 2.0) * size * vector()),
                  .inertia = Matrix3d(0.5 * (inertia + inertia.transpose()))};
    const double group = uniform(0.0, 1.0);
    if (group < 0.1) given.loads = Loads::none;
    if (group > 0.8) {
        given.loads = Loads::coefficients;
        given.coefficients = {.drag_coefficient = magnitude(0.01, 100.0),
                              .lift_coefficient = uniform(-10.0, 10.0),
                              .reference_area = size * size * magnitude(0.01, 10.0),
                              .normal = Vector3d(vector().normalized()),
                              .center_of_pressure = size * vector()};
    }
    ImmersedBody result = make_immersed_body(body, given, water());
    result.dynamic = coefficients(size);
    prepare(result);
    return result;
}

BodyState RandomBodies::state() {
    BodyState result;
    result.position = vector();
    result.orientation = Quaterniond::FromTwoVectors(vector(), vector());
    const double turning = magnitude(1e-4, 1e3);
    const double speed = magnitude(1e-4, 1e3);
    result.velocity << turning * vector(), speed * vector();
    std::uniform_real_distribution<double> component(-1.0, 1.0);
    result.wake.heading = Vector3d(component(wakes_), component(wakes_), component(wakes_)) / std::sqrt(3.0);
    result.wake.formed = std::abs(component(wakes_));
    return result;
}

}  // namespace samara::test
