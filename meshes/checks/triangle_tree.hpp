#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// The point of the triangle abc that is nearest to p. Ericson, Real-Time Collision Detection (2005), 5.1.5.
Vector3d closest_point_of_triangle(const Vector3d& p, const Vector3d& a, const Vector3d& b,
                                   const Vector3d& c);

/// A tree of boxes over flat triangles, for nearest points and overlaps in logarithmic time.
class TriangleTree {
  public:
    using Triangle = std::array<std::int32_t, 3>;  ///< three indices of vertices
    using Box = Eigen::AlignedBox3d;

    /// Copies the triangles; their indices must lie within `vertices`.
    TriangleTree(std::vector<Vector3d> vertices, std::vector<Triangle> triangles);

    struct Nearest {
        std::size_t triangle = 0;
        Vector3d point = Vector3d::Zero();
        double squared_distance =
            std::numeric_limits<double>::infinity();  ///< infinite: none within the bound
    };

    /// The nearest point of the surface within `bound` of p.
    [[nodiscard]] Nearest nearest(const Vector3d& p,
                                  double bound = std::numeric_limits<double>::infinity()) const;

    /// Whether the surface has a point within `bound` of p: stops at the first one it finds.
    [[nodiscard]] bool is_within(const Vector3d& p, double bound) const;

    /// Calls `visit` with each triangle whose box meets `box`, with a long one maybe more than once, until
    /// `visit` returns false.
    void visit_overlaps(const Box& box, const std::function<bool(std::size_t)>& visit) const;

    [[nodiscard]] const std::vector<Vector3d>& vertices() const { return vertices_; }
    [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }
    [[nodiscard]] const Vector3d& corner(std::size_t triangle, int index) const {
        return vertices_[static_cast<std::size_t>(triangles_[triangle][static_cast<std::size_t>(index)])];
    }
    /// The smallest axis-aligned box around the triangle.
    [[nodiscard]] Box box_of(std::size_t triangle) const;

  private:
    struct Node {
        Box box;
        std::uint32_t first = 0;  // of its pieces in order_
        std::uint32_t count = 0;  // 0: an inner node
        std::uint32_t right = 0;  // an inner node's second child; the first follows the node itself
    };

    void add_pieces(std::size_t triangle, std::vector<Box>& boxes) const;
    void build(std::uint32_t first, std::uint32_t count, const std::vector<Box>& boxes,
               std::vector<std::uint32_t>& pieces);
    [[nodiscard]] Nearest search(const Vector3d& p, double bound, double good_enough) const;

    std::vector<Vector3d> vertices_;
    std::vector<Triangle> triangles_;
    std::vector<std::uint32_t> order_;  // the triangle of each piece
    std::vector<Node> nodes_;
};

}  // namespace samara
