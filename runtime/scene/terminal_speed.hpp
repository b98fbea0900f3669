#pragma once

#include "samara/core/body/body.hpp"
#include "samara/core/physics/fluid.hpp"
#include "samara/core/simulation/loaded_body.hpp"
#include "samara/scene/scene.hpp"

namespace samara {

/// Drag coefficient, on the largest projected area, that the estimate of the terminal speed takes:
/// between a sphere's 0.4 and a square plate's 1.2 at Reynolds numbers of 1e3 to 1e5 (Hoerner, Fluid-Dynamic
/// Drag, 1965, chapter 3).
inline constexpr double terminal_drag_coefficient = 1.0;

/// Returns the largest area (m^2) of the body's projected area over the nodes of an octahedral map and the
/// principal axes.
double largest_projected_area(const Body& body);

/// Returns the speed (m/s) at which the drag, with terminal_drag_coefficient on the largest projected area,
/// balances the weight less the buoyancy: |mass - rho V| g = C rho A U^2 / 2, for a body that sinks or rises.
/// `mass` in kg, `gravity` in m/s^2. 0 where the weight and the buoyancy are equal to 1e-6, or gravity is 0:
/// then no speed belongs to the body.
double terminal_speed(const Body& body, const Fluid& fluid, double mass, double gravity);

/// Throws Error, which names the scene and the sizes that can be had, where copies of a body of a scene are
/// so large or small that they would fall at more than twice the highest or less than half the lowest
/// Reynolds number of its tables: by terminal_speed(), of each size. A body that reads them at one Reynolds
/// number alone passes.
void require_sizes_in_tables(const Scene& scene, const SceneBody& scene_body, const LoadedBody& loaded);

}  // namespace samara
