#include "samara/core/contact/ground_contact.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace samara {
namespace {

// Chosen, not derived (docs/explanation/integrator.md#ground): far below what a picture shows.
constexpr double touching = 1e-5;  // gap that counts as none, relative to the bounding radius
// gap of points that hold a body at rest, relative to the bounding radius
constexpr double supporting = 1e-4;
constexpr double hovering = 1e-3;  // additional gap, relative to the displacement by the load in a step
// speed that counts as none, relative to the change in a step without the ground
constexpr double still = 1e-4;
// s: half a frame of film. A gust that could lift a body at rest does so up to this later.
constexpr double judged_after = 0.02;

Vector6d relative_to(const Vector3d& ground_velocity, const BodyState& state) {
    Vector6d velocity = state.velocity;
    velocity.tail<3>() -= state.orientation.conjugate() * ground_velocity;
    return velocity;
}

/// Returns whether a body comes to rest, or stays at rest, where it stood before a step. `velocity`: before
/// it; `change`: in it, without contacts.
bool rests(const TouchingBody& body, const ContactSet& stood, double time_step, const Vector6d& velocity,
           const Vector6d& change) noexcept {
    const auto energy = [&](const Vector6d& u) { return 0.5 * u.dot(body.inertia * u); };
    const double radius = body.contact_points.bounding_radius;
    const double load = (body.inertia * change).tail<3>().norm() / time_step;
    if (!(energy(velocity) < resting_energy * load * radius)) return false;
    const double near = supporting * radius + hovering * time_step * change.tail<3>().norm();
    const bool is_moved = std::any_of(stood.begin(), stood.end(), [&](const NearPoint& point) {
        if (point.on_ground() && point.gap < -near) return true;  // the ground was raised over it
        return point.gap <= near &&
               !(point.surface_velocity.isZero(0.0) && point.surface_angular_velocity.isZero(0.0));
    });
    if (is_moved) return false;
    const Approach approach{.margin = near, .touching = near, .time_step = time_step};
    return energy(after_impulses(body, stood, approach, change)) < still * still * energy(change);
}

/// Removes the displacement that the load caused in a step as far as contacts opposed it. Otherwise a lying
/// body would rotate a little in each step, and never come to rest. `found` receives the impulses that would
/// oppose all of the load.
void hold_against_load(const TouchingBody& body, const ContactSet& stood, const Approach& approach,
                       const Vector6d& change, FoundImpulses& found, BodyState& state) noexcept {
    const Vector6d moved = 0.5 * change;
    const Vector6d held = approach.time_step * (after_impulses(body, stood, approach, moved, &found) - moved);
    found.scale(2.0);  // moved by half of the change
    if (held.isZero(0.0)) return;
    state.position += stood.to_world() * held.tail<3>();
    const Vector3d half_rotation = 0.5 * held.head<3>();
    state.orientation =
        (state.orientation * Quaterniond(1.0, half_rotation.x(), half_rotation.y(), half_rotation.z()))
            .normalized();
}

/// Keeps a body out of the obstacles on its path since before the step.
void keep_out_of_obstacles(const TouchingBody& body, const Ground& ground, double time_step,
                           const BodyState& before, BodyState& state) noexcept {
    const BodyPlace reached = ground.in_world(state);
    BodyPlace mended = reached;
    keep_out(*ground.obstacles, body.contact_points, ground.time - time_step, ground.time,
             ground.in_world_before(before), mended);
    if (mended.position != reached.position) state.position = mended.position + ground.origin;
    state.orientation = mended.orientation;
}

/// Returns a record of body axes in the world's axes.
ContactRecord in_world(const ContactRecord& of_body, const Matrix3d& to_world, const Ground& ground,
                       const BodyState& state) noexcept {
    ContactRecord record = of_body;
    record.impulse = to_world * of_body.impulse;
    record.point = ground.in_world(state).position + to_world * of_body.point;
    record.normal = to_world * of_body.normal;
    record.time = ground.time;
    return record;
}

}  // namespace

Ground ground_in_flow(const Surroundings& surroundings, double begin, double end) noexcept {
    const Vector3d displacement = flow_displacement(surroundings, end);
    const Vector3d velocity = flow_velocity(surroundings, end);
    constexpr double none = -std::numeric_limits<double>::infinity();
    return {.height = surroundings.ground ? *surroundings.ground - displacement.z() : none,
            .velocity = -velocity,
            .travel = flow_displacement(surroundings, begin) - displacement,
            .gain = flow_velocity(surroundings, begin) - velocity,
            .obstacles = surroundings.obstacles.get(),
            .origin = -displacement,
            .time = end};
}

bool has_ground(const Surroundings& surroundings) noexcept {
    return surroundings.ground || surroundings.obstacles != nullptr;
}

void touch_ground(const TouchingBody& body, const Ground& ground, double time_step, const BodyState& before,
                  BodyState& state, ContactRecord* record) noexcept {
    state.at_rest = false;
    const double radius = body.contact_points.bounding_radius;
    Vector6d velocity = relative_to(ground.velocity, state);
    // A bound of the points' motion: impulses may rotate the body to twice its speed.
    const double margin = 2.0 * time_step * (velocity.tail<3>().norm() + radius * velocity.head<3>().norm());
    const bool is_over_ground = state.position.z() - ground.height - radius <= margin;
    const Vector6d velocity_before = relative_to(ground.velocity - ground.gain, before);
    const Vector6d change = velocity - velocity_before;
    // From a standstill the load alone may bring it against a thin sheet.
    const double reached = margin + time_step * change.tail<3>().norm();
    const ContactPoints& points = body.contact_points;
    const bool is_at_obstacle =
        ground.obstacles != nullptr && passes_near(*ground.obstacles, points, ground.in_world_before(before),
                                                   ground.in_world(state), reached);
    if (!is_over_ground && !is_at_obstacle) return;

    ContactSet stood(before.orientation.toRotationMatrix());
    if (is_over_ground) {
        stood.add_ground(points, before.position.z() + ground.travel.z() - ground.height, margin);
    }
    if (is_at_obstacle) {
        add_obstacles(*ground.obstacles, points, ground.in_world_before(before), velocity_before,
                      ground.time - time_step, time_step, reached, stood);
    }
    if (rests(body, stood, time_step, velocity_before, change)) {
        state.position = before.position;
        state.orientation = before.orientation;
        keep_on_ground(ground, state);
        return;
    }
    const Approach approach{
        .margin = reached, .touching = touching * radius, .time_step = time_step, .drift = velocity_before};
    FoundImpulses found;
    hold_against_load(body, stood, approach, change, found, state);
    if (is_at_obstacle) keep_out_of_obstacles(body, ground, time_step, before, state);
    velocity = relative_to(ground.velocity, state);
    const Matrix3d to_world = state.orientation.toRotationMatrix();
    const double above = state.position.z() - ground.height;
    const double lift = std::max(0.0, reach(points, -to_world.row(2).transpose()) - above);
    state.position.z() += lift;
    ContactSet near(to_world);
    if (is_over_ground) near.add_ground(points, above + lift, margin);
    if (is_at_obstacle) {
        add_obstacles(*ground.obstacles, points, ground.in_world(state), velocity, ground.time, time_step,
                      reached, near);
    }
    const Approach next{.margin = reached, .touching = touching * radius, .time_step = time_step};
    ContactRecord now;
    state.velocity +=
        after_impulses(body, near, next, velocity, &found, record == nullptr ? nullptr : &now) - velocity;
    if (record != nullptr && now.strongest > 0.0) record->add(in_world(now, to_world, ground, state));
}

void keep_on_ground(const Ground& ground, BodyState& state) noexcept {
    state.position += ground.travel;
    state.velocity << Vector3d::Zero(), state.orientation.conjugate() * ground.velocity;
    state.acceleration.setZero();
    state.at_rest = true;
}

kernel::RestJudgement judgement_of_rest(const ImmersedBody& body, const Surroundings& surroundings,
                                        double time_step) noexcept {
    const bool is_carried = surroundings.obstacles != nullptr && surroundings.obstacles->moves();
    if (is_carried || body.turbulence == Turbulence::constant) return {1};
    const bool meets_stream = surroundings.wind != nullptr || !surroundings.gust.amplitude.isZero(0.0) ||
                              (body.turbulence == Turbulence::table && !surroundings.current.isZero(0.0));
    if (!meets_stream) return {};
    return {static_cast<std::uint64_t>(std::max(1.0, std::round(judged_after / time_step)))};
}

}  // namespace samara
