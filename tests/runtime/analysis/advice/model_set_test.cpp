#include "samara/analysis/advice/model_set.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "support/hard_bodies.hpp"
#include "support/known_bodies.hpp"

namespace samara {
namespace {

constexpr Loads all_loads[] = {Loads::none, Loads::coefficients, Loads::table};
constexpr Dynamic all_dynamic[] = {Dynamic::of_body, Dynamic::by_default, Dynamic::none};
constexpr Turbulence all_turbulence[] = {Turbulence::none, Turbulence::constant, Turbulence::table};

/// Every choice of models, with and without one Reynolds number alone.
std::vector<ModelSet> all_sets() {
    std::vector<ModelSet> sets;
    for (const Loads loads : all_loads) {
        for (const Dynamic dynamic : all_dynamic) {
            for (const Turbulence turbulence : all_turbulence) {
                for (const bool added_mass : {true, false}) {
                    for (const bool one_reynolds_number : {true, false}) {
                        ModelSet set{.loads = loads,
                                     .added_mass = added_mass,
                                     .dynamic = dynamic,
                                     .turbulence = turbulence};
                        if (one_reynolds_number) set.table_reynolds_number = 2e3;
                        sets.push_back(set);
                    }
                }
            }
        }
    }
    return sets;
}

/// A body with tables at two Reynolds numbers and identified coefficients.
const Body& full_body() {
    static const Body body = test::lopsided_shape();
    return body;
}

TEST(ModelSet, OfABodyWithASetIsThatSet) {
    for (ModelSet set : all_sets()) {
        set.drag_coefficient = 0.47;
        set.turbulent_kinetic_energy = 0.003;
        set.dissipation_rate = 0.02;
        SceneBody body = test::scene_body(1200.0);
        set_models(set, body);
        EXPECT_EQ(model_set_of(body), set);
    }
}

TEST(ModelSet, SaysAllThatASceneBodyMayFlyWithAndChangesNothingElse) {
    SceneBody body = test::scene_body(1200.0);
    body.position = Vector3d(1.0, 2.0, 3.0);
    body.count = 7;
    body.spread_angle = 0.3;
    body.start = 1.5;
    body.langevin = Langevin::body_velocity;
    body.coefficients.lift_coefficient = 0.6;
    body.coefficients.reference_area = 0.02;
    const SceneBody before = body;
    set_models(ModelSet{.loads = Loads::none, .turbulence = Turbulence::none}, body);
    EXPECT_EQ(body.loads, Loads::none);
    EXPECT_EQ(body.position, before.position);
    EXPECT_EQ(body.count, before.count);
    EXPECT_EQ(body.spread_angle, before.spread_angle);
    EXPECT_EQ(body.start, before.start);
    EXPECT_EQ(body.langevin, before.langevin);
    EXPECT_EQ(body.coefficients.lift_coefficient, before.coefficients.lift_coefficient);
    EXPECT_EQ(body.coefficients.reference_area, before.coefficients.reference_area);
    EXPECT_EQ(body.mass.density, before.mass.density);
    set_models(model_set_of(before), body);
    EXPECT_EQ(model_set_of(body), model_set_of(before));
}

TEST(ModelSet, NeedsWhatItFliesWith) {
    const ModelCost everything = cost_of(ModelSet{}, full_body());
    EXPECT_EQ(
        everything,
        (ModelCost{.falls = true, .tables = true, .reynolds_numbers = true, .kirchhoff = true, .step = 8}));
    const ModelCost inertia = cost_of({.loads = Loads::none, .turbulence = Turbulence::none}, full_body());
    EXPECT_EQ(inertia, (ModelCost{.kirchhoff = true}));
    const ModelCost nothing =
        cost_of({.loads = Loads::none, .added_mass = false, .turbulence = Turbulence::none}, full_body());
    EXPECT_EQ(nothing, ModelCost{});
    // Turbulence from tables needs the tables also where the loads are coefficients.
    EXPECT_TRUE(cost_of({.loads = Loads::coefficients}, full_body()).tables);
    EXPECT_FALSE(cost_of({.loads = Loads::coefficients}, full_body()).falls);
    EXPECT_FALSE(cost_of({.table_reynolds_number = 1e3}, full_body()).reynolds_numbers);
    // A body without coefficients of its own needs no falls for them.
    EXPECT_FALSE(cost_of(ModelSet{}, test::baked_ellipsoid({0.01, 0.02, 0.04})).falls);
}

TEST(ModelSet, CostsLessWithoutAPart) {
    const auto cost = [](const ModelSet& set) { return cost_of(set, full_body()); };
    for (const ModelSet& set : all_sets()) {
        ModelSet less = set;
        less.added_mass = false;
        EXPECT_LE(cost(less), cost(set));
        EXPECT_EQ(cost(less) < cost(set), set.added_mass);
        less = set;
        less.turbulence = Turbulence::none;
        EXPECT_LE(cost(less), cost(set));
        EXPECT_EQ(cost(less) < cost(set), set.turbulence != Turbulence::none);
        less = set;
        less.dynamic = Dynamic::none;
        EXPECT_LE(cost(less), cost(set));
        EXPECT_EQ(cost(less) < cost(set), set.dynamic != Dynamic::none && set.loads != Loads::none);
        less = set;
        less.table_reynolds_number = 1e3;
        EXPECT_LE(cost(less), cost(set));
        less = set;
        less.loads = Loads::none;
        EXPECT_LE(cost(less), cost(set));
    }
    // What is dear to make outweighs any work of a step.
    EXPECT_GT((ModelCost{.kirchhoff = true}), (ModelCost{.step = 8}));
    EXPECT_GT((ModelCost{.tables = true}), (ModelCost{.kirchhoff = true, .step = 8}));
    EXPECT_GT((ModelCost{.falls = true}),
              (ModelCost{.tables = true, .reynolds_numbers = true, .kirchhoff = true, .step = 8}));
}

TEST(ModelSet, IsSaidInWords) {
    EXPECT_EQ(in_words(ModelSet{}, full_body()),
              "table loads, added mass, identified dynamic coefficients, turbulence from tables");
    EXPECT_EQ(
        in_words({.table_reynolds_number = 2500.0}, test::baked_ellipsoid({0.01, 0.02, 0.04})),
        "table loads, the Reynolds number 2500 alone, added mass, default dynamic coefficients, turbulence "
        "from tables");
    EXPECT_EQ(
        in_words({.loads = Loads::coefficients,
                  .drag_coefficient = 0.47,
                  .added_mass = false,
                  .turbulence = Turbulence::constant,
                  .turbulent_kinetic_energy = 0.01,
                  .dissipation_rate = 0.2},
                 full_body()),
        "drag coefficient 0.47, no added mass, rotational drag, constant turbulence (k 0.01 m^2/s^2, epsilon "
        "0.2 m^2/s^3)");
    EXPECT_EQ(
        in_words({.loads = Loads::none, .added_mass = false, .turbulence = Turbulence::none}, full_body()),
        "no loads, no added mass, no turbulence");
}

TEST(ModelSet, IsSaidInOtherWordsWhereItFliesOtherwise) {
    // Sets that fly alike may read alike; others must not.
    const auto flies_alike = [](ModelSet a, ModelSet b) {
        for (ModelSet* set : {&a, &b}) {
            if (set->loads == Loads::none) set->dynamic = Dynamic::none;
            if (set->loads == Loads::coefficients && set->dynamic == Dynamic::of_body) {
                set->dynamic = Dynamic::by_default;
            }
            if (set->loads != Loads::table && set->turbulence != Turbulence::table)
                set->table_reynolds_number = {};
        }
        return a == b;
    };
    const std::vector<ModelSet> sets = all_sets();
    for (const ModelSet& a : sets) {
        for (const ModelSet& b : sets) {
            EXPECT_EQ(in_words(a, full_body()) == in_words(b, full_body()), flies_alike(a, b))
                << in_words(a, full_body()) << "\n"
                << in_words(b, full_body());
        }
    }
}

TEST(ModelPart, HasANameOfItsOwn) {
    EXPECT_STREQ(name_of(ModelPart::identified_coefficients), "identified coefficients");
    EXPECT_STREQ(name_of(ModelPart::table_loads), "table loads");
    EXPECT_STREQ(name_of(ModelPart::turbulence), "turbulence");
    EXPECT_STREQ(name_of(ModelPart::reynolds_dependence), "Reynolds dependence");
    EXPECT_STREQ(name_of(ModelPart::added_mass), "added mass");
    EXPECT_STREQ(name_of(ModelPart::dynamic_coefficients), "dynamic coefficients");
}

}  // namespace
}  // namespace samara
