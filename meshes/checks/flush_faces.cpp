#include "meshes/checks/flush_faces.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

namespace samara {
namespace {

constexpr double least_share = 1e-6;    // of the smaller triangle
constexpr double most_slope = 0.1;      // of the one triangle on the other
constexpr double most_distance = 1e-4;  // over the width of the patch: sharp wedges are no touching sides

// Twice the area of the triangle in the plane, positive where it turns left.
double turn(const Vector3d& from, const Vector3d& to, const Vector3d& p) {
    return (to.x() - from.x()) * (p.y() - from.y()) - (to.y() - from.y()) * (p.x() - from.x());
}

// Whether a triangle lies to the right of a line or on it, as most that share a corner or a side do.
bool lies_beside(const std::array<Vector3d, 3>& triangle, const Vector3d& from, const Vector3d& to) {
    constexpr double rounding = 1e-12;
    return std::all_of(triangle.begin(), triangle.end(), [&](const Vector3d& p) {
        return turn(from, to, p) <= rounding * (to - from).norm() * (p - from).norm();
    });
}

// The part of a convex polygon to the left of the line from `from` to `to`; z is carried along.
void keep_left(std::vector<Vector3d>& polygon, const Vector3d& from, const Vector3d& to) {
    const auto side = [&](const Vector3d& p) { return turn(from, to, p); };
    std::vector<Vector3d> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vector3d& p = polygon[i];
        const Vector3d& q = polygon[(i + 1) % polygon.size()];
        const double here = side(p);
        const double there = side(q);
        if (here >= 0.0) kept.push_back(p);
        if ((here > 0.0 && there < 0.0) || (here < 0.0 && there > 0.0)) {
            kept.emplace_back(p + here / (here - there) * (q - p));
        }
    }
    polygon = std::move(kept);
}

double twice_the_area(const std::vector<Vector3d>& polygon) {
    double sum = 0.0;
    for (std::size_t i = 2; i < polygon.size(); ++i) sum += turn(polygon[0], polygon[i - 1], polygon[i]);
    return std::abs(sum);
}

}  // namespace

std::optional<FlushPatch> flush_patch(const std::array<Vector3d, 3>& a, const std::array<Vector3d, 3>& b,
                                      double tolerance) {
    const Vector3d across = (a[1] - a[0]).cross(a[2] - a[0]);
    const Vector3d its = (b[1] - b[0]).cross(b[2] - b[0]);
    const Vector3d normal = across.normalized();
    if (its.cross(normal).norm() > most_slope * its.norm()) return std::nullopt;
    Matrix3d frame;  // rows: two axes in the plane of a, its normal
    frame.row(0) = (a[1] - a[0]).normalized();
    frame.row(1) = normal.cross(frame.row(0).transpose());
    frame.row(2) = normal;
    const std::array<double, 3> heights = {normal.dot(b[0] - a[0]), normal.dot(b[1] - a[0]),
                                           normal.dot(b[2] - a[0])};
    const auto [low, high] = std::minmax({heights[0], heights[1], heights[2]});
    if (low > tolerance || high < -tolerance) return std::nullopt;
    std::array<Vector3d, 3> base;
    std::array<Vector3d, 3> side;
    for (std::size_t i = 0; i < 3; ++i) {
        base[i] = frame * (a[i] - a[0]);
        side[i] = frame * (b[i] - a[0]);
    }
    for (std::size_t i = 0; i < 3; ++i) {
        if (lies_beside(side, base[i], base[(i + 1) % 3])) return std::nullopt;
    }
    std::vector<Vector3d> patch(side.begin(), side.end());
    for (std::size_t i = 0; i < 3; ++i) keep_left(patch, base[i], base[(i + 1) % 3]);
    const double area = 0.5 * twice_the_area(patch);
    if (patch.size() < 3 || area < 0.5 * least_share * std::min(across.norm(), its.norm()))
        return std::nullopt;
    const double limit = std::min(tolerance, most_distance * std::sqrt(area));
    Vector3d middle = Vector3d::Zero();
    for (const Vector3d& corner : patch) {
        if (std::abs(corner.z()) > limit) return std::nullopt;
        middle += corner / static_cast<double>(patch.size());
    }
    return FlushPatch{area, a[0] + frame.transpose() * middle};
}

}  // namespace samara
