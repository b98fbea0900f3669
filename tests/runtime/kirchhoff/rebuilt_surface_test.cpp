#include "samara/kirchhoff/surfaces/rebuilt_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "samara/core/surface/curved_surface.hpp"
#include "samara/core/surface/surface_check.hpp"
#include "samara/kirchhoff/surfaces/refinement.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

/// The largest distance of an edge node from the ellipsoid.
double node_error(const Surface& flat, const Vector3d& semi_axes) {
    const Surface rebuilt = rebuilt_surface(flat, find_creases(flat));
    double worst = 0.0;
    for (std::size_t i = flat.vertices.size(); i < rebuilt.vertices.size(); ++i) {
        const Vector3d unit = rebuilt.vertices[i].cwiseQuotient(semi_axes);
        worst = std::max(worst, std::abs(unit.norm() - 1.0) / unit.cwiseQuotient(semi_axes).norm());
    }
    return worst;
}

/// An upright prism over a polygon of n sides around the unit circle, each side cut in two triangles.
Surface cylinder(int n, double height) {
    Surface surface;
    for (const double z : {0.0, height}) {
        for (int i = 0; i < n; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / n;
            surface.vertices.emplace_back(std::cos(angle), std::sin(angle), z);
        }
    }
    surface.vertices.emplace_back(0.0, 0.0, 0.0);
    surface.vertices.emplace_back(0.0, 0.0, height);
    for (int i = 0; i < n; ++i) {
        const int next = (i + 1) % n;
        surface.corners.push_back({i, next, next + n});
        surface.corners.push_back({i, next + n, i + n});
        surface.corners.push_back({2 * n, next, i});
        surface.corners.push_back({2 * n + 1, i + n, next + n});
    }
    return surface;
}

TEST(RebuiltSurface, EdgeNodesOfASmoothBodyAreRightToTheFourthOrder) {
    for (const Vector3d& semi_axes : {Vector3d(1.0, 1.0, 1.0), Vector3d(1.0, 2.0, 4.0)}) {
        const double coarse = node_error(test::ellipsoid(semi_axes, 3), semi_axes);
        const double fine = node_error(test::ellipsoid(semi_axes, 4), semi_axes);
        EXPECT_GT(std::log2(coarse / fine), 3.5);
        EXPECT_LT(fine, 2e-4 * semi_axes.maxCoeff());
    }
}

TEST(RebuiltSurface, EdgeNodesOfAnUnevenMeshAreTenTimesNearerThanTheStraightEdges) {
    const Surface flat = test::shaken_icosphere(3, 0.3, 5);
    const Surface straight = with_straight_edge_nodes(flat);
    double straight_error = 0.0;
    for (const Vector3d& vertex : straight.vertices) {
        straight_error = std::max(straight_error, 1.0 - vertex.norm());
    }
    EXPECT_LT(10.0 * node_error(flat, Vector3d::Ones()), straight_error);
}

TEST(RebuiltSurface, OfAPolyhedronIsThePolyhedron) {
    const Surface flat = test::box({1.0, 2.0, 0.01}, 4);
    const Surface rebuilt = rebuilt_surface(flat, find_creases(flat));
    const Surface straight = with_straight_edge_nodes(flat);
    ASSERT_EQ(rebuilt.vertices.size(), straight.vertices.size());
    for (std::size_t i = 0; i < rebuilt.vertices.size(); ++i) {
        EXPECT_LT((rebuilt.vertices[i] - straight.vertices[i]).norm(), 1e-12);
    }
}

TEST(RebuiltSurface, KeepsTheRimOfADiscSharpAndMakesItRound) {
    const Surface flat = cylinder(24, 0.2);
    const CreasedSurface rebuilt = {rebuilt_surface(flat, find_creases(flat)), find_creases(flat)};
    const Surface fine = without_edge_nodes(refined(rebuilt).surface);
    const double exact = std::numbers::pi * 0.2;
    EXPECT_NEAR(test::moments_of(fine).volume, exact, 5e-3 * exact);
    EXPECT_GT(exact - test::moments_of(flat).volume, 1e-2 * exact);
    for (const Vector3d& vertex : fine.vertices) {
        EXPECT_GT(vertex.z(), -1e-12);
        EXPECT_LT(vertex.z(), 0.2 + 1e-12);
    }
}

TEST(Creases, AreTheTwelveEdgesOfABox) {
    constexpr int n = 3;
    const Creases creases = find_creases(test::box({1.0, 2.0, 3.0}, n));
    std::ptrdiff_t sides = 0;
    for (const auto& triangle : creases) sides += std::count(triangle.begin(), triangle.end(), true);
    EXPECT_EQ(sides, 2 * 12 * n);
    EXPECT_FALSE(any_crease(find_creases(test::icosphere(2))));
}

TEST(Creases, AreFoundWhereAFlatSheetIsFoldedALittleButNotOnACylinder) {
    Surface sheet = test::box({1.0, 1.0, 0.01}, 4);
    for (Vector3d& vertex : sheet.vertices) vertex.z() += 0.15 * std::max(0.0, vertex.x());
    const Creases folded = find_creases(sheet);
    int along_fold = 0;
    for (std::size_t t = 0; t < folded.size(); ++t) {
        for (std::size_t side = 0; side < 3; ++side) {
            const Vector3d& from = sheet.vertices[static_cast<std::size_t>(sheet.corners[t][side])];
            const Vector3d& to = sheet.vertices[static_cast<std::size_t>(sheet.corners[t][(side + 1) % 3])];
            const bool is_on_fold =
                std::abs(from.x()) < 1e-9 && std::abs(to.x()) < 1e-9 && std::abs(from.z() - to.z()) < 1e-9;
            if (is_on_fold && folded[t][side]) ++along_fold;
        }
    }
    EXPECT_EQ(along_fold, 2 * 2 * 4);
    // A cylinder's sides turn by 15 degrees, and are no creases: its two rims are.
    const Creases round = find_creases(cylinder(24, 0.5));
    std::ptrdiff_t sides = 0;
    for (const auto& triangle : round) sides += std::count(triangle.begin(), triangle.end(), true);
    EXPECT_EQ(sides, 2 * 2 * 24);
}

TEST(RefinedSurface, CutsEachTriangleInFourOnTheSameSurface) {
    const Surface curved = test::curved_ellipsoid({1.0, 2.0, 4.0}, 2);
    const CreasedSurface fine = refined({curved, find_creases(curved)});
    EXPECT_EQ(fine.surface.triangle_count(), 4 * curved.triangle_count());
    EXPECT_NO_THROW(require_bounding_surface(fine.surface));
    EXPECT_EQ(fine.surface.vertices.size(), 2 * fine.surface.triangle_count() + 2);  // Euler, order 2
    // Without creases the cuts are the given edge nodes.
    const Surface corners = without_edge_nodes(fine.surface);
    EXPECT_NEAR(test::moments_of(corners).volume,
                test::moments_of(test::ellipsoid({1.0, 2.0, 4.0}, 3)).volume, 1e-9);
}

TEST(RefinedSurface, OfABoxIsTheBoxWithTrianglesGradedToItsEdges) {
    const Surface flat = test::box({1.0, 1.0, 1.0}, 2);
    CreasedSurface fine = {rebuilt_surface(flat, find_creases(flat)), find_creases(flat)};
    for (int i = 0; i < 2; ++i) fine = refined(fine);
    const Surface corners = without_edge_nodes(fine.surface);
    EXPECT_NO_THROW(require_bounding_surface(corners));
    EXPECT_NEAR(test::moments_of(corners).volume, 1.0, 1e-12);
    EXPECT_NEAR(surface_area(corners), 6.0, 1e-12);
    double nearest = 1.0;  // of the vertices off the edges, to an edge
    for (const Vector3d& vertex : corners.vertices) {
        Vector3d depth = Vector3d::Constant(0.5) - vertex.cwiseAbs();
        std::sort(depth.begin(), depth.end());
        if (depth[1] > 1e-9) nearest = std::min(nearest, depth[1]);
    }
    EXPECT_NEAR(nearest, 0.5 * cut_towards_creases * cut_towards_creases, 1e-12);
    EXPECT_EQ(fine.creases, find_creases(fine.surface));
}

}  // namespace
}  // namespace samara
