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

}  // namespace
}  // namespace samara
