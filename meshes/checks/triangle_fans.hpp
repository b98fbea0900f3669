#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// Returns the shape quality of a triangle: 1 where it is equilateral, 0 where it has no area.
double triangle_quality(const Vector3d& a, const Vector3d& b, const Vector3d& c);

/// A closed surface of flat triangles, with the list of triangles around each vertex, for edge collapses. The
/// lists are those of the last `gather`: until the next one only vertices that are not locked may be changed,
/// and each change locks the vertices that it concerns.
class TriangleFans {
  public:
    using Triangle = std::array<std::int32_t, 3>;

    TriangleFans(std::vector<Vector3d> vertices, std::vector<Triangle> triangles);

    /// Drops removed triangles, finds the triangles around each vertex, unlocks all.
    void gather();

    /// Lists the vertices joined to v by an edge.
    void gather_ring(std::size_t v, std::vector<std::int32_t>& ring) const;

    /// Whether a vertex with the first ring of neighbours can be collapsed into a neighbour with the other
    /// ring (the link condition): the rings share two vertices, which keep at least three triangles each.
    [[nodiscard]] bool keeps_topology(const std::vector<std::int32_t>& ring,
                                      const std::vector<std::int32_t>& other) const;

    /// Whether, with v collapsed into the target, the normal of each triangle changes by less than the angle
    /// with cosine `least_cosine`, and its quality stays at least `least`.
    [[nodiscard]] bool keeps_shape(std::size_t v, std::int32_t target, double least_cosine,
                                   double least) const;

    /// Returns the least triangle_quality() around v.
    [[nodiscard]] double worst_quality(std::size_t v) const;

    /// Collapses v into its neighbour `target`: two triangles are removed.
    void collapse_into(std::size_t v, std::int32_t target);

    /// The triangles around v, as a range of indices [begin, end).
    [[nodiscard]] const std::uint32_t* begin_around(std::size_t v) const {
        return around_.data() + first_around_[v];
    }
    [[nodiscard]] const std::uint32_t* end_around(std::size_t v) const {
        return around_.data() + first_around_[v + 1];
    }

    /// Whether v has so many triangles, as in the middle of a fan, that trying to collapse it would take
    /// long.
    [[nodiscard]] bool is_hub(std::size_t v) const { return end_around(v) - begin_around(v) > 32; }

    [[nodiscard]] bool is_locked(std::int32_t v) const { return locked_[static_cast<std::size_t>(v)]; }
    void lock(std::int32_t v) { locked_[static_cast<std::size_t>(v)] = true; }

    [[nodiscard]] const Vector3d& vertex(std::int32_t v) const {
        return vertices[static_cast<std::size_t>(v)];
    }
    /// Returns the area vector: half the cross product of two sides.
    [[nodiscard]] Vector3d area_vector_of(const Triangle& triangle) const;

    std::vector<Vector3d> vertices;
    std::vector<Triangle> triangles;  ///< removed ones have corners of -1 until the next gather

  private:
    std::vector<std::uint32_t> first_around_;
    std::vector<std::uint32_t> around_;  // triangles, vertex after vertex
    std::vector<bool> locked_;
};

}  // namespace samara
