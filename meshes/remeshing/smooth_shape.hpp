#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "meshes/checks/triangle_tree.hpp"
#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// The smooth shape that fine flat triangles approximate: creased at edges where the normals of the triangles
/// differ by more than an angle, smooth elsewhere.
///
/// A point of a triangle is lifted by half the mean, with the point's barycentric coordinates as weights, of
/// its offsets from the tangent planes at the corners: exact for surfaces whose height is quadratic, third
/// order for others. (Boubekeur and Alexa, Phong Tessellation, ACM Trans. Graph. 27(5), 2008, with the factor
/// 1/2, which gives this order.) The tangent planes are those of quadratic surfaces fitted to the neighbours;
/// next to creases they are means over the triangles on the same side, weighted as in Max, J. Graphics Tools
/// 4(2), 1999 (exact for a sphere). Creases are lifted likewise, by their tangents. Where normals differ by
/// more than half the crease angle, the triangles are taken for flat.
class SmoothShape {
  public:
    /// `flat`: closed, its vertices welded, of order 1. `crease_angle`: radians.
    SmoothShape(const Surface& flat, double crease_angle);

    /// Returns the point of the smooth surface over the nearest point of the triangles; nothing where the
    /// normal there points away from `normal`.
    [[nodiscard]] std::optional<Vector3d> on_surface(const Vector3d& point, const Vector3d& normal) const;

    /// Returns the point of the smooth crease over the nearest point of the creases; nothing where that is
    /// farther than `bound` (m).
    [[nodiscard]] std::optional<Vector3d> on_crease(const Vector3d& point, double bound) const;

    /// Whether the point lies within `bound` (m) of a crease.
    [[nodiscard]] bool is_near_crease(const Vector3d& point, double bound) const {
        return creases_.is_within(point, bound);
    }

    /// The angle between normals (radians) above which an edge is a crease.
    [[nodiscard]] double crease_angle() const { return crease_angle_; }

  private:
    void gather_triangles_around();
    void gather_crease_neighbours();
    [[nodiscard]] const Vector3d& normal_at(std::size_t triangle, std::size_t corner) const;
    void find_normals(std::size_t vertex) const;
    [[nodiscard]] Vector3d fitted_normal(const std::vector<std::size_t>& around, std::size_t vertex,
                                         const Vector3d& normal) const;
    [[nodiscard]] Vector3d tangent_at(std::size_t segment, int end) const;

    Surface flat_;
    double crease_angle_;
    double least_smooth_cosine_;
    TriangleTree triangles_;
    TriangleTree creases_;  // triangles without width
    std::vector<std::uint32_t> first_around_;
    std::vector<std::uint32_t> around_;  // triangles, vertex after vertex
    std::vector<std::array<std::int32_t, 2>>
        crease_neighbours_;  // at each vertex; -1: fewer than two, -2: more
    // Computed on first use for all corners at a vertex, without locks: a shape is used by one thread.
    mutable std::vector<Vector3d> normals_;
    mutable std::vector<bool> has_normals_;
};

/// Returns the point of a smooth surface over a point near it (m); nothing where there is none.
using LiftedPoint = std::function<std::optional<Vector3d>(const Vector3d&)>;

/// Finds the middle node of an edge of quadratic triangles on the smooth surface that they approximate: the
/// point where the surface's normal is perpendicular to the chord and lies between the normals at its ends.
/// With it the triangles follow the surface to fourth order in the edge's length, with the point nearest to
/// the chord's middle only to third (docs/studies/kirchhoff). `ends`: the edge's ends on the surface;
/// `across`: the third corners of the triangles on both sides. Returns nothing where the surface is not known
/// all around.
std::optional<Vector3d> middle_on_surface(const std::array<Vector3d, 2>& ends,
                                          const std::array<Vector3d, 2>& across, const LiftedPoint& lifted);

}  // namespace samara
