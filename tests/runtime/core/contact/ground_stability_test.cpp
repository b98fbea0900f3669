// Bodies that settle on the ground, at steps from 0.1 ms to a film frame.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "support/ground_bodies.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

struct Case {
    std::string name;
    ImmersedBody body;
    Quaterniond start;
    double drop;      ///< m
    double duration;  ///< s
    Vector3d flat;    ///< the axis that must end upright; zero: any
};

Quaterniond turned(double degrees, const Vector3d& axis) {
    return Quaterniond(Eigen::AngleAxisd(degrees * degree, axis.normalized()));
}

std::vector<Case> cases() {
    const Fluid water = *fluid_preset("water");
    const Fluid air = *fluid_preset("air");
    const Vector3d z = Vector3d::UnitZ();
    const ImmersedBody plate = test::uniform_body(test::box({0.04, 0.03, 0.001}, 4), 2700.0, water);
    const ImmersedBody paper = test::uniform_body(test::box({0.05, 0.05, 0.0005}, 4), 800.0, air);
    const ImmersedBody disc = test::uniform_body(test::disc(0.02, 0.002), 2000.0, water);
    const ImmersedBody cube = test::uniform_body(test::box({0.02, 0.02, 0.02}, 2), 1500.0, water);
    const ImmersedBody ellipsoid = test::uniform_body(test::ellipsoid({0.04, 0.02, 0.01}, 3), 1200.0, water);
    const ImmersedBody steel = test::uniform_body(test::box({0.02, 0.02, 0.02}, 2), 7800.0, air);
    return {{"plate 2 degrees off its edge", plate, turned(88, {0, 1, 0}), 0.01, 6.0, z},
            {"plate on its corner", plate, turned(60, {1, 2, 0.3}), 0.05, 6.0, z},
            {"plate that lies", plate, Quaterniond::Identity(), 0.0, 2.0, z},
            {"paper in air", paper, turned(85, {0.2, 1, 0}), 0.02, 6.0, z},
            {"disc on its rim", disc, turned(85, {1, 0.1, 0}), 0.01, 6.0, z},
            {"cube", cube, turned(30, {1, 2, 0.5}), 0.02, 6.0, Vector3d::Zero()},
            {"steel cube in air, from 2 m", steel, turned(30, {1, 2, 0.5}), 2.0, 6.0, Vector3d::Zero()},
            {"ellipsoid", ellipsoid, turned(40, {1, 2, 0.5}), 0.02, 15.0, z}};
}

class Settling : public testing::TestWithParam<double> {};

TEST_P(Settling, BodiesComeToRestLyingFlatWithoutSinking) {
    const double step = GetParam();
    Surroundings surroundings;
    surroundings.ground = 0.0;
    for (const Case& given : cases()) {
        if (step < 1e-3 && given.duration > 10.0) continue;  // minutes
        const BodyState start = test::above_ground(given.body, given.start, given.drop);
        BodyState state = start;
        const Noise noise(1, "body", 0, 0);
        const auto steps = static_cast<std::uint64_t>(given.duration / step);
        double deepest = 0.0;
        for (std::uint64_t i = 0; i < steps; ++i) {
            state = advance(given.body, surroundings, 0.0, step, state, noise, i).state;
            deepest = std::max(deepest, -test::lowest_point(given.body, state));
        }
        EXPECT_EQ(state.velocity.norm(), 0.0) << given.name;
        EXPECT_LT(deepest, 1e-9 * given.body.contact_points.bounding_radius) << given.name;
        const double clearance = test::lowest_point(given.body, state);
        EXPECT_LT(clearance, 1e-4 * given.body.contact_points.bounding_radius) << given.name;
        double upright = (state.orientation * given.flat).z();
        if (given.flat.isZero()) upright = state.orientation.toRotationMatrix().row(2).cwiseAbs().maxCoeff();
        EXPECT_GT(std::abs(upright), std::cos(1.0 * degree)) << given.name;
    }
}

INSTANTIATE_TEST_SUITE_P(Steps, Settling, testing::Values(1e-4, 0.002, 1.0 / 60.0, 1.0 / 24.0));

TEST(Settling, ABodyAtRestKeepsItsPlaceToTheLastBitForAMinute) {
    Surroundings surroundings;
    surroundings.ground = 0.0;
    const ImmersedBody plate =
        test::uniform_body(test::box({0.04, 0.03, 0.001}, 4), 2700.0, *fluid_preset("water"));
    BodyState state = test::above_ground(plate, turned(3, {1, 1, 0}), 0.001);
    state = test::flown(plate, surroundings, state, 2.0, 1.0 / 60.0);
    const BodyState end = test::flown(plate, surroundings, state, 60.0, 1.0 / 60.0);
    EXPECT_EQ(end.position, state.position);
    EXPECT_EQ(end.orientation.coeffs(), state.orientation.coeffs());
}

}  // namespace
}  // namespace samara
