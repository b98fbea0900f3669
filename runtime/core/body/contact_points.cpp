#include "samara/core/body/contact_points.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>

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
constexpr double vanishing = 12.0;      // widths, at which the weight is 6e-6
constexpr int directions = 512;         // the directions in which corners are sought: 9 degrees apart
constexpr int subdivisions = 16;        // of the map of round points
constexpr std::size_t enough = 20'000;  // vertices to smooth a side over

constexpr std::ptrdiff_t in_box = 16;  // vertices in each box but the last; an even number

/// Vertices with the area of the surface that belongs to each, box by box of neighbours.
struct WeightedPoints {
    Eigen::MatrixX3d points;
    Eigen::VectorXd areas;
    std::vector<std::size_t> turns;   ///< of each point: its place among the vertices
    std::vector<std::size_t> places;  ///< of each vertex: its place among the points
    Eigen::MatrixX3d centers;         ///< of the boxes
    Eigen::MatrixX3d halves;          ///< half the lengths of the boxes
};

/// Distances (m) that points reach along a direction. Of most boxes the bound is enough.
class Reaches {
  public:
    explicit Reaches(const WeightedPoints& points)
        : points_(points), reaches_(points.areas.size()), is_near_(points.turns.size() / 64 + 1) {}

    /// Finds the points that reach `least` or farther, and others of their boxes.
    void find(const Vector3d& direction, double least) {
        bounds_.noalias() = points_.centers * direction;
        bounds_.noalias() += points_.halves * direction.cwiseAbs();
        boxes_.clear();
        farthest_ = -std::numeric_limits<double>::infinity();
        for (Eigen::Index box = 0; box < bounds_.size(); ++box) {
            if (bounds_[box] < least) continue;
            const Eigen::Index first = box * in_box;
            const Eigen::Index count = std::min(in_box, reaches_.size() - first);
            reaches_.segment(first, count).noalias() = points_.points.middleRows(first, count) * direction;
            farthest_ = std::max(farthest_, reaches_.segment(first, count).maxCoeff());
            boxes_.push_back(box);
        }
    }
    /// Returns the farthest of those found; minus infinity where there is none.
    [[nodiscard]] double farthest() const { return farthest_; }
    /// Calls `use` with the place and the reach of those that reach `least`, in the order of the vertices.
    template <typename Use>
    void for_each_from(double least, const Use& use) {
        for (const Eigen::Index box : boxes_) {
            const Eigen::Index first = box * in_box;
            for (Eigen::Index i = first; i < std::min(first + in_box, reaches_.size()); ++i) {
                const std::size_t turn = points_.turns[static_cast<std::size_t>(i)];
                is_near_[turn / 64] |= std::uint64_t{reaches_[i] >= least} << turn % 64;
            }
        }
        for (std::size_t word = 0; word < is_near_.size(); ++word) {
            for (std::uint64_t left = std::exchange(is_near_[word], 0); left != 0; left &= left - 1) {
                const std::size_t turn = 64 * word + static_cast<std::size_t>(std::countr_zero(left));
                const auto place = static_cast<Eigen::Index>(points_.places[turn]);
                use(place, reaches_[place]);
            }
        }
    }

  private:
    const WeightedPoints& points_;
    Eigen::VectorXd reaches_;
    Eigen::VectorXd bounds_;
    std::vector<Eigen::Index> boxes_;  ///< those that were looked into
    std::vector<std::uint64_t> is_near_;
    double farthest_ = 0.0;
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
using CornerReaches = Eigen::Array<double, Eigen::Dynamic, 1, Eigen::ColMajor, most_corners, 1>;

CornerReaches corner_reaches(const ContactPoints& points, const Vector3d& direction) {
    const std::size_t count = points.corners.size();
    CornerReaches reaches(eigen_index(count));
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
        std::size_t farthest = 0;
        double most = -std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < points.size(); ++k) {
            const double along = points[k].dot(direction);
            if (along <= most) continue;
            most = along;
            farthest = k;
        }
        chosen.push_back(farthest);
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

/// Puts the vertices from `first` to before `end` in the order of boxes, by halves along the longest side.
void put_into_boxes(const std::vector<Vector3d>& vertices, std::vector<std::size_t>& order,
                    std::ptrdiff_t first, std::ptrdiff_t end) {
    if (end - first <= in_box) return;
    Vector3d low = vertices[order[static_cast<std::size_t>(first)]];
    Vector3d high = low;
    for (std::ptrdiff_t i = first; i < end; ++i) {
        low = low.cwiseMin(vertices[order[static_cast<std::size_t>(i)]]);
        high = high.cwiseMax(vertices[order[static_cast<std::size_t>(i)]]);
    }
    Eigen::Index axis = 0;
    (high - low).maxCoeff(&axis);
    const std::ptrdiff_t middle = first + (end - first + in_box) / (2 * in_box) * in_box;
    std::nth_element(order.begin() + first, order.begin() + middle, order.begin() + end,
                     [&](std::size_t a, std::size_t b) { return vertices[a][axis] < vertices[b][axis]; });
    put_into_boxes(vertices, order, first, middle);
    put_into_boxes(vertices, order, middle, end);
}

/// Returns `enough` of the vertices, evenly chosen where there are more.
WeightedPoints thinned(const std::vector<Vector3d>& vertices, const std::vector<double>& areas) {
    const std::size_t stride = 1 + vertices.size() / enough;
    const std::size_t count = (vertices.size() + stride - 1) / stride;
    std::vector<std::size_t> order(count);
    for (std::size_t i = 0; i < count; ++i) order[i] = i * stride;
    // Eigen rounds the last of an odd number otherwise than the rest: it stays the last.
    put_into_boxes(vertices, order, 0, static_cast<std::ptrdiff_t>(count - count % 2));
    const auto rows = static_cast<Eigen::Index>(count);
    const Eigen::Index boxes = (rows + in_box - 1) / in_box;
    WeightedPoints result;
    result.points.resize(rows, 3);
    result.areas.resize(rows);
    result.places.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        result.points.row(static_cast<Eigen::Index>(i)) = vertices[order[i]].transpose();
        result.areas[static_cast<Eigen::Index>(i)] = areas[order[i]];
        result.turns.push_back(order[i] / stride);
        result.places[result.turns.back()] = i;
    }
    result.centers.resize(boxes, 3);
    result.halves.resize(boxes, 3);
    for (Eigen::Index i = 0; i < boxes; ++i) {
        const auto within = result.points.middleRows(i * in_box, std::min(in_box, rows - i * in_box));
        result.centers.row(i) = 0.5 * (within.colwise().maxCoeff() + within.colwise().minCoeff());
        result.halves.row(i) = 0.5 * (within.colwise().maxCoeff() - within.colwise().minCoeff());
    }
    return result;
}

/// Returns the mean of the points near the farthest one, weighted by how near they are to it and by their
/// area. `reaches`: of those within `vanishing` widths of it.
Vector3d smoothed_extreme(const WeightedPoints& points, Reaches& reaches, double width) {
    const double farthest = reaches.farthest();
    double weights = 0.0;
    Vector3d sum = Vector3d::Zero();
    reaches.for_each_from(farthest - vanishing * width, [&](Eigen::Index place, double reach) {
        const double weight = points.areas[place] * std::exp((reach - farthest) / width);
        weights += weight;
        sum += weight * points.points.row(place).transpose();
    });
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
    const double rounding = 1e-9 * result.bounding_radius;
    Reaches reaches(points);
    const std::vector<Vector3d> nodes = octahedral_nodes(subdivisions);
    const bool has_round_sides = std::any_of(nodes.begin(), nodes.end(), [&](const Vector3d& direction) {
        const double of_corners = reach_of_corners(result, direction);
        reaches.find(direction, of_corners + width - rounding);
        return of_corners < reaches.farthest() - width;
    });
    if (!has_round_sides) {
        result.middle = mean_of(result);
        return result;
    }
    Vector3d last = vertices.front();  // lies near the farthest point of the next direction
    for (const Vector3d& direction : nodes) {
        reaches.find(direction, last.dot(direction) - vanishing * width - rounding);
        last = smoothed_extreme(points, reaches, width);
        result.round.push_back(last);
        // Beside a sharp edge the smoothed point must stay within the hull, or it would hold the edge up.
        if (!result.corners.empty()) continue;
        result.round.back() += (reaches.farthest() - last.dot(direction)) * direction;
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
        const CornerReaches reaches = corner_reaches(points, direction);
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
