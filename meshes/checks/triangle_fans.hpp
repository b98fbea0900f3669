#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// 1 for an equilateral triangle, 0 for one without area.
double triangle_quality(const Vector3d& a, const Vector3d& b, const Vector3d& c);

/// A closed surface of flat triangles with the triangles around each vertex, whose vertices may be drawn into
/// neighbours. What is around a vertex is as it was at the last `gather`: until the next, only what is not
/// `locked` may be changed, and each change locks the vertices that it concerns.
class TriangleFans {
  public:
    using Triangle = std::array<std::int32_t, 3>;

    TriangleFans(std::vector<Vector3d> vertices, std::vector<Triangle> triangles);

    /// Drops removed triangles, finds the triangles around each vertex, unlocks all.
    void gather();

    /// The vertices joined to v by an edge.
    void gather_ring(std::size_t v, std::vector<std::int32_t>& ring) const;

    /// The link condition for drawing a vertex with the one ring into a neighbour with the other: these share
    /// two vertices, which keep at least three triangles each.
    [[nodiscard]] bool keeps_topology(const std::vector<std::int32_t>& ring,
                                      const std::vector<std::int32_t>& other) const;

    /// Whether, with v drawn into the target, each triangle turns by less than the angle with that cosine and
    /// keeps the quality `least`.
    [[nodiscard]] bool keeps_shape(std::size_t v, std::int32_t target, double least_cosine,
                                   double least) const;

    /// The least quality of the triangles around v.
    [[nodiscard]] double worst_quality(std::size_t v) const;

    /// Draws v into its neighbour: two triangles are removed.
    void draw_into(std::size_t v, std::int32_t target);

    /// Triangles around v, as indices: [first, last).
    [[nodiscard]] const std::uint32_t* begin_around(std::size_t v) const {
        return around_.data() + first_around_[v];
    }
    [[nodiscard]] const std::uint32_t* end_around(std::size_t v) const {
        return around_.data() + first_around_[v + 1];
    }

    /// Whether so many triangles meet at v, as in the middle of a fan, that trying to draw it somewhere takes
    /// long.
    [[nodiscard]] bool is_hub(std::size_t v) const { return end_around(v) - begin_around(v) > 32; }

    [[nodiscard]] bool is_locked(std::int32_t v) const { return locked_[static_cast<std::size_t>(v)]; }
    void lock(std::int32_t v) { locked_[static_cast<std::size_t>(v)] = true; }

    [[nodiscard]] const Vector3d& vertex(std::int32_t v) const {
        return vertices[static_cast<std::size_t>(v)];
    }
    /// Half the cross product of two sides.
    [[nodiscard]] Vector3d area_vector_of(const Triangle& triangle) const;

    std::vector<Vector3d> vertices;
    std::vector<Triangle> triangles;  ///< removed ones have corners of -1 until the next gather

  private:
    std::vector<std::uint32_t> first_around_;
    std::vector<std::uint32_t> around_;  // triangles, vertex after vertex
    std::vector<bool> locked_;
};

}  // namespace samara
