#pragma once

#include "samara/core/simulation/simulation.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara::test {

/// A uniform body of the surface for flights.
LoadedBody body_of(const Surface& surface);

/// Without loads and without the fluid's inertia.
BodyPhysics without_fluid(double density);

/// Of bodies that meet, in next to nothing; gravity in m/s^2, downwards.
SimulationSettings colliding_in_vacuum(double gravity, double step);

/// Of all bodies (J), potential energy from the height 0, in gravity (m/s^2) and without a fluid.
double energy_of(const Simulation& simulation, double gravity);

/// How deep (m) the hulls of two bodies overlap; 0 where they do not.
double overlap_of(const Simulation& simulation, std::size_t first, std::size_t second);

/// The largest of all pairs.
double deepest_overlap(const Simulation& simulation);

/// The height (m) of the lowest contact point of a body.
double lowest_point(const Simulation& simulation, std::size_t index);

}  // namespace samara::test
