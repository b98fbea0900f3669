#include "samara/scene/terminal_speed.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/test_shapes.hpp"

namespace samara {
namespace {

const Fluid water = *fluid_preset("water");
constexpr double gravity = 9.81;

Body ellipsoid(const Vector3d& semi_axes) {
    Body body;
    body.surface = test::ellipsoid(semi_axes, 4);
    body.moments = test::moments_of(body.surface);
    return body;
}

Body sphere(double radius) {
    return ellipsoid(Vector3d::Constant(radius));
}

double mass_at(const Body& body, double density) {
    return density * body.moments.volume;
}

TEST(TerminalSpeed, BalancesWeightBuoyancyAndDragOfASphere) {
    const double radius = 0.01;
    const Body body = sphere(radius);
    const double expected =
        std::sqrt(8.0 / 3.0 * radius * gravity * (2000.0 / water.density - 1.0) / terminal_drag_coefficient);
    EXPECT_NEAR(terminal_speed(body, water, mass_at(body, 2000.0), gravity), expected, 2e-3 * expected);
}

TEST(TerminalSpeed, IsThatOfTheExcessWhetherTheBodySinksOrRises) {
    const Body body = sphere(0.02);
    const double sinking = terminal_speed(body, water, mass_at(body, water.density + 300.0), gravity);
    const double rising = terminal_speed(body, water, mass_at(body, water.density - 300.0), gravity);
    EXPECT_NEAR(sinking, rising, 1e-12);
}

TEST(TerminalSpeed, GrowsWithTheRootOfSizeAndGravity) {
    const Body small = ellipsoid({0.01, 0.02, 0.04});
    const Body large = ellipsoid({0.04, 0.08, 0.16});
    const double speed = terminal_speed(small, water, mass_at(small, 1200.0), gravity);
    EXPECT_NEAR(terminal_speed(large, water, mass_at(large, 1200.0), gravity), 2.0 * speed, 1e-12);
    EXPECT_NEAR(terminal_speed(small, water, mass_at(small, 1200.0), 4.0 * gravity), 2.0 * speed, 1e-12);
}

TEST(TerminalSpeed, IsNoneWithoutGravityOrWhereTheBodyFloats) {
    const Body body = sphere(0.01);
    EXPECT_EQ(terminal_speed(body, water, mass_at(body, 2000.0), 0.0), 0.0);
    EXPECT_EQ(terminal_speed(body, water, mass_at(body, water.density), gravity), 0.0);
}

TEST(LargestProjectedArea, OfAnEllipsoidIsThatAlongItsShortestAxis) {
    const Body body = ellipsoid({0.01, 0.02, 0.04});
    const double exact = std::numbers::pi * 0.02 * 0.04;
    EXPECT_NEAR(largest_projected_area(body), exact, 2e-3 * exact);
}

}  // namespace
}  // namespace samara
