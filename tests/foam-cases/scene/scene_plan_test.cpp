#include "foam-cases/scene/scene_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../converter/load_laws.hpp"
#include "../converter/table_cases.hpp"
#include "converter/tables/direction_sampling.hpp"
#include "foam-cases/scene/scene_plan_report.hpp"
#include "samara/pictures/draw.hpp"
#include "support/expect_error.hpp"
#include "support/known_bodies.hpp"
#include "support/temporary_folder.hpp"
#include "test_bodies.hpp"

namespace samara {
namespace {

/// The rubber ellipsoid with its exact tensor and an ellipsoid's symmetry.
Body rubber() {
    Body body = test::rubber_ellipsoid();
    body.symmetry = test::ellipsoid({0.01, 0.02, 0.04}).symmetry;
    return body;
}

SceneGoal goal_of(double tolerance) {
    SceneGoal goal;
    goal.scene.duration = 3.0;
    SceneBody body;
    body.name = "rubber";
    body.mass.density = 1200.0;
    body.orientation = Quaterniond(0.8, 0.0, -0.55, 0.1).normalized();
    goal.scene.bodies = {body};
    goal.tolerance = tolerance;
    goal.falls = 6;
    goal.draws = 6;
    return goal;
}

SampledFalls simulated(const SceneGoal& goal) {
    return simulate_for_bake(goal.scene, 0, rubber(), goal.falls);
}

TEST(ScenePlan, OfASceneInWhichTheBodyDoesNotMoveIsRejected) {
    const auto error_of = [](double duration, double start, double step) {
        SceneGoal goal = goal_of(0.1);
        goal.scene.file = "odd.toml";
        goal.scene.duration = duration;
        goal.scene.step = step;
        goal.scene.bodies[0].start = start;
        return test::error_of(
            [&] { first_plan(goal, rubber(), bake_quality("smoke"), {}, simulated(goal)); });
    };
    for (const auto& [duration, start, step] :
         {std::array{1e-4, 0.0, 1.0}, {1.0, 2.0, 2e-3}, {1.0, 1.0, 2e-3}}) {
        EXPECT_THAT(error_of(duration, start, step),
                    testing::StartsWith("odd.toml: the body 'rubber' does not move in the scene"));
    }
}

/// A box's law with a stall that no polynomial of low degree follows.
LoadEntry law(const Vector3d& d) {
    LoadEntry entry = test::BoxLaw()(d);
    const double stall = 1.0 + 0.6 * std::tanh(6.0 * (std::abs(d.x()) - 0.8));
    entry.force *= stall;
    entry.moment *= stall;
    return entry;
}

/// Returns the result of solving the plan's cases if the flow obeyed the law.
Conversion solved(const Body& body, const ScenePlan& plan) {
    Conversion conversion;
    conversion.body = body;
    for (const BakeCase& entry : plan.cases.cases) {
        if (entry.purpose != CasePurpose::table) continue;
        SolvedCase one;
        one.name = entry.name;
        one.reynolds_number = entry.reynolds_number;
        one.mesh = "mesh";
        one.sample = {entry.direction, law(entry.direction), {}};
        conversion.cases.push_back(one);
    }
    LoadTables tables;
    tables.reference_length = reference_length(body.moments.surface_area);
    tables.subdivisions = plan.cases.subdivisions;
    tables.axes = plan.cases.axes;
    conversion.sampling_errors =
        fill_tables(tables, body.symmetry, conversion.cases, plan.cases.main_reynolds_number);
    conversion.body.tables = tables;
    return conversion;
}

ScenePlan planned(const SceneGoal& goal, const Body& body) {
    return first_plan(goal, body, bake_quality("smoke"), {},
                      simulate_for_bake(goal.scene, 0, body, goal.falls));
}

ScenePlan baked(const SceneGoal& goal, const Body& body) {
    ScenePlan plan = planned(goal, body);
    while (plan.stopped_because.empty()) judge_round(goal, solved(body, plan), 0.0, plan);
    return plan;
}

TEST(ScenePlan, BeginsWithFewDirectionsAtTheReynoldsNumberOfTheFall) {
    const ScenePlan plan = planned(goal_of(0.1), rubber());
    EXPECT_EQ(plan.chosen.size(), 6u);       // the axes, and three where it moves
    EXPECT_EQ(plan.cases.cases.size(), 6u);  // one mesh at smoke
    EXPECT_EQ(plan.candidates.directions.size(), 45u);
    EXPECT_GT(plan.cases.main_reynolds_number, 3e3);
    EXPECT_LT(plan.cases.main_reynolds_number, 3e4);
    EXPECT_TRUE(plan.cases.covers_scene);
    EXPECT_EQ(plan_json(plan.cases)["covers"], "scene");
}

TEST(ScenePlan, NamesItsCasesByTheirDirectionSoThatRoundsGoOnFromOneAnother) {
    const ScenePlan plan = baked(goal_of(0.005), rubber());
    ASSERT_GT(plan.rounds.size(), 1u);
    std::set<std::string> names;
    for (const BakeCase& entry : plan.cases.cases) names.insert(entry.name);
    EXPECT_EQ(names.size(), plan.cases.cases.size());
    const ScenePlan first = planned(goal_of(0.005), rubber());
    for (const BakeCase& entry : first.cases.cases) EXPECT_TRUE(names.contains(entry.name)) << entry.name;
}

TEST(ScenePlan, StopsWhereTheToleranceIsMet) {
    const ScenePlan plan = baked(goal_of(0.5), rubber());
    EXPECT_EQ(plan.stopped_because, "the tolerance is met");
    EXPECT_LE(plan.rounds.back().error.worst(0.5), 1.0);
    EXPECT_LT(plan.chosen.size(), plan.candidates.directions.size());
}

TEST(ScenePlan, StopsAfterItsFirstRoundOnlyWhereThatSolvesEveryDirection) {
    EXPECT_GE(baked(goal_of(0.5), rubber()).rounds.size(), 2u);
    SceneGoal goal = goal_of(0.5);
    goal.whole_grid = true;
    EXPECT_EQ(baked(goal, rubber()).rounds.size(), 1u);
}

TEST(ScenePlan, StatesNoErrorBelowTheChangeSinceTheRoundBefore) {
    ScenePlan plan = baked(goal_of(0.002), rubber());
    ASSERT_GE(plan.rounds.size(), 2u);
    for (std::size_t i = 1; i < plan.rounds.size(); ++i) {
        const auto now = *plan.rounds[i].simulation.mean(Metric::descent_speed);
        const auto then = *plan.rounds[i - 1].simulation.mean(Metric::descent_speed);
        const double change = std::abs(now.value - then.value);
        const double chance = 2.0 * std::hypot(*now.error, *then.error);
        const double stated =
            plan.rounds[i].error.metrics[Metric::descent_speed]->of_table * std::abs(now.value);
        EXPECT_GE(std::hypot(stated, chance), change * (1.0 - 1e-9)) << "round " << i;
    }
}

TEST(ScenePlan, SolvesMoreDirectionsForASmallerTolerance) {
    EXPECT_GT(baked(goal_of(0.002), rubber()).chosen.size(), baked(goal_of(0.5), rubber()).chosen.size());
}

TEST(ScenePlan, LeavesLessUncertainWithMoreDirections) {
    const ScenePlan plan = baked(goal_of(0.002), rubber());
    ASSERT_GE(plan.rounds.size(), 3u);
    EXPECT_LT(plan.rounds.back().error.worst(0.1), 0.5 * plan.rounds.front().error.worst(0.1));
}

TEST(ScenePlan, SpendsNoMoreThanItsBudget) {
    SceneGoal goal = goal_of(0.002);
    goal.budget = 1.3 * planned(goal, rubber()).cases.cpu_seconds;
    const ScenePlan plan = baked(goal, rubber());
    EXPECT_THAT(plan.stopped_because, testing::HasSubstr("budget"));
    EXPECT_LE(plan.cases.cpu_seconds, *goal.budget);
    EXPECT_GT(plan.rounds.size(), 0u);
}

TEST(ScenePlan, NeverTakesMoreRoundsThanThereMayBe) {
    SceneGoal goal = goal_of(1e-4);
    goal.most_rounds = 2;
    const ScenePlan plan = baked(goal, rubber());
    EXPECT_EQ(plan.rounds.size(), 2u);
    EXPECT_THAT(plan.stopped_because, testing::HasSubstr("2 rounds"));
}

TEST(ScenePlan, IsTheSameEveryTime) {
    const SceneGoal goal = goal_of(0.05);
    EXPECT_EQ(scene_plan_as_json(goal, baked(goal, rubber())),
              scene_plan_as_json(goal, baked(goal, rubber())));
}

TEST(ScenePlan, OfABallIsOneDirection) {
    Body ball = test::exact_sphere(0.02);
    ball.symmetry = test::sphere(0.02).symmetry;
    const ScenePlan plan = planned(goal_of(0.1), ball);
    EXPECT_EQ(plan.chosen.size(), 1u);
    EXPECT_EQ(plan.candidates.directions.size(), 1u);
}

TEST(ScenePlan, HoldsTheDirectionsThatItsSimulationsVisited) {
    const SceneGoal goal = goal_of(0.1);
    const Body body = rubber();
    const SampledFalls simulation = simulate_for_bake(goal.scene, 0, body, goal.falls);
    const ScenePlan plan = first_plan(goal, body, bake_quality("smoke"), {}, simulation);
    for (const FlowVisit& visit : simulation.visits) EXPECT_TRUE(plan.region.holds(visit.direction));
    EXPECT_FALSE(std::ranges::all_of(plan.region.planned, [](std::uint8_t one) { return one == 1; }));
}

TEST(ScenePlanPicture, HoldsEachVisitAndEachImageOfACase) {
    const Symmetry symmetry = test::ellipsoid({0.01, 0.02, 0.04}).symmetry;
    ScenePlan plan;
    plan.candidates.directions = required_directions(symmetry, 4);
    plan.chosen = {0, 1};
    std::vector<FlowVisit> visits(100);
    for (FlowVisit& visit : visits) visit.direction = symmetry.axes * Vector3d(0.6, 0.0, 0.8);
    const nlohmann::json picture = plan_picture("leaf", visits, symmetry, plan);
    ASSERT_EQ(picture["visited"].size(), 100U);
    EXPECT_NEAR(picture["visited"][0][0].get<double>(), 0.6, 1e-12);
    EXPECT_EQ(picture["cases"].size(), 2 * elements_in_map_axes(symmetry).size());
    const test::TemporaryFolder folder;
    draw_picture(folder / "plan.svg", picture);
    EXPECT_GT(std::filesystem::file_size(folder / "plan.svg"), 5000U);
}

}  // namespace
}  // namespace samara
