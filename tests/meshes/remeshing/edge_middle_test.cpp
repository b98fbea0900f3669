// Where the middle nodes of edges go on a smooth surface.
#include "meshes/remeshing/edge_middle.hpp"

#include <gtest/gtest.h>

namespace samara {
namespace {

const Vector3d semi_axes(1.0, 2.0, 4.0);

/// The point of the ellipsoid on the ray through a point.
Vector3d on_ellipsoid(const Vector3d& point) {
    return point / point.cwiseQuotient(semi_axes).norm();
}

/// The corners of two triangles of a sphere, stretched to the ellipsoid: an edge and what is across.
struct Pair {
    std::array<Vector3d, 2> ends, across;
};
Pair pair_of_size(double size) {
    const Vector3d at = Vector3d(0.5, 0.4, 0.7).normalized();
    const Vector3d x = Vector3d(0.2, 0.9, -0.5).cross(at).normalized();
    const Vector3d y = at.cross(x);
    const auto corner = [&](double u, double v) -> Vector3d {
        return semi_axes.cwiseProduct((at + size * (u * x + v * y)).normalized());
    };
    return {{corner(-0.5, 0.0), corner(0.5, 0.1)}, {corner(0.1, 0.8), corner(0.0, -0.9)}};
}

/// How far the found node lies from the middle of the sphere's arc, stretched alike; over the edge's length.
double off(double size) {
    const Pair pair = pair_of_size(size);
    const auto found = middle_on_surface(pair.ends, pair.across, on_ellipsoid);
    const Vector3d ideal = on_ellipsoid(pair.ends[0] + pair.ends[1]);
    return (found.value() - ideal).norm() / (pair.ends[1] - pair.ends[0]).norm();
}

/// How far the point nearest to the chord's middle lies from there.
double off_of_nearest(double size) {
    const Pair pair = pair_of_size(size);
    const Vector3d middle = 0.5 * (pair.ends[0] + pair.ends[1]);
    const Vector3d ideal = on_ellipsoid(middle);
    const Vector3d normal = ideal.cwiseQuotient(semi_axes.cwiseProduct(semi_axes)).normalized();
    const Vector3d along = (middle - ideal) - (middle - ideal).dot(normal) * normal;
    return along.norm() / (pair.ends[1] - pair.ends[0]).norm();
}

TEST(EdgeMiddle, OfAnEllipsoidIsThatOfTheSphereItIsStretchedFrom) {
    EXPECT_LT(off(0.2), 0.1 * off_of_nearest(0.2));
    EXPECT_LT(off(0.1), 0.1 * off_of_nearest(0.1));
}

TEST(EdgeMiddle, LiesOnTheSurface) {
    const Pair pair = pair_of_size(0.3);
    const Vector3d found = middle_on_surface(pair.ends, pair.across, on_ellipsoid).value();
    EXPECT_NEAR(found.cwiseQuotient(semi_axes).norm(), 1.0, 1e-12);
}

TEST(EdgeMiddle, IsHalfwayWhereNothingBends) {
    const std::array<Vector3d, 2> ends = {Vector3d(0.0, 0.0, 0.0), Vector3d(2.0, 1.0, 0.0)};
    const std::array<Vector3d, 2> across = {Vector3d(0.2, 3.0, 0.0), Vector3d(1.5, -1.0, 0.0)};
    const auto on_plane = [](const Vector3d& point) -> std::optional<Vector3d> { return point; };
    const Vector3d found = middle_on_surface(ends, across, on_plane).value();
    EXPECT_LT((found - Vector3d(1.0, 0.5, 0.0)).norm(), 1e-12);
}

TEST(EdgeMiddle, IsNotKnownWhereTheSurfaceIsNot) {
    const Pair pair = pair_of_size(0.2);
    const auto in_half = [&](const Vector3d& point) -> std::optional<Vector3d> {
        const bool is_left = (point - pair.across[0]).norm() < (point - pair.across[1]).norm();
        return is_left ? std::optional(on_ellipsoid(point)) : std::nullopt;
    };
    EXPECT_FALSE(middle_on_surface(pair.ends, pair.across, in_half));
}

}  // namespace
}  // namespace samara
