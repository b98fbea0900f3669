#pragma once

#include <string>
#include <vector>

#include "samara/core/body/body.hpp"
#include "samara/core/dynamics/immersed_body.hpp"

namespace samara::test {

/// The fluids of scene presets.
Fluid water();
Fluid air();

/// An ellipsoid about the origin with its exact tensor and the blunt tables of known_bodies.hpp.
Body baked_ellipsoid(const Vector3d& semi_axes);

/// A sphere with its exact tensor, and tables of the same drag coefficient in all directions: 0.5 times its
/// cross section at all Reynolds numbers from 1 up, no moment.
Body baked_sphere(double radius, int subdivisions = 2);

/// A sheet of A4 paper 0.1 mm thick, its normal along x, with blunt tables. Its tensor is the one that
/// `samara kirchhoff --tolerance 0.01` gives for the box, rounded to three digits.
Body paper_sheet();

/// The body in the fluid, of uniform density (kg/m^3), without turbulence; its centre of mass is moved by
/// `offset` (m).
ImmersedBody immersed(const Body& body, double density, const Fluid& fluid, Loads loads = Loads::table,
                      const Vector3d& offset = Vector3d::Zero());

/// A body and its name in tables.
struct NamedBody {
    std::string name;
    ImmersedBody body;
};

/// Returns five bodies with different difficulties: a rubber ellipsoid (1:2:4 cm) in water, a paper sheet in
/// air, a bubble (an ellipsoid, 2:3:4 mm), a neutral ellipsoid and a copper coin (an ellipsoid, 1:12.5:12.5
/// mm) in water. Sizes are semi-axes.
std::vector<NamedBody> five_bodies(Loads loads);

}  // namespace samara::test
