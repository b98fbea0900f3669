#include "meshes/remeshing/smooth_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>
#include <Eigen/QR>

#include "samara/core/base/numbers.hpp"
#include "samara/core/surface/surface_edges.hpp"

namespace samara {
namespace {

using Triangle = TriangleTree::Triangle;

constexpr std::int32_t none = -1;
constexpr std::int32_t many = -2;

std::vector<Triangle> crease_segments(const Surface& flat, double crease_angle) {
    std::vector<Triangle> segments;
    const double least_cosine = std::cos(crease_angle);
    const std::vector<EdgeUse> uses = edge_uses(flat);
    for (const auto& edge : edges_of(uses)) {
        const Vector3d first = area_vector(flat, as_index(edge.front().triangle));
        const Vector3d second = area_vector(flat, as_index(edge.back().triangle));
        if (first.dot(second) >= least_cosine * first.norm() * second.norm()) continue;
        segments.push_back({edge.front().low, edge.front().high, edge.front().high});
    }
    return segments;
}

// Returns the barycentric coordinates of a point of the triangle.
Vector3d weights_in(const TriangleTree& tree, std::size_t triangle, const Vector3d& point) {
    const Vector3d& a = tree.corner(triangle, 0);
    const Vector3d ab = tree.corner(triangle, 1) - a;
    const Vector3d ac = tree.corner(triangle, 2) - a;
    const Vector3d normal = ab.cross(ac);
    const double v = normal.dot(ab.cross(point - a)) / normal.squaredNorm();
    const double u = normal.dot((point - a).cross(ac)) / normal.squaredNorm();
    return {1.0 - u - v, u, v};
}

}  // namespace

SmoothShape::SmoothShape(const Surface& flat, double crease_angle)
    : flat_(flat),
      crease_angle_(crease_angle),
      least_smooth_cosine_(std::cos(0.5 * crease_angle)),
      triangles_(flat.vertices, flat.corners),
      creases_(flat.vertices, crease_segments(flat, crease_angle)),
      normals_(3 * flat.corners.size()),
      has_normals_(flat.vertices.size(), false) {
    gather_triangles_around();
    gather_crease_neighbours();
}

void SmoothShape::gather_triangles_around() {
    first_around_.assign(flat_.vertices.size() + 1, 0);
    for (const Triangle& triangle : flat_.corners) {
        for (const std::int32_t corner : triangle) ++first_around_[as_index(corner) + 1];
    }
    std::partial_sum(first_around_.begin(), first_around_.end(), first_around_.begin());
    around_.resize(3 * flat_.corners.size());
    std::vector<std::uint32_t> next(first_around_.begin(), first_around_.end() - 1);
    for (std::size_t t = 0; t < flat_.corners.size(); ++t) {
        for (const std::int32_t corner : flat_.corners[t]) {
            around_[next[as_index(corner)]++] = static_cast<std::uint32_t>(t);
        }
    }
}

void SmoothShape::gather_crease_neighbours() {
    crease_neighbours_.assign(flat_.vertices.size(), {none, none});
    for (const Triangle& segment : creases_.triangles()) {
        for (const auto& [from, to] :
             {std::pair{segment[0], segment[1]}, std::pair{segment[1], segment[0]}}) {
            auto& [one, two] = crease_neighbours_[as_index(from)];
            if (one == none) {
                one = to;
            } else {
                two = two == none ? to : many;
            }
        }
    }
}

// Returns the unit normal of the smooth surface at the triangle's corner, on its side of any crease.
const Vector3d& SmoothShape::normal_at(std::size_t triangle, std::size_t corner) const {
    const std::size_t vertex = as_index(flat_.corners[triangle][corner]);
    if (!has_normals_[vertex]) find_normals(vertex);
    return normals_[3 * triangle + corner];
}

// Finds the normals of all corners at the vertex: creases divide the ordered triangles around it into sides,
// each with one normal.
void SmoothShape::find_normals(std::size_t vertex) const {
    struct Corner {
        std::size_t triangle;
        std::size_t place;  // of the vertex among the triangle's corners
        std::int32_t next;  // the vertex after it
        std::int32_t last;
        Vector3d area;
    };
    std::vector<Corner> fan;
    for (std::uint32_t i = first_around_[vertex]; i < first_around_[vertex + 1]; ++i) {
        const Triangle& corners = flat_.corners[around_[i]];
        const auto place = static_cast<std::size_t>(
            std::find(corners.begin(), corners.end(), static_cast<std::int32_t>(vertex)) - corners.begin());
        fan.push_back({around_[i], place, corners[(place + 1) % 3], corners[(place + 2) % 3],
                       area_vector(flat_, around_[i])});
    }
    std::sort(fan.begin(), fan.end(), [](const Corner& a, const Corner& b) { return a.next < b.next; });
    const auto after = [&](std::size_t i) {
        const auto found = std::lower_bound(fan.begin(), fan.end(), fan[i].last,
                                            [](const Corner& a, std::int32_t next) { return a.next < next; });
        return found != fan.end() && found->next == fan[i].last
                   ? static_cast<std::size_t>(found - fan.begin())
                   : fan.size();
    };
    const auto is_smooth = [&](std::size_t one, std::size_t two) {
        const Vector3d& first = fan[one].area;
        const Vector3d& second = fan[two].area;
        return first.dot(second) >= least_smooth_cosine_ * first.norm() * second.norm();
    };
    // The triangles in order around the vertex, starting behind a crease where there is one.
    std::vector<std::size_t> order;
    std::vector<bool> begins_side;
    std::size_t start = 0;
    std::vector<bool> seen(fan.size(), false);
    const auto walk = [&](std::size_t from) {
        order.clear();
        std::fill(seen.begin(), seen.end(), false);
        for (std::size_t i = from; i < fan.size() && !seen[i]; i = after(i)) {
            seen[i] = true;
            order.push_back(i);
        }
    };
    walk(start);
    for (std::size_t k = 0; k < order.size(); ++k) {
        const std::size_t next = order[(k + 1) % order.size()];
        if (!is_smooth(order[k], next)) {
            start = next;
            break;
        }
    }
    walk(start);
    for (std::size_t begin = 0; begin < order.size();) {
        std::size_t end = begin + 1;
        while (end < order.size() && is_smooth(order[end - 1], order[end])) ++end;
        std::vector<std::size_t> side;
        Vector3d sum = Vector3d::Zero();
        for (std::size_t k = begin; k < end; ++k) {
            const Corner& corner = fan[order[k]];
            const Vector3d one = flat_.vertices[as_index(corner.next)] - flat_.vertices[vertex];
            const Vector3d two = flat_.vertices[as_index(corner.last)] - flat_.vertices[vertex];
            sum += one.cross(two) / (one.squaredNorm() * two.squaredNorm());
            side.push_back(corner.triangle);
        }
        Vector3d normal = sum.normalized();
        if (side.size() == fan.size() && side.size() >= 5) normal = fitted_normal(side, vertex, normal);
        for (std::size_t k = begin; k < end; ++k) {
            normals_[3 * fan[order[k]].triangle + fan[order[k]].place] = normal;
        }
        begin = end;
    }
    has_normals_[vertex] = true;
}

// Returns the normal of the quadratic surface through the vertex that fits its neighbours best; `normal` is
// an approximation.
Vector3d SmoothShape::fitted_normal(const std::vector<std::size_t>& around, std::size_t vertex,
                                    const Vector3d& normal) const {
    const Vector3d x = normal.unitOrthogonal();
    const Vector3d y = normal.cross(x);
    const auto count = static_cast<Eigen::Index>(around.size());
    Eigen::Matrix<double, Eigen::Dynamic, 5> terms(count, 5);
    Eigen::VectorXd heights(count);
    double length = 0.0;
    for (Eigen::Index i = 0; i < count; ++i) {
        const Triangle& corners = flat_.corners[around[static_cast<std::size_t>(i)]];
        const auto at = static_cast<std::size_t>(
            std::find(corners.begin(), corners.end(), static_cast<std::int32_t>(vertex)) - corners.begin());
        const Vector3d offset = flat_.vertices[as_index(corners[(at + 1) % 3])] - flat_.vertices[vertex];
        if (i == 0) length = offset.norm();
        const double u = offset.dot(x) / length;
        const double v = offset.dot(y) / length;
        terms.row(i) << u, v, u * u, u * v, v * v;
        heights[i] = offset.dot(normal) / length;
    }
    const Eigen::Matrix<double, 5, 1> fit = terms.colPivHouseholderQr().solve(heights);
    const Vector3d fitted = (normal - fit[0] * x - fit[1] * y).normalized();
    // The fit is not trusted where the neighbours are noisy or lie on a conic.
    constexpr double least_cosine = 0.95;
    return fitted.dot(normal) > least_cosine ? fitted : normal;
}

// Returns the unit tangent of the crease at an end of the segment: that of the circle through its neighbours,
// or along the segment where creases join, end or bend.
Vector3d SmoothShape::tangent_at(std::size_t segment, int end) const {
    const Vector3d& here = creases_.corner(segment, end);
    const Vector3d along = (creases_.corner(segment, 1 - end) - here).normalized();
    const auto& [one, two] = crease_neighbours_[as_index(creases_.triangles()[segment][as_index(end)])];
    if (one < 0 || two < 0) return along;
    const Vector3d before = here - flat_.vertices[as_index(one)];
    const Vector3d after = flat_.vertices[as_index(two)] - here;
    if (before.dot(after) < least_smooth_cosine_ * before.norm() * after.norm()) return along;
    return (before / before.squaredNorm() + after / after.squaredNorm()).normalized();
}

std::optional<Vector3d> SmoothShape::on_surface(const Vector3d& point, const Vector3d& normal) const {
    const TriangleTree::Nearest nearest = triangles_.nearest(point);
    const std::size_t t = nearest.triangle;
    if (!(area_vector(flat_, t).dot(normal) > 0.0)) return std::nullopt;
    const Vector3d weights = weights_in(triangles_, t, nearest.point);
    Vector3d lifted = nearest.point;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector3d& plane = normal_at(t, i);
        const Vector3d from_corner = nearest.point - triangles_.corner(t, static_cast<int>(i));
        lifted -= 0.5 * weights[static_cast<Eigen::Index>(i)] * from_corner.dot(plane) * plane;
    }
    return lifted;
}

std::optional<Vector3d> SmoothShape::on_crease(const Vector3d& point, double bound) const {
    const TriangleTree::Nearest nearest = creases_.nearest(point, bound);
    if (!std::isfinite(nearest.squared_distance)) return std::nullopt;
    const std::size_t s = nearest.triangle;
    const Vector3d& from = creases_.corner(s, 0);
    const Vector3d& to = creases_.corner(s, 1);
    const double place = (nearest.point - from).norm() / (to - from).norm();
    Vector3d lifted = nearest.point;
    for (const int end : {0, 1}) {
        const Vector3d tangent = tangent_at(s, end);
        const Vector3d from_end = nearest.point - creases_.corner(s, end);
        const Vector3d off = tangent * tangent.dot(from_end) - from_end;
        lifted += 0.5 * (end == 0 ? 1.0 - place : place) * off;
    }
    return lifted;
}

namespace {

constexpr int samples = 9;                 // sampled points of the surface, besides the ends
constexpr double weight_of_ends = 10.0;    // the heights of the ends are exact
constexpr double weight_of_middle = 0.01;  // where the surface is flat, the normals do not determine the node
constexpr int most_steps = 5;
constexpr int steps_to_place = 2;
constexpr double most_astray = 0.25;   // distance from the chord's middle, relative to its length
constexpr double least_change = 1e-6;  // between the normals at the ends

/// The surface as a cubic height function over the edge, which lies from (-1/2, 0) to (1/2, 0). The y^3 term
/// is left out, since it would rotate all normals alike.
struct Height {
    static constexpr int terms = 9;
    Eigen::Matrix<double, terms, 1> coefficients;

    static Eigen::Matrix<double, 1, terms> monomials(double x, double y) {
        Eigen::Matrix<double, 1, terms> row;
        row << 1.0, x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y;
        return row;
    }
    [[nodiscard]] Eigen::Vector2d slope(double x, double y) const {
        const auto& c = coefficients;
        return {c[1] + 2.0 * c[3] * x + c[4] * y + 3.0 * c[6] * x * x + 2.0 * c[7] * x * y + c[8] * y * y,
                c[2] + c[4] * x + 2.0 * c[5] * y + c[7] * x * x + 2.0 * c[8] * x * y};
    }
    [[nodiscard]] Eigen::Matrix2d bend(double x, double y) const {
        const auto& c = coefficients;
        const double mixed = c[4] + 2.0 * c[7] * x + 2.0 * c[8] * y;
        return (Eigen::Matrix2d() << 2.0 * c[3] + 6.0 * c[6] * x + 2.0 * c[7] * y, mixed, mixed,
                2.0 * c[5] + 2.0 * c[8] * x)
            .finished();
    }
};

/// Gauss-Newton iteration from the middle. A normal lies between those at the ends where its slope is on the
/// line through theirs.
std::optional<Eigen::Vector2d> place_of_middle(const Height& height) {
    const Eigen::Vector2d first = height.slope(-0.5, 0.0);
    const Eigen::Vector2d change = height.slope(0.5, 0.0) - first;
    Eigen::Vector2d across(-change.y(), change.x());
    across = change.norm() > least_change ? Eigen::Vector2d(across / change.norm()) : Eigen::Vector2d::Zero();
    Eigen::Vector2d place = Eigen::Vector2d::Zero();
    for (int step = 0; step < most_steps; ++step) {
        const Eigen::Vector2d slope = height.slope(place.x(), place.y());
        const Eigen::Matrix2d bend = height.bend(place.x(), place.y());
        Eigen::Matrix<double, 4, 2> jacobian;
        jacobian << bend.row(0), across.transpose() * bend, weight_of_middle * Eigen::Matrix2d::Identity();
        Eigen::Vector4d residual;
        residual << slope.x(), across.dot(slope - first), weight_of_middle * place;
        const Eigen::Matrix2d normal_matrix = jacobian.transpose() * jacobian;
        place -= normal_matrix.inverse() * (jacobian.transpose() * residual);
        if (!(place.norm() < most_astray)) return std::nullopt;
    }
    return place;
}

}  // namespace

std::optional<Vector3d> middle_on_surface(const std::array<Vector3d, 2>& ends,
                                          const std::array<Vector3d, 2>& across, const LiftedPoint& lifted) {
    const Vector3d middle = 0.5 * (ends[0] + ends[1]);
    const double length = (ends[1] - ends[0]).norm();
    const Vector3d x = (ends[1] - ends[0]) / length;
    // The sum of the area vectors of the triangles on both sides.
    const Vector3d area = x.cross(across[0] - middle) - x.cross(across[1] - middle);
    const Vector3d z = area.normalized();
    const Vector3d y = z.cross(x);
    const double breadth = 0.5 * area.norm() / length;
    if (!(breadth > 0.0)) return std::nullopt;

    Eigen::Matrix<double, samples + 2, Height::terms> rows;
    Eigen::Matrix<double, samples + 2, 1> heights;
    const auto keep = [&](int i, const Vector3d& point, double weight) {
        const Vector3d arm = (point - middle) / length;
        rows.row(i) = weight * Height::monomials(arm.dot(x), arm.dot(y) / breadth);
        heights[i] = weight * arm.dot(z);
    };
    keep(samples, ends[0], weight_of_ends);
    keep(samples + 1, ends[1], weight_of_ends);
    int i = 0;
    for (const double along : {0.3, 0.5, 0.7}) {
        const Vector3d on_edge = ends[0] + along * (ends[1] - ends[0]);
        for (const Vector3d& start : {on_edge, Vector3d(on_edge + 0.25 * (across[0] - on_edge)),
                                      Vector3d(on_edge + 0.25 * (across[1] - on_edge))}) {
            const std::optional<Vector3d> point = lifted(start);
            if (!point) return std::nullopt;
            keep(i++, *point, 1.0);
        }
    }
    Height height;
    height.coefficients = rows.colPivHouseholderQr().solve(heights);
    // Rescaled from units of the breadth.
    height.coefficients.array() /= Eigen::Array<double, Height::terms, 1>{
        1.0, 1.0, breadth, 1.0, breadth, breadth * breadth, 1.0, breadth, breadth * breadth};
    const std::optional<Eigen::Vector2d> place = place_of_middle(height);
    if (!place) return std::nullopt;
    // `lifted` need not project along z, so the start is corrected.
    const Vector3d wanted = middle + length * (place->x() * x + place->y() * y);
    std::optional<Vector3d> found = lifted(wanted);
    Vector3d start = wanted;
    for (int step = 0; found && step < steps_to_place; ++step) {
        const Vector3d off = wanted - *found;
        start += off - off.dot(z) * z;
        found = lifted(start);
    }
    return found;
}

}  // namespace samara
