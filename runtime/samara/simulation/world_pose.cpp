#include "samara/simulation/world_pose.hpp"

namespace samara {

Pose pose_of(const BodyState& state, const Surroundings& surroundings, double time) {
    return {.position = state.position + flow_displacement(surroundings, time),
            .orientation = state.orientation,
            .velocity = state.orientation * state.velocity.tail<3>() + flow_velocity(surroundings, time),
            .angular_velocity = state.orientation * state.velocity.head<3>()};
}

BodyState state_of(const Pose& pose, const Surroundings& surroundings, double time) {
    BodyState state;
    state.position = pose.position - flow_displacement(surroundings, time);
    state.orientation = pose.orientation;
    const Quaterniond to_body = pose.orientation.conjugate();
    state.velocity << to_body * pose.angular_velocity,
        to_body * (pose.velocity - flow_velocity(surroundings, time));
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
    return state_of(pose, surroundings, scene_body.start);
}

}  // namespace samara
