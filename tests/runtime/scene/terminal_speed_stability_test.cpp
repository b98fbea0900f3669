// Falls at a film frame's step: bubbles, balloons, paper, heavy bodies and thick fluids.

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "samara/core/dynamics/loads.hpp"
#include "samara/core/integrator/step.hpp"
#include "support/ground_bodies.hpp"
#include "support/hard_bodies.hpp"
#include "support/known_bodies.hpp"
#include "support/reference_step.hpp"
#include "support/stability_row.hpp"

namespace samara {
namespace {

const Vector3d earth(0.0, 0.0, -9.81);
constexpr double film_frame = 1.0 / 24.0;

BodyState flown(const ImmersedBody& body, const BodyState& state, double h, double duration) {
    return test::flown(body, {.gravity = earth}, state, duration, h);
}

double speed_of(const BodyState& state) {
    return state.velocity.tail<3>().norm();
}

/// The terminal speed of a baked sphere (drag coefficient 0.5 on its cross section, at a Reynolds number
/// above 1): weight = drag.
double terminal_speed(double radius, double density, const Fluid& fluid) {
    return std::sqrt(8.0 / 3.0 * radius * 9.81 * std::abs(density / fluid.density - 1.0) / 0.5);
}

void expect_terminal_speed(const std::string& subject, double radius, double density, const Fluid& fluid,
                           double start_over_terminal = 0.0) {
    const ImmersedBody body = test::immersed(test::baked_sphere(radius), density, fluid);
    const double terminal = terminal_speed(radius, density, fluid);
    for (const auto& [h, name] : {std::pair(1e-3, "0.001 s"), {film_frame, "1/24 s"}, {1.0, "1 s"}}) {
        BodyState start;
        start.velocity.tail<3>() = start_over_terminal * terminal * Vector3d::UnitZ();
        const BodyState end = flown(body, start, h, 60.0);
        test::expect_row(
            {subject, name, "error of the terminal speed", 1e-6, std::abs(speed_of(end) / terminal - 1.0)});
        EXPECT_EQ(end.velocity.tail<3>().dot(earth) > 0.0, density > fluid.density);
    }
}

TEST(TerminalSpeed, OfABubbleOfOneMillimetre) {
    expect_terminal_speed("air bubble of 1 mm in water", 0.0005, 1.204, test::water());
}

TEST(TerminalSpeed, OfABalloon) {
    // Helium and rubber: a seventh less than air.
    expect_terminal_speed("balloon of 30 cm in air", 0.15, 1.03, test::air());
}

TEST(TerminalSpeed, OfALeadShot) {
    expect_terminal_speed("lead shot of 4 mm in water", 0.002, 11'340.0, test::water());
}

TEST(TerminalSpeed, FromAHundredTimesIt) {
    expect_terminal_speed("ball of 4 cm in water, start at 100 times terminal speed", 0.02, 1200.0,
                          test::water(), 100.0);
}

TEST(TerminalSpeed, OfABallInHoneyIsThatOfStokes) {
    // 1 mm of steel in honey falls at a Reynolds number of 2e-3, far below the table.
    const Fluid honey{.density = 1420.0, .viscosity = 10.0};
    const double radius = 0.0005;
    const ImmersedBody body = test::immersed(test::baked_sphere(radius), 7800.0, honey);
    const double stokes = 2.0 / 9.0 * (7800.0 - 1420.0) * 9.81 * radius * radius / honey.viscosity;
    for (const auto& [h, name] : {std::pair(1e-3, "0.001 s"), {film_frame, "1/24 s"}, {1.0, "1 s"}}) {
        const double ratio = speed_of(flown(body, test::tumbling_state(1.0, 100.0), h, 30.0)) / stokes;
        test::expect_row(
            {"steel ball of 1 mm in honey", name, "error of the Stokes speed", 2e-3, std::abs(ratio - 1.0)});
    }
}

TEST(HardFalls, ABodyABillionTimesDenserFallsAsInVacuum) {
    const Body shape = test::baked_ellipsoid({0.01, 0.02, 0.04});
    const ImmersedBody body = test::immersed(shape, 1e9 * test::water().density, test::water());
    for (const auto& [h, name] : {std::pair(film_frame, "1/24 s"), {1.0, "1 s"}}) {
        const BodyState end = flown(body, {}, h, 10.0);
        test::expect_row({"a billion times denser than water", name, "error of g t after 10 s", 1e-5,
                          std::abs(speed_of(end) / 98.1 - 1.0)});
    }
}

TEST(HardFalls, APaperSheetAtAFilmFramesStep) {
    // Without a moment the sheet stays broadside.
    Body calm = test::paper_sheet();
    for (LoadEntry& entry : calm.tables->entries) entry.moment.setZero();
    const ImmersedBody steady = test::immersed(calm, 750.0, test::air());
    BodyState broadside;
    broadside.orientation = Quaterniond::FromTwoVectors(Vector3d::UnitX(), Vector3d::UnitZ());
    const double weight = (steady.mass - steady.fluid_density * steady.volume) * 9.81;
    const BodyState end = flown(steady, broadside, film_frame, 20.0);
    const double drag = (load_matrix(steady, end.velocity) * end.velocity).tail<3>().norm();
    test::expect_row({"paper sheet in air, broadside", "1/24 s", "error of drag against weight", 1e-6,
                      std::abs(drag / weight - 1.0)});

    const ImmersedBody body = test::immersed(test::paper_sheet(), 750.0, test::air());
    BodyState state = test::tumbling_state(0.5, 3.0);
    double fastest = 0.0;
    for (int i = 0; i < 60; ++i) {
        state = flown(body, state, film_frame, 1.0);
        fastest = std::max(fastest, std::isfinite(speed_of(state)) ? speed_of(state) : INFINITY);
    }
    // The least drag coefficient of the blunt tables, edgewise at a high Reynolds number, is 0.32.
    const double edgewise = std::sqrt(weight / (0.5 * body.fluid_density * body.reference_area * 0.32));
    test::expect_row({"paper sheet in air, tumbling for 60 s", "1/24 s",
                      "speed over the edgewise terminal one", 1.0, fastest / edgewise});
}

TEST(HardFalls, ASheetsTotalEnergyNeverRises) {
    const ImmersedBody body = test::immersed(test::paper_sheet(), 750.0, test::air());
    const double weight = (body.mass - body.fluid_density * body.volume) * 9.81;
    for (const auto& [h, name] : {std::pair(film_frame, "1/24 s"), {1.0 / 60.0, "1/60 s"}}) {
        BodyState state = test::tumbling_state(0.5, 3.0);
        double largest = 0.0;
        for (int i = 0; i < 2400; ++i) {
            const BodyState next = implicit_step(body, earth, h, state);
            const double rise = kinetic_energy(body, next) - kinetic_energy(body, state) +
                                weight * (next.position.z() - state.position.z());
            largest = std::max(largest, rise / std::max(kinetic_energy(body, next), 1e-6 * weight));
            state = next;
        }
        test::expect_row({"paper sheet in air, falling", name,
                          "largest rise of total energy in a step, over E", 1e-10, largest});
    }
}

TEST(HardFalls, ASphereThrownAcrossItsTablesNeverSpins) {
    // Bilinear tables push it aside, which turns its path, but give no moment.
    const ImmersedBody body = test::immersed(test::baked_sphere(0.02), 1200.0, test::water());
    for (const auto& [h, name] : {std::pair(1e-3, "0.001 s"), {film_frame, "1/24 s"}}) {
        BodyState state;
        state.velocity.tail<3>() = Vector3d(27.0, 5.0, 36.0);
        double fastest = 0.0;
        for (int i = 0; i < 1000; ++i) {
            state = implicit_step(body, earth, h, state);
            fastest = std::max(fastest, state.velocity.head<3>().norm());
        }
        test::expect_row({"sphere thrown at 45 m/s across its tables", name, "spin, rad/s", 1e-6, fastest});
    }
}

TEST(HardFalls, WithoutGravityABodyAtRestStaysAtRest) {
    const ImmersedBody body = test::immersed(test::paper_sheet(), 750.0, test::air());
    BodyState state;
    for (int i = 0; i < 100; ++i) state = implicit_step(body, Vector3d::Zero(), film_frame, state);
    test::expect_row({"zero gravity, start at rest", "1/24 s", "speed after 100 steps, m/s", 0.0,
                      state.velocity.norm() + state.position.norm()});
}

}  // namespace
}  // namespace samara
