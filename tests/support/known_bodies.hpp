#pragma once

#include "samara/core/body/body.hpp"
#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/integrator/step.hpp"
#include "samara/scene/scene.hpp"

namespace samara::test {

/// The ellipsoid with semi-axes 1, 2, 4 cm along x, y, z and its exact Kirchhoff tensor: Lamb, Hydrodynamics,
/// 6th ed., articles 114 and 115, evaluated to 13 digits.
Body rubber_ellipsoid();

/// A sphere of the radius (m) with its exact Kirchhoff tensor: half the displaced fluid's mass.
Body exact_sphere(double radius);

/// Returns tables similar to those of a blunt body: drag that differs along the axes, a lift, a moment that
/// takes away half the Kirchhoff moment of `body`, and a moment along the force. Two Reynolds numbers, 1e3
/// and 1e5, the second 20 % lower.
LoadTables blunt_tables(const Body& body, int subdivisions);

/// A body of uniform density in water with table loads, no noise.
SceneBody scene_body(double density);

/// The rubber ellipsoid with blunt_tables, in water at density 1200, centre of mass moved by `offset` (m).
ImmersedBody blunt_ellipsoid(const Vector3d& offset = Vector3d::Zero());

/// Returns the rubber ellipsoid with a coupling of rotation and translation in its Kirchhoff tensor,
/// blunt_tables, and full tensors as all dynamic coefficients: no term of the loads vanishes or is aligned
/// with another.
Body lopsided_shape();

/// A body with all its lengths times `size`, as a file of that size would have it. For bodies without
/// coefficients of their own.
Body scaled(Body body, double size);

/// The lopsided shape in water at density 1200, centre of mass moved by `offset` (m).
ImmersedBody lopsided_body(const Vector3d& offset = Vector3d::Zero());

/// The rubber ellipsoid in water without any loads.
ImmersedBody ideal_ellipsoid();

/// The rubber ellipsoid in water with loads by coefficients with a given area, without the kinks that
/// bilinear maps have, and the centre of mass off the centroid.
ImmersedBody smooth_ellipsoid();

/// Returns a state with different numbers everywhere: speeds of the order of `speed` (m/s), angular
/// velocities of `rate` (rad/s).
BodyState tumbling_state(double speed, double rate);

}  // namespace samara::test
