#include "meshes/checks/triangle_fans.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>

#include "samara/core/base/numbers.hpp"

namespace samara {
namespace {

bool has_corner(const TriangleFans::Triangle& triangle, std::int32_t vertex) {
    return std::find(triangle.begin(), triangle.end(), vertex) != triangle.end();
}

}  // namespace

double triangle_quality(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const double squares = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
    return 2.0 * std::sqrt(3.0) * (b - a).cross(c - a).norm() / squares;
}

TriangleFans::TriangleFans(std::vector<Vector3d> corners, std::vector<Triangle> faces)
    : vertices(std::move(corners)), triangles(std::move(faces)) {}

Vector3d TriangleFans::area_vector_of(const Triangle& triangle) const {
    const Vector3d& a = vertex(triangle[0]);
    return 0.5 * (vertex(triangle[1]) - a).cross(vertex(triangle[2]) - a);
}

void TriangleFans::gather() {
    std::erase_if(triangles, [](const Triangle& triangle) { return triangle[0] < 0; });
    first_around_.assign(vertices.size() + 1, 0);
    for (const Triangle& triangle : triangles) {
        for (const std::int32_t corner : triangle) ++first_around_[as_index(corner) + 1];
    }
    std::partial_sum(first_around_.begin(), first_around_.end(), first_around_.begin());
    around_.resize(3 * triangles.size());
    std::vector<std::uint32_t> next(first_around_.begin(), first_around_.end() - 1);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (const std::int32_t corner : triangles[t]) {
            around_[next[as_index(corner)]++] = static_cast<std::uint32_t>(t);
        }
    }
    locked_.assign(vertices.size(), false);
}

void TriangleFans::gather_ring(std::size_t v, std::vector<std::int32_t>& ring) const {
    // On a closed surface each neighbour follows v in one triangle.
    ring.clear();
    for (const std::uint32_t* t = begin_around(v); t != end_around(v); ++t) {
        const Triangle& triangle = triangles[*t];
        for (std::size_t corner = 0; corner < 3; ++corner) {
            if (as_index(triangle[corner]) == v) ring.push_back(triangle[(corner + 1) % 3]);
        }
    }
}

bool TriangleFans::keeps_topology(const std::vector<std::int32_t>& ring,
                                  const std::vector<std::int32_t>& other) const {
    int shared = 0;
    for (const std::int32_t v : ring) {
        if (std::find(other.begin(), other.end(), v) == other.end()) continue;
        if (++shared > 2 || end_around(as_index(v)) - begin_around(as_index(v)) <= 3) return false;
    }
    return shared == 2 && ring.size() + other.size() > 7;
}

bool TriangleFans::keeps_shape(std::size_t v, std::int32_t target, double least_cosine, double least) const {
    for (const std::uint32_t* t = begin_around(v); t != end_around(v); ++t) {
        const Triangle& triangle = triangles[*t];
        if (has_corner(triangle, target)) continue;
        Triangle moved = triangle;
        std::replace(moved.begin(), moved.end(), static_cast<std::int32_t>(v), target);
        const Vector3d before = area_vector_of(triangle);
        const Vector3d after = area_vector_of(moved);
        if (!(before.dot(after) > least_cosine * before.norm() * after.norm())) return false;
        if (triangle_quality(vertex(moved[0]), vertex(moved[1]), vertex(moved[2])) < least) return false;
    }
    return true;
}

double TriangleFans::worst_quality(std::size_t v) const {
    double worst = 1.0;
    for (const std::uint32_t* t = begin_around(v); t != end_around(v); ++t) {
        const auto& [a, b, c] = triangles[*t];
        worst = std::min(worst, triangle_quality(vertex(a), vertex(b), vertex(c)));
    }
    return worst;
}

void TriangleFans::collapse_into(std::size_t v, std::int32_t target) {
    for (const std::uint32_t* t = begin_around(v); t != end_around(v); ++t) {
        Triangle& triangle = triangles[*t];
        for (const std::int32_t corner : triangle) lock(corner);
        if (has_corner(triangle, target)) {
            triangle = {-1, -1, -1};
        } else {
            std::replace(triangle.begin(), triangle.end(), static_cast<std::int32_t>(v), target);
        }
    }
}

}  // namespace samara
