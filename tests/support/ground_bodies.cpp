#include "support/ground_bodies.hpp"

#include <cmath>
#include <numbers>

#include "samara/core/physics/body_physics.hpp"
#include "samara/kirchhoff/kirchhoff_solver.hpp"
#include "support/test_shapes.hpp"

namespace samara::test {

ImmersedBody uniform_body(const Surface& surface, double density, const Fluid& fluid, Loads loads) {
    Body body;
    body.name = "body";
    body.surface = surface;
    body.moments = moments_of(surface);
    body.kirchhoff = kirchhoff_tensor(body.surface, body.moments);
    BodyPhysics given;
    given.mass.density = density;
    given.loads = loads;
    given.coefficients.drag_coefficient = 1.2;
    given.turbulence = Turbulence::none;
    return make_immersed_body(body, given, fluid);
}

Surface disc(double radius, double thickness, int sides) {
    Surface surface;
    for (const double z : {-0.5 * thickness, 0.5 * thickness}) {
        surface.vertices.emplace_back(0.0, 0.0, z);
        for (int i = 0; i < sides; ++i) {
            const double turn = 2.0 * std::numbers::pi * i / sides;
            surface.vertices.emplace_back(radius * std::cos(turn), radius * std::sin(turn), z);
        }
    }
    const int top = sides + 1;
    for (int i = 0; i < sides; ++i) {
        const int a = 1 + i;
        const int b = 1 + (i + 1) % sides;
        surface.corners.push_back({0, b, a});
        surface.corners.push_back({top, top + a, top + b});
        surface.corners.push_back({a, b, top + b});
        surface.corners.push_back({a, top + b, top + a});
    }
    return surface;
}

double lowest_point(const ImmersedBody& body, const BodyState& state) {
    const Vector3d down = -(state.orientation.conjugate() * Vector3d::UnitZ());
    return state.position.z() - reach(body.contact_points, down);
}

BodyState above_ground(const ImmersedBody& body, const Quaterniond& orientation, double drop) {
    BodyState state;
    state.orientation = orientation;
    state.position.z() = drop - lowest_point(body, state);
    return state;
}

BodyState flown(const ImmersedBody& body, const Surroundings& surroundings, BodyState state, double duration,
                double time_step) {
    const Noise noise(1, "body", 0, 0);
    const auto steps = static_cast<std::uint64_t>(std::lround(duration / time_step));
    for (std::uint64_t i = 0; i < steps; ++i) {
        state = advance(body, surroundings, 0.0, time_step, state, noise, i).state;
    }
    return state;
}

}  // namespace samara::test
