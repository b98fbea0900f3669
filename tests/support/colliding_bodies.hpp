#pragma once

#include "samara/core/simulation/simulation.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara::test {

/// Returns a uniform body of the surface for simulations.
LoadedBody body_of(const Surface& surface);

/// Returns the physics of a body without loads and without the fluid's inertia.
BodyPhysics without_fluid(double density);

/// Returns the settings for bodies that collide, in next to no fluid; gravity in m/s^2, downwards.
SimulationSettings colliding_in_vacuum(double gravity, double step);

/// Returns the energy (J) of all bodies, potential energy from the height 0, in gravity (m/s^2) and without a
/// fluid.
double energy_of(const Simulation& simulation, double gravity);

/// Returns the depth (m) by which the hulls of two bodies overlap; 0 where they do not.
double overlap_of(const Simulation& simulation, std::size_t first, std::size_t second);

/// Returns the largest overlap (m) of all pairs.
double deepest_overlap(const Simulation& simulation);

/// Returns the height (m) of the lowest contact point of a body.
double lowest_point(const Simulation& simulation, std::size_t index);

}  // namespace samara::test
