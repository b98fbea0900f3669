#pragma once

#include <string>
#include <vector>

#include "converter/falls/free_fall.hpp"
#include "foam-cases/bake/bake_plan.hpp"
#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/kernel/body_state.hpp"
#include "samara/scene/scene.hpp"

namespace samara {

/// What a fall is solved by: a closure above the laminar Reynolds number, and the order of its steps in time
/// that goes with its mesh.
struct FallModel {
    Closure closure = Closure::k_epsilon;
    /// Whether the mesh resolves the boundary layer and time is taken to second order, or wall functions
    /// stand for the one and time is taken to first.
    bool resolved = false;

    /// The most of a new acceleration that a step may take, of a body whose largest_inertia_ratio() that is.
    [[nodiscard]] double acceleration_relaxation(double inertia_ratio) const;
    /// The step over L/U of such a body (docs/validate.md).
    [[nodiscard]] double time_step(double inertia_ratio) const;
};

/// The closure of that word (OpenFOAM's); throws Error unless falls are solved by it.
Closure closure_of_falls(const std::string& name);

/// The model of falls by that closure: resolved but for those of k and epsilon, whose walls are functions.
FallModel fall_model_of(Closure closure);

/// The largest of the fluid's inertia over the body's own, over all ways to move and turn: what makes a
/// solver that takes flow and motion in turn unstable, and so sets how much of a new acceleration it may
/// take.
double largest_inertia_ratio(const ImmersedBody& body);

/// About the speed (m/s) at which the body will move, rims included: the largest of that at the start, of the
/// terminal speed, and of a body hung off its centre of buoyancy that swings. Zero where nothing moves it.
double fall_speed(const Body& body, const ImmersedBody& immersed, const BodyState& start, const Fluid& fluid,
                  double gravity);

/// How long a fall that coefficients are identified from lasts, over L/U: some six swings.
inline constexpr double identification_fall_duration = 30.0;

/// The states from rest from which such falls start, each in its way oblique to all of the body's principal
/// axes, so that none of its motions is left out. `index`: of the fall.
BodyState identification_start(const Body& body, int index);

/// Adds the quality's falls to a plan and its estimated cost: of the body in the fluid, under a gravity of
/// that size (m/s^2), with each of the masses in turn. The body must have its Kirchhoff tensor.
void add_falls(const Body& body, const Fluid& fluid, const std::vector<MassSpecification>& masses,
               double gravity, BakePlan& plan);

/// A free fall of the body from a state, over `duration` (s), under a gravity (m/s^2, world axes). `speed`
/// (m/s): of the case's units, about that at which it falls. The body's added mass must be there.
FreeFall plan_fall(const Body& body, const ImmersedBody& immersed, const BodyState& start,
                   const Vector3d& gravity, double speed, double duration, const FallModel& model);

/// A plan of the kind fall: with no cases but these falls of one body, all on the mesh whose number of cells
/// around the body is nearest to `cells`, as a ratio: of meshes_of_falls(), or of those of all qualities
/// where the model is not resolved. They are called fall_00, fall_01, ...
BakePlan plan_falls(const Body& body, double cells, std::vector<FreeFall> falls, const FallModel& model);

/// CPU seconds of a fall on a mesh of so many cells, an estimate.
double estimated_fall_seconds(const FreeFall& fall, double cells);

}  // namespace samara
