#include "samara/analysis/metrics/flow_visits.hpp"

#include "samara/core/dynamics/body_size.hpp"
#include "samara/core/dynamics/loads.hpp"
#include "samara/core/simulation/world_pose.hpp"

namespace samara {

std::optional<FlowVisit> flow_visit(const Pose& pose, double time, const ImmersedBody& immersed,
                                    const Surroundings& surroundings, double size) {
    const Pose sampled =
        in_own_units(in_wind(in_flow(pose, surroundings, time), immersed, surroundings, time), size);
    const Vector3d velocity = centroid_velocity(sampled, immersed);
    const double speed = velocity.norm();
    if (!(speed > 0.0)) return std::nullopt;
    return FlowVisit{velocity / speed, reynolds_number(immersed, speed),
                     0.5 * immersed.fluid_density * speed * speed / (size * size)};
}

std::vector<FlowVisit> flow_visits(const Motion& motion, std::size_t body, const ImmersedBody& immersed,
                                   const Surroundings& surroundings) {
    const BodyMotion& of_body = motion.bodies[body];
    std::vector<FlowVisit> visits;
    visits.reserve(of_body.poses.size());
    for (int run = 0; run < motion.runs; ++run) {
        for (int frame = 0; frame < motion.frames(); ++frame) {
            for (int copy = 0; copy < of_body.copies; ++copy) {
                const Pose& pose = motion.pose(of_body, run, frame, copy);
                if (pose.velocity.isZero(0.0) && pose.angular_velocity.isZero(0.0)) continue;
                const double time = motion.times[static_cast<std::size_t>(frame)];
                if (const auto visit =
                        flow_visit(pose, time, immersed, surroundings, of_body.size(run, copy)))
                    visits.push_back(*visit);
            }
        }
    }
    return visits;
}

}  // namespace samara
