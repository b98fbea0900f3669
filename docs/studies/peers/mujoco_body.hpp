#pragma once

#include "peers/peer_body.hpp"

namespace samara {

/// One free body of uniform density in MuJoCo's ellipsoid fluid model, and nothing else: no contacts, no
/// constraints. MuJoCo makes its ellipsoid from a geom's half sizes, for ellipsoids, cylinders and boxes
/// alike (mju_geomSemiAxes): here the half extents of the body along its principal axes. Mass and inertia are
/// the body's own. MuJoCo knows no buoyancy: gravity is reduced by the fluid's share, which is the same force
/// as the body is uniform. The coefficients are the five of fluidcoef. `integrator`: one of MuJoCo's
/// mjtIntegrator. Making a body throws Error where its density is not uniform and where MuJoCo refuses it.
PeerModel mujoco_model(int integrator);

}  // namespace samara
