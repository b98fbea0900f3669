#include "meshes/remeshing/smooth_shape.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "meshes/remeshing/mesh_size_field.hpp"
#include "samara/core/surface/creases.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

// The greatest distance of lifted points from the unit ellipsoid, relative.
double distance_from_ellipsoid(const Vector3d& semi_axes, int level) {
    const Surface flat = test::ellipsoid(semi_axes, level);
    const SmoothShape shape(flat, sharp_angle);
    double largest = 0.0;
    for (std::size_t t = 0; t < flat.triangle_count(); ++t) {
        const auto lifted = shape.on_surface(triangle_centroid(flat, t), area_vector(flat, t));
        EXPECT_TRUE(lifted.has_value());
        if (lifted) largest = std::max(largest, std::abs(lifted->cwiseQuotient(semi_axes).norm() - 1.0));
    }
    return largest;
}

TEST(SmoothShape, LiftsFacetsOntoASphereToFourthOrder) {
    const double coarse = distance_from_ellipsoid(Vector3d::Ones(), 3);
    const double fine = distance_from_ellipsoid(Vector3d::Ones(), 4);
    EXPECT_LT(fine, 1e-5);
    EXPECT_NEAR(std::log2(coarse / fine), 4.0, 0.3);
}

TEST(SmoothShape, LiftsFacetsOntoAnEllipsoidToThirdOrderOrBetter) {
    const double coarse = distance_from_ellipsoid(Vector3d(1.0, 2.0, 4.0), 4);
    const double fine = distance_from_ellipsoid(Vector3d(1.0, 2.0, 4.0), 5);
    EXPECT_LT(fine, 1e-4);
    EXPECT_GT(std::log2(coarse / fine), 2.5);
}

TEST(SmoothShape, LeavesThePlacesOfAPolyhedronAlone) {
    const Surface box = test::box(Vector3d(1.0, 2.0, 3.0), 3);
    const SmoothShape shape(box, sharp_angle);
    const Vector3d on_face(0.5, 0.37, -0.91);
    const auto lifted = shape.on_surface(on_face, Vector3d::UnitX());
    ASSERT_TRUE(lifted.has_value());
    EXPECT_LT((*lifted - on_face).norm(), 1e-15);
    const Vector3d on_edge(0.5, 1.0, 0.123);
    const auto along = shape.on_crease(on_edge, 0.1);
    ASSERT_TRUE(along.has_value());
    EXPECT_LT((*along - on_edge).norm(), 1e-15);
}

TEST(SmoothShape, HasNoPlaceOnTheFarSideOfAThinBody) {
    const SmoothShape shape(test::box(Vector3d(1.0, 1.0, 0.01), 4), sharp_angle);
    EXPECT_FALSE(shape.on_surface(Vector3d(0.1, 0.1, 0.006), -Vector3d::UnitZ()).has_value());
    EXPECT_TRUE(shape.on_surface(Vector3d(0.1, 0.1, 0.006), Vector3d::UnitZ()).has_value());
}

TEST(SmoothShape, HasNoCreaseWhereNoneIsNear) {
    EXPECT_FALSE(SmoothShape(test::icosphere(3), sharp_angle).on_crease(Vector3d::UnitX(), 10.0).has_value());
    const SmoothShape box(test::box(Vector3d::Ones(), 2), sharp_angle);
    EXPECT_FALSE(box.on_crease(Vector3d(0.5, 0.0, 0.0), 0.4).has_value());
    EXPECT_TRUE(box.on_crease(Vector3d(0.5, 0.0, 0.0), 0.6).has_value());
}

const Vector3d ellipsoid_axes(1.0, 2.0, 4.0);

/// The point of the ellipsoid on the ray through a point.
Vector3d on_ellipsoid(const Vector3d& point) {
    return point / point.cwiseQuotient(ellipsoid_axes).norm();
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
        return ellipsoid_axes.cwiseProduct((at + size * (u * x + v * y)).normalized());
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
    const Vector3d normal = ideal.cwiseQuotient(ellipsoid_axes.cwiseProduct(ellipsoid_axes)).normalized();
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
    EXPECT_NEAR(found.cwiseQuotient(ellipsoid_axes).norm(), 1.0, 1e-12);
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
