#pragma once

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara::peers {

/// The Kirchhoff tensor, about the origin for a fluid of density 1, by point sources inside the body: one
/// under the centroid of each triangle, at `offset` times the root of the triangle's area below it. The
/// strengths give each triangle the flux that the body's motion asks for; a source's flux through a triangle
/// is the solid angle under which it sees it. The potential is then read at the centroids.
///
/// Written from the description in S. Weissmann and U. Pinkall, Underwater rigid body dynamics, ACM
/// Trans. Graph. 31(4), 2012; the offset is not in it and is the method's free parameter.
/// Dense LU with one thread, as published. `surface` is of order 1.
Matrix6d offset_source_tensor(const Surface& surface, double offset);

}  // namespace samara::peers
