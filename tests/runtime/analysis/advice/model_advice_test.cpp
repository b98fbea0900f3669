// Which physics a scene needs.

#include "samara/analysis/advice/model_advice.hpp"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "samara/core/base/error.hpp"
#include "support/hard_bodies.hpp"
#include "support/known_bodies.hpp"

namespace samara {
namespace {

using testing::Contains;
using testing::HasSubstr;

void ignore(double /*done*/, double /*total*/) {}

Scene scene_of(double density, const Fluid& fluid, double duration = 4.0) {
    Scene scene;
    scene.duration = duration;
    scene.fluid = fluid;
    SceneBody body = test::scene_body(density);
    body.turbulence = Turbulence::table;
    body.orientation = Quaterniond(Eigen::AngleAxisd(0.4, Vector3d(0.3, 1.0, 0.2).normalized()));
    scene.bodies.push_back(body);
    return scene;
}

BodyAdvice advice_of(const Scene& scene, const Body& body, const AdviceOptions& options = {}) {
    return advise_models(scene, {{body, "hash"}}, options, ignore).bodies.at(0);
}

const ModelEffect& omission(const BodyAdvice& advice, ModelPart part) {
    const auto found = std::find_if(advice.omissions.begin(), advice.omissions.end(),
                                    [&](const ModelEffect& one) { return one.part == part; });
    if (found == advice.omissions.end()) throw Error("the part was not left out");
    return *found;
}

double descent_change(const ModelEffect& effect) {
    const MetricEffect& descent = effect.effect.metrics[Metric::descent_speed];
    return descent.change->value / std::abs(descent.reference->value);
}

Body baked_ball() {
    Body ball = test::baked_sphere(0.02, 8);
    ball.symmetry.type = Symmetry::Type::spherical;
    return ball;
}

/// Of the tables, no turbulence.
void make_laminar(Body& body) {
    for (LoadEntry& entry : body.tables->entries) {
        entry.turbulent_kinetic_energy = 0.0;
        entry.dissipation_rate = 0.0;
    }
}

TEST(ModelAdvice, AStoneInAirNeedsNoAddedMass) {
    const Body ellipsoid = test::baked_ellipsoid({0.01, 0.02, 0.04});
    for (const Body& body : {baked_ball(), ellipsoid}) {
        const BodyAdvice advice = advice_of(scene_of(2700.0, test::air(), 2.0), body);
        EXPECT_FALSE(advice.recommended.models.added_mass);
        const ModelEffect& without = omission(advice, ModelPart::added_mass);
        EXPECT_EQ(without.effect.verdict, EffectVerdict::within);
        EXPECT_LT(std::abs(descent_change(without)), 0.01);
        EXPECT_FALSE(without.cost.kirchhoff);
    }
}

TEST(ModelAdvice, ALightBodyInWaterKeepsItsAddedMass) {
    const BodyAdvice advice =
        advice_of(scene_of(1050.0, test::water()), test::baked_ellipsoid({0.01, 0.02, 0.04}));
    EXPECT_TRUE(advice.recommended.models.added_mass);
    EXPECT_EQ(omission(advice, ModelPart::added_mass).effect.verdict, EffectVerdict::beyond);
}

TEST(ModelAdvice, ABallNeedsNoDirections) {
    const BodyAdvice advice = advice_of(scene_of(1300.0, test::water()), baked_ball());
    EXPECT_TRUE(advice.one_direction);
    const ModelEffect& without = omission(advice, ModelPart::table_loads);
    // Not exactly: between its nodes the map's forces are shorter than at them.
    EXPECT_NEAR(without.models.drag_coefficient, 0.5, 0.01);
    EXPECT_LT(std::abs(descent_change(without)), 0.01);
    EXPECT_EQ(advice.recommended.models.loads, Loads::coefficients);
}

TEST(ModelAdvice, ALaminarFlowNeedsNoTurbulence) {
    Body ball = baked_ball();
    make_laminar(ball);
    const BodyAdvice by_table = advice_of(scene_of(1300.0, test::water()), ball);
    EXPECT_EQ(by_table.full.models.turbulence, Turbulence::none);
    EXPECT_EQ(by_table.recommended.models.turbulence, Turbulence::none);
    EXPECT_THAT(by_table.notes, Contains(HasSubstr("the tables' turbulence is zero")));
    Fluid syrup = test::water();
    syrup.viscosity *= 200.0;  // laminar with the turbulence of the tables too
    const BodyAdvice by_number = advice_of(scene_of(1300.0, syrup), baked_ball());
    EXPECT_EQ(by_number.recommended.models.turbulence, Turbulence::none);
    EXPECT_THAT(by_number.notes, Contains(HasSubstr("the Reynolds number is")));
}

TEST(ModelAdvice, ATableThatDoesNotChangeWithTheReynoldsNumberNeedsOne) {
    Body body = test::baked_ellipsoid({0.01, 0.02, 0.04});
    const std::size_t plane = body.tables->entries.size() / 2;
    for (std::size_t i = 0; i < plane; ++i) body.tables->entries[plane + i] = body.tables->entries[i];
    const BodyAdvice advice = advice_of(scene_of(1200.0, test::water()), body);
    const ModelEffect& without = omission(advice, ModelPart::reynolds_dependence);
    EXPECT_LT(std::abs(descent_change(without)), 0.02);
    EXPECT_NEAR(*without.models.table_reynolds_number, advice.flow.reynolds_number, 1e-9);
    EXPECT_FALSE(without.cost.reynolds_numbers);
}

TEST(ModelAdvice, RecommendsASetThatIsCheaperAndWasCheckedAsAWhole) {
    const BodyAdvice advice =
        advice_of(scene_of(2700.0, test::air(), 2.0), test::baked_ellipsoid({0.01, 0.02, 0.04}));
    EXPECT_LT(advice.recommended.cost, advice.full.cost);
    EXPECT_EQ(advice.recommended.effect.verdict, EffectVerdict::within);
    EXPECT_GE(advice.recommended.effect.falls, 32U);
    for (std::size_t i = 1; i < advice.omissions.size(); ++i) {
        EXPECT_LE(*advice.omissions[i - 1].part, *advice.omissions[i].part);
    }
    for (const ModelEffect& one : advice.omissions) EXPECT_LT(one.cost, advice.full.cost);
}

TEST(ModelAdvice, KeepsEveryPartThatMatters) {
    AdviceOptions strict;
    strict.tolerance = 1e-9;
    const Scene scene = scene_of(1200.0, test::water());
    const BodyAdvice advice = advice_of(scene, test::lopsided_shape(), strict);
    EXPECT_EQ(advice.recommended.models, model_set_of(scene.bodies[0]));
    EXPECT_EQ(advice.omissions.size(), 7U);
}

/// Whether a set flies without what an omission left out.
bool lacks(const ModelSet& models, const ModelEffect& omission) {
    switch (*omission.part) {
        case ModelPart::identified_coefficients:
            return models.dynamic == Dynamic::by_default;
        case ModelPart::table_loads:
            return models.loads != Loads::table;
        case ModelPart::turbulence:
            return models.turbulence == omission.models.turbulence;
        case ModelPart::reynolds_dependence:
            return models.table_reynolds_number.has_value();
        case ModelPart::added_mass:
            return !models.added_mass;
        default:
            return models.dynamic == Dynamic::none;
    }
}

TEST(ModelAdvice, KeepsWhatMattersAloneWhereTwoErrorsCancel) {
    for (const double tolerance : {0.2, 0.3}) {
        AdviceOptions options;
        options.tolerance = tolerance;
        options.most_falls = 64;
        const BodyAdvice advice =
            advice_of(scene_of(1500.0, test::water(), 2.0), test::lopsided_shape(), options);
        int matter = 0;
        for (const ModelEffect& one : advice.omissions) {
            if (one.effect.verdict != EffectVerdict::beyond) continue;
            ++matter;
            EXPECT_FALSE(lacks(advice.recommended.models, one)) << one.left_out;
        }
        EXPECT_GT(matter, 0);
        EXPECT_LT(advice.recommended.cost, advice.full.cost);
    }
}

TEST(ModelAdvice, BeforeABakeJudgesTheAddedMassAlone) {
    const Body bare = test::exact_sphere(0.02);
    const Scene in_air = scene_of(2700.0, test::air(), 2.0);
    const BodyAdvice advice = advice_of(in_air, bare);
    ASSERT_EQ(advice.omissions.size(), 1U);
    EXPECT_EQ(advice.omissions[0].part, ModelPart::added_mass);
    EXPECT_THAT(advice.notes, Contains(HasSubstr("unknown before a bake")));
    ModelSet expected = model_set_of(in_air.bodies[0]);
    expected.added_mass = false;
    EXPECT_EQ(advice.recommended.models, expected);
    EXPECT_TRUE(advice.recommended.cost.tables);
    // Flown as a bake's first plan flies it: in a turbulence of a tenth of its speed.
    EXPECT_EQ(advice.full.models.turbulence, Turbulence::constant);
    EXPECT_THAT(advice.notes, Contains(HasSubstr("a tenth of the terminal speed")));
}

TEST(ModelAdvice, OfAFallThatIsTooShortKeepsEverything) {
    Scene scene = scene_of(1200.0, test::water());
    scene.bodies[0].start = 10.0;
    const BodyAdvice advice = advice_of(scene, test::baked_ellipsoid({0.01, 0.02, 0.04}));
    EXPECT_EQ(advice.recommended.models, model_set_of(scene.bodies[0]));
}

TEST(ModelAdvice, StartsNothingBelowTheGround) {
    Scene scene = scene_of(2700.0, test::air());
    scene.bodies[0].orientation = Quaterniond::Identity();
    scene.bodies[0].position = Vector3d(0.0, 0.0, 0.04);
    scene.ground = 0.0;
    AdviceOptions quick;
    quick.most_falls = quick.sampling.falls;
    EXPECT_NO_THROW((void)advice_of(scene, test::baked_ellipsoid({0.01, 0.02, 0.04}), quick));
    scene.bodies[0].position.z() = 1.0;
    EXPECT_FALSE(advice_of(scene, baked_ball()).recommended.models.added_mass);
}

TEST(ModelAdvice, NeverShakesABodyThatLiesOnTheGround) {
    Scene scene = scene_of(2000.0, test::water());
    scene.bodies[0].position.z() = 0.5;
    AdviceOptions quick;
    quick.most_falls = quick.sampling.falls;
    const auto constant = [&] {
        const BodyAdvice advice = advice_of(scene, test::baked_ellipsoid({0.01, 0.02, 0.04}), quick);
        return std::any_of(advice.omissions.begin(), advice.omissions.end(), [](const ModelEffect& one) {
            return one.models.turbulence == Turbulence::constant;
        });
    };
    EXPECT_TRUE(constant());
    scene.ground = 0.0;
    EXPECT_FALSE(constant());
}

TEST(ModelAdvice, OfABodyThatDoesNotMoveLeavesOutWhatItMay) {
    Scene scene = scene_of(1200.0, test::water(), 1.0);
    scene.gravity.setZero();
    const BodyAdvice advice = advice_of(scene, test::baked_ellipsoid({0.01, 0.02, 0.04}));
    for (const ModelEffect& one : advice.omissions) EXPECT_TRUE(one.flies) << one.left_out;
    EXPECT_FALSE(advice.recommended.cost.tables);
}

/// The advice without what is measured by the clock.
nlohmann::json decided(nlohmann::json advice) {
    for (nlohmann::json& body : advice["bodies"]) {
        for (const char* key : {"full", "recommended"}) body[key].erase("nanoseconds_per_step");
        for (nlohmann::json& one : body["omissions"]) one.erase("nanoseconds_per_step");
    }
    return advice;
}

TEST(ModelAdvice, IsTheSameForAnyNumberOfThreads) {
    const Scene scene = scene_of(1200.0, test::water(), 2.0);
    const std::vector<LoadedBody> loaded = {{test::lopsided_shape(), "hash"}};
    AdviceOptions options;
    options.most_falls = 64;
    options.sampling.threads = 1;
    const auto one = decided(as_json(advise_models(scene, loaded, options, ignore)));
    options.sampling.threads = 2;
    const auto two = decided(as_json(advise_models(scene, loaded, options, ignore)));
    EXPECT_EQ(one.dump(), two.dump());
}

TEST(ModelAdvice, IsAppliedToItsBodiesByName) {
    Scene scene = scene_of(2700.0, test::air(), 2.0);
    scene.bodies[0].name = "stone";
    scene.bodies.push_back(scene.bodies[0]);
    scene.bodies[1].name = "other";
    scene.bodies[0].models_auto = true;
    AdviceOptions options;
    options.auto_alone = true;
    const ModelAdvice advice =
        advise_models(scene, {{baked_ball(), "hash"}, {baked_ball(), "hash"}}, options, ignore);
    ASSERT_EQ(advice.bodies.size(), 1U);
    apply(advice, scene);
    EXPECT_EQ(model_set_of(scene.bodies[0]), advice.bodies[0].recommended.models);
    EXPECT_FALSE(scene.bodies[0].added_mass);
    EXPECT_TRUE(scene.bodies[1].added_mass);
}

TEST(ModelAdvice, SaysWhatEachPartChangesAndWhatIsRecommended) {
    Scene scene = scene_of(2700.0, test::air(), 2.0);
    scene.bodies[0].name = "stone";
    const ModelAdvice advice = advise_models(scene, {{baked_ball(), "hash"}}, {}, ignore);
    const std::string text = as_text(advice);
    for (const char* words :
         {"stone: falls of 2 s", "added mass", "table loads", "recommended: ", "needs: "}) {
        EXPECT_THAT(text, HasSubstr(words));
    }
    const nlohmann::json json = as_json(advice);
    EXPECT_EQ(json["tolerance"], 0.05);
    const nlohmann::json& body = json["bodies"][0];
    EXPECT_EQ(body["recommended"]["models"]["added_mass"], false);
    EXPECT_EQ(body["full"]["models"]["loads"], "table");
    EXPECT_EQ(body["omissions"][0]["figures"]["descent_speed"]["verdict"], "within");
}

}  // namespace
}  // namespace samara
