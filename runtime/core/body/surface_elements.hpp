#pragma once

#include <numbers>
#include <vector>

#include "samara/core/body/surface_loads.hpp"

namespace samara {

/// A triangle of a surface in the potential flow of a steady translation, in lengths of L about the centroid.
struct SurfaceElement {
    Vector3d place = Vector3d::Zero();   ///< its centre
    Vector3d normal = Vector3d::Zero();  ///< outward; zero where it has no area
    double area = 0.0;
    /// A column for each of the body's unit velocities: the fluid's velocity along the surface, as seen from
    /// the body.
    Matrix3d surface_velocity = Matrix3d::Zero();
};

/// One for each triangle.
std::vector<SurfaceElement> surface_elements(const SurfaceLoads& loads);

/// The pressure on the element over rho U^2 / 2 where the body moves along the unit vector `direction`
/// (docs/surface-loads.md, "The steady translation").
double pressure_on(const SurfaceElement& element, const Vector3d& direction, const SurfacePressure& pressure);

/// A over L^2.
inline constexpr double reference_area_over_length_square = std::numbers::pi / 4.0;

}  // namespace samara
