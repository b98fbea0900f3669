#include "samara/core/integrator/step.hpp"

#include "samara/core/contact/ground_contact.hpp"
#include "samara/core/dynamics/body_wind.hpp"
#include "samara/core/dynamics/loads.hpp"
#include "samara/core/kernel/kernel.hpp"

namespace samara {

BodyState implicit_step(const ImmersedBody& body, const Vector3d& gravity, double time_step,
                        const BodyState& state) noexcept {
    return implicit_step(body, gravity, time_step, state, state.sampled_turbulence);
}

BodyState implicit_step(const ImmersedBody& body, const Vector3d& gravity, double time_step,
                        const BodyState& state, const SampledTurbulence& sampled_turbulence) noexcept {
    BodyState result = state;
    result.sampled_turbulence = sampled_turbulence;
    const bool moves = !state.sampled_turbulence.velocity.isZero(0.0) ||
                       !sampled_turbulence.velocity.isZero(0.0) ||
                       !sampled_turbulence.angular_velocity.isZero(0.0);
    kernel::implicit_step(body.constants, gravity, time_step,
                          {state.sampled_turbulence.velocity, sampled_turbulence.velocity,
                           sampled_turbulence.angular_velocity, moves, false},
                          0, 1, nullptr, result);
    return result;
}

StepResult advance(const ImmersedBody& body, const Surroundings& surroundings, double start, double time_step,
                   const BodyState& state, const Noise& noise, std::uint64_t step, const Wrench* external,
                   ContactRecord* sampled) noexcept {
    StepResult result{state, 0};
    const double time = step_time(start, time_step, step);
    const double end = step_time(start, time_step, step + 1);
    const SampledTurbulence& seen = state.sampled_turbulence;
    if (state.at_rest && seen.velocity.isZero(0.0) && seen.angular_velocity.isZero(0.0) &&
        is_steady(body, surroundings)) {
        keep_on_ground(ground_in_flow(surroundings, time, end), result.state);
        return result;
    }
    const BodyWind wind(body, surroundings, start, time_step);
    const Vector3d gravity = apparent_gravity(surroundings, time, end);
    if (!has_ground(surroundings)) {
        const kernel::BlockSteps whole{.gravities = &gravity,
                                       .start = start,
                                       .time_step = time_step,
                                       .first_step = step,
                                       .steps = 1,
                                       .wind = wind.source()};
        result.substeps =
            kernel::advance_one(body.constants, whole, noise, external, result.state).most_substeps;
        result.wind_is_sound = wind.is_sound();
        return result;
    }
    const auto [substeps, stream] =
        kernel::begin_step(body.constants, time_step, wind.source(), noise, step, result.state);
    result.substeps = substeps;
    result.wind_is_sound = wind.is_sound();
    const double substep = time_step / result.substeps;
    BodyState before = state;
    for (int i = 0; i < result.substeps; ++i) {
        kernel::implicit_step(body.constants, gravity, substep, stream, i, result.substeps, external,
                              result.state);
        const double now = time + (i + 1) * substep;
        touch_ground(body, ground_in_flow(surroundings, now - substep, now), substep, before, result.state,
                     sampled);
        before = result.state;
    }
    return result;
}

namespace {

/// Returns the inertia of the fluid alone about the centre of mass: K less the body's own.
Matrix6d added_inertia_of(const ImmersedBody& body) {
    Matrix6d added = body.inertia;
    added.topLeftCorner<3, 3>() -= body.own_inertia;
    added.bottomRightCorner<3, 3>() -= body.mass * Matrix3d::Identity();
    return added;
}

/// The wind of the world in the lengths and times of a body of another size (body_size.hpp).
struct SizedWind {
    kernel::WindSource of_world;
    double size = 1.0;

    [[nodiscard]] kernel::WindSource source() const noexcept {
        if (of_world.sample == nullptr || size == 1.0) return of_world;
        return {sample, this};
    }

    static void sample(const void* context, std::uint64_t step, std::size_t count,
                       kernel::SampledWind& sampled) noexcept {
        const auto& self = *static_cast<const SizedWind*>(context);
        const auto scale = [count](auto& rows, double factor) {
            for (auto& row : rows) {
                for (std::size_t lane = 0; lane < count; ++lane) row[lane] *= factor;
            }
        };
        scale(sampled.place, self.size);
        self.of_world.sample(self.of_world.context, step, count, sampled);
        scale(sampled.begin, self.size);
        scale(sampled.end, self.size);
        scale(sampled.rotation, self.size * self.size);
    }
};

/// Returns begin_step() of a body of that size, whose constant turbulence is the world's.
kernel::SampledStream sampled_stream(const ImmersedBody& body, double size, double own_step,
                                     const kernel::WindSource& wind, const Noise& noise, std::uint64_t step,
                                     BodyState& state) {
    if (size == 1.0 || body.turbulence != Turbulence::constant) {
        return kernel::begin_step(body.constants, own_step, wind, noise, step, state).stream;
    }
    StepConstants constants = body.constants;
    constants.turbulent_kinetic_energy *= size * size;
    constants.dissipation_rate *= size * size * size * size;
    return kernel::begin_step(constants, own_step, wind, noise, step, state).stream;
}

/// Returns a matrix over (omega, v) in the lengths and times of the world; `linear`: the factor of its last
/// block.
Matrix6d in_world_units(const Matrix6d& matrix, double size, double linear) {
    Matrix6d result = linear * matrix;
    result.topRows<3>() *= size;
    result.leftCols<3>() *= size;
    return result;
}

}  // namespace

FluidLoad fluid_load_of(const ImmersedBody& body, double size, const Surroundings& surroundings, double start,
                        double time_step, const BodyState& state, const Noise& noise, std::uint64_t step) {
    const double size_square = size * size;
    const double own_step = time_step / size_square;
    const BodyWind body_wind(body, surroundings, start, time_step);
    const SizedWind wind{body_wind.source(), size};
    BodyState next = state;
    kernel::SampledStream stream = sampled_stream(body, size, own_step, wind.source(), noise, step, next);
    if (!stream.moves) stream = {Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};
    const Matrix3d to_world = state.orientation.toRotationMatrix();
    const Matrix3d to_body = to_world.transpose();
    const Vector3d gravity = size * size_square * surroundings.gravity;
    const Vector3d in_the_flow = size * size_square *
                                 apparent_gravity(surroundings, step_time(start, time_step, step),
                                                  step_time(start, time_step, step + 1));
    // The acceleration of the stream that the body is in, in the world.
    const Vector3d acceleration = to_body * ((stream.end - stream.begin) / own_step + gravity - in_the_flow);

    const Matrix6d added = added_inertia_of(body);
    const Vector3d omega = state.velocity.head<3>();
    Vector6d relative = state.velocity;
    relative.tail<3>() -= to_body * stream.begin;
    const Vector3d moving = relative.tail<3>();
    const Vector6d momentum = added * relative;
    // The fluid's momentum in the rotating axes, and the part of the acceleration relative to the stream, in
    // these axes, that is not the body's own.
    Vector6d transport;
    transport << Vector3d::Zero(), omega.cross(moving) + acceleration;
    Vector6d wrench = added * transport;
    wrench.head<3>() += momentum.head<3>().cross(omega) + momentum.tail<3>().cross(moving);
    wrench.tail<3>() += momentum.tail<3>().cross(omega);

    const Vector3d lift = -body.fluid_density * body.volume * (to_body * gravity - acceleration);
    wrench.head<3>() += body.center_of_buoyancy.cross(lift);
    wrench.tail<3>() += lift;

    Matrix6d damping = Matrix6d::Zero();
    if (body.loads != Loads::none) {
        const Vector6d of_centroid = body.to_centroid * relative;
        const Vector3d sampled_rotation = to_body * stream.rotation;
        const LoadMatrices loads = load_matrices(body, of_centroid, sampled_rotation,
                                                 to_body * stream.wake_fluctuation, shares_of(state.wake));
        wrench += body.to_centroid.transpose() *
                  (loads.relative.leftCols<3>() * sampled_rotation - loads.whole * of_centroid);
        damping = body.to_centroid.transpose() * loads.whole * body.to_centroid;
    }
    // Noise on the velocity itself, where that is the model.
    wrench += body.inertia * (next.velocity - state.velocity) / own_step;

    Matrix6d rotation = Matrix6d::Zero();
    rotation.topLeftCorner<3, 3>() = to_world;
    rotation.bottomRightCorner<3, 3>() = to_world;
    wrench.head<3>() *= size;
    return {rotation * wrench,
            rotation * in_world_units(added, size, size * size_square) * rotation.transpose(),
            rotation * in_world_units(damping, size, size) * rotation.transpose()};
}

}  // namespace samara
