#include <algorithm>
#include <cmath>

#include "samara/kirchhoff/panels/flat_triangle_integrals.hpp"

namespace samara {
namespace {

// Gauss-Legendre, 8 points on (-1, 1): as many as a batch holds.
constexpr std::array<double, 4> gauss_nodes = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                               0.9602898564975363};
constexpr std::array<double, 4> gauss_weights = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                                 0.1012285362903763};
constexpr double least_distance = 1.6;      // of a singularity from an interval's middle, in half lengths
constexpr double shortest_interval = 2e-3;  // of the edge: what is left is of the order of its square
constexpr double coplanar = 1e-11;          // of the radii
constexpr double far_common_line = 1e5;     // radii

/// Where, along an edge, the other triangle's potential is singular: at a place along the line and as far off
/// it as the closest approach.
struct Singularity {
    double place;
    double distance;
};

struct Singularities {
    std::array<Singularity, 6> list;
    std::size_t count = 0;

    void add(double place, double distance) { list[count++] = {place, distance}; }
};

struct Edge {
    Vector3d start;
    Vector3d tangent;
    double length;
};

/// Returns the singularities of a triangle's potential along an edge: its corners and, where the edge passes
/// them within their length, its own edges.
Singularities singularities(const Edge& edge, const FlatTriangle& other) {
    Singularities found;
    for (const Vector3d& corner : other.corners) {
        const Vector3d arm = corner - edge.start;
        const double place = arm.dot(edge.tangent);
        found.add(place, (arm - place * edge.tangent).norm());
    }
    for (std::size_t e = 0; e < 3; ++e) {
        const Vector3d arm = other.corners[e] - edge.start;
        const Vector3d across = edge.tangent.cross(other.tangents[e]);
        const double sine_squared = across.squaredNorm();
        if (sine_squared < 1e-16) continue;  // parallel: the potential is as smooth as far from it
        const double place = arm.cross(other.tangents[e]).dot(across) / sine_squared;
        const double there = arm.cross(edge.tangent).dot(across) / sine_squared;
        if (there < -0.2 * other.lengths[e] || there > 1.2 * other.lengths[e]) continue;
        found.add(place, std::abs(arm.dot(across)) / sine_squared);
    }
    return found;
}

/// Calls rule(middle, half) for intervals that make up (0, length), each a few half lengths away from all
/// singularities or very short.
template <typename Rule>
void on_graded_intervals(const Singularities& singular, double length, const Rule& rule) {
    struct Interval {
        double begin;
        double end;
    };
    std::array<Interval, 128> stack;
    std::size_t top = 0;
    stack[top++] = {0.0, length};
    while (top > 0) {
        const auto [begin, end] = stack[--top];
        const double middle = 0.5 * (begin + end);
        const double half = 0.5 * (end - begin);
        double nearest = least_distance;
        double split = middle;
        for (std::size_t k = 0; k < singular.count; ++k) {
            const auto& [place, distance] = singular.list[k];
            const double away = std::sqrt((place - middle) * (place - middle) + distance * distance) / half;
            if (away >= nearest) continue;
            nearest = away;
            const double inside = (place - begin) / (end - begin);
            if (inside > 0.05 && inside < 0.95) {
                split = place;
            } else {
                split = inside <= 0.05 ? begin + 0.25 * (end - begin) : end - 0.25 * (end - begin);
            }
        }
        if (nearest >= least_distance || end - begin < shortest_interval * length || top + 2 > stack.size()) {
            rule(middle, half);
        } else {
            stack[top++] = {begin, split};
            stack[top++] = {split, end};
        }
    }
}

void set_gauss_points(const Edge& edge, double middle, double half, PointBatch& points) {
    for (std::size_t k = 0; k < 4; ++k) {
        points.set(k, edge.start + (middle + half * gauss_nodes[k]) * edge.tangent);
        points.set(k + 4, edge.start + (middle - half * gauss_nodes[k]) * edge.tangent);
    }
}

double gauss_sum(const ValueBatch& batch) {
    double sum = 0.0;
    for (std::size_t k = 0; k < 4; ++k) sum += gauss_weights[k] * (batch.values[k] + batch.values[k + 4]);
    return sum;
}

/// Returns the integral along the edge of the triangle's potential.
double potential_along(const Edge& edge, const FlatTriangle& triangle) {
    double sum = 0.0;
    PointBatch points;
    on_graded_intervals(singularities(edge, triangle), edge.length, [&](double middle, double half) {
        set_gauss_points(edge, middle, half, points);
        sum += half * gauss_sum(uniform_potential(triangle, points));
    });
    return sum;
}

Edge edge_of(const FlatTriangle& triangle, std::size_t e) {
    return {triangle.corners[e], triangle.tangents[e], triangle.lengths[e]};
}

/// Returns half of the homogeneous formula: the edges of `first` in the potential of `second`.
double edges_in_potential(const FlatTriangle& first, const FlatTriangle& second, const Vector3d& origin) {
    double sum = 0.0;
    for (std::size_t e = 0; e < 3; ++e) {
        const double distance = first.outward[e].dot(first.corners[e] - origin);
        if (std::abs(distance) < 1e-14 * first.radius) continue;
        sum += distance * potential_along(edge_of(first, e), second);
    }
    return sum;
}

double homogeneous(const FlatTriangle& first, const FlatTriangle& second, const Vector3d& origin) {
    return (edges_in_potential(first, second, origin) + edges_in_potential(second, first, origin)) / 3.0;
}

/// Integrates over two triangles in parallel planes `height` apart; `second` may be slightly tilted, which is
/// left out.
double parallel(const FlatTriangle& first, const FlatTriangle& second, double height) {
    // Points of the first triangle at the height over the second one's plane, whose own tilt does not count.
    const double side = second.normal.dot(first.centroid - second.centroid) < 0.0 ? -1.0 : 1.0;
    double sum = 0.0;
    PointBatch points;
    for (std::size_t e = 0; e < 3; ++e) {
        const Edge edge = edge_of(first, e);
        on_graded_intervals(singularities(edge, second), edge.length, [&](double middle, double half) {
            set_gauss_points(edge, middle, half, points);
            for (std::size_t k = 0; k < point_batch; ++k) {
                const Vector3d point(points.x[k], points.y[k], points.z[k]);
                const double rise = side * height - second.normal.dot(point - second.centroid);
                points.set(k, point + rise * second.normal);
            }
            sum -= half * gauss_sum(contour_potential(second, first.outward[e], height, points));
        });
    }
    return sum;
}

/// Returns a corner that both triangles have; none: null.
const Vector3d* shared_corner(const FlatTriangle& first, const FlatTriangle& second) {
    for (const Vector3d& a : first.corners) {
        for (const Vector3d& b : second.corners) {
            if (a == b) return &a;
        }
    }
    return nullptr;
}

double largest_offset(const FlatTriangle& first, const FlatTriangle& second) {
    double offset = 0.0;
    for (const Vector3d& corner : first.corners) {
        offset = std::max(offset, std::abs(second.normal.dot(corner - second.centroid)));
    }
    return offset;
}

}  // namespace

double pair_potential(const FlatTriangle& first, const FlatTriangle& second) {
    // From a corner that is common to both, the edges at that corner are at no distance and drop out.
    if (const Vector3d* corner = shared_corner(first, second)) return homogeneous(first, second, *corner);
    const double radius = std::max(first.radius, second.radius);
    const Vector3d middle = 0.5 * (first.centroid + second.centroid);
    if (std::max(largest_offset(first, second), largest_offset(second, first)) < coplanar * radius) {
        return homogeneous(first, second, middle);
    }
    // The point of both planes that is closest to the middle.
    const Vector3d line = first.normal.cross(second.normal);
    const double sine_squared = line.squaredNorm();
    const double to_first = first.normal.dot(first.centroid - middle);
    const double to_second = second.normal.dot(second.centroid - middle);
    const Vector3d origin =
        (to_first * second.normal.cross(line) - to_second * first.normal.cross(line)) / sine_squared;
    if (sine_squared > 1e-24 && origin.norm() < far_common_line * radius) {
        return homogeneous(first, second, middle + origin);
    }
    return parallel(first, second, std::abs(second.normal.dot(first.centroid - second.centroid)));
}

double self_potential(const FlatTriangle& triangle) {
    const auto& [a, b, c] = triangle.lengths;
    const double half = 0.5 * (a + b + c);
    double sum = 0.0;
    for (const double length : triangle.lengths) sum += std::log((half - length) / half) / length;
    return -4.0 / 3.0 * triangle.area * triangle.area * sum;
}

}  // namespace samara
