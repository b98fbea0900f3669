#include "meshes/remeshing/remesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshes/checks/sound_surface.hpp"
#include "samara/core/surface/curved_surface.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

using std::numbers::pi;

MeshOptions with_triangles(int count, int order) {
    MeshOptions options;
    options.triangles = count;
    options.as_many_as_needed = false;
    options.order = order;
    return options;
}

double volume_of(const Surface& surface) {
    return test::moments_of(surface).volume;
}

const Vector3d semi_axes(1.0, 2.0, 4.0);

// How far the vertices lie from the ellipsoid, over its size there.
double distance_from_ellipsoid(const Surface& surface) {
    double greatest = 0.0;
    for (const Vector3d& vertex : surface.vertices) {
        greatest = std::max(greatest, std::abs(vertex.cwiseQuotient(semi_axes).norm() - 1.0));
    }
    return greatest;
}

TEST(Remesh, GivesTheNumberOfTrianglesThatWasAskedFor) {
    const Surface ellipsoid = test::ellipsoid(semi_axes, 4);
    for (const int count : {300, 1280, 3000}) {
        const Surface result = remesh(ellipsoid, with_triangles(count, 1), "ellipsoid").surface;
        EXPECT_NEAR(static_cast<double>(result.triangle_count()), count, 0.05 * count);
        EXPECT_EQ(result.order(), 1);
        EXPECT_NO_THROW(require_sound_surface(result));
    }
}

TEST(Remesh, PutsVerticesOnTheSmoothShapeThatTheTrianglesStandFor) {
    const Surface ellipsoid = test::ellipsoid(semi_axes, 4);
    const Surface result = remesh(ellipsoid, with_triangles(1000, 2), "ellipsoid").surface;
    EXPECT_EQ(result.order(), 2);
    // The given facets' own middles lie 1.6e-3 inside it.
    EXPECT_LT(distance_from_ellipsoid(result), 3e-4);
    EXPECT_NO_THROW(require_sound_surface(result));
}

// The chords of n equal triangles on a sphere lose 10.9 / n of the volume; more where curvatures differ.
TEST(Remesh, KeepsTheVolumeOfACurvedBodyUpToTheChordsOfItsTriangles) {
    const Surface ellipsoid = test::ellipsoid(semi_axes, 4);
    const double volume = 4.0 / 3.0 * pi * semi_axes.prod();
    std::vector<double> lost;
    for (const int count : {500, 2000}) {
        const double flat = volume_of(remesh(ellipsoid, with_triangles(count, 1), "ellipsoid").surface);
        lost.push_back(1.0 - flat / volume);
        EXPECT_GT(lost.back(), 10.0 / count);
        EXPECT_LT(lost.back(), 18.0 / count);
    }
    EXPECT_NEAR(lost[0] / lost[1], 4.0, 0.4);
}

TEST(Remesh, KeepsTheFacesAndEdgesOfABoxExactly) {
    const Vector3d edges(1.0, 2.0, 0.1);
    for (const int fineness : {1, 8}) {
        const Surface result =
            remesh(test::box(edges, fineness), with_triangles(800, automatic_order), "box").surface;
        EXPECT_EQ(result.order(), 1);
        EXPECT_NEAR(volume_of(result), edges.prod(), 1e-12 * edges.prod());
        EXPECT_NEAR(surface_area(result), 2.0 * (1.0 * 2.0 + 1.0 * 0.1 + 2.0 * 0.1), 1e-12);
        // Each corner of the box is a vertex, and each vertex lies on a face.
        for (int corner = 0; corner < 8; ++corner) {
            const Vector3d place(corner & 1 ? 0.5 : -0.5, corner & 2 ? 1.0 : -1.0, corner & 4 ? 0.05 : -0.05);
            EXPECT_TRUE(std::any_of(result.vertices.begin(), result.vertices.end(),
                                    [&](const Vector3d& vertex) { return (vertex - place).norm() < 1e-12; }));
        }
        for (const Vector3d& vertex : result.vertices) {
            EXPECT_NEAR(vertex.cwiseAbs().cwiseQuotient(0.5 * edges).maxCoeff(), 1.0, 1e-12);
        }
    }
}

TEST(Remesh, ReducesADenseSurfaceAndStaysOnIt) {
    const Surface dense = test::ellipsoid(semi_axes, 5);  // 20,480 triangles
    const Surface result = remesh(dense, with_triangles(600, 1), "dense").surface;
    EXPECT_NEAR(static_cast<double>(result.triangle_count()), 600.0, 30.0);
    EXPECT_LT(distance_from_ellipsoid(result), 2e-4);
}

TEST(Remesh, TakesASurfaceOfOrderTwoForWhatItsCurvedTrianglesAre) {
    const Surface curved = test::curved_ellipsoid(semi_axes, 2);  // 320 triangles
    const Surface result = remesh(curved, with_triangles(1280, 2), "curved").surface;
    EXPECT_LT(distance_from_ellipsoid(result), 0.02);
    const double exact = 4.0 / 3.0 * pi * semi_axes.prod();
    EXPECT_NEAR(volume_of(flattened(result, 4)), exact, 0.01 * exact);
}

TEST(Remesh, KeepsPiecesApart) {
    Surface two = test::icosphere(3);
    const Surface other = test::mapped(two, Matrix3d::Identity(), Vector3d(2.2, 0.0, 0.0));
    const auto first = static_cast<std::int32_t>(two.vertices.size());
    two.vertices.insert(two.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (const auto& [a, b, c] : other.corners) two.corners.push_back({a + first, b + first, c + first});
    const Surface result = remesh(two, with_triangles(1000, 1), "two").surface;
    EXPECT_NO_THROW(require_sound_surface(result));
    EXPECT_NEAR(volume_of(result), 8.0 / 3.0 * pi, 0.03 * 8.0 / 3.0 * pi);
    for (const Vector3d& vertex : result.vertices) EXPECT_GT(std::abs(vertex.x() - 1.1), 0.09);
}

TEST(Remesh, GivesTheSameEachTime) {
    const Surface uneven = test::shaken_icosphere(3, 0.3, 7);
    const Surface one = remesh(uneven, with_triangles(700, 2), "uneven").surface;
    const Surface two = remesh(uneven, with_triangles(700, 2), "uneven").surface;
    EXPECT_EQ(one.corners, two.corners);
    EXPECT_EQ(one.vertices, two.vertices);
    EXPECT_EQ(one.edge_nodes, two.edge_nodes);
}

TEST(Remesh, SizesAreThoseOfTheSurfaceInMetres) {
    MeshOptions options = with_triangles(0, 1);
    options.sizing = MeshOptions::Sizing::size;
    options.size = 0.25;
    const Surface result = remesh(test::box(Vector3d(4.0, 4.0, 4.0), 2), options, "box").surface;
    double longest = 0.0;
    for (std::size_t t = 0; t < result.triangle_count(); ++t)
        longest = std::max(longest, longest_edge(result, t));
    EXPECT_GT(longest, 0.2);
    EXPECT_LT(longest, 0.45);
}

TEST(Remesh, GivesMoreThanAskedForWhereTooFewAreNoBodies) {
    Surface many;
    for (int i = 0; i < 8; ++i) {
        const Surface one =
            test::mapped(test::icosphere(2), Matrix3d::Identity(), Vector3d(2.5 * i, 0.0, 0.0));
        const auto first = static_cast<std::int32_t>(many.vertices.size());
        many.vertices.insert(many.vertices.end(), one.vertices.begin(), one.vertices.end());
        for (const auto& [a, b, c] : one.corners) many.corners.push_back({a + first, b + first, c + first});
    }
    const MeshedShape result = remesh(many, with_triangles(16, 1), "many");
    EXPECT_GT(result.surface.triangle_count(), 16U);
    EXPECT_LT(std::abs(result.error.volume), 0.15);
    EXPECT_NO_THROW(require_sound_surface(result.surface));
}

TEST(Remesh, TellsItsProgressUpwards) {
    std::vector<double> shares;
    remesh(test::ellipsoid(semi_axes, 4), with_triangles(500, 1), "ellipsoid",
           [&](double share) { shares.push_back(share); });
    ASSERT_FALSE(shares.empty());
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_GE(shares.front(), 0.0);
    EXPECT_LE(shares.back(), 1.0);
}

}  // namespace
}  // namespace samara
