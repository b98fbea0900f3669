#include "samara/dynamics/step.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "samara/dynamics/ground_contact.hpp"
#include "samara/dynamics/loads.hpp"

namespace samara {
namespace {

constexpr double largest_turn = 0.3;  // rad in one implicit step
constexpr int passes = 3;  // the first predicts the middle of the step, the others are second order around it

/// G(mu) with mu' = G(mu) u + F: antisymmetric, so that it does no work.
Matrix6d momentum_transport(const Vector6d& momentum) {
    Matrix6d matrix = Matrix6d::Zero();
    matrix.topLeftCorner<3, 3>() = skew(momentum.head<3>());
    matrix.topRightCorner<3, 3>() = skew(momentum.tail<3>());
    matrix.bottomLeftCorner<3, 3>() = matrix.topRightCorner<3, 3>();
    return matrix;
}

/// (I + w^)^-1 for a vector w.
Matrix3d inverse_of_identity_plus_skew(const Vector3d& w) {
    return (Matrix3d::Identity() - skew(w) + w * w.transpose()) / (1.0 + w.squaredNorm());
}

/// Weight less buoyancy, and the moment of the buoyancy about the centre of mass: eq. 3, and eq. 4 with its
/// sign put right.
Vector6d gravity_load(const ImmersedBody& body, const Vector3d& gravity_in_body) {
    const double displaced = body.fluid_density * body.volume;
    Vector6d load;
    load << -displaced * body.center_of_buoyancy.cross(gravity_in_body),
        (body.mass - displaced) * gravity_in_body;
    return load;
}

/// The rotation by h omega of Cayley's map: the unit quaternion along (1, h omega / 2).
Quaterniond cayley(const Vector3d& turn) {
    return Quaterniond(1.0, 0.5 * turn.x(), 0.5 * turn.y(), 0.5 * turn.z()).normalized();
}

/// The rate (1/s) at which the body turns, or would turn by its Munk moment.
double turning_rate(const ImmersedBody& body, const Vector6d& velocity) {
    return velocity.head<3>().norm() + velocity.tail<3>().norm() * body.turning_scale;
}

}  // namespace

BodyState implicit_step(const ImmersedBody& body, const Vector3d& gravity, double time_step,
                        const BodyState& state) noexcept {
    const double h = time_step;
    const Matrix3d to_world = state.orientation.toRotationMatrix();
    const Vector3d gravity_in_body = to_world.transpose() * gravity;
    const Vector6d momentum = body.inertia * state.velocity;

    Vector6d middle = state.velocity;
    Vector3d middle_turning = state.velocity.head<3>();
    double theta = 0.5;
    for (int pass = 0; pass < passes; ++pass) {
        middle_turning = middle.head<3>();
        const Vector3d half_turn = 0.5 * h * middle_turning;
        // The seen fluid is fixed in the world while the body turns under it by half the step.
        const Matrix3d to_middle = inverse_of_identity_plus_skew(half_turn);
        Vector6d fluid;
        fluid << to_middle * (to_world.transpose() * state.seen_fluid.angular_velocity),
            to_middle * (to_world.transpose() * state.seen_fluid.velocity);
        const Matrix6d loads_at_centroid = load_matrix(body, body.to_centroid * middle - fluid);
        const Matrix6d loads_from_centroid = body.to_centroid.transpose() * loads_at_centroid;
        const Matrix6d loads = loads_from_centroid * body.to_centroid;
        const double stiffness = h * (loads.diagonal().array() / body.inertia.diagonal().array()).maxCoeff();
        theta = (3.0 + stiffness) / (6.0 + stiffness);
        const Matrix6d system =
            body.inertia + theta * h * (loads - momentum_transport(body.inertia * middle));
        const Vector6d right_side =
            momentum +
            theta * h * (gravity_load(body, to_middle * gravity_in_body) + loads_from_centroid * fluid);
        middle = system.partialPivLu().solve(right_side);
    }

    BodyState result = state;
    result.velocity = state.velocity + (middle - state.velocity) / theta;
    // The same turn that carried gravity: what gravity works is then what the height gives.
    result.position +=
        h * (to_world * (inverse_of_identity_plus_skew(-0.5 * h * middle_turning) * middle.tail<3>()));
    result.orientation = (state.orientation * cayley(h * middle_turning)).normalized();
    return result;
}

StepResult advance(const ImmersedBody& body, const Surroundings& surroundings, double time, double time_step,
                   const BodyState& state, const Noise& noise, std::uint64_t step) noexcept {
    StepResult result{state, 1};
    const TurbulenceLevel level = turbulence_level(body, (body.to_centroid * state.velocity).tail<3>());
    if (body.langevin == Langevin::seen_fluid) {
        result.state.seen_fluid = advance_seen_fluid(body, level, state.seen_fluid, time_step, noise, step);
    } else {
        result.state.velocity = advance_body_velocity(body, level, state.velocity, time_step, noise, step);
    }
    const double turns = time_step * turning_rate(body, result.state.velocity) / largest_turn;
    result.substeps = static_cast<int>(std::ceil(std::clamp(turns, 1.0, static_cast<double>(most_substeps))));
    const double h = time_step / result.substeps;
    for (int i = 0; i < result.substeps; ++i) {
        const double begin = time + i * h;
        const Vector3d gravity = apparent_gravity(surroundings, begin, begin + h);
        const BodyState before = i == 0 ? state : result.state;
        result.state = implicit_step(body, gravity, h, result.state);
        if (surroundings.ground) {
            touch_ground(body, ground_in_flow(surroundings, begin, begin + h), h, before, result.state);
        }
    }
    return result;
}

double kinetic_energy(const ImmersedBody& body, const BodyState& state) noexcept {
    return 0.5 * state.velocity.dot(body.inertia * state.velocity);
}

}  // namespace samara
