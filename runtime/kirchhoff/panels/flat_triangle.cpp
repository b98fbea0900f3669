#include "samara/kirchhoff/panels/flat_triangle.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"

namespace samara {
namespace {

Cluster make_cluster(const std::vector<FlatTriangle>& triangles, const std::vector<std::size_t>& order,
                     std::size_t begin, std::size_t end) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Cluster cluster{begin, end, Vector3d::Constant(infinity), Vector3d::Constant(-infinity)};
    for (std::size_t i = begin; i < end; ++i) {
        for (const Vector3d& corner : triangles[order[i]].corners) {
            cluster.low = cluster.low.cwiseMin(corner);
            cluster.high = cluster.high.cwiseMax(corner);
        }
    }
    return cluster;
}

}  // namespace

FlatTriangle flat_triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    FlatTriangle triangle;
    triangle.corners = {a, b, c};
    triangle.centroid = (a + b + c) / 3.0;
    const Vector3d twice_area = (b - a).cross(c - a);
    triangle.area = 0.5 * twice_area.norm();
    triangle.normal = twice_area / (2.0 * triangle.area);
    triangle.radius = 0.0;
    for (std::size_t e = 0; e < 3; ++e) {
        const Vector3d edge = triangle.corners[(e + 1) % 3] - triangle.corners[e];
        triangle.lengths[e] = edge.norm();
        triangle.tangents[e] = edge / triangle.lengths[e];
        triangle.outward[e] = triangle.tangents[e].cross(triangle.normal);
        triangle.radius = std::max(triangle.radius, (triangle.corners[e] - triangle.centroid).norm());
    }
    return triangle;
}

std::vector<FlatTriangle> flat_triangles(const Surface& surface) {
    std::vector<FlatTriangle> triangles;
    triangles.reserve(surface.triangle_count());
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        const auto corner = [&](std::size_t i) {
            return surface.vertices[static_cast<std::size_t>(surface.corners[t][i])];
        };
        triangles.push_back(flat_triangle(corner(0), corner(1), corner(2)));
        const FlatTriangle& triangle = triangles.back();
        // Also false where a coordinate is not a number.
        if (!(triangle.area > 1e-12 * triangle.radius * triangle.radius)) {
            throw Error(fmt::format(
                "triangle {} has no area or is not finite; mesh the shape again with 'samara mesh'", t));
        }
    }
    return triangles;
}

ClusterTree cluster_tree(const std::vector<FlatTriangle>& triangles, std::size_t leaf_size) {
    ClusterTree tree;
    tree.order.resize(triangles.size());
    std::iota(tree.order.begin(), tree.order.end(), std::size_t{0});
    tree.clusters.push_back(make_cluster(triangles, tree.order, 0, triangles.size()));
    for (std::size_t c = 0; c < tree.clusters.size(); ++c) {
        const Cluster cluster = tree.clusters[c];
        Eigen::Index axis = 0;
        (cluster.high - cluster.low).maxCoeff(&axis);
        const auto place = [&](std::size_t i) { return tree.order.begin() + static_cast<std::ptrdiff_t>(i); };
        // Ties are broken by index, so that the order is the same everywhere.
        const auto before = [&](auto i, auto j) {
            const double x = triangles[i].centroid[axis];
            const double y = triangles[j].centroid[axis];
            return x < y || (x == y && i < j);
        };
        if (cluster.size() <= leaf_size) {
            // So that those of one vector register are near each other.
            std::sort(place(cluster.begin), place(cluster.end), before);
            continue;
        }
        const std::size_t middle = cluster.begin + cluster.size() / 2;
        std::nth_element(place(cluster.begin), place(middle), place(cluster.end), before);
        tree.clusters[c].left = tree.clusters.size();
        tree.clusters[c].right = tree.clusters.size() + 1;
        tree.clusters.push_back(make_cluster(triangles, tree.order, cluster.begin, middle));
        tree.clusters.push_back(make_cluster(triangles, tree.order, middle, cluster.end));
    }
    return tree;
}

double box_distance(const Cluster& a, const Cluster& b) {
    return (a.low - b.high).cwiseMax(b.low - a.high).cwiseMax(0.0).norm();
}

double box_diameter(const Cluster& cluster) {
    return (cluster.high - cluster.low).norm();
}

}  // namespace samara
