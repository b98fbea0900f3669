#include "converter/tables/direction_sampling.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/surface/octahedral_map.hpp"

namespace samara {
namespace {

void require_subdivisions(int subdivisions) {
    if (subdivisions < 1) throw Error(fmt::format("a map cannot have {} subdivisions", subdivisions));
}

/// Returns the index of the node in this direction; nothing where it lies between nodes.
std::optional<std::size_t> node_at(const Vector3d& direction, int subdivisions, double tolerance) {
    const Eigen::Vector2d place = octahedral_coordinates(direction);
    const auto nearest = [&](double coordinate) {
        return std::clamp(static_cast<int>(std::lround((coordinate + 1.0) * subdivisions)), 0,
                          2 * subdivisions);
    };
    const int row = nearest(place.y());
    const int column = nearest(place.x());
    if ((octahedral_node(subdivisions, row, column) - direction).norm() > tolerance) return std::nullopt;
    return unique_node(subdivisions, row, column);
}

bool comes_before(const Vector3d& a, const Vector3d& b) {
    return std::lexicographical_compare(b.begin(), b.end(), a.begin(), a.end());
}

std::vector<std::size_t> largest_first(const std::vector<Vector3d>& nodes) {
    std::vector<std::size_t> order(nodes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return comes_before(nodes[a], nodes[b]); });
    return order;
}

std::vector<Vector3d> finite_directions(const Symmetry& symmetry, int subdivisions) {
    std::vector<Vector3d> directions;
    for (const NodeImage& image : node_images(symmetry, subdivisions)) directions.push_back(image.source);
    std::sort(directions.begin(), directions.end(), comes_before);
    directions.erase(std::unique(directions.begin(), directions.end()), directions.end());
    return directions;
}

std::vector<Vector3d> arc_directions(const AxialArc& arc) {
    std::vector<Vector3d> directions;
    for (int step = 0; step <= arc.steps; ++step) directions.push_back(arc.direction(step));
    return directions;
}

/// Rounds values within `tolerance` of -1, 0 or 1.
template <typename Derived>
typename Derived::PlainObject snapped(const Eigen::MatrixBase<Derived>& values, double tolerance) {
    return values.unaryExpr([tolerance](double value) {
        const double whole = std::round(value);
        return std::abs(value - whole) < tolerance ? whole : value;
    });
}

}  // namespace

double direction_tolerance(const Symmetry& symmetry) {
    return std::clamp(symmetry.tolerance, 1e-6, 1e-3);
}

std::vector<Matrix3d> elements_in_map_axes(const Symmetry& symmetry) {
    const double tolerance = direction_tolerance(symmetry);
    std::vector<Matrix3d> elements;
    for (const Matrix3d& element : symmetry.elements) {
        const Matrix3d in_map_axes = symmetry.axes.transpose() * element * symmetry.axes;
        const Matrix3d whole = in_map_axes.array().round();
        elements.push_back((in_map_axes - whole).norm() < tolerance ? whole : in_map_axes);
    }
    return elements;
}

std::size_t unique_node(int subdivisions, int row, int column) {
    const int last = 2 * subdivisions;
    if (row == 0 || row == last) column = std::min(column, last - column);
    if (column == 0 || column == last) row = std::min(row, last - row);
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(last + 1) +
           static_cast<std::size_t>(column);
}

double AxialArc::step_angle() const {
    return (mirrored ? 0.5 : 1.0) * std::numbers::pi / steps;
}

Vector3d AxialArc::direction(int step) const {
    const double angle = step * step_angle();
    // Rounding would leave 1e-17 where the arc crosses a map axis.
    return snapped(std::cos(angle) * axis + std::sin(angle) * across, 1e-15);
}

AxialArc axial_arc(const Symmetry& symmetry, int subdivisions) {
    require_subdivisions(subdivisions);
    const double tolerance = direction_tolerance(symmetry);
    AxialArc arc;
    arc.axis = snapped(symmetry.axes.transpose() * symmetry.axis, tolerance).normalized();
    Eigen::Index most_across = 0;
    snapped(arc.axis.cwiseAbs(), tolerance).minCoeff(&most_across);
    const Vector3d unit = Vector3d::Unit(most_across);
    arc.across = (unit - unit.dot(arc.axis) * arc.axis).normalized();
    arc.mirrored =
        std::any_of(symmetry.elements.begin(), symmetry.elements.end(), [&](const Matrix3d& element) {
            return (element * symmetry.axis + symmetry.axis).norm() < tolerance;
        });
    arc.steps = arc.mirrored ? subdivisions : 2 * subdivisions;
    return arc;
}

std::vector<NodeImage> node_images(const Symmetry& symmetry, int subdivisions) {
    require_subdivisions(subdivisions);
    const std::vector<Vector3d> nodes = octahedral_nodes(subdivisions);
    const std::vector<Matrix3d> elements = elements_in_map_axes(symmetry);
    std::vector<std::optional<NodeImage>> images(nodes.size());
    for (const std::size_t node : largest_first(nodes)) {
        const Vector3d& source = nodes[node];
        const auto assign = [&](std::size_t target, const Matrix3d& element) {
            if (!images[target]) images[target] = NodeImage{source, element};
        };
        const std::size_t self = *node_at(source, subdivisions, 1e-9);
        if (images[self]) continue;  // an image of a larger node
        assign(self, Matrix3d::Identity());
        for (const Matrix3d& element : elements) {
            const auto target = node_at(element * source, subdivisions, direction_tolerance(symmetry));
            if (target) assign(*target, element);
        }
    }
    std::vector<NodeImage> result;
    for (int row = 0; row <= 2 * subdivisions; ++row) {
        for (int column = 0; column <= 2 * subdivisions; ++column) {
            result.push_back(*images[unique_node(subdivisions, row, column)]);
        }
    }
    return result;
}

Matrix3d element_to_required(const Symmetry& symmetry, const Vector3d& direction) {
    const auto rotation = [](const Vector3d& from, const Vector3d& to) {
        return Eigen::Quaterniond::FromTwoVectors(from, to).toRotationMatrix();
    };
    if (symmetry.type == Symmetry::Type::spherical) return rotation(direction, Vector3d::UnitX());
    const double tolerance = direction_tolerance(symmetry);
    if (symmetry.type == Symmetry::Type::axial) {
        const AxialArc arc = axial_arc(symmetry, 1);
        const double along = direction.dot(arc.axis);
        const Vector3d across = direction - along * arc.axis;
        Matrix3d element = Matrix3d::Identity();
        if (across.norm() > tolerance) {
            const double angle = std::atan2(arc.axis.cross(arc.across).dot(across), arc.across.dot(across));
            element = Eigen::AngleAxisd(-angle, arc.axis).toRotationMatrix();
        }
        // A body of revolution whose ends are alike has the mirror between them.
        const Matrix3d mirror = Matrix3d::Identity() - 2.0 * arc.axis * arc.axis.transpose();
        return arc.mirrored && along < -tolerance ? Matrix3d(mirror * element) : element;
    }
    Matrix3d best = Matrix3d::Identity();
    for (const Matrix3d& element : elements_in_map_axes(symmetry)) {
        const Vector3d difference = element * direction - best * direction;
        const auto first = std::find_if(difference.begin(), difference.end(),
                                        [&](double value) { return std::abs(value) > tolerance; });
        if (first != difference.end() && *first > 0.0) best = element;
    }
    return best;
}

std::vector<Vector3d> required_directions(const Symmetry& symmetry, int subdivisions) {
    require_subdivisions(subdivisions);
    switch (symmetry.type) {
        case Symmetry::Type::spherical:
            return {Vector3d::UnitX()};
        case Symmetry::Type::axial:
            return arc_directions(axial_arc(symmetry, subdivisions));
        case Symmetry::Type::finite:
            break;
    }
    return finite_directions(symmetry, subdivisions);
}

}  // namespace samara
