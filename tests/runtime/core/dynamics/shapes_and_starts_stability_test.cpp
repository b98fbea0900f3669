// Extreme shapes and masses, starts without a direction, and order of accuracy.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "support/hard_bodies.hpp"
#include "support/known_bodies.hpp"
#include "support/reference_step.hpp"
#include "support/stability_row.hpp"

namespace samara {
namespace {

const Vector3d earth(0.0, 0.0, -9.81);
constexpr double film_frame = 1.0 / 24.0;

/// The largest kinetic energy over the largest that the height fallen can have given; infinity where a number
/// is lost. Not above 1 where nothing is made from nothing.
double energy_over_work(const ImmersedBody& body, BodyState state, double h, int steps) {
    const Noise noise(1, "body", 0, 0);
    const double start = kinetic_energy(body, state);
    const double displaced = body.fluid_density * body.volume;
    const auto potential = [&](const BodyState& at) {
        const Vector3d centroid = at.position + at.orientation * body.center_of_buoyancy;
        return -body.mass * earth.dot(at.position) + displaced * earth.dot(centroid);
    };
    const double top = potential(state);
    double largest = 0.0;
    for (int i = 0; i < steps; ++i) {
        state = advance(body, {.gravity = earth}, 0.0, h, state, noise, static_cast<std::uint64_t>(i)).state;
        const double ratio = kinetic_energy(body, state) / (start + top - potential(state));
        if (!std::isfinite(ratio)) return INFINITY;
        largest = std::max(largest, ratio);
    }
    return largest;
}

void expect_no_energy_from_nothing(const std::string& subject, const ImmersedBody& body) {
    for (const auto& [h, name] : {std::pair(1.0 / 60.0, "1/60 s"), {film_frame, "1/24 s"}, {1.0, "1 s"}}) {
        test::expect_row({subject, name, "kinetic energy over start and work of gravity", 1.0,
                          energy_over_work(body, test::tumbling_state(0.5, 10.0), h, 1000)});
    }
}

TEST(ExtremeShapes, ANeedleOfAspectAThousand) {
    const Body needle = test::baked_ellipsoid({2e-5, 2.1e-5, 0.02});
    expect_no_energy_from_nothing("steel needle, 1 : 1000, in water",
                                  test::immersed(needle, 7800.0, test::water()));
}

TEST(ExtremeShapes, AFlakeOfAspectTenThousand) {
    const Body flake = test::baked_ellipsoid({1e-6, 0.01, 0.011});
    expect_no_energy_from_nothing("gold leaf, 1 : 10,000, in air",
                                  test::immersed(flake, 19'300.0, test::air()));
}

TEST(ExtremeShapes, ACentreOfMassFarOutside) {
    const Body shape = test::baked_ellipsoid({0.01, 0.02, 0.04});
    expect_no_energy_from_nothing(
        "centre of mass five lengths outside",
        test::immersed(shape, 1200.0, test::water(), Loads::table, Vector3d(0.05, -0.1, 0.4)));
}

TEST(Starts, ABottomHeavyBodyReturnsUpright) {
    const ImmersedBody body = test::immersed(test::baked_ellipsoid({0.01, 0.02, 0.04}), test::water().density,
                                             test::water(), Loads::table, Vector3d(0.0, 0.0, -0.004));
    for (const auto& [h, name] : {std::pair(0.002, "0.002 s"), {film_frame, "1/24 s"}}) {
        BodyState state;
        state.orientation = Quaterniond(Eigen::AngleAxisd(2.5, Vector3d(1, 1, 0).normalized()));
        const auto steps = static_cast<int>(60.0 / h);
        for (int i = 0; i < steps; ++i) state = implicit_step(body, earth, h, state);
        test::expect_row({"bottom-heavy neutral body, upside down", name, "tilt after 60 s, rad", 0.02,
                          std::acos(std::min(1.0, (state.orientation * Vector3d::UnitZ()).z()))});
    }
}

/// A plate with lift, by coefficients: eq. 5 is singular there as printed.
ImmersedBody lifting_plate() {
    const Body shape = test::baked_ellipsoid({0.001, 0.03, 0.04});
    SceneBody given = test::scene_body(1200.0);
    given.loads = Loads::coefficients;
    given.coefficients.lift_coefficient = 1.2;
    given.coefficients.reference_area = 1e-3;
    return make_immersed_body(shape, given, test::water());
}

TEST(Starts, WithoutADirectionOrAlongAndAcrossTheNormal) {
    const std::array<std::pair<const char*, Vector3d>, 3> starts = {
        {{"at rest", Vector3d::Zero()},
         {"U parallel to N", Vector3d::UnitX()},
         {"U perpendicular to N", Vector3d::UnitY()}}};
    for (const auto& [name, direction] : starts) {
        for (const Loads loads : {Loads::coefficients, Loads::table}) {
            const ImmersedBody body = loads == Loads::table ? test::blunt_ellipsoid() : lifting_plate();
            BodyState exact;
            exact.velocity.tail<3>() = direction;
            BodyState beside = exact;
            beside.velocity.tail<3>() += 1e-8 * Vector3d(0.3, -0.5, 0.4);
            for (int i = 0; i < 10; ++i) {
                exact = implicit_step(body, earth, 1e-3, exact);
                beside = implicit_step(body, earth, 1e-3, beside);
            }
            const std::string kind = loads == Loads::table ? ", table" : ", coefficients";
            test::expect_row({std::string("start ") + name + kind, "0.001 s",
                              "distance after 10 steps from a start 1e-8 m/s beside it, m/s and rad/s", 1e-6,
                              (exact.velocity - beside.velocity).norm()});
        }
    }
}

using Step = BodyState (*)(const ImmersedBody&, double, const BodyState&);

/// By how much the lowest order of the last two halvings misses the one that is claimed; below 0 where it is
/// higher.
double missing_order(const ImmersedBody& body, double claimed, int fewest_steps, Step step) {
    BodyState start = test::tumbling_state(0.3, 8.0);
    start.sampled_turbulence = {Vector3d(0.05, -0.02, 0.03), Vector3d(0.5, 0.2, -0.1)};
    const auto velocity_after = [&](int steps, Step by) {
        BodyState state = start;
        for (int i = 0; i < steps; ++i) state = by(body, 0.5 / steps, state);
        return state.velocity;
    };
    const Vector6d exact = velocity_after(4096, [](const ImmersedBody& b, double h, const BodyState& s) {
        return reference_step(b, earth, h, s).state;
    });
    double missing = -INFINITY;
    double before = (velocity_after(fewest_steps, step) - exact).norm();
    for (const int factor : {2, 4}) {
        const double now = (velocity_after(factor * fewest_steps, step) - exact).norm();
        missing = std::max(missing, claimed - std::log2(before / now));
        before = now;
    }
    return missing;
}

TEST(Order, IsTwoOfTheImplicitStepAndFourOfTheReference) {
    const ImmersedBody body = test::smooth_ellipsoid();
    test::expect_row({"full model with smooth loads", "2.5 to 0.6 ms",
                      "2 less the order of the implicit step", 0.1,
                      missing_order(body, 2.0, 200, [](const ImmersedBody& b, double h, const BodyState& s) {
                          return implicit_step(b, earth, h, s);
                      })});
    test::expect_row({"full model with smooth loads", "16 to 4 ms", "4 less the order of the reference", 0.1,
                      missing_order(body, 4.0, 32, [](const ImmersedBody& b, double h, const BodyState& s) {
                          return reference_step(b, earth, h, s).state;
                      })});
}

}  // namespace
}  // namespace samara
