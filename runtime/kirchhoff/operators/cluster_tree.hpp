#pragma once

#include <cstddef>
#include <vector>

#include "samara/kirchhoff/panels/flat_triangle.hpp"

namespace samara {

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
