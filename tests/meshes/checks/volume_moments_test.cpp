#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "meshes/checks/shape_error.hpp"
#include "samara/core/surface/curved_surface.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

using std::numbers::pi;

TEST(VolumeMoments, OfABoxAreExact) {
    const Vector3d edges(0.01, 0.02, 0.05);
    const Vector3d shift(3.0, -2.0, 1.0);
    const VolumeMoments moments =
        volume_moments(test::mapped(test::box(edges, 3), Matrix3d::Identity(), shift));
    const double volume = edges.prod();
    EXPECT_NEAR(moments.volume, volume, 1e-12 * volume);
    EXPECT_LT((moments.centroid - shift).norm(), 1e-13);
    const Vector3d squares = edges.cwiseProduct(edges) / 12.0 * volume;
    EXPECT_LT((moments.second_moments - Matrix3d(squares.asDiagonal())).norm(), 1e-12 * squares.norm());
    EXPECT_NEAR(moments.surface_area, 2.0 * (0.0002 + 0.001 + 0.0005), 1e-15);
}

TEST(VolumeMoments, OfATetrahedronAreExact) {
    Surface corner;
    corner.vertices = {Vector3d::Zero(), Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
    corner.corners = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    const VolumeMoments moments = volume_moments(corner);
    EXPECT_NEAR(moments.volume, 1.0 / 6.0, 1e-15);
    EXPECT_LT((moments.centroid - Vector3d::Constant(0.25)).norm(), 1e-15);
    // Integral of x^2 is 1/60 and of xy 1/120 about the corner; less V c c^T.
    Matrix3d expected = Matrix3d::Constant(1.0 / 120.0 - 1.0 / 96.0);
    expected.diagonal().setConstant(1.0 / 60.0 - 1.0 / 96.0);
    EXPECT_LT((moments.second_moments - expected).norm(), 1e-16);
    EXPECT_NEAR(moments.surface_area, 1.5 + std::sqrt(3.0) / 2.0, 1e-15);
}

TEST(VolumeMoments, AreNegativeInsideOut) {
    Surface box = test::box(Vector3d::Ones(), 1);
    for (auto& triangle : box.corners) std::swap(triangle[1], triangle[2]);
    EXPECT_NEAR(volume_moments(box).volume, -1.0, 1e-14);
}

TEST(VolumeMoments, OfStraightSidedOrder2AreThoseOfOrder1) {
    const Surface flat = test::ellipsoid(Vector3d(1.0, 2.0, 4.0), 1, Vector3d(0.3, 0.2, 0.1));
    const VolumeMoments one = volume_moments(flat);
    const VolumeMoments two = volume_moments(with_straight_edge_nodes(flat));
    EXPECT_NEAR(two.volume, one.volume, 1e-13 * one.volume);
    EXPECT_NEAR(two.surface_area, one.surface_area, 1e-13 * one.surface_area);
    EXPECT_LT((two.centroid - one.centroid).norm(), 1e-13);
    EXPECT_LT((two.second_moments - one.second_moments).norm(), 1e-12 * one.second_moments.norm());
}

// The rule is exact for the quadratic geometry, so cutting the triangles finer changes nothing but rounding:
// checked against the flat formula on ever finer flat triangles, extrapolated.
TEST(VolumeMoments, OfCurvedTrianglesAreThoseOfTheCurvedSurface) {
    const Surface curved = test::curved_ellipsoid(Vector3d(1.0, 2.0, 4.0), 0);
    const double coarse = volume_moments(flattened(curved, 32)).volume;
    const double fine = volume_moments(flattened(curved, 64)).volume;
    const double extrapolated = fine + (fine - coarse) / 3.0;
    EXPECT_NEAR(volume_moments(curved).volume, extrapolated, 1e-6 * extrapolated);
}

struct Errors {
    double volume, second_moments, area;
};

Errors errors_of(const Surface& surface) {
    const Vector3d axes(1.0, 2.0, 4.0);
    const VolumeMoments moments = volume_moments(surface);
    const double volume = 4.0 / 3.0 * pi * axes.prod();
    const Matrix3d second = (volume / 5.0 * axes.cwiseProduct(axes)).asDiagonal();
    // The ellipsoid with semi-axes 1, 2, 4: by Gauss quadrature of the sphere's image.
    const double area = 63.476648652460796;
    return {std::abs(moments.volume / volume - 1.0), (moments.second_moments - second).norm() / second.norm(),
            std::abs(moments.surface_area / area - 1.0)};
}

TEST(VolumeMoments, OfFlatTrianglesConvergeAtSecondOrder) {
    const Errors coarse = errors_of(test::ellipsoid(Vector3d(1.0, 2.0, 4.0), 2));
    const Errors fine = errors_of(test::ellipsoid(Vector3d(1.0, 2.0, 4.0), 3));
    EXPECT_NEAR(std::log2(coarse.volume / fine.volume), 2.0, 0.1);
    EXPECT_NEAR(std::log2(coarse.second_moments / fine.second_moments), 2.0, 0.1);
    EXPECT_NEAR(std::log2(coarse.area / fine.area), 2.0, 0.1);
}

TEST(VolumeMoments, OfCurvedTrianglesConvergeAtFourthOrder) {
    const Errors coarse = errors_of(test::curved_ellipsoid(Vector3d(1.0, 2.0, 4.0), 1));
    const Errors fine = errors_of(test::curved_ellipsoid(Vector3d(1.0, 2.0, 4.0), 2));
    EXPECT_NEAR(std::log2(coarse.volume / fine.volume), 4.0, 0.3);
    EXPECT_NEAR(std::log2(coarse.second_moments / fine.second_moments), 4.0, 0.3);
    EXPECT_LT(fine.volume, 1e-3);
}

}  // namespace
}  // namespace samara
