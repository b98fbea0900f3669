#include "samara/core/collision/obstacle_set.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "samara/core/base/numbers.hpp"
#include "samara/core/surface/surface_edges.hpp"

namespace samara {
namespace {

// The sine of the angle from which an edge is not flat: meshes of a plane are far flatter, and no mesh
// of a curve is so fine.
constexpr double flat_edge = 1e-6;

double radius_of(const Surface& surface) {
    double radius = 0.0;
    for (const Vector3d& vertex : surface.vertices) radius = std::max(radius, vertex.norm());
    return radius;
}

}  // namespace

ObstacleFaces::ObstacleFaces(Obstacle obstacle) : obstacle_(std::move(obstacle)) {
    prepare_triangles();
    look_around_corners();
    grow_tree();
    set_keys(std::move(obstacle_.keys));
}

void ObstacleFaces::set_keys(std::vector<ObstacleKey> keys) {
    for (std::size_t i = 1; i < keys.size(); ++i) {
        Quaterniond& orientation = keys[i].orientation;
        if (orientation.dot(keys[i - 1].orientation) < 0.0) orientation.coeffs() *= -1.0;
    }
    obstacle_.keys = std::move(keys);
    measure_displacements();
}

void ObstacleFaces::prepare_triangles() {
    const Surface& surface = obstacle_.surface;
    const auto others = neighbours(surface);
    is_closed_ = true;
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        ObstacleTriangle& triangle = triangles_.emplace_back();
        triangle.index = static_cast<std::int32_t>(t);
        for (std::size_t i = 0; i < 3; ++i) {
            triangle.corners[i] = surface.vertices[as_index(surface.corners[t][i])];
        }
        triangle.normal = area_vector(surface, t).normalized();
        for (std::size_t i = 0; i < 3; ++i) {
            triangle.beyond[i] = triangle.corners[i];
            triangle.stands_out[i] = true;
            if (others[t][i] < 0) {
                is_closed_ = false;
                continue;
            }
            const std::size_t other = as_index(others[t][i]);
            for (const std::int32_t corner : surface.corners[other]) {
                if (corner == surface.corners[t][i] || corner == surface.corners[t][(i + 1) % 3]) continue;
                triangle.beyond[i] = surface.vertices[as_index(corner)];
            }
            triangle.stands_out[i] =
                triangle.normal.cross(area_vector(surface, other).normalized()).norm() > flat_edge;
        }
    }
}

void ObstacleFaces::look_around_corners() {
    const Surface& surface = obstacle_.surface;
    std::vector<std::vector<std::int32_t>> others(surface.vertices.size());
    for (const auto& corners : surface.corners) {
        for (std::size_t i = 0; i < 3; ++i) {
            auto& known = others[as_index(corners[i])];
            known.insert(known.end(), {corners[(i + 1) % 3], corners[(i + 2) % 3]});
        }
    }
    std::vector<std::size_t> first(1, 0);
    for (std::size_t i = 0; i < others.size(); ++i) {
        std::sort(others[i].begin(), others[i].end());
        others[i].erase(std::unique(others[i].begin(), others[i].end()), others[i].end());
        for (const std::int32_t other : others[i]) {
            around_.push_back((surface.vertices[as_index(other)] - surface.vertices[i]).normalized());
        }
        first.push_back(around_.size());
    }
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t corner = as_index(surface.corners[t][i]);
            triangles_[t].around[i] =
                std::span<const Vector3d>(around_).subspan(first[corner], first[corner + 1] - first[corner]);
        }
    }
}

void ObstacleFaces::grow_tree() {
    std::vector<BoxTree::Box> boxes;
    std::vector<Vector3d> middles;
    for (const ObstacleTriangle& triangle : triangles_) {
        const auto& [a, b, c] = triangle.corners;
        boxes.emplace_back(a);
        boxes.back().extend(b).extend(c);
        middles.emplace_back((a + b + c) / 3.0);
    }
    std::vector<std::uint32_t> order;
    tree_ = BoxTree(boxes, middles, order);
    std::vector<ObstacleTriangle> ordered;
    ordered.reserve(order.size());
    for (const std::uint32_t number : order) ordered.push_back(triangles_[number]);
    triangles_ = std::move(ordered);
}

void ObstacleFaces::remove() {
    is_removed_ = true;
    obstacle_.keys.resize(1);
    measure_displacements();
}

void ObstacleFaces::measure_displacements() {
    const auto& keys = obstacle_.keys;
    whereabouts_.setEmpty();
    fastest_ = 0.0;
    if (is_removed_) return;
    if (!obstacle_.moves()) {
        for (const Vector3d& vertex : obstacle_.surface.vertices) whereabouts_.extend(keys[0](vertex));
        return;
    }
    const double radius = radius_of(obstacle_.surface);
    for (const ObstacleKey& key : keys) {
        whereabouts_.extend(key.position + Vector3d::Constant(radius));
        whereabouts_.extend(key.position - Vector3d::Constant(radius));
    }
    for (std::size_t i = 1; i < keys.size(); ++i) {
        const double distance = (keys[i].position - keys[i - 1].position).norm() +
                                radius * keys[i].orientation.angularDistance(keys[i - 1].orientation);
        fastest_ = std::max(fastest_, distance / (keys[i].time - keys[i - 1].time));
    }
}

bool ObstacleFaces::encloses(const Vector3d& point) const noexcept {
    // The solid angle of all faces: van Oosterom and Strackee, IEEE Transactions on Biomedical Engineering
    // 30(2), 1983.
    double angle = 0.0;
    for (const ObstacleTriangle& triangle : triangles_) {
        const Vector3d a = triangle.corners[0] - point;
        const Vector3d b = triangle.corners[1] - point;
        const Vector3d c = triangle.corners[2] - point;
        angle += 2.0 * std::atan2(a.dot(b.cross(c)), a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() +
                                                         b.dot(c) * a.norm() + c.dot(a) * b.norm());
    }
    return std::abs(angle) > 2.0 * std::numbers::pi;
}

ObstacleSet::ObstacleSet(const std::vector<Obstacle>& obstacles) {
    for (const Obstacle& obstacle : obstacles) add(obstacle);
}

void ObstacleSet::add(Obstacle obstacle) {
    obstacles_.emplace_back(std::move(obstacle));
    measure();
}

void ObstacleSet::set_keys(std::size_t index, std::vector<ObstacleKey> keys) {
    obstacles_[index].set_keys(std::move(keys));
    measure();
}

void ObstacleSet::remove(std::size_t index) {
    obstacles_[index].remove();
    measure();
}

void ObstacleSet::measure() {
    whereabouts_.setEmpty();
    fastest_ = 0.0;
    for (const ObstacleFaces& faces : obstacles_) {
        fastest_ = std::max(fastest_, faces.fastest());
        whereabouts_.extend(faces.whereabouts());
    }
}

double distance_from(const ObstacleSet& obstacles, const Vector3d& place, double time,
                     double within) noexcept {
    double distance = within;
    for (const ObstacleFaces& faces : obstacles.obstacles()) {
        if (faces.whereabouts().squaredExteriorDistance(place) >= distance * distance) continue;
        const ObstaclePlace at = place_of(faces.obstacle(), time);
        const Vector3d point = at.orientation.conjugate() * (place - at.position);
        const Vector3d reach = Vector3d::Constant(distance);
        faces.visit_near({point - reach, point + reach}, [&](const ObstacleTriangle& triangle) {
            const auto& [a, b, c] = triangle.corners;
            distance = std::min(distance, (closest_point_of_triangle(point, a, b, c) - point).norm());
        });
        if (faces.is_closed() && faces.encloses(point)) return 0.0;
    }
    return distance;
}

}  // namespace samara
