// Drops a neutrally buoyant and a heavy sphere with the installed library alone.

#include <cstdio>

#include <samara/dynamics/step.hpp>
#include <samara/scene/scene.hpp>

int main() {
    samara::ImmersedBody body;
    body.fluid_density = 1000.0;
    body.viscosity = 1e-3;
    body.volume = 1e-3;
    body.mass = 1.5;
    body.inertia.diagonal() << 1e-3, 1e-3, 1e-3, 2.0, 2.0, 2.0;
    samara::prepare(body);
    samara::BodyState state;
    for (int i = 0; i < 100; ++i) {
        state = samara::implicit_step(body, samara::Vector3d(0.0, 0.0, -9.81), 0.01, state);
    }
    // Half a kilogram of weight in water moves two kilograms of body and fluid.
    const double expected = -0.25 * 9.81;
    std::printf("%.6f m/s after a second, %.6f expected\n", state.velocity[5], expected);
    return state.velocity[5] - expected < 1e-9 && expected - state.velocity[5] < 1e-9 ? 0 : 1;
}
