#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshes/checks/sound_surface.hpp"
#include "samara/core/surface/surface_edges.hpp"
#include "samara/core/surface/welded_surface.hpp"
#include "support/expect_error.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

Surface box(const Vector3d& low, const Vector3d& high, int n = 1) {
    return test::mapped(test::box(high - low, n), Matrix3d::Identity(), 0.5 * (low + high));
}

Matrix3d some_rotation() {
    return Quaterniond(0.83, 0.31, -0.42, 0.27).normalized().toRotationMatrix();
}

// Returns the parts rotated and rounded to 32-bit numbers: sides that lie on each other then differ by some
// 1e-8.
Surface rotated(const std::vector<Surface>& parts) {
    Surface surface = test::mapped(test::together(parts), some_rotation(), Vector3d(0.4, -0.3, 0.2));
    for (Vector3d& vertex : surface.vertices) vertex = vertex.cast<float>().cast<double>();
    return surface;
}

void expect_joined(const Surface& parts, double volume, double area, double tolerance) {
    const Surface whole = with_parts_joined(welded(parts));
    EXPECT_NO_THROW(require_sound_surface(whole));
    EXPECT_EQ(components(whole).size(), 1U);
    EXPECT_NEAR(test::moments_of(whole).volume, volume, tolerance * volume);
    EXPECT_NEAR(surface_area(whole), area, tolerance * area);
}

struct Parts {
    const char* name;
    std::vector<Surface> parts;
    double volume;
    double area;
};

std::vector<Parts> all_parts() {
    const Surface cube = box({0, 0, 0}, {1, 1, 1});
    return {
        {"cubes that overlap by half", {cube, box({0.5, 0, 0}, {1.5, 1, 1})}, 1.5, 8.0},
        {"a box that stands on a larger one",
         {box({0, 0, 0}, {2, 2, 1}), box({0.5, 0.5, 1}, {1.5, 1.5, 2})},
         5.0,
         20.0},
        {"boxes of the same section", {cube, box({0, 0, 1}, {1, 1, 3})}, 3.0, 14.0},
        {"boxes of the same section and other triangles", {cube, box({0, 0, 1}, {1, 1, 3}, 3)}, 3.0, 14.0},
        {"beams that lie across each other",
         {box({-3, -1, 0}, {3, 1, 1}), box({-1, -3, 1}, {1, 3, 2})},
         24.0,
         72.0},
        {"beams that cross in a plane",
         {box({-3, -1, 0}, {3, 1, 1}), box({-1, -3, 0}, {1, 3, 1})},
         20.0,
         64.0},
        {"a box within a box, flush on one side",
         {box({0, 0, 0}, {4, 4, 4}), box({1, 1, 3}, {2, 2, 4})},
         64.0,
         96.0},
        {"a box twice", {cube, cube}, 1.0, 6.0},
        {"three in a row", {cube, box({1, 0.2, 0.2}, {2, 0.8, 0.8}), box({2, 0, 0}, {3, 1, 1})}, 2.36, 13.68},
    };
}

TEST(JoinedParts, ThoseThatOverlapOrTouchWithFlushSidesAreOneExactly) {
    for (const Parts& each : all_parts()) {
        SCOPED_TRACE(each.name);
        expect_joined(test::together(each.parts), each.volume, each.area, 1e-12);
    }
}

TEST(JoinedParts, SidesThatRoundingSetsApartAreFlush) {
    for (const Parts& each : all_parts()) {
        SCOPED_TRACE(each.name);
        expect_joined(rotated(each.parts), each.volume, each.area, 2e-5);
    }
}

TEST(JoinedParts, ThoseThatPassThroughEachOtherAreOne) {
    const Surface ball = test::icosphere(2);
    const Surface other = test::mapped(ball, some_rotation(), Vector3d(0.9, 0.1, 0.2));
    const Surface whole = with_parts_joined(welded(test::together({ball, other})));
    EXPECT_NO_THROW(require_sound_surface(whole));
    // Two unit balls 0.927 apart, as the difference of the spheres and the lens between them.
    const double ball_volume = test::moments_of(ball).volume;
    const double h = 0.5 * Vector3d(0.9, 0.1, 0.2).norm();
    const double share_of_cap = (1.0 - h) * (1.0 - h) * (2.0 + h) / 4.0;
    EXPECT_NEAR(test::moments_of(whole).volume, 2.0 * ball_volume * (1.0 - share_of_cap), 0.01 * ball_volume);
}

TEST(JoinedParts, WhatNothingTouchesStaysAsItIs) {
    const Surface apart = welded(test::together({box({0, 0, 0}, {1, 1, 1}), box({1.0001, 0, 0}, {2, 1, 1})}));
    const Surface same = with_parts_joined(apart);
    EXPECT_EQ(same.vertices, apart.vertices);
    EXPECT_EQ(same.corners, apart.corners);
}

TEST(JoinedParts, ThatTouchInAnEdgeOrAPointAloneAreRejectedByNumberAndPlace) {
    Matrix3d on_its_edge = Eigen::AngleAxisd(std::acos(-1.0) / 4.0, Vector3d::UnitY()).toRotationMatrix();
    const Surface plate = box({-2, -2, -1}, {2, 2, 0});
    const Surface edge =
        test::mapped(test::box(Vector3d::Ones(), 1), on_its_edge, Vector3d(0, 0, std::sqrt(0.5)));
    const std::string error = test::error_of([&] {
        with_parts_joined(welded(test::together({plate, edge})));
    });
    EXPECT_THAT(error, AllOf(HasSubstr("part 1 (from (-2, -2, -1) to (2, 2, 0)) and part 2"),
                             HasSubstr("cannot join"), HasSubstr("or move them apart by more than")));
    // As it says.
    const Surface apart = test::mapped(edge, Matrix3d::Identity(), Vector3d(0, 0, 1e-5));
    EXPECT_NO_THROW(require_sound_surface(with_parts_joined(welded(test::together({plate, apart})))));
}

TEST(JoinedParts, PanelsThatCloseABoxEncloseACavity) {
    constexpr double w = 0.1;
    const std::vector<Surface> panels = {
        box({0, 0, 0}, {1, 1, w}),         box({0, 0, 1 - w}, {1, 1, 1}),
        box({0, 0, w}, {w, 1, 1 - w}),     box({1 - w, 0, w}, {1, 1, 1 - w}),
        box({w, 0, w}, {1 - w, w, 1 - w}), box({w, 1 - w, w}, {1 - w, 1, 1 - w})};
    EXPECT_THAT(test::error_of([&] { with_parts_joined(welded(test::together(panels))); }),
                HasSubstr("enclose a cavity"));
}

TEST(JoinedParts, APartThatTouchesItselfIsFound) {
    // A ring cut open, whose ends lie on each other: a box of three sides bent into a square.
    Surface ring;
    const std::vector<Eigen::Vector2d> outer = {{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0}};
    const std::vector<Eigen::Vector2d> inner = {{1, 1}, {2, 1}, {2, 2}, {1, 2}, {1, 1}};
    for (const double z : {0.0, 1.0}) {
        for (std::size_t i = 0; i < 5; ++i) {
            // The last ring of corners is moved a little along the cut, so that welding leaves it.
            const Eigen::Vector2d along = i == 4 ? Eigen::Vector2d(0.01, 0.01) : Eigen::Vector2d(0.0, 0.0);
            ring.vertices.emplace_back(outer[i].x() + along.x(), outer[i].y() + along.y(), z);
            ring.vertices.emplace_back(inner[i].x() - along.x(), inner[i].y() - along.y(), z);
        }
    }
    const auto quad = [&](std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
        ring.corners.push_back({a, b, c});
        ring.corners.push_back({a, c, d});
    };
    for (std::int32_t i = 0; i < 4; ++i) {
        const std::int32_t o = 2 * i;
        quad(o, o + 1, o + 3, o + 2);          // bottom
        quad(o + 10, o + 12, o + 13, o + 11);  // top
        quad(o, o + 2, o + 12, o + 10);        // outside
        quad(o + 1, o + 11, o + 13, o + 3);    // inside
    }
    quad(0, 10, 11, 1);
    quad(8, 9, 19, 18);
    const Surface surface = with_parts_joined(welded(ring));
    EXPECT_THAT(test::error_of([&] { require_sound_surface(surface); }),
                AllOf(HasSubstr("touches itself"), HasSubstr("lie on each other")));
}

}  // namespace
}  // namespace samara
