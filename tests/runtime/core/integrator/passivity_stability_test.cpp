// Bodies in still fluid without gravity never gain energy, whatever body, loads and step.

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "samara/core/integrator/batch.hpp"
#include "support/hard_bodies.hpp"
#include "support/known_bodies.hpp"
#include "support/random_bodies.hpp"
#include "support/reference_step.hpp"
#include "support/stability_row.hpp"

namespace samara {
namespace {

using Step = std::function<BodyState(const ImmersedBody&, double, const BodyState&)>;

BodyState implicit(const ImmersedBody& body, double h, const BodyState& state) {
    return implicit_step(body, Vector3d::Zero(), h, state);
}

BodyState with_substeps(const ImmersedBody& body, double h, const BodyState& state) {
    static const Noise noise(1, "body", 0, 0);
    return advance(body, {.gravity = Vector3d::Zero()}, 0.0, h, state, noise, 0).state;
}

BodyState reference(const ImmersedBody& body, double h, const BodyState& state) {
    return reference_step(body, Vector3d::Zero(), h, state).state;
}

/// The sum of the sizes of the terms that the energy is made of about the centroid, where the step works:
/// what they cancel to may be far less, and their rounding is not.
double energy_terms(const ImmersedBody& body, const BodyState& state) {
    const Matrix6d from_centroid = body.to_centroid.inverse();
    const Matrix6d inertia = from_centroid.transpose() * body.inertia * from_centroid;
    const Vector6d velocity = (body.to_centroid * state.velocity).cwiseAbs();
    return 0.5 * velocity.dot(inertia.cwiseAbs() * velocity);
}

/// What a rise of the energy is measured by.
using EnergyScale = std::function<double(const ImmersedBody&, const BodyState&)>;

/// The largest rise of the energy in a step of the simulation, relative to its scale; infinity where a number
/// is lost.
double largest_rise(const ImmersedBody& body, BodyState state, double h, int steps, const Step& step,
                    const EnergyScale& scale = kinetic_energy) {
    double largest = 0.0;
    double energy = kinetic_energy(body, state);
    for (int i = 0; i < steps; ++i) {
        const double size = scale(body, state);
        state = step(body, h, state);
        const double next = kinetic_energy(body, state);
        const bool finite =
            std::isfinite(next) && state.position.allFinite() && state.orientation.coeffs().allFinite();
        if (!finite) return INFINITY;
        if (energy > 0.0) largest = std::max(largest, (next - energy) / size);
        energy = next;
    }
    return largest;
}

struct Worst {
    double rise = 0.0;
    int body = -1;
};

Worst search(unsigned seed, int bodies, int steps, const Step& step) {
    test::RandomBodies random(seed);
    Worst worst;
    for (int i = 0; i < bodies; ++i) {
        const ImmersedBody body = random.body();
        const BodyState state = random.state();
        const double rise = largest_rise(body, state, random.magnitude(1e-6, 1.0), steps, step, energy_terms);
        if (!(rise <= worst.rise)) worst = {rise, i};
    }
    return worst;
}

void expect_passive(const std::string& what, unsigned seed, int bodies, int steps, double bound,
                    const Step& step) {
    const Worst worst = search(seed, bodies, steps, step);
    SCOPED_TRACE(fmt::format("seed {}, body {}", seed, worst.body));
    test::expect_row({fmt::format("{} random bodies, tables and states", bodies), "1e-6 to 1 s" + what,
                      "largest rise of E in a step, over the sum of its terms' sizes", bound, worst.rise});
}

TEST(Passivity, RandomBodiesNeverGainEnergyInAnImplicitStep) {
    expect_passive("", 11, 10'000, 10, 1e-10, implicit);
}

TEST(Passivity, RandomBodiesNeverGainEnergyWithSubsteps) {
    expect_passive(", substeps", 12, 10'000, 5, 1e-10, with_substeps);
}

TEST(Passivity, RandomBodiesNeverGainEnergyWithTheReference) {
    expect_passive(", reference", 13, 500, 2, 1e-10, reference);
}

TEST(Passivity, RandomBodiesNeverGainEnergyInSinglePrecision) {
    // Speeds to 10 m/s and rad/s, steps to a film frame: beyond, products of the numbers leave single
    // precision's range.
    const auto single = [](const ImmersedBody& body, double h, const BodyState& state) {
        Batch batch(body, 1, Precision::single_precision);
        batch.set_state(0, state);
        batch.advance({.gravity = Vector3d::Zero()}, 0.0, h, 0, 1);
        return batch.state(0);
    };
    test::RandomBodies random(14);
    double worst = 0.0;
    for (int i = 0; i < 5000; ++i) {
        const ImmersedBody body = random.body();
        BodyState state = random.state();
        state.velocity *= 0.01;
        worst = std::max(
            worst, largest_rise(body, state, random.magnitude(1e-6, 1.0 / 24.0), 5, single, energy_terms));
    }
    test::expect_row({"5000 random bodies, tables and states", "1e-6 to 1/24 s, single precision",
                      "largest rise of E in a step, over the sum of its terms' sizes", 1e-5, worst});
}

TEST(Passivity, AHollowBodyNeverGainsEnergy) {
    const Body shape = test::baked_ellipsoid({0.01, 0.02, 0.04});
    const double density = 1e-3 * test::water().density;
    for (const double h : {1.0 / 60.0, 1.0 / 24.0, 1.0, 5.0}) {
        const ImmersedBody body = test::immersed(shape, density, test::water());
        test::expect_row({"ellipsoid a thousandth of water's density", fmt::format("{:.3g} s", h),
                          "largest rise of E in a step", 1e-12,
                          largest_rise(body, test::tumbling_state(2.0, 50.0), h, 200, implicit)});
    }
    for (const double h : {1.0 / 60.0, 1.0 / 24.0}) {
        const ImmersedBody body =
            test::immersed(shape, density, test::water(), Loads::table, Vector3d(0.002, 0.001, -0.004));
        test::expect_row({"the same, centre of mass 4.6 mm off", fmt::format("{:.3g} s", h),
                          "largest rise of E in a step", 1e-12,
                          largest_rise(body, test::tumbling_state(2.0, 50.0), h, 200, implicit)});
    }
}

TEST(Passivity, ABodyWithoutTheFluidsInertiaNeverGainsEnergy) {
    for (const double density : {1.0, 1200.0}) {
        SceneBody given = test::scene_body(density);
        given.added_mass = false;
        const ImmersedBody body = make_immersed_body(test::lopsided_shape(), given, test::water());
        for (const double h : {1e-3, 1.0 / 24.0, 1.0}) {
            test::expect_row({fmt::format("ellipsoid of density {:g} in water, no added mass", density),
                              fmt::format("{:.3g} s", h), "largest rise of E in a step", 1e-12,
                              largest_rise(body, test::tumbling_state(2.0, 50.0), h, 200, implicit)});
        }
    }
}

TEST(Passivity, ATableWithASharpEdgeGivesNoEnergyAndNoNaN) {
    Body shape = test::baked_ellipsoid({0.01, 0.02, 0.04});
    for (std::size_t i = 0; i < shape.tables->entries.size(); i += 2) {
        shape.tables->entries[i].force *= 100.0;
        shape.tables->entries[i].moment *= -100.0;
    }
    const ImmersedBody body = test::immersed(shape, 1200.0, test::water());
    for (const double h : {1e-4, 1.0 / 24.0, 1.0}) {
        test::expect_row({"table that jumps 100-fold between neighbours", fmt::format("{:.2g} s", h),
                          "largest rise of E in a step", 1e-10,
                          largest_rise(body, test::tumbling_state(1.0, 10.0), h, 500, implicit)});
    }
}

TEST(Passivity, ASpinOfAThousandAtAFilmFramesStepDies) {
    const ImmersedBody body = test::blunt_ellipsoid(Vector3d(0.001, 0.0, 0.002));
    BodyState state = test::tumbling_state(0.1, 1000.0);
    const double start = state.velocity.head<3>().norm();
    const double rise = largest_rise(body, state, 1.0 / 24.0, 240, with_substeps);
    for (int i = 0; i < 240; ++i) state = with_substeps(body, 1.0 / 24.0, state);
    test::expect_row(
        {"spin of 1000 rad/s, offset mass", "1/24 s", "largest rise of E in a step", 1e-10, rise});
    test::expect_row({"spin of 1000 rad/s, offset mass", "1/24 s", "spin left after 10 s, part", 0.05,
                      state.velocity.head<3>().norm() / start});
}

}  // namespace
}  // namespace samara
