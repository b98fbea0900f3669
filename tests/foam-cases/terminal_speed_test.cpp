#include "foam-cases/terminal_speed.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "samara/base/error.hpp"
#include "test_bodies.hpp"

namespace samara {
namespace {

const Fluid water = *fluid_preset("water");
constexpr double gravity = 9.81;

double mass_at(const Body& body, double density) {
    return density * body.moments.volume;
}

TEST(TerminalSpeed, BalancesWeightBuoyancyAndDragOfASphere) {
    const double radius = 0.01;
    const Body body = test::sphere(radius, 5);
    const double expected =
        std::sqrt(8.0 / 3.0 * radius * gravity * (2000.0 / water.density - 1.0) / terminal_drag_coefficient);
    EXPECT_NEAR(terminal_speed(body, water, mass_at(body, 2000.0), gravity), expected, 2e-3 * expected);
}

TEST(TerminalSpeed, IsThatOfTheExcessWhetherTheBodySinksOrRises) {
    const Body body = test::sphere(0.02);
    const double sinking = terminal_speed(body, water, mass_at(body, water.density + 300.0), gravity);
    const double rising = terminal_speed(body, water, mass_at(body, water.density - 300.0), gravity);
    EXPECT_NEAR(sinking, rising, 1e-12);
}

TEST(TerminalSpeed, GrowsWithTheRootOfSizeAndGravity) {
    const Body small = test::ellipsoid({0.01, 0.02, 0.04});
    const Body large = test::ellipsoid({0.04, 0.08, 0.16});
    const double speed = terminal_speed(small, water, mass_at(small, 1200.0), gravity);
    EXPECT_NEAR(terminal_speed(large, water, mass_at(large, 1200.0), gravity), 2.0 * speed, 1e-12);
    EXPECT_NEAR(terminal_speed(small, water, mass_at(small, 1200.0), 4.0 * gravity), 2.0 * speed, 1e-12);
}

TEST(TerminalSpeed, OfABodyThatFloatsInTheFluidIsRefusedWithItsName) {
    const Body body = test::sphere(0.01);
    try {
        terminal_speed(body, water, mass_at(body, water.density), gravity);
        FAIL() << "no error";
    } catch (const Error& fault) {
        EXPECT_NE(std::string(fault.what()).find("sphere"), std::string::npos);
        EXPECT_NE(std::string(fault.what()).find("choose another density"), std::string::npos);
    }
}

TEST(TerminalSpeed, NeedsGravity) {
    const Body body = test::sphere(0.01);
    EXPECT_THROW(terminal_speed(body, water, mass_at(body, 2000.0), 0.0), Error);
}

TEST(LargestProjectedArea, OfAnEllipsoidIsThatAlongItsShortestAxis) {
    const Body body = test::ellipsoid({0.01, 0.02, 0.04}, {0.3, -0.1, 0.2}, 5);
    const double exact = std::numbers::pi * 0.02 * 0.04;
    EXPECT_NEAR(largest_projected_area(body), exact, 2e-3 * exact);
}

TEST(TerminalReynoldsNumber, IsSpeedTimesLengthOverViscosityToThreeDigits) {
    const Body body = test::sphere(0.01, 5);
    const double exact = 0.5 * 0.02 / water.kinematic_viscosity();
    const double rounded = terminal_reynolds_number(body, water, 0.5);
    EXPECT_NEAR(rounded, exact, 6e-3 * exact);
    EXPECT_NEAR(std::remainder(rounded, 10.0), 0.0, 1e-9);  // some 9960
}

}  // namespace
}  // namespace samara
