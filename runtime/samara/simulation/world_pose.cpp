#include "samara/simulation/world_pose.hpp"

#include <fmt/format.h>

#include "samara/base/error.hpp"

namespace samara {

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

BodyState state_of(const Pose& in_flow) {
    BodyState state;
    state.position = in_flow.position;
    state.orientation = in_flow.orientation;
    const Quaterniond to_body = in_flow.orientation.conjugate();
    state.velocity << to_body * in_flow.angular_velocity, to_body * in_flow.velocity;
    return state;
}

BodyState initial_state(const SceneBody& scene_body, const Vector3d& center_of_mass,
                        const Surroundings& surroundings, const Noise& noise) {
    Pose pose{.position = scene_body.position,
              .orientation = scene_body.orientation,
              .velocity = scene_body.velocity,
              .angular_velocity = scene_body.angular_velocity};
    if (scene_body.count > 1) {
        const auto place = noise.uniforms(0, NoiseStream::start_position);
        for (int axis = 0; axis < 3; ++axis) {
            pose.position[axis] +=
                (2.0 * place[static_cast<std::size_t>(axis)] - 1.0) * scene_body.spread_position[axis];
        }
        const auto axis = noise.normals(0, NoiseStream::start_angle);
        const double angle = scene_body.spread_angle * place[3];
        const Vector3d about(axis[0], axis[1], axis[2]);
        pose.orientation = Quaterniond(Eigen::AngleAxisd(angle, about.normalized())) * pose.orientation;
    }
    pose.position += pose.orientation * center_of_mass;
    return state_of(in_flow(pose, surroundings, scene_body.start));
}

void require_above_ground(const ImmersedBody& body, const std::string& name, const Surroundings& surroundings,
                          double start, const BodyState& state, std::size_t copy, std::size_t copies) {
    if (!surroundings.ground) return;
    const Vector3d down = state.orientation.conjugate() * -Vector3d::UnitZ();
    const double height = state.position.z() + flow_displacement(surroundings, start).z();
    const double depth = *surroundings.ground - height + reach(body.contact_points, down);
    if (depth <= 1e-6 * body.contact_points.bounding_radius) return;
    throw Error(
        fmt::format("body '{}'{} starts {:.4g} m below the ground at {:g} m; start it higher, or "
                    "lower the ground",
                    name, copies > 1 ? fmt::format(", copy {},", copy) : "", depth, *surroundings.ground));
}

}  // namespace samara
