#include <algorithm>

#include <gtest/gtest.h>

#include "meshes/checks/shape_error.hpp"
#include "meshes/checks/sound_surface.hpp"
#include "meshes/checks/triangle_tree.hpp"
#include "meshes/remeshing/remesh.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

double greatest_distance(const Surface& points, const Surface& surface) {
    const TriangleTree tree(surface.vertices, surface.corners);
    double squared = 0.0;
    for (const Vector3d& point : points.vertices) {
        squared = std::max(squared, tree.nearest(point).squared_distance);
    }
    return std::sqrt(squared);
}

TEST(ReducedSurface, StaysSoundAndCloseToTheShape) {
    const Surface dense = test::ellipsoid(Vector3d(1.0, 2.0, 4.0), 5);
    for (const std::size_t wanted : {8000U, 2000U, 500U}) {
        const Surface few = reduced(dense, wanted);
        EXPECT_LE(few.triangle_count(), wanted);
        EXPECT_GT(few.triangle_count(), wanted * 9 / 10);
        EXPECT_NO_THROW(require_sound_surface(few));
        // Chords of equilateral triangles on a sphere of radius 2 would be 6 / wanted deep.
        EXPECT_LT(greatest_distance(dense, few), 40.0 / static_cast<double>(wanted));
    }
}

TEST(ReducedSurface, KeepsTheEdgesOfABoxAndOfAThinPlate) {
    for (const Vector3d& edges :
         {Vector3d(1.0, 2.0, 3.0), Vector3d(1.0, 1.0, 1e-3), Vector3d(1.0, 1.0, 1e-4)}) {
        const Surface few = reduced(test::box(edges, 30), 1000);
        EXPECT_LE(few.triangle_count(), 1000U);
        EXPECT_NO_THROW(require_sound_surface(few));
        EXPECT_NEAR(volume_moments(few).volume, edges.prod(), 1e-10 * edges.prod());
    }
}

TEST(ReducedSurface, KeepsPiecesApart) {
    Surface two = test::icosphere(4);
    const Surface other = test::mapped(two, Matrix3d::Identity(), Vector3d(2.01, 0.0, 0.0));
    const auto first = static_cast<std::int32_t>(two.vertices.size());
    two.vertices.insert(two.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (const auto& [a, b, c] : other.corners) two.corners.push_back({a + first, b + first, c + first});
    const Surface few = reduced(two, 600);
    EXPECT_NO_THROW(require_sound_surface(few));
    EXPECT_NEAR(volume_moments(few).volume, volume_moments(two).volume, 0.05 * volume_moments(two).volume);
}

TEST(ReducedSurface, LeavesWhatIsFewEnough) {
    const Surface sphere = test::icosphere(2);
    EXPECT_EQ(reduced(sphere, 320).corners, sphere.corners);
}

}  // namespace
}  // namespace samara
