// Free motion: what must be kept is kept, over many steps and fast spins.

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "support/hard_bodies.hpp"
#include "support/known_bodies.hpp"
#include "support/reference_step.hpp"
#include "support/stability_row.hpp"

namespace samara {
namespace {

/// u K u / 2, |p|^2 and l . p.
Vector3d invariants(const ImmersedBody& body, const BodyState& state) {
    const Vector6d momentum = body.inertia * state.velocity;
    const Vector3d linear = momentum.tail<3>();
    return {kinetic_energy(body, state), linear.squaredNorm(), momentum.head<3>().dot(linear)};
}

/// The largest change of an invariant in free motion, each over its first value.
double drift_of_the_reference(const ImmersedBody& body, BodyState state, int steps) {
    const Vector3d first = invariants(body, state);
    double largest = 0.0;
    for (int i = 0; i < steps; ++i) {
        const ReferenceResult result = reference_step(body, Vector3d::Zero(), 1e-3, state);
        if (!result.converged) return INFINITY;
        state = result.state;
        const Vector3d change = (invariants(body, state) - first).cwiseQuotient(first).cwiseAbs();
        largest = std::max(largest, change.maxCoeff());
    }
    return largest;
}

void expect_kept(const std::string& subject, const ImmersedBody& body, const BodyState& start, int steps) {
    test::expect_row({subject, "0.001 s, reference",
                      "drift of E, |p|^2, l.p in " + std::to_string(steps) + " steps", 1e-11,
                      drift_of_the_reference(body, start, steps)});
}

TEST(FreeMotion, TheReferenceKeepsTheInvariantsOfACoupledBodyForAMillionSteps) {
    const ImmersedBody body = test::immersed(test::rubber_ellipsoid(), 1200.0, test::water(), Loads::none,
                                             Vector3d(0.002, 0.001, -0.004));
    expect_kept("coupled ellipsoid, free", body, test::tumbling_state(0.3, 6.0), 1'000'000);
}

TEST(FreeMotion, TheReferenceKeepsTheInvariantsOfFiveBodies) {
    for (const test::NamedBody& named : test::five_bodies(Loads::none)) {
        expect_kept(named.name + ", free", named.body, test::tumbling_state(0.3, 6.0), 200'000);
    }
}

TEST(FreeMotion, TheReferenceKeepsTheInvariantsOfAFastSpin) {
    expect_kept("ellipsoid, free, spin 100 rad/s", test::ideal_ellipsoid(), test::tumbling_state(0.3, 100.0),
                200'000);
}

TEST(FreeMotion, TheImplicitStepKeepsItsEnergyAtAFilmFramesStepAndBeyond) {
    const ImmersedBody body = test::ideal_ellipsoid();
    for (const auto& [step, name] : {std::pair(1.0 / 24.0, "1/24 s"), std::pair(1.0, "1 s")}) {
        for (const double spin : {100.0, 1000.0}) {
            BodyState state = test::tumbling_state(0.5, spin);
            const double energy = kinetic_energy(body, state);
            double largest = 0.0;
            for (int i = 0; i < 1000; ++i) {
                state = implicit_step(body, Vector3d::Zero(), step, state);
                largest = std::max(largest, std::abs(kinetic_energy(body, state) / energy - 1.0));
            }
            test::expect_row({"ellipsoid, free, spin " + std::to_string(static_cast<int>(spin)) + " rad/s",
                              name, "drift of E in 1000 steps", 1e-10, largest});
        }
    }
}

}  // namespace
}  // namespace samara
