// Bodies and obstacles that are hard to part: slivers, needles in corners, obstacles that move fast.

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/ground_bodies.hpp"
#include "support/obstacles.hpp"
#include "support/stability_row.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

const Fluid air = *fluid_preset("air");

Quaterniond turned(double angle, const Vector3d& axis) {
    return Quaterniond(Eigen::AngleAxisd(angle, axis.normalized()));
}

/// The deepest that the body's lowest point came below the height 0 (m), and whether all stayed numbers.
double deepest(const ImmersedBody& body, const Surroundings& surroundings, BodyState state, double duration,
               double step) {
    const Noise noise(1, "body", 0, 0);
    double depth = 0.0;
    const auto steps = static_cast<std::uint64_t>(std::lround(duration / step));
    for (std::uint64_t i = 0; i < steps; ++i) {
        state = advance(body, surroundings, 0.0, step, state, noise, i).state;
        if (!state.position.allFinite() || !state.velocity.allFinite()) return NAN;
        depth = std::max(depth, -test::lowest_point(body, state));
    }
    return depth;
}

std::string in_words(double step) {
    return step < 0.01 ? "2 ms" : "1/24 s";
}

TEST(ObstacleStability, SliverFacesCarryABodyAsOthersDo) {
    // Faces of 1 m by 20 micrometres beside whole ones.
    Surface surface;
    const double rows[] = {-0.5, -0.02, -0.01998, 0.0, 2e-5, 0.02, 0.5};
    for (const double y : rows) {
        surface.vertices.emplace_back(-0.5, y, 0.0);
        surface.vertices.emplace_back(0.5, y, 0.0);
    }
    for (int i = 0; i < 6; ++i) {
        surface.corners.push_back({2 * i, 2 * i + 1, 2 * i + 3});
        surface.corners.push_back({2 * i, 2 * i + 3, 2 * i + 2});
    }
    const Surroundings slivers = test::with_obstacles({test::obstacle(surface)});
    const ImmersedBody block = test::uniform_body(test::box({0.04, 0.03, 0.01}, 2), 700.0, air);
    for (const double step : {0.002, 1.0 / 24.0}) {
        double depth = 0.0;
        for (int i = 0; i < 8; ++i) {
            BodyState state;
            state.position = {0.0, 0.002 * i - 0.01, 0.06};
            state.orientation = turned(0.7 * i, {1.0, 0.2 * i, 0.3});
            depth = std::max(depth, deepest(block, slivers, state, 2.0, step));
        }
        test::expect_row({"a block on slivers of 20 micrometres", in_words(step),
                          "depth below the face, over its size", 1e-3,
                          depth / block.contact_points.bounding_radius});
    }
}

TEST(ObstacleStability, ANeedleInACornerStaysInIt) {
    const ImmersedBody needle = test::uniform_body(test::box({0.05, 0.0008, 0.0008}, 2), 2000.0, air);
    const auto wall = [](const Vector3d& place, const Vector3d& axis) {
        return test::obstacle(test::sheet(1.0, 1.0), {place, turned(0.5 * std::numbers::pi, axis)});
    };
    const Surroundings corner = test::with_obstacles(
        {test::obstacle(test::sheet(1.0, 1.0)), wall({0.03, 0, 0}, {0, 1, 0}), wall({-0.03, 0, 0}, {0, 1, 0}),
         wall({0, 0.01, 0}, {1, 0, 0}), wall({0, -0.01, 0}, {1, 0, 0})});
    for (const double step : {0.002, 1.0 / 24.0}) {
        double depth = 0.0;
        for (int i = 0; i < 6; ++i) {
            BodyState state;
            state.position = {0.0, 0.0, 0.1};
            state.orientation = turned(0.5 * std::numbers::pi + 0.1 * i, {0.0, 1.0, 0.02});
            state.velocity << 0.0, 1.0, 0.0, 0.0, 0.0, 0.0;
            depth = std::max(depth, deepest(needle, corner, state, 2.0, step));
        }
        test::expect_row({"a needle in a corner", in_words(step), "depth below the face, over its size", 0.02,
                          depth / needle.contact_points.bounding_radius});
    }
}

TEST(ObstacleStability, AnObstacleThatMovesFastTakesABodyAlongAndDoesNotPassIt) {
    // A thin sheet that rises at 20 m/s against a body that floats.
    const ImmersedBody block = test::uniform_body(test::box({0.04, 0.03, 0.01}, 2), 700.0, air);
    for (const double step : {0.002, 1.0 / 24.0}) {
        double below = 0.0;
        for (int i = 0; i < 8; ++i) {
            Obstacle bat = test::obstacle(test::sheet(2.0, 2.0));
            bat.keys = {{{Vector3d(0, 0, -1), Quaterniond::Identity()}, 0.0},
                        {{Vector3d(0, 0, 9), Quaterniond::Identity()}, 0.5}};
            const Surroundings surroundings = test::with_obstacles({bat});
            BodyState state;
            state.orientation = turned(0.6 * i, {1.0, 0.3 * i, 0.2});
            const Noise noise(1, "body", 0, 0);
            for (std::uint64_t k = 0; (static_cast<double>(k) + 1.0) * step <= 0.5; ++k) {
                state = advance(block, surroundings, 0.0, step, state, noise, k).state;
                const double height = place_of(bat, (static_cast<double>(k) + 1.0) * step).position.z();
                below = std::max(below, height - test::lowest_point(block, state));
            }
        }
        test::expect_row({"a block struck by a sheet at 20 m/s", in_words(step),
                          "depth below the sheet, over its size", 0.01,
                          below / block.contact_points.bounding_radius});
    }
}

}  // namespace
}  // namespace samara
