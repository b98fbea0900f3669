#include "samara/core/dynamics/body_wind.hpp"

#include <algorithm>

namespace samara {
namespace {

/// Returns about the body's radius: L/2, exact for a sphere.
double reach_of(const ImmersedBody& body) {
    return 0.5 * body.length;
}

/// Returns the share of the wind that reaches a place in the world (m) at a time (s) beside surfaces.
double share_of(const Surroundings& surroundings, const Vector3d& place, double time) noexcept {
    const WindSurfaceLayer& layer = surroundings.wind->surface_layer();
    double distance = layer.height;
    if (surroundings.ground) distance = std::min(distance, place.z() - *surroundings.ground);
    if (surroundings.obstacles != nullptr && distance > 0.0) {
        distance = distance_from(*surroundings.obstacles, place, time, distance);
    }
    return layer.share_at(distance);
}

Vector3d column(const double (&rows)[3][WindBlock::size], std::size_t lane) {
    return {rows[0][lane], rows[1][lane], rows[2][lane]};
}

}  // namespace

Vector3d wind_velocity(const ImmersedBody& body, const Surroundings& surroundings, const Vector3d& place,
                       double time) noexcept {
    if (surroundings.wind == nullptr) return Vector3d::Zero();
    const Vector3d in_world = place + flow_displacement(surroundings, time);
    WindBlock block;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        block.place[axis][0] = in_world[static_cast<Eigen::Index>(axis)];
    }
    constexpr double any_duration = 1e-3;  // it affects the rate alone, which is not used here
    surroundings.wind->blow(time, {reach_of(body), any_duration}, 1, block);
    return share_of(surroundings, in_world, time) * column(block.velocity, 0);
}

kernel::WindSource BodyWind::source() const noexcept {
    if (surroundings_->wind == nullptr) return {};
    return {sample, this};
}

void BodyWind::sample(const void* context, std::uint64_t step, std::size_t count,
                      kernel::SampledWind& sampled) noexcept {
    const auto& self = *static_cast<const BodyWind*>(context);
    const Surroundings& surroundings = *self.surroundings_;
    const double begin = step_time(self.start_, self.time_step_, step);
    const double time = 0.5 * (begin + step_time(self.start_, self.time_step_, step + 1));
    const Vector3d displacement = flow_displacement(surroundings, time);
    const Vector3d flow = flow_velocity(surroundings, time);
    // The places are predicted for mid-step in the flow's frame; here they are in the world.
    WindBlock block = {};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t lane = 0; lane < count; ++lane) {
            block.place[axis][lane] =
                sampled.place[axis][lane] + displacement[static_cast<Eigen::Index>(axis)];
        }
    }
    if (!surroundings.wind->blow(time, {reach_of(*self.body_), self.time_step_}, count, block)) {
        self.unsound_.store(true, std::memory_order_relaxed);
    }
    for (std::size_t lane = 0; lane < count; ++lane) {
        // The shear of the layer itself, thinner than the bodies in it, is left out of the gradient.
        const double share = share_of(surroundings, column(block.place, lane), time);
        const Vector3d velocity = share * column(block.velocity, lane);
        Matrix3d gradient;
        for (std::size_t i = 0; i < 9; ++i) {
            gradient(static_cast<Eigen::Index>(i / 3), static_cast<Eigen::Index>(i % 3)) =
                share * block.gradient[i][lane];
        }
        // The fluid's own acceleration, whose pressure acts on the body as on the displaced fluid.
        const Vector3d acceleration = share * column(block.rate, lane) + gradient * (flow + velocity);
        const Vector3d half_change = 0.5 * self.time_step_ * acceleration;
        const Vector3d rotation =
            0.5 * Vector3d(gradient(2, 1) - gradient(1, 2), gradient(0, 2) - gradient(2, 0),
                           gradient(1, 0) - gradient(0, 1));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<Eigen::Index>(axis);
            sampled.begin[axis][lane] = velocity[i] - half_change[i];
            sampled.end[axis][lane] = velocity[i] + half_change[i];
            sampled.rotation[axis][lane] = rotation[i];
        }
    }
}

}  // namespace samara
