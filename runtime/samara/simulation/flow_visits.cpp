#include "samara/simulation/flow_visits.hpp"

#include "samara/dynamics/loads.hpp"

namespace samara {

std::vector<FlowVisit> flow_visits(const Motion& motion, std::size_t body, const ImmersedBody& immersed,
                                   const Surroundings& surroundings) {
    const BodyMotion& of_body = motion.bodies[body];
    std::vector<FlowVisit> visits;
    visits.reserve(of_body.poses.size());
    for (int run = 0; run < motion.runs; ++run) {
        for (int frame = 0; frame < motion.frames(); ++frame) {
            const Vector3d flow = flow_velocity(surroundings, motion.times[static_cast<std::size_t>(frame)]);
            for (int copy = 0; copy < of_body.copies; ++copy) {
                const Pose& pose = motion.pose(of_body, run, frame, copy);
                if (pose.velocity.isZero(0.0) && pose.angular_velocity.isZero(0.0)) continue;
                const Quaterniond to_body = pose.orientation.conjugate();
                const Vector3d velocity =
                    to_body * (pose.velocity - flow) +
                    (to_body * pose.angular_velocity).cross(immersed.center_of_buoyancy);
                const double speed = velocity.norm();
                if (!(speed > 0.0)) continue;
                visits.push_back({velocity / speed, reynolds_number(immersed, speed),
                                  0.5 * immersed.fluid_density * speed * speed});
            }
        }
    }
    return visits;
}

}  // namespace samara
