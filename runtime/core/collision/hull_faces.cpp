#include "samara/core/collision/hull_faces.hpp"

#include <algorithm>
#include <cmath>

namespace samara {
namespace {

// Over the bounding radius, or its square.
constexpr double flat = 1e-5;
constexpr double smallest_area = 1e-6;

/// How the corners lie about a plane.
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

void turn_around(const std::vector<Vector3d>& corners, HullFace& face) {
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
    const auto look_at = [&](Vector3d normal, const Vector3d& place) {
        if (is_known(normal)) return;
        Sides sides = sides_of(corners, normal, normal.dot(place), flat * radius);
        if (!sides.all_below) return;
        HullFace face{normal, std::move(sides.within)};
        turn_around(corners, face);
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
