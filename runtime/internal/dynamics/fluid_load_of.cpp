#include "internal/dynamics/fluid_load_of.hpp"

#include "internal/dynamics/loads.hpp"
#include "internal/dynamics/wind_field.hpp"
#include "internal/kernel/kernel.hpp"

namespace samara {
namespace {

/// The inertia of the fluid alone about the centre of mass: K less the body's own.
Matrix6d added_inertia_of(const ImmersedBody& body) {
    Matrix6d added = body.inertia;
    added.topLeftCorner<3, 3>() -= body.own_inertia;
    added.bottomRightCorner<3, 3>() -= body.mass * Matrix3d::Identity();
    return added;
}

}  // namespace

FluidLoad fluid_load_of(const ImmersedBody& body, const Surroundings& surroundings, double start,
                        double time_step, const BodyState& state, const Noise& noise,
                        std::uint64_t step) noexcept {
    const WindMeeting wind(body, surroundings, start, time_step);
    BodyState stirred = state;
    kernel::SeenStream stream =
        kernel::begin_step(body.constants, time_step, wind.source(), noise, step, stirred).stream;
    if (!stream.moves) stream = {Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero(), false, false};
    const Matrix3d to_world = state.orientation.toRotationMatrix();
    const Matrix3d to_body = to_world.transpose();
    const Vector3d gravity = apparent_gravity(surroundings, step_time(start, time_step, step),
                                              step_time(start, time_step, step + 1));
    // Of the stream that the body is in, in the world.
    const Vector3d acceleration =
        to_body * ((stream.end - stream.begin) / time_step + surroundings.gravity - gravity);

    const Matrix6d added = added_inertia_of(body);
    const Vector3d omega = state.velocity.head<3>();
    Vector6d relative = state.velocity;
    relative.tail<3>() -= to_body * stream.begin;
    const Vector3d moving = relative.tail<3>();
    const Vector6d momentum = added * relative;
    // The fluid's momentum in the turning axes, and the part of the acceleration relative to the stream, in
    // these axes, that is not the body's own.
    Vector6d transport;
    transport << Vector3d::Zero(), omega.cross(moving) + acceleration;
    Vector6d wrench = added * transport;
    wrench.head<3>() += momentum.head<3>().cross(omega) + momentum.tail<3>().cross(moving);
    wrench.tail<3>() += momentum.tail<3>().cross(omega);

    const Vector3d lift = -body.fluid_density * body.volume * (to_body * surroundings.gravity - acceleration);
    wrench.head<3>() += body.center_of_buoyancy.cross(lift);
    wrench.tail<3>() += lift;

    Matrix6d damping = Matrix6d::Zero();
    if (body.loads != Loads::none) {
        const Vector6d of_centroid = body.to_centroid * relative;
        const Vector3d seen_rotation = to_body * stream.rotation;
        const LoadMatrices loads = load_matrices(body, of_centroid, seen_rotation);
        wrench += body.to_centroid.transpose() *
                  (loads.relative.leftCols<3>() * seen_rotation - loads.whole * of_centroid);
        damping = body.to_centroid.transpose() * loads.whole * body.to_centroid;
    }
    // Noise on the velocity itself, where that is the model.
    wrench += body.inertia * (stirred.velocity - state.velocity) / time_step;

    Matrix6d turn = Matrix6d::Zero();
    turn.topLeftCorner<3, 3>() = to_world;
    turn.bottomRightCorner<3, 3>() = to_world;
    return {turn * wrench, turn * added * turn.transpose(), turn * damping * turn.transpose()};
}

}  // namespace samara
