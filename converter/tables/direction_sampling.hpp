#pragma once

#include <vector>

#include "samara/core/body/body.hpp"

namespace samara {

// Map axes are the columns of symmetry.axes: the axes of the octahedral map and of the cases. A direction is
// the unit vector of the body's velocity relative to the fluid.

/// Returns the directions (map axes) that must be solved so that the body's symmetry gives all nodes of the
/// octahedral map whose octahedron edges are cut into `subdivisions`:
///  - spherical: one, the map's first axis;
///  - axial: the points of axial_arc;
///  - finite: one node of each orbit under `symmetry.elements`, the largest in the order of (x, y, z), hence
///    with positive components where the symmetry allows it; largest first.
/// An element that maps a node between nodes (such as a rotation by 72 degrees) does not merge it with
/// others. Deterministic. Throws Error where subdivisions < 1.
std::vector<Vector3d> required_directions(const Symmetry& symmetry, int subdivisions);

/// Half a great circle from a body's axis of rotation, in even steps of the polar angle.
struct AxialArc {
    Vector3d axis;    ///< the axis of rotation (map axes); polar angle 0
    Vector3d across;  ///< perpendicular to it: the arc's direction at 90 degrees
    bool mirrored;    ///< whether a symmetry reverses the axis: the arc ends at 90 degrees, else at 180
    int steps;        ///< `subdivisions` steps to 90 degrees, twice as many to 180

    [[nodiscard]] double step_angle() const;  ///< rad
    /// Returns the unit vector (map axes) after `step` of `steps`.
    [[nodiscard]] Vector3d direction(int step) const;
};

/// Returns the arc on which an axial body is solved. The body's axis may be any column of `axes`.
AxialArc axial_arc(const Symmetry& symmetry, int subdivisions);

/// Returns the elements of the group in map axes. Those that permute the map's axes to within the accuracy of
/// the symmetry do so exactly here.
std::vector<Matrix3d> elements_in_map_axes(const Symmetry& symmetry);

/// Returns the index of node (row, column) among the (2 subdivisions + 1)^2 of the map; nodes of the same
/// direction share the smallest.
std::size_t unique_node(int subdivisions, int row, int column);

/// A node of the map as the image of a required direction: node = element * source.
struct NodeImage {
    Vector3d source;   ///< one of required_directions
    Matrix3d element;  ///< map axes
};

/// Returns a NodeImage for each node of the map, row by row, for a body of finite symmetry. Nodes of the same
/// direction have the same image.
std::vector<NodeImage> node_images(const Symmetry& symmetry, int subdivisions);

/// Returns the orthogonal matrix (map axes) of the body's symmetry that maps a direction to the equivalent
/// one of required_directions(): of its images the largest in the order of (x, y, z), the one on the arc of a
/// body of revolution, or the map's first axis for a sphere.
Matrix3d element_to_required(const Symmetry& symmetry, const Vector3d& direction);

/// Returns the distance between unit vectors below which they are one direction: 1e-6, or the tolerance of
/// the symmetry, up to 1e-3.
double direction_tolerance(const Symmetry& symmetry);

}  // namespace samara
