#include "converter/falls/falling_body.hpp"

#include <cmath>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/simulation/world_pose.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

ImmersedBody falling_body(const Body& body, const FreeFall& fall) {
    const double length = reference_length(body.moments.surface_area);
    if (std::abs(length - fall.length) > 1e-6 * length) {
        throw Error(
            fmt::format("{}: the fall is of another body than {}: its length L is {:.6g} m, not {:.6g} m",
                        fall.name, body.name, fall.length, length));
    }
    const double mass_unit = fall.fluid_density * length * length * length;
    BodyPhysics physics;
    physics.mass.mass = fall.mass * mass_unit;
    physics.mass.center_of_mass = body.moments.centroid + length * (fall.axes * fall.center_of_mass);
    physics.mass.inertia =
        mass_unit * length * length * (fall.axes * fall.inertia() * fall.axes.transpose()).eval();
    physics.turbulence = Turbulence::none;
    Fluid fluid;
    fluid.density = fall.fluid_density;
    fluid.viscosity = fall.speed * length * fall.fluid_density / fall.reynolds_number;
    return make_immersed_body(body, physics, fluid, body.name);
}

std::vector<BodyState> states_of(const FallRecord& record) {
    const FreeFall& fall = record.fall;
    const Matrix3d& axes = fall.axes;
    const auto state = [&](const Vector3d& position, const Matrix3d& turn, const Vector3d& velocity,
                           const Vector3d& angular_velocity) {
        BodyState one;
        one.position = fall.length * (axes * (position - fall.center_of_mass));
        one.orientation = Quaterniond(axes * turn * axes.transpose());
        one.velocity << axes * (turn.transpose() * angular_velocity) / fall.time_unit(),
            axes * (turn.transpose() * velocity) * fall.speed;
        return one;
    };
    std::vector<BodyState> states = {
        state(fall.center_of_mass, Matrix3d::Identity(), fall.velocity, fall.angular_velocity)};
    for (const FallSample& sample : record.samples) {
        states.push_back(state(sample.position, sample.turn, sample.velocity, sample.angular_velocity));
    }
    return states;
}

Vector3d gravity_of(const FreeFall& fall) {
    return fall.axes * fall.gravity * fall.speed / fall.time_unit();
}

Motion motion_of(const Body& body, const Vector3d& gravity, double interval,
                 const std::vector<BodyState>& states) {
    Motion motion;
    motion.gravity = gravity;
    motion.frame_rate = 1.0 / interval;
    BodyMotion& one = motion.bodies.emplace_back();
    one.name = body.name;
    one.shortest_axis = principal_axes(body.moments).col(0);
    for (std::size_t i = 0; i < states.size(); ++i) {
        motion.times.push_back(static_cast<double>(i) * interval);
        one.poses.push_back(flow_pose(states[i]));
    }
    return motion;
}

}  // namespace samara
