#include "samara/core/simulation/world_pose.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/collision/obstacle_contact.hpp"
#include "samara/core/dynamics/body_wind.hpp"
#include "samara/core/simulation/simulation.hpp"
#include "samara/core/surface/surface_check.hpp"

namespace samara {
namespace {

std::string copy_in_words(const std::string& name, std::size_t copy, std::size_t copies) {
    return fmt::format("body '{}'{}", name, copies > 1 ? fmt::format(", copy {},", copy) : "");
}

}  // namespace

Pose flow_pose(const BodyState& state) {
    return {.position = state.position,
            .orientation = state.orientation,
            .velocity = state.orientation * state.velocity.tail<3>(),
            .angular_velocity = state.orientation * state.velocity.head<3>()};
}

Pose in_world(const Pose& in_flow, const Surroundings& surroundings, double time) {
    Pose pose = in_flow;
    pose.position += flow_displacement(surroundings, time);
    pose.velocity += flow_velocity(surroundings, time);
    return pose;
}

Pose in_flow(const Pose& in_world, const Surroundings& surroundings, double time) {
    Pose pose = in_world;
    pose.position -= flow_displacement(surroundings, time);
    pose.velocity -= flow_velocity(surroundings, time);
    return pose;
}

Pose in_wind(const Pose& in_flow, const ImmersedBody& body, const Surroundings& surroundings, double time) {
    Pose pose = in_flow;
    pose.velocity -= wind_velocity(body, surroundings, in_flow.position, time);
    return pose;
}

BodyState state_of(const Pose& in_flow) {
    BodyState state;
    state.position = in_flow.position;
    state.orientation = in_flow.orientation;
    const Quaterniond to_body = in_flow.orientation.conjugate();
    state.velocity << to_body * in_flow.angular_velocity, to_body * in_flow.velocity;
    return state;
}

Pose held(const Pose& in_flow, const Surroundings& surroundings, double start) {
    Pose pose = in_world(in_flow, surroundings, start);
    pose.velocity.setZero();
    pose.angular_velocity.setZero();
    return pose;
}

Pose pose_between(const Pose& before, const Pose& after, double begin, double duration, double time) {
    return interpolated(before, after, std::clamp((time - begin) / duration, 0.0, 1.0), duration);
}

Vector3d centroid_velocity(const Pose& in_flow, const ImmersedBody& body) noexcept {
    const Quaterniond to_body = in_flow.orientation.conjugate();
    return to_body * in_flow.velocity + (to_body * in_flow.angular_velocity).cross(body.center_of_buoyancy);
}

CopyStart start_of_copy(const Release& release, double time_step, const Noise& noise) {
    CopyStart start;
    Pose& pose = start.pose;
    pose = {.position = release.position,
            .orientation = release.orientation,
            .velocity = release.velocity,
            .angular_velocity = release.angular_velocity};
    const auto drawn = noise.uniforms(0, NoiseStream::start_size_and_time);
    if (release.count > 1) {
        start.first_step =
            static_cast<std::uint64_t>(std::round(release.spread_start * drawn[1] / time_step));
    }
    if (release.emitter != nullptr) {
        const auto numbers = noise.uniforms(0, NoiseStream::start_emission);
        const Emission left =
            emission(*release.emitter, release.start + static_cast<double>(start.first_step) * time_step,
                     {numbers[0], numbers[1], numbers[2]});
        pose.position = left.place.position;
        pose.orientation = left.place.orientation * pose.orientation;
        pose.velocity += left.velocity;
        pose.angular_velocity += left.angular_velocity;
    }
    if (release.spreads_size()) {
        start.size = release.smallest_size * std::pow(release.largest_size / release.smallest_size, drawn[0]);
    }
    if (release.count == 1) return start;
    const auto place = noise.uniforms(0, NoiseStream::start_position);
    for (int axis = 0; axis < 3; ++axis) {
        pose.position[axis] +=
            (2.0 * place[static_cast<std::size_t>(axis)] - 1.0) * release.spread_position[axis];
    }
    const auto axis = noise.normals(0, NoiseStream::start_angle);
    const double angle = release.spread_angle * place[3];
    const Vector3d about(axis[0], axis[1], axis[2]);
    pose.orientation = Quaterniond(Eigen::AngleAxisd(angle, about.normalized())) * pose.orientation;
    return start;
}

BodyState initial_state(const CopyStart& start, const Vector3d& center_of_mass,
                        const Surroundings& surroundings, double time) {
    Pose pose = start.pose;
    pose.position += pose.orientation * (start.size * center_of_mass);
    return state_of(in_flow(pose, surroundings, time));
}

BodyState initial_state(const Release& release, const Vector3d& center_of_mass,
                        const Surroundings& surroundings, const Noise& noise) {
    constexpr double any_step = 1.0;  // one copy starts with its grid
    return initial_state(start_of_copy(release, any_step, noise), center_of_mass, surroundings,
                         release.start);
}

void require_above_ground(const TouchingBody& body, const std::string& name, const Surroundings& surroundings,
                          double start, const BodyState& state, std::size_t copy, std::size_t copies) {
    if (!surroundings.ground) return;
    const Vector3d down = state.orientation.conjugate() * -Vector3d::UnitZ();
    const double height = state.position.z() + flow_displacement(surroundings, start).z();
    const double depth = *surroundings.ground - height + reach(body.contact_points, down);
    if (depth <= 1e-6 * body.contact_points.bounding_radius) return;
    throw Error(
        fmt::format("{} starts {:.4g} m below the ground at {:g} m; start it higher, or "
                    "lower the ground",
                    copy_in_words(name, copy, copies), depth, *surroundings.ground));
}

void require_outside_obstacles(const TouchingBody& body, const std::string& name,
                               const Surroundings& surroundings, double start, const BodyState& state,
                               std::size_t copy, std::size_t copies) {
    if (surroundings.obstacles == nullptr) return;
    const BodyPlace place{state.position + flow_displacement(surroundings, start), state.orientation};
    const auto overlap = first_overlap(*surroundings.obstacles, body.contact_points, place, start);
    if (!overlap) return;
    throw Error(fmt::format("{} starts inside obstacle '{}', at {}; start it elsewhere, or move the obstacle",
                            copy_in_words(name, copy, copies), overlap->obstacle,
                            samara::place(overlap->position)));
}

Surroundings surroundings_of(const SimulationSettings& settings) {
    const Wind wind = settings.wind.seeded(settings.seed);
    // A wind that is the same everywhere is a current, to the last bit.
    const Vector3d uniform = wind.is_field() ? Vector3d::Zero() : wind.velocity;
    return {
        .gravity = settings.gravity,
        .current = settings.fluid.current + uniform,
        .gust = settings.fluid.gust,
        .ground = settings.ground,
        .obstacles =
            settings.obstacles.empty() ? nullptr : std::make_shared<const ObstacleSet>(settings.obstacles),
        .wind = wind.is_field() ? std::make_shared<const WindField>(wind, settings.fluid.current) : nullptr};
}

}  // namespace samara
