#pragma once

#include <string>
#include <vector>

#include "converter/falls/free_fall.hpp"
#include "foam-cases/bake/bake_plan.hpp"
#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/kernel/body_state.hpp"
#include "samara/scene/scene.hpp"

namespace samara {

/// The model of a fall: its closure above the laminar Reynolds number, and the order of its time steps, which
/// depends on the mesh.
struct FallModel {
    Closure closure = Closure::k_epsilon;
    /// Whether the mesh resolves the boundary layer and time steps are of second order; else wall functions
    /// model the boundary layer and time steps are of first order.
    bool resolved = false;

    /// Returns the largest stable share of a new acceleration in a step, for a body with this
    /// largest_inertia_ratio().
    [[nodiscard]] double acceleration_relaxation(double inertia_ratio) const;
    /// Returns the time step (in L/U) for a body with this largest_inertia_ratio()
    /// (docs/explanation/full-cfd.md).
    [[nodiscard]] double time_step(double inertia_ratio) const;
};

/// Returns the closure with OpenFOAM's word `name`; throws Error where falls are not solved by it.
Closure closure_of_falls(const std::string& name);

/// Returns the model of falls by a closure: with resolved boundary layer, except for closures of k and
/// epsilon, which use wall functions.
FallModel fall_model_of(Closure closure);

/// Returns the largest ratio of the fluid's added inertia to the body's own over all translations and
/// rotations. It determines the stability of a solver that alternates between flow and motion, and so the
/// share of a new acceleration that a step may take.
double largest_inertia_ratio(const ImmersedBody& body);

/// Estimates the speed (m/s) of the body and its rims: the largest of the speed at the start, the terminal
/// speed, and the speed of small oscillations about the centre of buoyancy. Zero where nothing moves it.
double fall_speed(const Body& body, const ImmersedBody& immersed, const BodyState& start, const Fluid& fluid,
                  double gravity);

/// The duration of a fall from which coefficients are identified, in L/U: about six oscillations.
inline constexpr double identification_fall_duration = 30.0;

/// Returns the start of such a fall, from rest and oblique to all of the body's principal axes, differently
/// for each `index`, so that all motions occur.
BodyState identification_start(const Body& body, int index);

/// Returns whether a body of that terminal speed (m/s) and reference length (m), let go from rest under a
/// gravity of that magnitude (m/s^2), can reach a tenth of the speed in such a fall. Else the fall shows
/// nothing of its loads in motion.
bool has_time_to_fall(double speed, double length, double gravity);

/// Adds the quality's falls and their estimated cost to a plan: of the body in the fluid, under a gravity of
/// that magnitude (m/s^2), alternating between the masses. The body must have its Kirchhoff tensor. Of a body
/// so dense that it has no time to fall, the plan's quality has no falls then.
void add_falls(const Body& body, const Fluid& fluid, const std::vector<MassSpecification>& masses,
               double gravity, BakePlan& plan);

/// Plans a free fall of the body from a state, over `duration` (s), under a gravity (m/s^2, world axes).
/// `speed` (m/s): the case's unit of velocity, about the speed of the fall. The body must have its added
/// mass.
FreeFall plan_fall(const Body& body, const ImmersedBody& immersed, const BodyState& start,
                   const Vector3d& gravity, double speed, double duration, const FallModel& model);

/// Returns a plan of the type `fall`: only these falls of one body, named fall_00, fall_01, ..., all on the
/// mesh whose number of cells is nearest to `cells` by ratio: of meshes_of_falls(), or of those of all
/// qualities where the model is not resolved.
BakePlan plan_falls(const Body& body, double cells, std::vector<FreeFall> falls, const FallModel& model);

/// Estimates the CPU seconds of a fall on a mesh with that number of cells.
double estimated_fall_seconds(const FreeFall& fall, double cells);

}  // namespace samara
