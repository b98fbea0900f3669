#pragma once

#include <vector>

#include "samara/body/body.hpp"

namespace samara {

/// The two numbers of the pressure that all bodies share, chosen on the reference falls
/// (docs/surface-loads.md).
struct SurfacePressure {
    double base = -0.54;  ///< over rho U^2 / 2, behind the body, and the least anywhere: a flow that
                          ///< would have to go below leaves the surface
    double separation_sine = 0.38;  ///< of the angle between flow and face at which the face is wholly in the
                                    ///< wake
};

/// The potential flow over a surface in steady tows, solved once.
class SurfaceFlow {
  public:
    /// `surface` is closed and outward. The potential is solved on its flat triangles (unit_potentials); of a
    /// finer surface on those of a coarser one. The result does not depend on `threads` (0: all cores).
    /// Throws Error where the equations cannot be solved.
    SurfaceFlow(const Surface& surface, const VolumeMoments& moments, int threads = 0);

    /// The loads: the flow's pressure where it is attached, at least the base pressure, and the base pressure
    /// where the surface turns away from it.
    [[nodiscard]] SurfaceLoads loads(const SurfacePressure& pressure = {}) const;

  private:
    /// A triangle, in lengths of L about the centroid.
    struct Element {
        Vector3d place;
        Vector3d normal;
        double area;
        /// A column for each of the body's unit velocities: the fluid's velocity along the surface, as seen
        /// from the body.
        Matrix3d slip;
    };
    [[nodiscard]] PressureLoads in_direction(const SurfacePressure& pressure,
                                             const Vector3d& direction) const;

    std::vector<Element> elements_;
};

/// SurfaceFlow(surface, moments, threads).loads().
SurfaceLoads surface_loads(const Surface& surface, const VolumeMoments& moments, int threads = 0);

}  // namespace samara
