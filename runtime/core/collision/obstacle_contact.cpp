#include "samara/core/collision/obstacle_contact.hpp"

#include <algorithm>
#include <limits>

#include "samara/core/collision/face_contacts.hpp"
#include "samara/core/collision/hull_separation.hpp"

namespace samara {
namespace {

// Chosen by trial, so that the tests ObstacleContact and ObstacleStability pass.
constexpr double starting = 1e-6;  // overlap with which a body may start, relative to the bounding radius
// overlap that is tolerated before it is removed, relative to the bounding radius
constexpr double slack = 1e-4;
// the same where a rotation causes it: half the square of 0.3 rad, and a little more
constexpr double small_rotation = 0.06;
constexpr double finest_share = 1e-3;  // precision of the place where a body arrives, relative to its path
constexpr int most_rounds = 4;         // passes over all faces near a body
constexpr int rounds_of_lifting = 2;

PlacedHull placed(const ContactPoints& points, const BodyPlace& body, const ObstaclePlace& obstacle) {
    const Quaterniond to_obstacle = obstacle.orientation.conjugate();
    return {&points, (to_obstacle * body.orientation).toRotationMatrix(),
            to_obstacle * (body.position - obstacle.position)};
}

Eigen::AlignedBox3d box_about(const Vector3d& a, const Vector3d& b, double radius) {
    return {a.cwiseMin(b) - Vector3d::Constant(radius), a.cwiseMax(b) + Vector3d::Constant(radius)};
}

/// Returns the mean angular velocity (rad/s, world axes) of a rotation.
Vector3d angular_velocity(const Quaterniond& from, const Quaterniond& to, double time) {
    const Eigen::AngleAxisd rotation(to * from.conjugate());
    return rotation.angle() / time * rotation.axis();
}

/// The path of a body as an obstacle sees it.
class Passage {
  public:
    Passage(const ContactPoints& points, const BodyPlace& before, const BodyPlace& after,
            const ObstaclePlace& obstacle_before, const ObstaclePlace& obstacle_after)
        : points_(points), obstacle_(obstacle_after), begin_(seen(before, obstacle_before)) {
        lead_to(after);
    }

    void lead_to(const BodyPlace& after) {
        end_ = seen(after, obstacle_);
        if (begin_.orientation.dot(end_.orientation) < 0.0) end_.orientation.coeffs() *= -1.0;
    }
    [[nodiscard]] PlacedHull hull(double share) const {
        const BodyPlace at = between(share);
        return {&points_, at.orientation.toRotationMatrix(), at.position};
    }
    [[nodiscard]] BodyPlace in_world(double share) const {
        const BodyPlace at = between(share);
        return {obstacle_.position + obstacle_.orientation * at.position,
                (obstacle_.orientation * at.orientation).normalized()};
    }
    [[nodiscard]] Vector3d to_world(const Vector3d& direction) const {
        return obstacle_.orientation * direction;
    }
    /// Returns an upper bound (m) of the distance that any point of the body moves.
    [[nodiscard]] double length() const {
        return (end_.position - begin_.position).norm() +
               points_.bounding_radius * begin_.orientation.angularDistance(end_.orientation);
    }
    [[nodiscard]] Eigen::AlignedBox3d box() const {
        return box_about(begin_.position, end_.position, points_.bounding_radius);
    }

  private:
    static BodyPlace seen(const BodyPlace& body, const ObstaclePlace& obstacle) {
        const Quaterniond to_obstacle = obstacle.orientation.conjugate();
        return {to_obstacle * (body.position - obstacle.position), to_obstacle * body.orientation};
    }
    [[nodiscard]] BodyPlace between(double share) const {
        if (share == 0.0) return begin_;
        if (share == 1.0) return end_;
        return {begin_.position + share * (end_.position - begin_.position),
                begin_.orientation.slerp(share, end_.orientation)};
    }

    const ContactPoints& points_;
    ObstaclePlace obstacle_;
    BodyPlace begin_, end_;
};

/// Returns the share of the path, up to 1, that a body surely completes without passing through the triangle:
/// at both ends of each part of it one plane separates the two.
double free_share(const Passage& passage, const ObstacleTriangle& triangle, double allowed) {
    constexpr double any = std::numeric_limits<double>::infinity();
    double share = 0.0;
    double part = 0.5;
    PlacedHull hull = passage.hull(0.0);
    Vector3d normal = separation(hull, triangle, any).normal;
    while (share < 1.0 && part >= finest_share) {
        const double next_share = std::min(1.0, share + part);
        const PlacedHull next = passage.hull(next_share);
        const Separation there = separation(next, triangle, any);
        const bool is_free = gap_along(next, triangle, normal) >= -allowed ||
                             (there.gap >= -allowed && gap_along(hull, triangle, there.normal) >= -allowed);
        if (!is_free) {
            part *= 0.5;
            continue;
        }
        share = next_share;
        hull = next;
        normal = there.normal;
    }
    return share;
}

/// Corrects the end of the path with regard to one triangle; returns whether it had to.
bool pass_by(Passage& passage, const ObstacleTriangle& triangle, double radius, int round, BodyPlace& after) {
    const double allowed = slack * radius;
    const PlacedHull begin = passage.hull(0.0);
    const PlacedHull end = passage.hull(1.0);
    const auto stays = [&](const Vector3d& normal) {
        return gap_along(begin, triangle, normal) >= -allowed && gap_along(end, triangle, normal) >= -allowed;
    };
    if (stays(triangle.normal) || stays(-triangle.normal)) return false;
    const Separation before = separation(begin, triangle, passage.length());
    if (before.gap > passage.length()) return false;
    if (before.gap < -allowed) return false;  // it began inside, and is moved out later
    const double gap = gap_along(end, triangle, before.normal);
    if (gap >= -allowed) return false;
    const Separation later = separation(end, triangle, std::numeric_limits<double>::infinity());
    if (later.gap >= -allowed && gap_along(begin, triangle, later.normal) >= -allowed) return false;
    if (round < rounds_of_lifting && -gap <= small_rotation * radius) {
        after.position -= gap * passage.to_world(before.normal);
    } else {
        const double share = round + 1 < most_rounds ? free_share(passage, triangle, allowed) : 0.0;
        if (share >= 1.0) return false;
        after = passage.in_world(share);
    }
    passage.lead_to(after);
    return true;
}

void lift(const ObstacleSet& obstacles, const ContactPoints& points, double time, BodyPlace& body) {
    const double radius = points.bounding_radius;
    for (const ObstacleFaces& faces : obstacles.obstacles()) {
        if (!faces.whereabouts().intersects(box_about(body.position, body.position, radius))) continue;
        const ObstaclePlace place = place_of(faces.obstacle(), time);
        const PlacedHull hull = placed(points, body, place);
        faces.visit_near(box_about(hull.position, hull.position, radius),
                         [&](const ObstacleTriangle& triangle) {
                             const Separation part = separation(placed(points, body, place), triangle, 0.0);
                             if (part.gap < 0.0 && part.gap > -small_rotation * radius)
                                 body.position -= part.gap * (place.orientation * part.normal);
                         });
    }
}

}  // namespace

bool passes_near(const ObstacleSet& obstacles, const ContactPoints& points, const BodyPlace& before,
                 const BodyPlace& after, double margin) noexcept {
    const double radius = points.bounding_radius + margin;
    const Eigen::AlignedBox3d box = box_about(before.position, after.position, radius);
    return std::any_of(obstacles.obstacles().begin(), obstacles.obstacles().end(),
                       [&](const ObstacleFaces& faces) { return faces.whereabouts().intersects(box); });
}

std::optional<Overlap> first_overlap(const ObstacleSet& obstacles, const ContactPoints& points,
                                     const BodyPlace& body, double time) {
    const double radius = points.bounding_radius;
    std::optional<Overlap> found;
    for (const ObstacleFaces& faces : obstacles.obstacles()) {
        if (faces.is_removed()) continue;
        const ObstaclePlace place = place_of(faces.obstacle(), time);
        const PlacedHull hull = placed(points, body, place);
        const Vector3d middle = hull.position + hull.orientation * points.middle;
        if (faces.is_closed() && faces.encloses(middle)) found = {faces.obstacle().name, place(middle)};
        faces.visit_near(
            box_about(hull.position, hull.position, radius), [&](const ObstacleTriangle& triangle) {
                if (found || separation(hull, triangle, 0.0).gap >= -starting * radius) return;
                found = {faces.obstacle().name,
                         place((triangle.corners[0] + triangle.corners[1] + triangle.corners[2]) / 3.0)};
            });
        if (found) return found;
    }
    return found;
}

void add_obstacles(const ObstacleSet& obstacles, const ContactPoints& points, const BodyPlace& body,
                   const Vector6d& velocity, double time, double time_step, double margin,
                   ContactSet& near) noexcept {
    int number = -1;
    for (const ObstacleFaces& faces : obstacles.obstacles()) {
        ++number;
        const double reached = margin + 2.0 * time_step * faces.fastest();
        const double radius = points.bounding_radius + reached;
        if (!faces.whereabouts().intersects(box_about(body.position, body.position, radius))) continue;
        const Obstacle& obstacle = faces.obstacle();
        const ObstaclePlace now = place_of(obstacle, time);
        const ObstaclePlace next = place_of(obstacle, time + time_step);
        ContactSurfaceVelocity surface;
        if (obstacle.moves()) {
            const Quaterniond to_obstacle = now.orientation.conjugate();
            surface.angular_velocity =
                to_obstacle * angular_velocity(now.orientation, next.orientation, time_step);
            surface.linear_velocity = to_obstacle * (next.position - now.position) / time_step;
        }
        const PlacedHull hull = placed(points, body, now);
        FaceContacts contacts(hull, velocity, surface, time_step, reached, obstacle.friction, number, near);
        faces.visit_near(box_about(hull.position, hull.position, radius),
                         [&](const ObstacleTriangle& triangle) { contacts.add(triangle); });
    }
}

void keep_out(const ObstacleSet& obstacles, const ContactPoints& points, double begin, double end,
              const BodyPlace& before, BodyPlace& after) noexcept {
    const double radius = points.bounding_radius;
    bool mended = true;
    for (int round = 0; round < most_rounds && mended; ++round) {
        mended = false;
        for (const ObstacleFaces& faces : obstacles.obstacles()) {
            if (!faces.whereabouts().intersects(box_about(before.position, after.position, radius))) continue;
            const Obstacle& obstacle = faces.obstacle();
            Passage passage(points, before, after, place_of(obstacle, begin), place_of(obstacle, end));
            faces.visit_near(passage.box(), [&](const ObstacleTriangle& triangle) {
                mended = pass_by(passage, triangle, radius, round, after) || mended;
            });
        }
    }
    lift(obstacles, points, end, after);
}

}  // namespace samara
