#include "samara/pictures/body_arcs.hpp"

#include <algorithm>
#include <cmath>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/base/numbers.hpp"

namespace samara {
namespace {

constexpr int step = 5;  // degrees between the directions that are compared
// Share of the largest force. Smaller differences are those of interpolation, which between the nodes of a
// usual map takes up to 2.2 % from the force on a sphere and deflects 2.6 % of it.
constexpr double same_share = 0.03;
constexpr double nearly = 0.6;  // degrees off an arc that still count as on it

double largest_drag(const LoadTables& tables, double reynolds_number) {
    double largest = 0.0;
    for (const LoadEntry& entry : at_reynolds_number(tables, reynolds_number).entries) {
        largest = std::max(largest, entry.force.norm());
    }
    return largest;
}

/// Returns whether the values of two arcs, each at its own angle, are alike all around; lifts and moments by
/// size.
template <typename OtherAngle>
bool alike(const LoadTables& tables, const BodyArc& one, const BodyArc& other, double reynolds_number,
           double tolerance, const OtherAngle& other_angle) {
    for (int i = 0; i < 360; i += step) {
        const double angle = i;
        const ArcValues here = values_on(tables, one, angle / degrees, reynolds_number);
        const ArcValues there = values_on(tables, other, other_angle(angle) / degrees, reynolds_number);
        if (here.largest_difference(there) > tolerance) return false;
    }
    return true;
}

/// Returns the principal axes; those of the symmetry where moments that are all alike say nothing of them.
Matrix3d axes_of_arcs(const Body& body) {
    constexpr double alike_share = 1e-3;
    const Vector3d moments = eigenvalues_of(body.moments.second_moments);
    if (moments[2] - moments[0] < alike_share * moments[2]) return body.symmetry.axes;
    return principal_axes(body.moments);
}

void add_angle(std::vector<double>& angles, double angle, double most) {
    angle = std::fmod(angle + 720.0, 360.0);
    if (angle > 360.0 - 0.5 * nearly) angle = 0.0;
    if (angle > most + 0.5 * nearly) return;
    angle = std::min(angle, most);
    const auto near = [&](double known) { return std::abs(known - angle) < nearly; };
    if (std::ranges::none_of(angles, near)) angles.push_back(angle);
}

/// Returns the images of a direction under rotation about an axis that lie in the plane of an arc.
std::vector<Vector3d> rotated_into(const BodyArc& arc, const Vector3d& axis, const Vector3d& direction) {
    const double along = direction.dot(axis);
    const Vector3d in_plane = axis - axis.dot(arc.normal()) * arc.normal();
    if (in_plane.norm() < 0.99) return {};
    const Vector3d aside = arc.normal().cross(in_plane.normalized());
    const double away = std::sqrt(std::max(0.0, 1.0 - along * along));
    return {along * axis + away * aside, along * axis - away * aside};
}

}  // namespace

Vector3d BodyArc::direction(double angle) const {
    return std::cos(angle) * from + std::sin(angle) * to;
}

Vector3d BodyArc::across(double angle) const {
    return std::cos(angle) * to - std::sin(angle) * from;
}

double ArcValues::largest_difference(const ArcValues& other) const {
    return std::max({std::abs(drag - other.drag), std::abs(std::abs(lift) - std::abs(other.lift)),
                     std::abs(std::abs(moment) - std::abs(other.moment))});
}

ArcValues values_on(const LoadTables& tables, const BodyArc& arc, double angle, double reynolds_number) {
    const Vector3d direction = arc.direction(angle);
    const LoadEntry entry = look_up(tables, direction, reynolds_number);
    return {-entry.force.dot(direction), entry.force.dot(arc.across(angle)), entry.moment.dot(arc.normal()),
            entry.turbulent_kinetic_energy};
}

ArcValues errors_on(const LoadTables& tables, const BodyArc& arc, double angle, double reynolds_number) {
    if (tables.errors.size() != tables.entries.size()) return {0.0, 0.0, 0.0, 0.0};
    const Vector3d direction = arc.direction(angle);
    const LoadEntryError error = look_up_error(tables, direction, reynolds_number);
    return {error.force.cwiseProduct(direction).norm(), error.force.cwiseProduct(arc.across(angle)).norm(),
            error.moment.cwiseProduct(arc.normal()).norm(), error.turbulent_kinetic_energy};
}

std::vector<BodyArc> arcs_of(const Body& body, double reynolds_number) {
    const LoadTables& tables = *body.tables;
    const Matrix3d axes = axes_of_arcs(body);
    const double tolerance = same_share * largest_drag(tables, reynolds_number);
    std::vector<BodyArc> arcs;
    for (const auto& [name, from, to] :
         {std::tuple("short to long", 0, 2), std::tuple("short to middle", 0, 1),
          std::tuple("middle to long", 1, 2)}) {
        const BodyArc arc{name, axes.col(from), axes.col(to)};
        const auto known = [&](const BodyArc& other) {
            return alike(tables, arc, other, reynolds_number, tolerance, [](double angle) { return angle; });
        };
        if (std::ranges::none_of(arcs, known)) arcs.push_back(arc);
    }
    return arcs;
}

double shown_angle(const LoadTables& tables, const std::vector<BodyArc>& arcs, double reynolds_number) {
    const double tolerance = same_share * largest_drag(tables, reynolds_number);
    const auto repeats = [&](const auto& other_angle) {
        return std::ranges::all_of(arcs, [&](const BodyArc& arc) {
            return alike(tables, arc, arc, reynolds_number, tolerance, other_angle);
        });
    };
    if (!repeats([](double angle) { return -angle; })) return 360.0;
    return repeats([](double angle) { return 180.0 - angle; }) ? 90.0 : 180.0;
}

std::vector<double> angles_on(const BodyArc& arc, const Symmetry& symmetry, const Vector3d& direction,
                              double most) {
    std::vector<double> angles;
    if (symmetry.type == Symmetry::Type::spherical) return {0.0};
    for (const Matrix3d& element : symmetry.elements) {
        std::vector<Vector3d> images = {element * direction};
        if (symmetry.type == Symmetry::Type::axial) {
            const auto rotated = rotated_into(arc, symmetry.axis, images.front());
            images.insert(images.end(), rotated.begin(), rotated.end());
        }
        for (const Vector3d& image : images) {
            if (std::abs(image.dot(arc.normal())) > std::sin(nearly / degrees)) continue;
            add_angle(angles, degrees * std::atan2(image.dot(arc.to), image.dot(arc.from)), most);
        }
    }
    return angles;
}

}  // namespace samara
