#pragma once

#include <array>
#include <cstddef>

#include "samara/kirchhoff/panels/flat_triangle.hpp"

namespace samara {

/// How many points are evaluated at once.
inline constexpr std::size_t point_batch = 8;

/// Points in space, a coordinate each row.
struct PointBatch {
    alignas(64) std::array<double, point_batch> x;
    alignas(64) std::array<double, point_batch> y;
    alignas(64) std::array<double, point_batch> z;

    void set(std::size_t i, const Vector3d& point) {
        x[i] = point.x();
        y[i] = point.y();
        z[i] = point.z();
    }
};

/// One value for each point of a batch.
struct ValueBatch {
    alignas(64) std::array<double, point_batch> values;
};

/// Points that carry three strengths each.
struct SourceBatch {
    PointBatch points;
    std::array<ValueBatch, 3> strengths;
};

/// Integrals of the densities v_k of a triangle (1 at corner k, 0 at the others, linear between), summed over
/// sources: rows k, columns the strengths.
struct HatSums {
    Matrix3d potentials = Matrix3d::Zero();  ///< strength x integral of v_k / r
    Matrix3d solid_angles =
        Matrix3d::Zero();  ///< strength x integral of v_k n . (y - x) / r^3, y on the triangle
};

/// Returns the integral of 1/r over the triangle at each point, which may lie on it (Wilton et al., IEEE
/// Trans. Antennas Propag. AP-32(3), 1984, eq. 5; the solid angle: van Oosterom and Strackee 1983).
ValueBatch uniform_potential(const FlatTriangle& triangle, const PointBatch& points);

/// Returns the sum over the triangle's edges of direction . m times the integral of r - h log(r + h) along
/// the edge, m the edge's outward normal, for points at the height h >= 0 (the same for all) above the
/// triangle's plane. The potential in the plane of r - h log(r + h) has the Laplacian 1/r.
ValueBatch contour_potential(const FlatTriangle& triangle, const Vector3d& direction, double height,
                             const PointBatch& points);

/// Adds the potentials and solid angles of the triangle's three linear densities at the sources to `sums`;
/// all share their logarithms (Wilton et al. 1984). A point in the triangle's plane has no solid angle.
void add_hat_sums(const FlatTriangle& triangle, const SourceBatch& sources, HatSums& sums);

/// Returns the double integral of 1/r over two triangles in any position to each other (apart, touching, the
/// same, or facing each other at any distance), to about 1e-9 of the radii cubed; not for triangles that
/// cross.
///
/// Reduced to integrals over edges: 1/r is homogeneous about any point O common to both planes, so that
/// 3 V = sum over the edges of either triangle of (distance of the edge from O) x (integral along the edge of
/// the other one's potential); planes that are parallel, or nearly so compared with the distance of the
/// triangles, have V = - sum over pairs of edges of m . m' times the integral of r - h log(r + h). (Lenoir
/// and Salles, SIAM J. Sci. Comput. 34(6), 2012, derive closed forms in this way.) What is left are
/// integrals along edges, by Gauss rules on intervals graded towards the other triangle's corners and edges.
double pair_potential(const FlatTriangle& first, const FlatTriangle& second);

/// Returns the double integral of 1/r over one triangle twice, in closed form: -4/3 A^2 sum over edges of
/// log(1 - l/p) / l with half the perimeter p (Eibert and Hansen, IEEE Trans. Antennas Propag. 43(12), 1995).
double self_potential(const FlatTriangle& triangle);

}  // namespace samara
