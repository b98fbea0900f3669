#include "samara/core/collision/lowest_side.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace samara {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
}

/// Twice the area of the triangle abc in the plane, above zero where it runs anticlockwise.
double area(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    return cross((b - a).head<2>(), (c - a).head<2>());
}

}  // namespace

LowestSide::LowestSide(const PlacedHull& hull, const Vector3d& normal, double tolerance) noexcept
    : first_(normal.unitOrthogonal()), second_(normal.cross(first_)) {
    double lowest = std::numeric_limits<double>::infinity();
    const auto place_of = [&](const Vector3d& corner) {
        return Vector3d(hull.position + hull.orientation * corner);
    };
    for (const Vector3d& corner : hull.points->corners)
        lowest = std::min(lowest, normal.dot(place_of(corner)));
    for (const Vector3d& corner : hull.points->corners) {
        const Vector3d place = place_of(corner);
        const double height = normal.dot(place);
        if (height > lowest + tolerance) continue;
        outline_[count_++] << flat(place), height;
    }
    turn_around();
    fit_plane();
}

void LowestSide::turn_around() noexcept {
    if (count_ < 3) return;
    // The outline of the points: Andrew, Information Processing Letters 9(5), 1979.
    std::sort(outline_.begin(), outline_.begin() + count_, [](const Vector3d& a, const Vector3d& b) {
        return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
    });
    const double extent = (outline_[count_ - 1] - outline_[0]).head<2>().squaredNorm();
    std::array<Vector3d, 2 * most_corners> hull;
    std::size_t size = 0;
    const auto take = [&](const Vector3d& point, std::size_t least) {
        while (size > least && area(hull[size - 2], hull[size - 1], point) <= 1e-9 * extent) --size;
        hull[size++] = point;
    };
    for (std::size_t i = 0; i < count_; ++i) take(outline_[i], 1);
    const std::size_t upper = size;
    for (std::size_t i = count_ - 1; i-- > 0;) take(outline_[i], upper);
    count_ = std::max<std::size_t>(size - 1, 1);
    std::copy_n(hull.begin(), count_, outline_.begin());
}

void LowestSide::fit_plane() noexcept {
    if (count_ == 0) return;
    const Vector3d& a = outline_[0];
    slope_ = {0.0, 0.0, a.z()};
    if (count_ == 1) return;
    if (count_ == 2) {
        const Vector3d along = outline_[1] - a;
        const double square = along.head<2>().squaredNorm();
        if (!(square > 0.0)) return;
        slope_.head<2>() = along.z() / square * along.head<2>();
    } else {
        Vector3d normal = Vector3d::Zero();  // Newell's
        for (std::size_t i = 1; i + 1 < count_; ++i) {
            normal += (outline_[i] - a).cross(outline_[i + 1] - a);
        }
        if (!(normal.z() > 0.0)) return;
        slope_.head<2>() = -normal.head<2>() / normal.z();
    }
    slope_.z() = a.z() - slope_.head<2>().dot(a.head<2>());
}

double LowestSide::height(const Vector3d& place) const noexcept {
    return slope_.head<2>().dot(flat(place)) + slope_.z();
}

bool LowestSide::covers(const Vector3d& a, const Vector3d& b, double& from, double& to) const noexcept {
    if (count_ < 2) return false;
    const Eigen::Vector2d start = flat(a);
    const Eigen::Vector2d along = flat(b) - start;
    if (count_ == 2) {
        const Eigen::Vector2d edge = (outline_[1] - outline_[0]).head<2>();
        const Eigen::Vector2d to_edge = outline_[0].head<2>() - start;
        const double both = cross(along, edge);
        if (std::abs(both) <= 1e-9 * along.norm() * edge.norm()) return false;
        from = to = cross(to_edge, edge) / both;
        const double on_edge = cross(to_edge, along) / both;
        return from >= 0.0 && from <= 1.0 && on_edge >= 0.0 && on_edge <= 1.0;
    }
    for (std::size_t i = 0; i < count_; ++i) {
        const Eigen::Vector2d corner = outline_[i].head<2>();
        const Eigen::Vector2d edge = outline_[(i + 1) % count_].head<2>() - corner;
        const double inside = cross(edge, start - corner);  // above zero within
        const double entering = cross(edge, along);
        if (entering == 0.0) {
            if (inside < 0.0) return false;
            continue;
        }
        const double share = -inside / entering;
        if (entering > 0.0) {
            from = std::max(from, share);
        } else {
            to = std::min(to, share);
        }
        if (from > to) return false;
    }
    return true;
}

}  // namespace samara
