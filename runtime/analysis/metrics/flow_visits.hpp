#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/dynamics/surroundings.hpp"
#include "samara/motion/motion.hpp"

namespace samara {

/// The flow that a body met at one frame: where its tables were read.
struct FlowVisit {
    Vector3d direction;      ///< unit vector, body axes: the centroid's velocity relative to flow and wind
    double reynolds_number;  ///< of that velocity
    double pressure;         ///< rho |v|^2 / 2 (Pa)
};

/// The visit of one pose at one time (s) of a body of `size` over the shape's; nothing where it rests in the
/// flow.
std::optional<FlowVisit> flow_visit(const Pose& pose, double time, const ImmersedBody& immersed,
                                    const Surroundings& surroundings, double size = 1.0);

/// The visits of all runs and copies of a body of a motion with its poses, frame by frame, without those in
/// which it rests in the world or in the flow: held until its start, or lying on the ground.
std::vector<FlowVisit> flow_visits(const Motion& motion, std::size_t body, const ImmersedBody& immersed,
                                   const Surroundings& surroundings);

}  // namespace samara
