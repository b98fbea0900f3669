#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "meshes/checks/sound_surface.hpp"
#include "meshes/remeshing/mesh_size_field.hpp"
#include "meshes/remeshing/remesh.hpp"
#include "meshes/remeshing/smooth_shape.hpp"
#include "samara/core/surface/creases.hpp"
#include "samara/core/surface/surface_edges.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

using std::numbers::pi;

MeshOptions with_triangles(int count) {
    MeshOptions options;
    options.triangles = count;
    options.as_many_as_needed = false;
    options.order = 1;
    return options;
}

Surface remeshed_alone(const Surface& start, const MeshOptions& options, double crease_angle = sharp_angle) {
    const SmoothShape shape(start, crease_angle);
    const MeshSizeField field(start);
    return remeshed(start, shape, field, options, crease_angle);
}

// The standard deviation of the edges' lengths over their mean.
double spread_of_lengths(const Surface& surface) {
    std::vector<double> lengths;
    const std::vector<EdgeUse> uses = edge_uses(surface);
    for (const auto& edge : edges_of(uses)) {
        const EdgeUse& use = edge.front();
        lengths.push_back((surface.vertices[static_cast<std::size_t>(use.high)] -
                           surface.vertices[static_cast<std::size_t>(use.low)])
                              .norm());
    }
    double mean = 0.0;
    for (const double length : lengths) mean += length / static_cast<double>(lengths.size());
    double variance = 0.0;
    for (const double length : lengths) {
        variance += (length - mean) * (length - mean) / static_cast<double>(lengths.size());
    }
    return std::sqrt(variance) / mean;
}

double smallest_angle(const Surface& surface) {
    double smallest = pi;
    for (const auto& triangle : surface.corners) {
        for (std::size_t i = 0; i < 3; ++i) {
            const auto vertex = [&](std::size_t k) -> const Vector3d& {
                return surface.vertices[static_cast<std::size_t>(triangle[k % 3])];
            };
            const Vector3d one = vertex(i + 1) - vertex(i);
            const Vector3d two = vertex(i + 2) - vertex(i);
            smallest = std::min(smallest, std::atan2(one.cross(two).norm(), one.dot(two)));
        }
    }
    return smallest;
}

bool is_closed(const Surface& surface) {
    const std::vector<EdgeUse> uses = edge_uses(surface);
    bool closed = true;
    for (const auto& edge : edges_of(uses)) closed = closed && edge.size() == 2;
    return closed;
}

TEST(RemeshedSurface, HasSidesOfLikeLengthWhereTheGivenOnesWereUneven) {
    const Surface uneven = test::shaken_icosphere(3, 0.35, 3);
    const Surface result = remeshed_alone(uneven, with_triangles(1280));
    EXPECT_LT(spread_of_lengths(result), 0.7 * spread_of_lengths(uneven));
    EXPECT_GT(smallest_angle(result), smallest_angle(uneven));
    EXPECT_GT(smallest_angle(result), 25.0 / 180.0 * pi);
}

TEST(RemeshedSurface, StaysClosedAndSoundAsItGetsFinerOrCoarser) {
    const Surface sphere = test::icosphere(3);  // 1280 triangles
    for (const int count : {200, 1280, 5000}) {
        const Surface result = remeshed_alone(sphere, with_triangles(count));
        EXPECT_NEAR(static_cast<double>(result.triangle_count()), count, 0.05 * count);
        EXPECT_TRUE(is_closed(result));
        EXPECT_EQ(result.order(), 1);
        EXPECT_NO_THROW(require_sound_surface(result));
        // Euler's formula for a closed surface without holes.
        EXPECT_EQ(2 * result.vertices.size(), result.triangle_count() + 4);
    }
}

TEST(RemeshedSurface, KeepsItsVerticesOnTheSmoothShape) {
    const Surface sphere = test::icosphere(3);  // its facets' middles lie 7e-3 inside the sphere
    const Surface result = remeshed_alone(sphere, with_triangles(3000));
    double greatest = 0.0;
    for (const Vector3d& vertex : result.vertices) {
        greatest = std::max(greatest, std::abs(vertex.norm() - 1.0));
    }
    EXPECT_LT(greatest, 2e-4);
    // The chords of n triangles with equal sides lose 10.9 / n of the sphere's volume.
    const double lost = 1.0 - test::moments_of(result).volume / (4.0 / 3.0 * pi);
    EXPECT_NEAR(lost * static_cast<double>(result.triangle_count()), 10.9, 1.1);
}

TEST(RemeshedSurface, KeepsCreasesAndCorners) {
    const Vector3d edges(1.0, 2.0, 3.0);
    const Surface result = remeshed_alone(test::box(edges, 4), with_triangles(1500));
    EXPECT_NEAR(test::moments_of(result).volume, edges.prod(), 1e-12 * edges.prod());
    EXPECT_NEAR(surface_area(result), 22.0, 1e-11);
    // All twelve edges are there, from corner to corner, in sides of triangles.
    double length = 0.0;
    const std::vector<EdgeUse> uses = edge_uses(result);
    for (const auto& edge : edges_of(uses)) {
        const Vector3d one = area_vector(result, static_cast<std::size_t>(edge.front().triangle));
        const Vector3d two = area_vector(result, static_cast<std::size_t>(edge.back().triangle));
        if (one.dot(two) > 0.5 * one.norm() * two.norm()) continue;
        length += (result.vertices[static_cast<std::size_t>(edge.front().high)] -
                   result.vertices[static_cast<std::size_t>(edge.front().low)])
                      .norm();
    }
    EXPECT_NEAR(length, 4.0 * (1.0 + 2.0 + 3.0), 1e-11);
}

TEST(RemeshedSurface, TakesShallowFoldsForCreasesFromTheAngleThatIsGiven) {
    // A roof with an angle of 30 degrees along x = 0 of a long house.
    Surface house = test::box(Vector3d(2.0, 2.0, 1.0), 8);
    const double rise = std::tan(15.0 / 180.0 * pi);
    for (Vector3d& vertex : house.vertices) {
        if (vertex.z() > 0.49) vertex.z() += rise * (1.0 - std::abs(vertex.x()));
    }
    ASSERT_NO_THROW(require_sound_surface(house));
    const double volume = test::moments_of(house).volume;
    const Surface result = remeshed_alone(house, with_triangles(800), 20.0 / 180.0 * pi);
    EXPECT_NEAR(test::moments_of(result).volume, volume, 1e-10);
    double highest = 0.0;
    for (const Vector3d& vertex : result.vertices) highest = std::max(highest, vertex.z());
    EXPECT_NEAR(highest, 0.5 + rise, 1e-12);
}

TEST(RemeshedSurface, SizesFollowTheField) {
    MeshOptions options = with_triangles(0);
    options.sizing = MeshOptions::Sizing::size;
    options.size = 0.2;
    const Surface sphere = test::icosphere(3);
    const MeshSizeField field(sphere);
    const Surface result = remeshed_alone(sphere, options);
    // Sides are split above 4/3 of the wanted length, and drawn together below 4/5 where that makes none
    // longer.
    double mean = 0.0;
    double greatest = 0.0;
    const std::vector<EdgeUse> uses = edge_uses(result);
    const auto edges = edges_of(uses);
    for (const auto& edge : edges) {
        const Vector3d& low = result.vertices[static_cast<std::size_t>(edge.front().low)];
        const Vector3d& high = result.vertices[static_cast<std::size_t>(edge.front().high)];
        const double ratio = (high - low).norm() / (options.size * field(0.5 * (low + high)));
        mean += ratio / static_cast<double>(edges.size());
        greatest = std::max(greatest, ratio);
    }
    EXPECT_GT(mean, 2.0 / 3.0);
    EXPECT_LT(mean, 1.1);
    EXPECT_LT(greatest, 1.5);
}

TEST(RemeshedSurface, IsTheSameEachTime) {
    const Surface uneven = test::shaken_icosphere(3, 0.35, 3);
    const Surface one = remeshed_alone(uneven, with_triangles(900));
    const Surface two = remeshed_alone(uneven, with_triangles(900));
    EXPECT_EQ(one.vertices, two.vertices);
    EXPECT_EQ(one.corners, two.corners);
}

}  // namespace
}  // namespace samara
