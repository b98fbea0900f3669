#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "meshes/checks/triangle_tree.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// The shape that fine flat triangles stand for: smooth where neighbours turn by less than an angle, creased
/// where they turn by more.
///
/// A point of a triangle is lifted by half the mean, with the point's barycentric coordinates as weights, of
/// its offsets from the tangent planes at the corners: exact for surfaces whose height is quadratic, third
/// order for others. (Boubekeur and Alexa, Phong Tessellation, ACM Trans. Graph. 27(5), 2008, with the factor
/// 1/2, which makes it so.) The tangent planes are those of quadratic surfaces fitted to the neighbours; next
/// to creases of the triangles on the same side, weighted as in Max, J. Graphics Tools 4(2), 1999: exact for
/// a sphere. Creases are lifted alike, by their tangents. Where triangles turn by more than half the angle of
/// creases, they are taken for flat.
class SmoothShape {
  public:
    /// `flat`: closed, its vertices welded, of order 1. `crease_angle`: radians.
    SmoothShape(const Surface& flat, double crease_angle);

    /// The point of the smooth surface over the nearest point of the triangles; nothing where these look
    /// away from `normal` there.
    [[nodiscard]] std::optional<Vector3d> on_surface(const Vector3d& point, const Vector3d& normal) const;

    /// The point of the smooth crease over the nearest point of the creases; nothing where that is further
    /// than `bound`.
    [[nodiscard]] std::optional<Vector3d> on_crease(const Vector3d& point, double bound) const;

    /// Whether the point lies within `bound` (m) of a crease.
    [[nodiscard]] bool is_near_crease(const Vector3d& point, double bound) const {
        return creases_.is_within(point, bound);
    }

    /// Faces that meet at more than this angle (radians) are creased.
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
        crease_neighbours_;  // of each vertex; -1: fewer, -2: more than 2
    // Of each corner, found when one at the vertex is first asked for: a shape is asked by one thread.
    mutable std::vector<Vector3d> normals_;
    mutable std::vector<bool> has_normals_;
};

}  // namespace samara
