#include "meshes/symmetry/symmetry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "meshes/symmetry/image_comparison.hpp"
#include "meshes/symmetry/symmetry_group.hpp"
#include "samara/core/base/linear_algebra.hpp"

namespace samara {
namespace {

using std::numbers::pi;

constexpr int highest_order = 16;  // of rotations about a single axis
constexpr int highest_order_of_polyhedra = 5;
constexpr std::size_t most_directions = 28;

// Eigenvalues within this many tolerances (relative) count as one: they vary as the square of lengths.
constexpr double degenerate = 4.0;

// Returns the coordinate axis of the shape that is nearest to the direction.
Vector3d nearest_shape_axis(const Vector3d& direction) {
    Eigen::Index largest = 0;
    direction.cwiseAbs().maxCoeff(&largest);
    return Vector3d::Unit(largest);
}

bool is_near(const Vector3d& a, const Vector3d& b) {
    return std::abs(a.dot(b)) > 0.995;
}

// Tests rotations by angles that no finite rotation group of low order contains.
bool is_axis_of_revolution(const ImageComparison& images, const Vector3d& axis) {
    constexpr std::array<double, 5> fractions = {0.381966, 0.145898, 0.072949, 0.031415, 0.267949};
    return std::all_of(fractions.begin(), fractions.end(), [&](double fraction) {
        return images.is_symmetry(Operation{axis, 2.0 * pi * fraction, false}.matrix());
    });
}

bool is_spherical(const ImageComparison& images) {
    return is_axis_of_revolution(images, Vector3d::UnitZ()) &&
           is_axis_of_revolution(images, Vector3d::UnitX()) &&
           is_axis_of_revolution(images, Vector3d(1.0, 1.0, 1.0).normalized());
}

// Returns the axis of revolution among the directions, exactly a coordinate axis of the shape where it is
// near one.
std::optional<Vector3d> axis_of_revolution(const ImageComparison& images,
                                           const std::vector<Vector3d>& directions) {
    for (const Vector3d& direction : directions) {
        const Vector3d shape_axis = nearest_shape_axis(direction);
        if (is_near(direction, shape_axis) && is_axis_of_revolution(images, shape_axis)) return shape_axis;
        if (is_axis_of_revolution(images, direction)) return direction;
    }
    return std::nullopt;
}

Symmetry axial_symmetry(const ImageComparison& images, const Vector3d& axis) {
    Symmetry symmetry;
    symmetry.type = Symmetry::Type::axial;
    symmetry.axis = axis;
    symmetry.axes = frame_about(axis);
    Eigen::Index column = 0;
    (symmetry.axes.transpose() * axis).cwiseAbs().maxCoeff(&column);
    const Vector3d across = symmetry.axes.col((column + 1) % 3);
    const Matrix3d mirror_through = Matrix3d::Identity() - 2.0 * across * across.transpose();
    const Matrix3d mirror_across = Matrix3d::Identity() - 2.0 * axis * axis.transpose();
    symmetry.elements = {Matrix3d::Identity(), mirror_through};
    if (images.is_symmetry(mirror_across)) {
        symmetry.elements.push_back(mirror_across);
        symmetry.elements.push_back(mirror_through * mirror_across);
    }
    return symmetry;
}

// Adds rotations, rotoreflections and mirrors of the orders 2 to `highest` about the direction, the highest
// first, since the lower ones are often powers of these.
void add_operations_about(SymmetryGroup& group, const Vector3d& direction, int highest) {
    for (int order = highest; order >= 2; --order) {
        group.add_refined({direction, 2.0 * pi / order, false});
        group.add_refined({direction, 2.0 * pi / order, true});
    }
}

// Adds mirrors and rotations by 180 degrees whose axes are perpendicular to the body's one axis, at any angle
// about it.
void add_operations_across(SymmetryGroup& group, const ImageComparison& images, const Vector3d& axis) {
    constexpr int steps = 120;
    constexpr std::size_t points = 100;
    const Vector3d first = axis.unitOrthogonal();
    const Vector3d second = axis.cross(first);
    for (const bool improper : {true, false}) {
        std::array<double, steps> distances;
        const auto operation = [&](int step) {
            const double angle = pi * step / steps;
            return Operation{std::cos(angle) * first + std::sin(angle) * second, pi, improper};
        };
        for (int i = 0; i < steps; ++i) {
            distances[static_cast<std::size_t>(i)] = images.mean_distance(operation(i).matrix(), points);
        }
        for (int i = 0; i < steps; ++i) {
            const double here = distances[static_cast<std::size_t>(i)];
            const double before = distances[static_cast<std::size_t>((i + steps - 1) % steps)];
            const double after = distances[static_cast<std::size_t>((i + 1) % steps)];
            if (here <= before && here <= after) group.add_refined(operation(i));
        }
    }
}

void add_new_direction(std::vector<Vector3d>& directions, const Vector3d& direction) {
    if (direction.norm() < 0.2) return;
    const Vector3d unit = direction.normalized();
    const bool known = std::any_of(directions.begin(), directions.end(),
                                   [&](const Vector3d& other) { return std::abs(unit.dot(other)) > 0.9995; });
    if (!known) directions.push_back(unit);
}

double integer_power(double base, int exponent) {
    double result = 1.0;
    for (int i = 0; i < exponent; ++i) result *= base;
    return result;
}

// Adds directions d where the sum of (x . d)^power over the points has an extremum: the axes of a polyhedral
// group are among them. Shifted power iteration: Kolda and Mayo, SIAM J. Matrix Anal. Appl. 32(4), 2011.
void add_extremal_directions(std::vector<Vector3d>& directions, const std::vector<Vector3d>& points,
                             int power) {
    constexpr int starts = 24;
    constexpr int iterations = 80;
    double scale = 0.0;
    for (const Vector3d& x : points) scale += integer_power(x.norm(), power);
    for (int start = 0; start < starts; ++start) {
        // The starts lie on a Fibonacci spiral over the half sphere.
        const double height = (start + 0.5) / starts;
        const double azimuth = 2.399963229728653 * start;
        const double radius = std::sqrt(1.0 - height * height);
        for (const double sign : {1.0, -1.0}) {
            Vector3d d(radius * std::cos(azimuth), radius * std::sin(azimuth), height);
            for (int i = 0; i < iterations; ++i) {
                Vector3d gradient = Vector3d::Zero();
                for (const Vector3d& x : points) gradient += integer_power(x.dot(d), power - 1) * x;
                const Vector3d next = (sign * gradient / scale + 0.3 * d).normalized();
                const bool settled = (next - d).norm() < 1e-5;
                d = next;
                if (settled) break;
            }
            add_new_direction(directions, d);
        }
    }
}

// Returns candidate axes for bodies whose second moments single out no axis.
std::vector<Vector3d> polyhedral_directions(const ImageComparison& images) {
    const std::size_t count = std::min<std::size_t>(images.points().size(), 1000);
    const std::vector<Vector3d> points(images.points().begin(),
                                       images.points().begin() + static_cast<std::ptrdiff_t>(count));
    std::vector<Vector3d> directions = {Vector3d::UnitZ(), Vector3d::UnitX(), Vector3d::UnitY()};
    for (const int power : {3, 4, 6}) add_extremal_directions(directions, points, power);
    // A polyhedral group has few axes; nearly round bodies have many irrelevant extrema.
    directions.resize(std::min(directions.size(), most_directions));
    return directions;
}

void add_polyhedral_operations(SymmetryGroup& group, std::vector<Vector3d> directions) {
    for (const Vector3d& direction : directions)
        add_operations_about(group, direction, highest_order_of_polyhedra);
    constexpr std::size_t most_combined = 10;
    directions.resize(std::min(directions.size(), most_combined));
    std::vector<Vector3d> combined = directions;
    for (const Vector3d& a : directions) {
        for (const Vector3d& b : directions) {
            add_new_direction(combined, a + b);
            add_new_direction(combined, a - b);
            add_new_direction(combined, a.cross(b));
        }
    }
    for (std::size_t i = directions.size(); i < combined.size(); ++i) {
        group.add_refined({combined[i], pi, true});
        group.add_refined({combined[i], pi, false});
    }
}

// The principal directions of the second moments, as columns. `free_axis`: the index of the one that is
// unique where the other two may be any perpendicular pair, 3 where none is unique, -1 where all three are.
struct PrincipalDirections {
    Matrix3d directions;
    int free_axis = -1;
};

PrincipalDirections principal_directions(const VolumeMoments& moments, double tolerance) {
    const auto [values, directions] = principal_values(moments.second_moments);
    const double limit = degenerate * tolerance * values[2];
    const bool low_pair = values[1] - values[0] < limit;
    const bool high_pair = values[2] - values[1] < limit;
    PrincipalDirections result{directions, -1};
    if (low_pair) result.free_axis = 2;
    if (high_pair) result.free_axis = 0;
    if (low_pair && high_pair) result.free_axis = 3;
    return result;
}

Symmetry finite_symmetry(const ImageComparison& images, const PrincipalDirections& principal,
                         const std::vector<Vector3d>& directions) {
    SymmetryGroup group(images);
    // Signed permutations first, so that bodies aligned with their axes get exact elements.
    for (const Matrix3d& element : signed_permutations()) group.add(element);
    group.add(-Matrix3d::Identity());
    if (principal.free_axis == 3) {
        // The cube's group is a subgroup of no larger finite one.
        if (group.elements().size() < 48) add_polyhedral_operations(group, directions);
    } else {
        for (int i = 0; i < 3; ++i) {
            const Vector3d direction = principal.directions.col(i);
            add_operations_about(group, direction, i == principal.free_axis ? highest_order : 2);
        }
        if (principal.free_axis >= 0) {
            add_operations_across(group, images, principal.directions.col(principal.free_axis));
        }
    }
    Symmetry symmetry;
    AlignedGroup aligned = aligned_group(group.elements());
    symmetry.axes = aligned.axes;
    symmetry.elements = std::move(aligned.elements);
    return symmetry;
}

Symmetry search(const ImageComparison& images, const VolumeMoments& moments) {
    const PrincipalDirections principal = principal_directions(moments, images.tolerance());
    std::vector<Vector3d> directions;
    if (principal.free_axis == 3) {
        if (is_spherical(images)) {
            Symmetry symmetry;
            symmetry.type = Symmetry::Type::spherical;
            symmetry.elements = {Matrix3d::Identity(), -Matrix3d::Identity()};
            return symmetry;
        }
        directions = polyhedral_directions(images);
    } else if (principal.free_axis >= 0) {
        directions.push_back(principal.directions.col(principal.free_axis));
    }
    if (const auto axis = axis_of_revolution(images, directions)) return axial_symmetry(images, *axis);
    return finite_symmetry(images, principal, directions);
}

}  // namespace

Symmetry find_symmetry(const Surface& surface, const VolumeMoments& moments, double tolerance) {
    const ImageComparison images(surface, moments.centroid, tolerance);
    Symmetry symmetry = search(images, moments);
    symmetry.tolerance = images.tolerance();
    return symmetry;
}

std::string describe(const Symmetry& symmetry) {
    if (symmetry.type == Symmetry::Type::spherical) return "spherical: all rotations and reflections";
    if (symmetry.type == Symmetry::Type::axial) {
        return fmt::format("a body of revolution about ({:.4g}, {:.4g}, {:.4g}){}", symmetry.axis.x(),
                           symmetry.axis.y(), symmetry.axis.z(),
                           symmetry.elements.size() > 2 ? ", with a mirror plane across that axis" : "");
    }
    const auto mirrors =
        std::count_if(symmetry.elements.begin(), symmetry.elements.end(), [](const Matrix3d& element) {
            return std::abs(element.trace() - 1.0) < 0.1 && element.determinant() < 0.0;
        });
    if (symmetry.elements.size() == 1) return "none";
    return fmt::format("{} rotations and reflections, {} mirror plane{}", symmetry.elements.size(), mirrors,
                       mirrors == 1 ? "" : "s");
}

}  // namespace samara
