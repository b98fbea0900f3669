#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "samara/kirchhoff/panels/flat_triangle_integrals.hpp"
#include "samara/kirchhoff/panels/linear_elements.hpp"
#include "samara/kirchhoff/panels/triangle_rules.hpp"

namespace samara {

/// Point sources in single precision, coordinate by coordinate: the three rotations' strengths and an area
/// vector each.
struct RotationSources {
    std::size_t stride = 0;                   ///< distance in the arrays between two points of a triangle
    std::array<std::vector<float>, 3> place;  ///< from the middle of the triangle's group
    std::array<std::vector<float>, 3> strength;
    std::array<std::vector<float>, 3> area_vector;
};

/// Triangles that follow each other and are near each other.
struct SourceGroup {
    std::size_t begin;
    std::size_t end;
    Vector3d low;  ///< corners of the box that holds them
    Vector3d high;
    double radius;  ///< the largest

    [[nodiscard]] Vector3d middle() const { return 0.5 * (low + high); }
};

/// Sources in one, three or six points a triangle, and batches for the near ones.
struct RotationSourceSets {
    RotationSources one;
    RotationSources three;
    RotationSources six;
    std::vector<float> radius;
    std::vector<SourceGroup> groups;
    std::vector<std::array<SourceBatch, 2>> near;
};

/// Sums over sources at one point.
struct FieldAtPoint {
    std::array<double, 3> potential{};  ///< sum of strength / r, one for each rotation
    std::array<double, 3> flux{};       ///< sum of g n . (y - x) / r^3, y and n this point's
};

/// The fields of all distant triangles at the points of one.
struct DistantFields {
    /// The sum of the solid angles from the middle, but for those of the triangles in `exact`.
    double solid_angle = 0.0;
    FieldAtPoint one;                   ///< at the middle, of triangles very far off
    std::array<FieldAtPoint, 3> three;  ///< at the points of the rule, of those less far
    std::array<FieldAtPoint, 6> six;    ///< at the points of the rule, of those still nearer
    std::vector<std::size_t> exact;     ///< triangles whose solid angle is left to do
    std::vector<std::size_t> near;      ///< triangles too near for point sources
};

/// Returns the normal velocities x cross n of the unit rotations, as sources.
RotationSourceSets rotation_sources(const LinearElements& elements);

/// Returns the fields of all triangles at the points of one of them.
DistantFields distant_fields(const RotationSourceSets& sources, const FlatTriangle& triangle);

/// Returns a point of a rule on a triangle.
Vector3d place_on(const FlatTriangle& triangle, const RulePoint& point);

}  // namespace samara
