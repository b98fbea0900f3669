#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "samara/core/surface/surface.hpp"

namespace samara {

/// A flat triangle with what its integrals need. Edge e runs from corner e to corner e + 1.
struct FlatTriangle {
    std::array<Vector3d, 3> corners;   ///< counter-clockwise from outside
    std::array<Vector3d, 3> tangents;  ///< unit, along the edges
    std::array<Vector3d, 3> outward;   ///< unit, in the plane, out of the triangle across the edges
    std::array<double, 3> lengths;     ///< of the edges
    Vector3d centroid;
    Vector3d normal;  ///< unit, outward
    double area;
    double radius;  ///< the distance from the centroid to the farthest corner
};

/// Returns the flat triangle with these corners. A triangle without an area gets a normal that is not finite.
FlatTriangle flat_triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c);

/// Returns the triangles of a surface of order 1. Throws Error at a triangle without an area or a vertex that
/// is not finite.
std::vector<FlatTriangle> flat_triangles(const Surface& surface);

/// A part of a surface: triangles that follow each other in ClusterTree::order.
struct Cluster {
    std::size_t begin;
    std::size_t end;
    Vector3d low;  ///< corners of the box that holds the triangles
    Vector3d high;
    std::size_t left = 0;  ///< children in ClusterTree::clusters; 0: none
    std::size_t right = 0;

    [[nodiscard]] std::size_t size() const { return end - begin; }
    [[nodiscard]] bool is_leaf() const { return left == 0; }
};

/// A surface's triangles in clusters, each halved across the longest side of its box.
struct ClusterTree {
    std::vector<Cluster> clusters;   ///< the whole first, parents before children
    std::vector<std::size_t> order;  ///< the triangles' indices, near ones next to each other
};

/// Halves a surface until each leaf has no more than `leaf_size` triangles.
ClusterTree cluster_tree(const std::vector<FlatTriangle>& triangles, std::size_t leaf_size);

/// Returns the distance between two clusters' boxes; 0 where they touch.
double box_distance(const Cluster& a, const Cluster& b);

/// Returns the length of the diagonal of a cluster's box.
double box_diameter(const Cluster& cluster);

}  // namespace samara
