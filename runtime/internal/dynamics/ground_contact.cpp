#include "internal/dynamics/ground_contact.hpp"

#include <algorithm>

#include "internal/dynamics/contact_impulses.hpp"

namespace samara {
namespace {

// Chosen, not derived (docs/theory.md#ground): far below what a picture shows.
constexpr double touching = 1e-5;    // gap that counts as none, over the bounding radius
constexpr double supporting = 1e-4;  // gap of points that hold a body at rest, over the bounding radius
constexpr double hovering = 1e-3;    // more of it, over the way that the load would move the body in a step
constexpr double still = 1e-4;  // speed that counts as none, over what the step would give without the ground

Vector6d relative_to(const Vector3d& ground_velocity, const BodyState& state) {
    Vector6d velocity = state.velocity;
    velocity.tail<3>() -= state.orientation.conjugate() * ground_velocity;
    return velocity;
}

/// How a body stood before a step, over the ground as it is after it.
Stance stance_before(const Ground& ground, const BodyState& before, double time_step) {
    return {.to_world = before.orientation.toRotationMatrix(),
            .height = before.position.z() + ground.travel.z() - ground.height,
            .time_step = time_step};
}

/// Whether a body comes to rest or stays at rest where it stood before a step. `velocity`: before it;
/// `change`: in it, without the ground.
bool rests(const ImmersedBody& body, Stance stance, const Vector6d& velocity,
           const Vector6d& change) noexcept {
    const auto energy = [&](const Vector6d& u) { return 0.5 * u.dot(body.inertia * u); };
    const double radius = body.contact_points.bounding_radius;
    const double load = (body.inertia * change).tail<3>().norm() / stance.time_step;
    if (!(energy(velocity) < resting_energy * load * radius)) return false;
    stance.margin = stance.touching =
        supporting * radius + hovering * stance.time_step * change.tail<3>().norm();
    return energy(after_impulses(body, stance, change)) < still * still * energy(change);
}

/// Takes back what the load moved the body by in a step, as far as the ground was in its way. Else it would
/// turn a little in each step that it lies, and never lie still.
void hold_against_load(const ImmersedBody& body, Stance stance, const Vector6d& velocity,
                       const Vector6d& change, BodyState& state) noexcept {
    stance.touching = touching * body.contact_points.bounding_radius;
    stance.drift = velocity;
    const Vector6d moved = 0.5 * change;
    const Vector6d held = stance.time_step * (after_impulses(body, stance, moved) - moved);
    if (held.isZero(0.0)) return;
    state.position += stance.to_world * held.tail<3>();
    const Vector3d half_turn = 0.5 * held.head<3>();
    state.orientation =
        (state.orientation * Quaterniond(1.0, half_turn.x(), half_turn.y(), half_turn.z())).normalized();
}

}  // namespace

Ground ground_in_flow(const Surroundings& surroundings, double begin, double end) noexcept {
    const Vector3d displacement = flow_displacement(surroundings, end);
    const Vector3d velocity = flow_velocity(surroundings, end);
    return {.height = *surroundings.ground - displacement.z(),
            .velocity = -velocity,
            .travel = flow_displacement(surroundings, begin) - displacement,
            .gain = flow_velocity(surroundings, begin) - velocity};
}

void touch_ground(const ImmersedBody& body, const Ground& ground, double time_step, const BodyState& before,
                  BodyState& state) noexcept {
    state.at_rest = false;
    const double radius = body.contact_points.bounding_radius;
    Vector6d velocity = relative_to(ground.velocity, state);
    // No point moves faster than this, nor twice as fast once impulses have turned the body.
    const double margin = 2.0 * time_step * (velocity.tail<3>().norm() + radius * velocity.head<3>().norm());
    const double height = state.position.z() - ground.height;
    if (!(height - radius <= margin)) return;

    const Vector6d velocity_before = relative_to(ground.velocity - ground.gain, before);
    const Vector6d change = velocity - velocity_before;
    Stance stood = stance_before(ground, before, time_step);
    if (rests(body, stood, velocity_before, change)) {
        state.position = before.position;
        state.orientation = before.orientation;
        stay_on(ground, state);
        return;
    }
    stood.margin = margin;
    hold_against_load(body, stood, velocity_before, change, state);
    velocity = relative_to(ground.velocity, state);
    const Matrix3d to_world = state.orientation.toRotationMatrix();
    const double above = state.position.z() - ground.height;
    const double lift = std::max(0.0, reach(body.contact_points, -to_world.row(2).transpose()) - above);
    state.position.z() += lift;
    const Stance stance{.to_world = to_world,
                        .height = above + lift,
                        .margin = margin,
                        .touching = touching * radius,
                        .time_step = time_step};
    state.velocity += after_impulses(body, stance, velocity) - velocity;
}

void stay_on(const Ground& ground, BodyState& state) noexcept {
    state.position += ground.travel;
    state.velocity << Vector3d::Zero(), state.orientation.conjugate() * ground.velocity;
    state.acceleration.setZero();
    state.at_rest = true;
}

bool is_steady(const ImmersedBody& body, const Surroundings& surroundings) noexcept {
    return surroundings.gust.amplitude.isZero(0.0) &&
           (body.turbulence == Turbulence::none ||
            (body.turbulence == Turbulence::table && surroundings.current.isZero(0.0)));
}

}  // namespace samara
