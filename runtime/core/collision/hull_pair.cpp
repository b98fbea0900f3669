#include "samara/core/collision/hull_pair.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "samara/core/collision/hull_separation.hpp"

namespace samara {
namespace {

constexpr double of_face = 1e-6;     // one less the cosine of the angle between a normal and that of its face
constexpr double sticks_out = 1e-4;  // height of a round side over a face, relative to the bounding radius
constexpr double drawn_in = 0.03;    // share by which a hull is shrunk towards its middle, where two touch
constexpr double seam = 1e-6;  // by which a face extends over its sides, relative to the bounding radius
constexpr std::size_t most_outline = 2 * most_corners + 8;

Vector3d middle_of(const PlacedHull& hull) {
    return hull.position + hull.orientation * hull.points->middle;
}

/// Finds the plane that separates hulls which are each shrunk towards their middle. Round sides are smoothed
/// tables, of which two that touch may seem to overlap by less than that. False where even these overlap.
bool separation_drawn_in(const CollisionHull& first, const CollisionHull& second, PairSeparation& result) {
    const Vector3d first_middle = middle_of(first.hull);
    const Vector3d second_middle = middle_of(second.hull);
    const auto of = [](const PlacedHull& hull, const Vector3d& middle) {
        return [&hull, middle](const Vector3d& direction) {
            return Vector3d(middle + (1.0 - drawn_in) * (hull.farthest(direction) - middle));
        };
    };
    Simplex simplex;
    Vector3d separation = first_middle - second_middle;
    if (!nearest_separation(of(first.hull, first_middle), of(second.hull, second_middle), simplex,
                            separation))
        return false;
    result.normal = separation.normalized();
    result.gap = gap_along(first.hull, second.hull, result.normal);
    result.on_second =
        second.hull.points->round.empty()
            ? Vector3d(second_middle + (simplex.on_second() - second_middle) / (1.0 - drawn_in))
            : second.hull.farthest(result.normal);
    result.overlap = result.gap <= 0.0;
    return true;
}

/// Returns the direction along which hulls that overlap do so least.
PairSeparation least_overlap(const CollisionHull& first, const CollisionHull& second) {
    PairSeparation apart;
    const bool barely = separation_drawn_in(first, second, apart);
    PairSeparation best{Vector3d::UnitZ(), -std::numeric_limits<double>::infinity(), Vector3d::Zero(), true};
    const auto look_along = [&](const Vector3d& normal) {
        const double gap = gap_along(first.hull, second.hull, normal);
        if (gap <= best.gap) return;
        best.normal = normal;
        best.gap = gap;
    };
    const Vector3d between = between_middles(first, second);
    if (between.norm() > 0.0) look_along(between.normalized());
    if (barely) look_along(apart.normal);
    look_along(Vector3d::UnitZ());
    look_along(-Vector3d::UnitZ());
    for (const HullFace& face : *first.faces) look_along(-(first.hull.orientation * face.normal));
    for (const HullFace& face : *second.faces) look_along(second.hull.orientation * face.normal);
    best.on_second = second.hull.farthest(best.normal);
    return best;
}

/// Returns the face of a hull whose normal is nearest to a unit vector; null where there is none.
const HullFace* face_along(const CollisionHull& of, const Vector3d& direction, double& cosine) {
    const Vector3d own = of.hull.orientation.transpose() * direction;
    const HullFace* found = nullptr;
    cosine = -1.0;
    for (const HullFace& face : *of.faces) {
        const double along = face.normal.dot(own);
        if (along <= cosine) continue;
        cosine = along;
        found = &face;
    }
    return found;
}

Vector3d corner_of(const PlacedHull& hull, std::size_t corner) {
    return hull.position + hull.orientation * hull.points->corners[corner];
}

/// A face's outline that is cut by the sides of another. Never allocates.
class Outline {
  public:
    Outline(const PlacedHull& hull, const HullFace& face) {
        for (const std::size_t corner : face.outline) add(corner_of(hull, corner));
    }

    /// Keeps the part inside the plane.
    void cut(const Vector3d& outwards, double plane) {
        const std::array<Vector3d, most_outline> before = points_;
        const std::size_t count = count_;
        count_ = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const Vector3d& a = before[i];
            const Vector3d& b = before[(i + 1) % count];
            const double out_a = outwards.dot(a) - plane;
            const double out_b = outwards.dot(b) - plane;
            if (out_a <= 0.0) add(a);
            if ((out_a <= 0.0) != (out_b <= 0.0)) add(a + out_a / (out_a - out_b) * (b - a));
        }
    }

    [[nodiscard]] const Vector3d* begin() const { return points_.data(); }
    [[nodiscard]] const Vector3d* end() const { return points_.data() + count_; }

  private:
    void add(const Vector3d& point) {
        if (count_ < points_.size()) points_[count_++] = point;
    }
    std::array<Vector3d, most_outline> points_;
    std::size_t count_ = 0;
};

/// Keeps, of more points than there is room for, the lowest and those that are farthest from all before.
class PointChoice {
  public:
    void add(const HullContact::Point& point) {
        if (count_ < all_.size()) all_[count_++] = point;
    }
    void give(HullContact& hull_contact) const {
        const std::size_t room = hull_contact.points.size();
        if (count_ <= room) {
            std::copy_n(all_.begin(), count_, hull_contact.points.begin());
            hull_contact.count = count_;
            return;
        }
        std::array<double, most_outline> distance;
        distance.fill(std::numeric_limits<double>::infinity());
        std::size_t next = 0;
        for (std::size_t i = 1; i < count_; ++i) {
            if (all_[i].gap < all_[next].gap) next = i;
        }
        while (hull_contact.count < room) {
            hull_contact.points[hull_contact.count++] = all_[next];
            const Vector3d chosen = all_[next].on_second;
            for (std::size_t i = 0; i < count_; ++i) {
                distance[i] = std::min(distance[i], (all_[i].on_second - chosen).squaredNorm());
            }
            next = static_cast<std::size_t>(std::max_element(distance.begin(), distance.begin() + count_) -
                                            distance.begin());
        }
    }

  private:
    std::array<HullContact::Point, most_outline> all_;
    std::size_t count_ = 0;
};

/// Adds the points of `lying`, a face of one hull, that lie over the face `carrying` of the other within
/// reach. `normal`: of the carrying face, outwards; `swapped`: whether the carrying hull is the first.
void add_shared(const CollisionHull& carrying, const HullFace& face, const CollisionHull& lying,
                const HullFace& other, const Vector3d& normal, double reach, bool swapped,
                HullContact& hull_contact) {
    Outline outline(lying.hull, other);
    for (std::size_t i = 0; i < face.outline.size(); ++i) {
        const Vector3d a = corner_of(carrying.hull, face.outline[i]);
        const Vector3d b = corner_of(carrying.hull, face.outline[(i + 1) % face.outline.size()]);
        const Vector3d outwards = (b - a).cross(normal).normalized();
        outline.cut(outwards, outwards.dot(a) + seam * carrying.hull.radius());
    }
    const double plane = normal.dot(corner_of(carrying.hull, face.outline.front()));
    PointChoice choice;
    for (const Vector3d& point : outline) {
        const double gap = normal.dot(point) - plane;
        if (gap > reach) continue;
        const Vector3d under = point - gap * normal;
        choice.add(swapped ? HullContact::Point{under, point, gap} : HullContact::Point{point, under, gap});
    }
    choice.give(hull_contact);
}

/// Returns whether no round side stands out over the corners along a direction.
bool ends_in_corners(const CollisionHull& of, const Vector3d& direction) {
    const ContactPoints& points = *of.hull.points;
    if (points.round.empty()) return true;
    const Vector3d own = of.hull.orientation.transpose() * direction;
    double farthest = -std::numeric_limits<double>::infinity();
    for (const Vector3d& corner : points.corners) farthest = std::max(farthest, own.dot(corner));
    return own.dot(lowest_round_point(points, own)) - farthest <= sticks_out * points.bounding_radius;
}

}  // namespace

Vector3d between_middles(const CollisionHull& first, const CollisionHull& second) noexcept {
    return middle_of(first.hull) - middle_of(second.hull);
}

std::optional<PairSeparation> plane_between(const CollisionHull& first, const CollisionHull& second,
                                            double enough, Vector3d separation) noexcept {
    Simplex simplex;
    const auto of_first = [&](const Vector3d& direction) { return first.hull.farthest(direction); };
    const auto of_second = [&](const Vector3d& direction) { return second.hull.farthest(direction); };
    const auto gap = nearest_separation(of_first, of_second, simplex, separation, enough);
    if (gap && *gap > 0.0) return PairSeparation{separation.normalized(), *gap, simplex.on_second(), false};
    PairSeparation drawn_apart;
    if (separation_drawn_in(first, second, drawn_apart) && !drawn_apart.overlap) return drawn_apart;
    return {};
}

PairSeparation pair_separation(const CollisionHull& first, const CollisionHull& second,
                               double enough) noexcept {
    const auto apart = plane_between(first, second, enough, between_middles(first, second));
    return apart ? *apart : least_overlap(first, second);
}

bool come_within(const CollisionHull& first, const CollisionHull& second, double distance) noexcept {
    Simplex simplex;
    Vector3d separation = between_middles(first, second);
    const auto of_first = [&](const Vector3d& direction) { return first.hull.farthest(direction); };
    const auto of_second = [&](const Vector3d& direction) { return second.hull.farthest(direction); };
    const auto gap = nearest_separation(of_first, of_second, simplex, separation, distance, distance);
    return !(gap && *gap > distance);
}

HullContact hull_contact(const CollisionHull& first, const CollisionHull& second, const PairSeparation& apart,
                         double reach) noexcept {
    HullContact result;
    result.normal = apart.normal;
    result.gap = apart.gap;
    if (apart.gap > reach) return result;
    double first_cosine = 0.0;
    double second_cosine = 0.0;
    const HullFace* first_face = face_along(first, -apart.normal, first_cosine);
    const HullFace* second_face = face_along(second, apart.normal, second_cosine);
    const bool second_carries = second_cosine >= first_cosine;
    const bool faces_touch = first_face != nullptr && second_face != nullptr &&
                             std::max(first_cosine, second_cosine) > 1.0 - of_face &&
                             ends_in_corners(first, -apart.normal) && ends_in_corners(second, apart.normal);
    if (faces_touch && second_carries) {
        const Vector3d normal = second.hull.orientation * second_face->normal;
        add_shared(second, *second_face, first, *first_face, normal, reach, false, result);
    } else if (faces_touch) {
        const Vector3d normal = first.hull.orientation * first_face->normal;
        add_shared(first, *first_face, second, *second_face, normal, reach, true, result);
    }
    if (result.count > 0) return result;
    result.points[0] = {apart.on_second + apart.gap * apart.normal, apart.on_second, apart.gap};
    result.count = 1;
    return result;
}

namespace {

// Relative to the bounding radius, or its square.
constexpr double flat_contact = 1e-5;
constexpr double smallest_area = 1e-6;

/// The corners on each side of a plane.
struct Sides {
    bool all_below = true;
    std::vector<std::size_t> within;
};

Sides sides_of(const std::vector<Vector3d>& corners, const Vector3d& normal, double plane, double tolerance) {
    Sides sides;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const double above = normal.dot(corners[i]) - plane;
        if (above > tolerance) sides.all_below = false;
        if (std::abs(above) <= tolerance) sides.within.push_back(i);
    }
    return sides;
}

void find_outline(const std::vector<Vector3d>& corners, HullFace& face) {
    Vector3d middle = Vector3d::Zero();
    for (const std::size_t i : face.outline) middle += corners[i];
    middle /= static_cast<double>(face.outline.size());
    const Vector3d first = face.normal.unitOrthogonal();
    const Vector3d second = face.normal.cross(first);
    const auto angle = [&](std::size_t i) {
        const Vector3d arm = corners[i] - middle;
        return std::atan2(second.dot(arm), first.dot(arm));
    };
    std::sort(face.outline.begin(), face.outline.end(),
              [&](std::size_t a, std::size_t b) { return angle(a) < angle(b); });
}

}  // namespace

std::vector<HullFace> hull_faces(const ContactPoints& points) {
    const std::vector<Vector3d>& corners = points.corners;
    const double radius = points.bounding_radius;
    std::vector<HullFace> faces;
    const auto is_known = [&](const Vector3d& normal) {
        return std::any_of(faces.begin(), faces.end(),
                           [&](const HullFace& face) { return face.normal.dot(normal) > 1.0 - 1e-9; });
    };
    const auto look_at = [&](const Vector3d& normal, const Vector3d& place) {
        if (is_known(normal)) return;
        Sides sides = sides_of(corners, normal, normal.dot(place), flat_contact * radius);
        if (!sides.all_below) return;
        HullFace face{normal, std::move(sides.within)};
        find_outline(corners, face);
        faces.push_back(std::move(face));
    };
    for (std::size_t i = 0; i < corners.size(); ++i) {
        for (std::size_t j = i + 1; j < corners.size(); ++j) {
            for (std::size_t k = j + 1; k < corners.size(); ++k) {
                const Vector3d area = (corners[j] - corners[i]).cross(corners[k] - corners[i]);
                if (area.norm() <= smallest_area * radius * radius) continue;
                look_at(area.normalized(), corners[i]);
                look_at(-area.normalized(), corners[i]);
            }
        }
    }
    return faces;
}

}  // namespace samara
