#include "samara/core/body/contact_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "samara/core/surface/octahedral_map.hpp"
#include "samara/core/surface/surface_edges.hpp"

namespace samara {
namespace {

// An edge is sharp from this angle between the normals of its faces (rad): a prism of up to ten sides (0.63)
// has edges, one of more sides is round.
constexpr double sharp = 0.6;
// The width over which facets are smoothed, over the bounding radius, and so the most that a round side
// stands off its place (docs/reference/scene-file.md#ground). The facets of a sphere of 1280 triangles reach
// 0.4 % inwards.
constexpr double smoothing = 0.01;
constexpr int directions = 512;         // the directions in which corners are sought: 9 degrees apart
constexpr int subdivisions = 16;        // of the map of round points
constexpr std::size_t enough = 20'000;  // vertices to smooth a side over

/// Vertices with the area of the surface that belongs to each.
struct WeightedPoints {
    Eigen::MatrixX3d points;
    Eigen::VectorXd areas;
};

std::vector<double> vertex_areas(const Surface& surface) {
    std::vector<double> areas(surface.vertices.size(), 0.0);
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        const double third = area_vector(surface, t).norm() / 3.0;
        for (const auto corner : surface.corners[t]) areas[static_cast<std::size_t>(corner)] += third;
    }
    return areas;
}

/// Returns the vertices at the ends of sharp or open edges.
std::vector<Vector3d> sharp_vertices(const Surface& surface, const Vector3d& origin) {
    std::vector<bool> is_sharp(surface.vertices.size(), false);
    const std::vector<EdgeUse> uses = edge_uses(surface);
    for (const auto& edge : edges_of(uses)) {
        bool smooth = edge.size() == 2;
        if (smooth) {
            const Vector3d a = area_vector(surface, static_cast<std::size_t>(edge[0].triangle));
            const Vector3d b = area_vector(surface, static_cast<std::size_t>(edge[1].triangle));
            smooth = std::atan2(a.cross(b).norm(), a.dot(b)) <= sharp;
        }
        if (smooth) continue;
        is_sharp[static_cast<std::size_t>(edge[0].low)] = true;
        is_sharp[static_cast<std::size_t>(edge[0].high)] = true;
    }
    std::vector<Vector3d> points;
    for (std::size_t i = 0; i < is_sharp.size(); ++i) {
        if (is_sharp[i]) points.push_back(surface.vertices[i] - origin);
    }
    return points;
}

/// How far each corner reaches along a direction (m).
using Reaches = Eigen::Array<double, Eigen::Dynamic, 1, Eigen::ColMajor, most_corners, 1>;

Reaches corner_reaches(const ContactPoints& points, const Vector3d& direction) {
    const std::size_t count = points.corners.size();
    Reaches reaches(eigen_index(count));
    const double* const coordinates = points.corners.data()->data();
    double* const to = reaches.data();
    const double x = direction.x();
    const double y = direction.y();
    const double z = direction.z();
    // Without a branch, so that the compiler takes several corners at once.
    for (std::size_t i = 0; i < count; ++i) {
        const double* const corner = coordinates + 3 * i;
        to[i] = corner[0] * x + corner[1] * y + corner[2] * z;
    }
    return reaches;
}

/// Returns how far the farthest corner reaches along a direction.
double reach_of_corners(const ContactPoints& points, const Vector3d& direction) {
    if (points.corners.empty()) return -std::numeric_limits<double>::infinity();
    return corner_reaches(points, direction).maxCoeff();
}

Vector3d mean_of(const ContactPoints& points) {
    Vector3d sum = Vector3d::Zero();
    for (const Vector3d& point : points.corners) sum += point;
    for (const Vector3d& point : points.round) sum += point;
    return sum / static_cast<double>(points.corners.size() + points.round.size());
}

/// Returns a direction of a set that is evenly spread over the sphere: a spiral with the golden angle between
/// neighbours.
Vector3d spiral_direction(int index) {
    const double z = 1.0 - (2.0 * index + 1.0) / directions;
    const double angle = index * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double radius = std::sqrt(1.0 - z * z);
    return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// Returns the points that reach farthest in some direction.
std::vector<Vector3d> extreme_points(const std::vector<Vector3d>& points) {
    std::vector<std::size_t> chosen;
    if (points.empty()) return {};
    for (int i = 0; i < directions; ++i) {
        const Vector3d direction = spiral_direction(i);
        const auto farthest = std::max_element(
            points.begin(), points.end(),
            [&](const Vector3d& a, const Vector3d& b) { return a.dot(direction) < b.dot(direction); });
        chosen.push_back(static_cast<std::size_t>(farthest - points.begin()));
    }
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    std::vector<Vector3d> extreme;
    extreme.reserve(chosen.size());
    for (const std::size_t i : chosen) extreme.push_back(points[i]);
    return extreme;
}

/// Returns `most_corners` of the points, each the farthest from those before it.
std::vector<Vector3d> well_spread(const std::vector<Vector3d>& points) {
    if (points.size() <= most_corners) return points;
    std::vector<double> distance(points.size(), std::numeric_limits<double>::infinity());
    std::vector<Vector3d> spread;
    std::size_t next = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        if (points[i].squaredNorm() > points[next].squaredNorm()) next = i;
    }
    while (spread.size() < most_corners) {
        spread.push_back(points[next]);
        for (std::size_t i = 0; i < points.size(); ++i) {
            distance[i] = std::min(distance[i], (points[i] - spread.back()).squaredNorm());
        }
        next =
            static_cast<std::size_t>(std::max_element(distance.begin(), distance.end()) - distance.begin());
    }
    return spread;
}

/// Returns `enough` of the vertices, evenly chosen where there are more.
WeightedPoints thinned(const std::vector<Vector3d>& vertices, const std::vector<double>& areas) {
    const std::size_t stride = 1 + vertices.size() / enough;
    const auto count = static_cast<Eigen::Index>((vertices.size() + stride - 1) / stride);
    WeightedPoints result{Eigen::MatrixX3d(count, 3), Eigen::VectorXd(count)};
    for (Eigen::Index i = 0; i < count; ++i) {
        const std::size_t vertex = static_cast<std::size_t>(i) * stride;
        result.points.row(i) = vertices[vertex].transpose();
        result.areas[i] = areas[vertex];
    }
    return result;
}

/// Returns the mean of the points near the farthest one, weighted by how near they are to it and by their
/// area. `reaches`: of the points along the direction.
Vector3d smoothed_extreme(const WeightedPoints& points, const Eigen::VectorXd& reaches, double width) {
    constexpr double vanishing = 12.0;  // widths, at which the weight is 6e-6
    const double farthest = reaches.maxCoeff();
    const double nearest = farthest - vanishing * width;
    double weights = 0.0;
    Vector3d sum = Vector3d::Zero();
    for (Eigen::Index i = 0; i < reaches.size(); ++i) {
        if (reaches[i] < nearest) continue;
        const double weight = points.areas[i] * std::exp((reaches[i] - farthest) / width);
        weights += weight;
        sum += weight * points.points.row(i).transpose();
    }
    return sum / weights;
}

}  // namespace

ContactPoints contact_points(const Surface& surface, const Vector3d& center_of_mass) {
    ContactPoints result;
    std::vector<Vector3d> vertices = surface.vertices;
    for (Vector3d& vertex : vertices) {
        vertex -= center_of_mass;
        result.bounding_radius = std::max(result.bounding_radius, vertex.norm());
    }
    result.corners = well_spread(extreme_points(sharp_vertices(surface, center_of_mass)));

    const WeightedPoints points = thinned(vertices, vertex_areas(surface));
    const double width = smoothing * result.bounding_radius;
    Eigen::VectorXd reaches(points.areas.size());
    const std::vector<Vector3d> nodes = octahedral_nodes(subdivisions);
    const bool has_round_sides = std::any_of(nodes.begin(), nodes.end(), [&](const Vector3d& direction) {
        reaches.noalias() = points.points * direction;
        return reach_of_corners(result, direction) < reaches.maxCoeff() - width;
    });
    if (!has_round_sides) {
        result.middle = mean_of(result);
        return result;
    }
    for (const Vector3d& direction : nodes) {
        reaches.noalias() = points.points * direction;
        Vector3d point = smoothed_extreme(points, reaches, width);
        // Beside a sharp edge the smoothed point must stay within the hull, or it would hold the edge up.
        if (result.corners.empty()) point += (reaches.maxCoeff() - point.dot(direction)) * direction;
        result.round.push_back(point);
    }
    result.middle = mean_of(result);
    return result;
}

Vector3d lowest_round_point(const ContactPoints& points, const Vector3d& down) noexcept {
    constexpr std::size_t size = 2 * subdivisions + 1;
    const OctahedralCell cell = octahedral_cell(subdivisions, down);
    const Vector3d* first =
        &points.round[static_cast<std::size_t>(cell.row) * size + static_cast<std::size_t>(cell.column)];
    const double s = cell.column_fraction;
    return (1.0 - cell.row_fraction) * ((1.0 - s) * first[0] + s * first[1]) +
           cell.row_fraction * ((1.0 - s) * first[size] + s * first[size + 1]);
}

Vector3d farthest_point(const ContactPoints& points, const Vector3d& direction) noexcept {
    Vector3d farthest = Vector3d::Zero();
    double most = -std::numeric_limits<double>::infinity();
    if (!points.corners.empty()) {
        const Reaches reaches = corner_reaches(points, direction);
        most = reaches.maxCoeff();
        const auto found = std::find(reaches.begin(), reaches.end(), most);
        if (found != reaches.end())
            farthest = points.corners[static_cast<std::size_t>(found - reaches.begin())];
    }
    if (points.round.empty()) return farthest;
    const Vector3d round = lowest_round_point(points, direction);
    return round.dot(direction) > most ? round : farthest;
}

double reach(const ContactPoints& points, const Vector3d& direction) noexcept {
    double farthest = reach_of_corners(points, direction);
    if (!points.round.empty())
        farthest = std::max(farthest, lowest_round_point(points, direction).dot(direction));
    return farthest;
}

}  // namespace samara
