#include "samara/core/integrator/step.hpp"

#include "samara/core/contact/ground_contact.hpp"
#include "samara/core/dynamics/body_size.hpp"
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
    const bool is_still = seen.velocity.isZero(0.0) && seen.angular_velocity.isZero(0.0);
    if (state.at_rest && judgement_of_rest(body, surroundings, time_step).skips(step, is_still)) {
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

/// The parts of the fluid's load on a body in body axes about the centre of mass, in its own units.
struct LoadParts {
    Vector6d transport;  ///< of the fluid's momentum, but for the body's own acceleration
    Vector6d buoyancy;
    Vector6d loads = Vector6d::Zero();
    Matrix6d damping = Matrix6d::Zero();
    Vector3d relative_velocity;  ///< of the centroid
};

/// Where and when a body is, for the parts of its load.
struct LoadPlace {
    const ImmersedBody& body;
    const BodyState& state;
    Matrix3d to_body;
    Vector3d gravity;      ///< world axes, own units
    Vector3d in_the_flow;  ///< apparent_gravity(), likewise
    double own_step;
};

LoadParts load_parts(const LoadPlace& at, const kernel::SampledStream& stream) {
    const ImmersedBody& body = at.body;
    LoadParts parts;
    // The acceleration of the stream that the body is in, in the world.
    const Vector3d acceleration =
        at.to_body * ((stream.end - stream.begin) / at.own_step + at.gravity - at.in_the_flow);
    const Matrix6d added = body.inertia - own_inertia(body);
    const Vector3d omega = at.state.velocity.head<3>();
    Vector6d relative = at.state.velocity;
    relative.tail<3>() -= at.to_body * stream.begin;
    const Vector3d moving = relative.tail<3>();
    const Vector6d momentum = added * relative;
    // The fluid's momentum in the rotating axes, and the part of the acceleration relative to the stream, in
    // these axes, that is not the body's own.
    Vector6d transport;
    transport << Vector3d::Zero(), omega.cross(moving) + acceleration;
    parts.transport = added * transport;
    parts.transport.head<3>() += momentum.head<3>().cross(omega) + momentum.tail<3>().cross(moving);
    parts.transport.tail<3>() += momentum.tail<3>().cross(omega);

    const Vector3d upward = -body.fluid_density * body.volume * (at.to_body * at.gravity - acceleration);
    parts.buoyancy << body.center_of_buoyancy.cross(upward), upward;

    const Vector6d of_centroid = body.to_centroid * relative;
    parts.relative_velocity = of_centroid.tail<3>();
    if (body.loads == Loads::none) return parts;
    const Vector3d sampled_rotation = at.to_body * stream.rotation;
    const LoadMatrices loads = load_matrices(body, of_centroid, sampled_rotation,
                                             at.to_body * stream.wake_fluctuation, shares_of(at.state.wake));
    parts.loads = body.to_centroid.transpose() *
                  (loads.relative.leftCols<3>() * sampled_rotation - loads.whole * of_centroid);
    parts.damping = body.to_centroid.transpose() * loads.whole * body.to_centroid;
    return parts;
}

/// A body in its next step: its place, the stream that it is in, and the stream without the turbulence.
struct NextStep {
    LoadPlace at;
    kernel::SampledStream stream;
    kernel::SampledStream calm;
    Vector6d noise;  ///< the wrench of a noise on the velocity itself, where that is the model
};

NextStep next_step(const ImmersedBody& body, double size, const Surroundings& surroundings, double start,
                   double time_step, const BodyState& state, const Noise& noise, std::uint64_t step) {
    const double size_square = size * size;
    const double own_step = time_step / size_square;
    const BodyWind body_wind(body, surroundings, start, time_step);
    const SizedWind wind{body_wind.source(), size};
    BodyState next = state;
    kernel::SampledStream stream = sampled_stream(body, size, own_step, wind.source(), noise, step, next);
    if (!stream.moves) stream = {Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};
    kernel::SampledStream calm = stream;
    if (body.constants.langevin == Langevin::wake) {
        calm.begin -= stream.wake_fluctuation;
        calm.end -= stream.wake_fluctuation;
    } else if (body.constants.langevin == Langevin::sampled_turbulence && stream.moves) {
        calm.begin -= state.sampled_turbulence.velocity;
        calm.end -= next.sampled_turbulence.velocity;
    }
    calm.rotation -= stream.moves ? next.sampled_turbulence.angular_velocity : Vector3d::Zero();
    calm.wake_fluctuation.setZero();
    return {{body, state, state.orientation.toRotationMatrix().transpose(),
             size * size_square * surroundings.gravity,
             size * size_square *
                 apparent_gravity(surroundings, step_time(start, time_step, step),
                                  step_time(start, time_step, step + 1)),
             own_step},
            stream,
            calm,
            inertia_of_size(body, size) * (next.velocity - state.velocity) / own_step};
}

}  // namespace

FluidLoad fluid_load_of(const ImmersedBody& body, double size, const Surroundings& surroundings, double start,
                        double time_step, const BodyState& state, const Noise& noise, std::uint64_t step) {
    const NextStep next = next_step(body, size, surroundings, start, time_step, state, noise, step);
    const LoadParts parts = load_parts(next.at, next.stream);
    Vector6d wrench = parts.transport + parts.buoyancy + parts.loads + next.noise;
    const Matrix3d to_world = next.at.to_body.transpose();
    Matrix6d rotation = Matrix6d::Zero();
    rotation.topLeftCorner<3, 3>() = to_world;
    rotation.bottomRightCorner<3, 3>() = to_world;
    wrench.head<3>() *= size;
    const Matrix6d added = body.inertia - own_inertia(body);
    return {rotation * wrench,
            rotation * in_world_units(added, size, size * size * size) * rotation.transpose(),
            rotation * in_world_units(parts.damping, size, size) * rotation.transpose()};
}

FluidForces fluid_forces_of(const ImmersedBody& body, double size, const Surroundings& surroundings,
                            double start, double time_step, const BodyState& state, const Noise& noise,
                            std::uint64_t step) {
    const NextStep next = next_step(body, size, surroundings, start, time_step, state, noise, step);
    const LoadParts parts = load_parts(next.at, next.calm);
    const LoadParts whole = load_parts(next.at, next.stream);
    Vector6d acceleration = state.acceleration;  // of the world, in body axes
    acceleration.tail<3>() += state.velocity.head<3>().cross(state.velocity.tail<3>());
    const Matrix6d added = body.inertia - own_inertia(body);
    Vector6d drag = Vector6d::Zero();
    if (!parts.relative_velocity.isZero(0.0)) {
        const Vector3d path = parts.relative_velocity.normalized();
        drag.tail<3>() = path * path.dot(parts.loads.tail<3>());
    }
    const Matrix3d to_world = next.at.to_body.transpose();
    const auto in_world = [&](const Vector6d& wrench) {
        return Wrench{to_world * wrench.tail<3>(), size * (to_world * wrench.head<3>())};
    };
    return {in_world(parts.buoyancy), in_world(parts.transport - added * acceleration), in_world(drag),
            in_world(parts.loads - drag),
            in_world(whole.transport - parts.transport + whole.buoyancy - parts.buoyancy + whole.loads -
                     parts.loads + next.noise)};
}

}  // namespace samara
