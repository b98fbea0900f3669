#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "samara/core/base/box_tree.hpp"
#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// Spreads points over a flat triangle: calls `visit` with the middle of each of its equal parts and the
/// number of parts, a square number of about `wanted`.
template <typename Visit>
void visit_middles(const Vector3d& a, const Vector3d& b, const Vector3d& c, double wanted,
                   const Visit& visit) {
    const int n = 1 + static_cast<int>(std::sqrt(wanted));
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < 2 * (n - i) - 1; ++j) {
            const int column = j / 2;
            const double third = (j % 2 == 0 ? 1.0 : 2.0) / 3.0;
            const double u = (i + third) / n;
            const double v = (column + third) / n;
            visit(Vector3d((1.0 - u - v) * a + u * b + v * c), n * n);
        }
    }
}

/// A tree of boxes over flat triangles, for nearest points and overlaps in logarithmic time.
class TriangleTree {
  public:
    using Triangle = std::array<std::int32_t, 3>;  ///< three indices of vertices
    using Box = BoxTree::Box;

    /// Copies the triangles; their indices must lie within `vertices`.
    TriangleTree(std::vector<Vector3d> vertices, std::vector<Triangle> triangles);

    struct Nearest {
        std::size_t triangle = 0;
        Vector3d point = Vector3d::Zero();
        double squared_distance =
            std::numeric_limits<double>::infinity();  ///< infinite: none within the bound
    };

    /// Returns the nearest point of the surface within `bound` of p.
    [[nodiscard]] Nearest nearest(const Vector3d& p,
                                  double bound = std::numeric_limits<double>::infinity()) const;

    /// Whether the surface has a point within `bound` of p: stops at the first one it finds.
    [[nodiscard]] bool is_within(const Vector3d& p, double bound) const;

    /// Calls `visit` with each triangle whose box intersects `box`, perhaps more than once with a long one,
    /// until `visit` returns false.
    template <typename Visit>
    void visit_overlaps(const Box& box, const Visit& visit) const {
        tree_.visit_near(box, [&](std::uint32_t piece) {
            const std::size_t triangle = order_[piece];
            return !box_of(triangle).intersects(box) || visit(triangle);
        });
    }

    [[nodiscard]] const std::vector<Vector3d>& vertices() const { return vertices_; }
    [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }
    [[nodiscard]] const Vector3d& corner(std::size_t triangle, int index) const {
        return vertices_[static_cast<std::size_t>(triangles_[triangle][static_cast<std::size_t>(index)])];
    }
    /// Returns the smallest axis-aligned box around the triangle.
    [[nodiscard]] Box box_of(std::size_t triangle) const;

  private:
    void add_pieces(std::size_t triangle, std::vector<Box>& boxes) const;
    [[nodiscard]] Nearest search(const Vector3d& p, double bound, double good_enough) const;

    std::vector<Vector3d> vertices_;
    std::vector<Triangle> triangles_;
    std::vector<std::uint32_t> order_;  // the triangle of each piece
    BoxTree tree_;
};

}  // namespace samara
