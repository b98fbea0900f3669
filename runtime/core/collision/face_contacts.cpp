#include "samara/core/collision/face_contacts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include <Eigen/Core>

namespace samara {
namespace {

// Relative to the bounding radius.
constexpr double level = 1e-3;  // height within which the points of a side count as facing a plane
constexpr double seam = 1e-6;   // by which faces extend over their sides, so that nothing falls between two
constexpr double same = 1e-9;   // distance within which two points are one
// The cosine of the angle by which a face beyond an edge may rise over the plane that the edge holds.
constexpr double beyond_plane = 1e-3;

/// Returns which corners of the triangle are nearest to a body along a normal.
std::array<bool, 3> highest_corners(const ObstacleTriangle& triangle, const Vector3d& normal, double plane,
                                    double tolerance) {
    std::array<bool, 3> highest{};
    for (std::size_t i = 0; i < 3; ++i) highest[i] = plane - normal.dot(triangle.corners[i]) <= tolerance;
    return highest;
}

/// Returns whether the surface beyond a side stays below a plane through it.
bool holds_plane(const ObstacleTriangle& triangle, std::size_t side, const Vector3d& normal) {
    const Vector3d offset = triangle.beyond[side] - triangle.corners[side];
    return normal.dot(offset) <= beyond_plane * offset.norm();
}

/// Returns whether the edge or corner that is nearest to a body stands out of the surface towards it.
bool stands_free(const ObstacleTriangle& triangle, const std::array<bool, 3>& highest,
                 const Vector3d& normal) {
    for (std::size_t i = 0; i < 3; ++i) {
        if (highest[i] && highest[(i + 1) % 3])
            return triangle.stands_out[i] && holds_plane(triangle, i, normal);
    }
    const auto corner =
        static_cast<std::size_t>(std::find(highest.begin(), highest.end(), true) - highest.begin());
    // A corner within one plane does not.
    if (!triangle.stands_out[corner] && !triangle.stands_out[(corner + 2) % 3]) return false;
    const auto& around = triangle.around[corner];
    return std::all_of(around.begin(), around.end(),
                       [&](const Vector3d& offset) { return normal.dot(offset) <= beyond_plane; });
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
}

/// Returns twice the area of the triangle abc in the plane, above zero where it runs anticlockwise.
double doubled_area(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    return cross((b - a).head<2>(), (c - a).head<2>());
}

/// The corners of a hull that lie lowest along a normal, within a tolerance: one, an edge, or the outline of
/// a face. Never allocates.
class LowestSide {
  public:
    /// `tolerance`: m, above the lowest corner.
    LowestSide(const PlacedHull& hull, const Vector3d& normal, double tolerance) noexcept;

    /// Finds the part of the line from a to b, from share `from` to share `to`, that lies under this side
    /// along the normal; false where none does.
    bool covers(const Vector3d& a, const Vector3d& b, double& from, double& to) const noexcept;

    /// Returns the height (m) along the normal over a place under this side.
    [[nodiscard]] double height(const Vector3d& place) const noexcept;

  private:
    [[nodiscard]] Eigen::Vector2d flat(const Vector3d& place) const noexcept {
        return {first_.dot(place), second_.dot(place)};
    }
    void find_outline() noexcept;
    void fit_plane() noexcept;

    Vector3d first_, second_;                     // axes in the plane
    std::array<Vector3d, most_corners> outline_;  // both coordinates in the plane, and the height
    std::size_t count_ = 0;
    Vector3d slope_ = Vector3d::Zero();  // height is slope x (first, second, 1)
};

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
    find_outline();
    fit_plane();
}

void LowestSide::find_outline() noexcept {
    if (count_ < 3) return;
    // The convex outline of the points: Andrew, Information Processing Letters 9(5), 1979.
    std::sort(outline_.begin(), outline_.begin() + count_, [](const Vector3d& a, const Vector3d& b) {
        return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
    });
    const double extent = (outline_[count_ - 1] - outline_[0]).head<2>().squaredNorm();
    std::array<Vector3d, 2 * most_corners> hull;
    std::size_t size = 0;
    const auto take = [&](const Vector3d& point, std::size_t least) {
        while (size > least && doubled_area(hull[size - 2], hull[size - 1], point) <= 1e-9 * extent) --size;
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
        Vector3d normal = Vector3d::Zero();  // by Newell's method
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

}  // namespace

FaceContacts::FaceContacts(const PlacedHull& hull, const Vector6d& velocity,
                           const ContactSurfaceVelocity& surface, double time_step, double margin,
                           double friction, int obstacle, ContactSet& near) noexcept
    : hull_(hull),
      next_(hull),
      velocity_(velocity),
      surface_(surface),
      time_step_(time_step),
      margin_(margin),
      friction_(friction),
      obstacle_(obstacle),
      near_(near) {
    const Vector3d rotation = time_step * (hull.orientation * velocity.head<3>() - surface.angular_velocity);
    const Vector3d offset = time_step * (hull.orientation * velocity.tail<3>() - surface.at(hull.position));
    if (rotation.norm() > 0.0) {
        next_.orientation = Eigen::AngleAxisd(rotation.norm(), rotation.normalized()) * hull.orientation;
    }
    next_.position += offset;
}

bool FaceContacts::passes_by(const ObstacleTriangle& triangle, const Separation& now) const noexcept {
    if (now.gap <= level * hull_.radius()) return false;
    if (gap_along(next_, triangle, now.normal) >= 0.0) return false;  // another load may bring it there
    const Separation later = separation(next_, triangle, std::numeric_limits<double>::infinity());
    return later.gap >= 0.0 && gap_along(hull_, triangle, later.normal) >= 0.0;
}

void FaceContacts::add_point(const Vector3d& of_body, const Vector3d& normal, double gap) noexcept {
    const Vector3d place = hull_.position + hull_.orientation * of_body - gap * normal;
    near_.add({.point = of_body,
               .normal = hull_.orientation.transpose() * normal,
               .gap = gap,
               .friction = friction_,
               .obstacle = obstacle_,
               .surface_velocity = hull_.orientation.transpose() * surface_.at(place),
               .surface_angular_velocity = hull_.orientation.transpose() * surface_.angular_velocity});
}

void FaceContacts::add_corners(const ObstacleTriangle& triangle, const Vector3d& normal,
                               double plane) noexcept {
    const auto look_at = [&](const Vector3d& point) {
        const Vector3d place = hull_.position + hull_.orientation * point;
        const double gap = normal.dot(place) - plane;
        if (gap > margin_) return;
        const Vector3d velocity =
            hull_.orientation * (velocity_.tail<3>() + velocity_.head<3>().cross(point)) - surface_.at(place);
        const double closing = -normal.dot(velocity);
        // What all but touches touches here and now: by rounding it would arrive anywhere.
        const double until =
            gap > level * hull_.radius() && closing > 0.0 ? std::min(gap / closing, time_step_) : 0.0;
        if (!triangle.is_under(place + until * velocity, seam * hull_.radius())) return;
        add_point(point, normal, gap);
    };
    for (const Vector3d& corner : hull_.points->corners) look_at(corner);
    if (hull_.points->round.empty()) return;
    look_at(lowest_round_point(*hull_.points, Vector3d(hull_.orientation.transpose() * -normal)));
}

bool FaceContacts::add_crossings(const ObstacleTriangle& triangle, const Vector3d& normal,
                                 double plane) noexcept {
    const bool any_stands_out =
        std::any_of(triangle.stands_out.begin(), triangle.stands_out.end(), [](bool out) { return out; });
    if (!any_stands_out) return false;
    const double radius = hull_.radius();
    const std::array<bool, 3> highest = highest_corners(triangle, normal, plane, level * radius);
    const double thickness = -hull_.lowest(-normal) - hull_.lowest(normal);
    const LowestSide side(hull_, normal, std::min(level * radius, 0.25 * thickness));
    bool found = false;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t next = (i + 1) % 3;
        if (!highest[i] || !highest[next] || !triangle.stands_out[i]) continue;
        if (!holds_plane(triangle, i, normal)) continue;
        const Vector3d& a = triangle.corners[i];
        const Vector3d& b = triangle.corners[next];
        double from = 0.0;
        double to = 1.0;
        if (!side.covers(a, b, from, to)) continue;
        const auto add = [&](double share) {
            const Vector3d place = a + share * (b - a);
            const double height = side.height(place);
            if (height - plane > margin_) return;
            const Vector3d of_hull = place + (height - normal.dot(place)) * normal;
            add_point(hull_.orientation.transpose() * (of_hull - hull_.position), normal, height - plane);
            found = true;
        };
        add(from);
        if ((to - from) * (b - a).norm() > same * radius) add(to);
    }
    return found;
}

bool FaceContacts::may_touch_inside(const ObstacleTriangle& triangle) const noexcept {
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector3d side = triangle.corners[(i + 1) % 3] - triangle.corners[i];
        const Vector3d outwards = side.cross(triangle.normal).normalized();
        if (hull_.lowest(outwards) > outwards.dot(triangle.corners[i]) + margin_) return false;
    }
    return true;
}

void FaceContacts::add_inside(const ObstacleTriangle& triangle) noexcept {
    if (!may_touch_inside(triangle)) return;
    const Separation part = plane_of_face(hull_, triangle);
    if (part.gap > margin_ || passes_by(triangle, part)) return;
    add_corners(triangle, part.normal, triangle.reach(part.normal));
}

void FaceContacts::add(const ObstacleTriangle& triangle) noexcept {
    const auto& outside = triangle.stands_out;
    if (std::none_of(outside.begin(), outside.end(), [](bool out) { return out; }))
        return add_inside(triangle);
    const Separation part = separation(hull_, triangle, margin_);
    if (part.gap > margin_ || passes_by(triangle, part)) return;
    const double plane = triangle.reach(part.normal);
    const std::array<bool, 3> highest =
        highest_corners(triangle, part.normal, plane, 0.1 * level * hull_.radius());
    if (part.of_face || (highest[0] && highest[1] && highest[2])) {
        add_corners(triangle, part.normal, plane);
        add_crossings(triangle, part.normal, plane);
        return;
    }
    if (!stands_free(triangle, highest, part.normal)) return add_inside(triangle);
    if (add_crossings(triangle, part.normal, plane)) return;
    const Vector3d of_hull = part.on_triangle + part.gap * part.normal;
    add_point(hull_.orientation.transpose() * (of_hull - hull_.position), part.normal, part.gap);
}

}  // namespace samara
