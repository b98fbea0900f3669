#include "foam-cases/falls/fall_plan.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "foam-cases/falls/validate.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/simulation/world_pose.hpp"
#include "samara/scene/terminal_speed.hpp"
#include "test_bodies.hpp"

namespace samara {
namespace {

const Fluid water = {1000.0, 1e-3, Vector3d::Zero(), {}};

SceneBody of_density(double density) {
    SceneBody body;
    body.loads = Loads::none;
    body.turbulence = Turbulence::none;
    body.mass.density = density;
    return body;
}

// The plan of a fall of a body whose centre of mass is off its centroid, and which is rotated in the world.
SceneBody uneven_and_turned() {
    SceneBody body = of_density(1000.0);
    body.mass = {};
    body.mass.mass = 0.04;
    body.mass.center_of_mass = Vector3d(0.001, -0.002, 0.004);
    Matrix3d inertia;
    inertia << 8e-6, 1e-6, -5e-7, 1e-6, 7e-6, 8e-7, -5e-7, 8e-7, 6e-6;
    body.mass.inertia = inertia;
    body.orientation = Quaterniond(Eigen::AngleAxisd(0.8, Vector3d(1, 2, -1).normalized()));
    body.position = {3, 4, 5};
    return body;
}

BodyState start_of(const SceneBody& scene_body, const ImmersedBody& immersed, const Fluid& fluid) {
    Surroundings surroundings;
    surroundings.current = fluid.current;
    return initial_state(scene_body, immersed.center_of_mass, surroundings, Noise(1, "body", 0, 0));
}

const Vector3d gravity(0.0, 0.0, -9.81);
constexpr double speed = 0.2;

struct Planned {
    Body body = test::ellipsoid({0.01, 0.02, 0.04}, {0.5, 0.0, 0.0});
    SceneBody scene_body;
    Fluid fluid = water;
    ImmersedBody immersed;
    BodyState start;
    FallModel model = fall_model_of(Closure::k_omega_sst_lm);
    FreeFall fall;

    explicit Planned(const SceneBody& of) : scene_body(of) {}
    void plan() {
        immersed = make_immersed_body(body, scene_body, fluid);
        start = start_of(scene_body, immersed, fluid);
        fall = plan_fall(body, immersed, start, gravity, speed, 3.0, model);
    }
};

TEST(FallPlan, HasTheUnitsOfTheBodyTheSpeedAndTheFluid) {
    Planned planned(of_density(1200.0));
    planned.plan();
    const FreeFall& fall = planned.fall;
    const double length = reference_length(planned.body.moments.surface_area);
    EXPECT_DOUBLE_EQ(fall.length, length);
    EXPECT_DOUBLE_EQ(fall.reynolds_number, speed * length / 1e-6);
    EXPECT_EQ(fall.closure, Closure::k_omega_sst_lm);
    EXPECT_NEAR(fall.volume, planned.body.moments.volume / std::pow(length, 3.0), 1e-12);
    EXPECT_NEAR(fall.mass, 1.2 * fall.volume, 1e-12);
    EXPECT_NEAR(fall.duration, 3.0 * speed / length, 1e-9);
    EXPECT_NEAR(fall.gravity.norm(), 9.81 * length / (speed * speed), 1e-9);
    EXPECT_LT(fall.center_of_mass.norm(), 1e-12);
    EXPECT_EQ(fall.principal_axes, Matrix3d::Identity());
    // m (b^2 + c^2)/5
    const double expected = 1.2 * fall.volume * (0.02 * 0.02 + 0.04 * 0.04) / 5.0 / (length * length);
    EXPECT_NEAR(fall.principal_moments.x(), expected, 1e-9);
    EXPECT_EQ(fall.velocity, Vector3d::Zero());
    EXPECT_EQ(fall.time_step, planned.model.time_step(largest_inertia_ratio(planned.immersed)));
}

TEST(FallPlan, RotatesEverythingIntoCaseAxes) {
    Planned planned(uneven_and_turned());
    Matrix3d& axes = planned.body.symmetry.axes;
    axes << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    planned.plan();
    const FreeFall& fall = planned.fall;
    const Matrix3d orientation = planned.scene_body.orientation.toRotationMatrix();
    const double unit = fall.length / (speed * speed);
    EXPECT_LT((orientation * axes * fall.gravity - gravity * unit).norm(), 1e-9);
    const Vector3d from_centroid = *planned.scene_body.mass.center_of_mass - planned.body.moments.centroid;
    EXPECT_LT((axes * fall.center_of_mass * fall.length - from_centroid).norm(), 1e-12);
    const double inertia_unit = water.density * std::pow(fall.length, 5.0);
    const Matrix3d inertia = axes * fall.inertia() * axes.transpose() * inertia_unit;
    EXPECT_LT((inertia - *planned.scene_body.mass.inertia).norm(), 1e-15);
    EXPECT_NEAR(fall.principal_axes.determinant(), 1.0, 1e-12);
}

// The solver writes angles about x, y and z, which are not unique where the third axis is the first of the
// case.
TEST(FallPlan, TakesPrincipalAxesThatAreNearTheCases) {
    SceneBody body = uneven_and_turned();
    *body.mass.inertia << 9e-6, 0, 0, 0, 7e-6, 1e-7, 0, 1e-7, 6e-6;
    Planned planned(body);
    planned.plan();
    EXPECT_GT(planned.fall.principal_axes.diagonal().minCoeff(), 0.9);
    EXPECT_NEAR(planned.fall.principal_axes(0, 0), 1.0, 1e-12);
}

TEST(FallPlan, IsTheSameInAnyCurrentThatCarriesTheBodyAlong) {
    SceneBody body = uneven_and_turned();
    body.velocity = {0.1, 0.2, -0.3};
    body.angular_velocity = {1, 2, 3};
    Planned at_rest(body);
    at_rest.plan();
    const Vector3d current(0.5, -0.25, 0.125);
    body.velocity += current;
    Planned carried(body);
    carried.fluid.current = current;
    carried.plan();
    EXPECT_LT((carried.fall.velocity - at_rest.fall.velocity).norm(), 1e-12);
    EXPECT_LT((carried.fall.angular_velocity - at_rest.fall.angular_velocity).norm(), 1e-12);
    EXPECT_EQ(carried.fall.gravity, at_rest.fall.gravity);
}

// Where the fluid is at rest and the body has the momenta of both, it keeps K^-1 of them, the velocity asked
// for.
TEST(FallPlan, StartsWithTheMomentaOfBodyAndFluid) {
    SceneBody body = of_density(2000.0);
    body.velocity = {0.0, 0.0, -0.3};
    Planned planned(body);
    planned.model = fall_model_of(Closure::k_epsilon);
    planned.plan();
    // The test body has the added mass of a sphere.
    EXPECT_NEAR(planned.fall.velocity.z(), -0.3 * (2.0 + 0.5) / 2.0 / speed, 1e-9);
    // With time steps of second order the fluid takes half of its share of a jump.
    planned.model = fall_model_of(Closure::k_omega_sst_lm);
    planned.plan();
    EXPECT_NEAR(planned.fall.velocity.z(), -0.3 * (2.0 + 0.5) / (2.0 + 0.25) / speed, 1e-9);

    SceneBody uneven = uneven_and_turned();
    uneven.velocity = {0.1, 0.2, -0.3};
    uneven.angular_velocity = {1, 2, 3};
    Planned turned(uneven);
    turned.model = fall_model_of(Closure::k_epsilon);
    turned.plan();
    const FreeFall& fall = turned.fall;
    Vector6d own;
    own << turned.immersed.own_inertia * fall.angular_velocity / fall.time_unit(),
        turned.immersed.mass * fall.velocity * speed;
    const Vector6d left = turned.immersed.inverse_inertia * own;
    EXPECT_LT((left - turned.start.velocity).norm(), 1e-9);
}

TEST(FallPlan, RelaxesBelowTheStabilityOfTakingFlowAndMotionInTurn) {
    for (const double density : {20.0, 500.0, 1200.0, 8000.0}) {
        Planned planned(of_density(density));
        planned.model = fall_model_of(Closure::k_epsilon);
        planned.plan();
        // The test body has half its displaced mass as added mass, and no added moment of inertia.
        const double ratio = 0.5 * 1000.0 / density;
        EXPECT_NEAR(largest_inertia_ratio(planned.immersed), ratio, 1e-9);
        EXPECT_NEAR(planned.fall.acceleration_relaxation, std::min(0.7, 0.75 * 2.0 / (1.0 + ratio)), 1e-12);
    }
}

// The accelerations of a body whose fluid answers as it does in time of second order, from a jolt on: its
// largest after so many steps.
double error_after(int steps, double share, double ratio) {
    std::vector<double> past = {1.0, 0.0, 0.0, 0.0};  // latest first
    for (int i = 0; i < steps; ++i) {
        const double answer = ratio * (9.0 * past[1] - 6.0 * past[2] + past[3]) / 4.0;
        past = {(1.0 - share) * past[0] - share * answer, past[0], past[1], past[2]};
    }
    double largest = 0.0;
    for (const double error : past) largest = std::max(largest, std::abs(error));
    return largest;
}

TEST(FallPlan, RelaxesSoMuchThatErrorsDieOutInTimeOfSecondOrder) {
    const FallModel model = fall_model_of(Closure::k_omega_sst_lm);
    for (const double ratio : {0.05, 0.4, 0.5, 0.57, 0.65, 0.8, 1.0, 1.3, 3.0, 10.0, 25.0}) {
        const double share = model.acceleration_relaxation(ratio);
        EXPECT_LE(share, 0.7);
        EXPECT_LT(error_after(100, share, ratio), 1e-3) << ratio;
        if (share < 0.7) {
            EXPECT_GT(error_after(100, 1.5 * share, ratio), 1.0) << ratio;
        }
    }
}

TEST(FallPlan, HasStepsInWhichABodyAnswersHardlyLate) {
    const FallModel model = fall_model_of(Closure::k_omega_sst_lm);
    for (const double ratio : {0.05, 0.4, 1.3, 3.0, 10.0, 25.0}) {
        const double share = model.acceleration_relaxation(ratio);
        EXPECT_LE(model.time_step(ratio) / (share * (1.0 + ratio)), 0.02 + 1e-12) << ratio;
        EXPECT_GE(model.time_step(ratio), 0.008) << ratio;
    }
    EXPECT_EQ(fall_model_of(Closure::k_epsilon).time_step(3.0), 0.01);
}

TEST(FallModel, IsResolvedButForClosuresOfKAndEpsilon) {
    EXPECT_FALSE(fall_model_of(Closure::k_epsilon).resolved);
    EXPECT_FALSE(fall_model_of(Closure::rng_k_epsilon).resolved);
    for (const char* name : {"kOmegaSSTLM", "kOmegaSST", "laminar"}) {
        EXPECT_TRUE(fall_model_of(closure_of_falls(name)).resolved) << name;
    }
    EXPECT_EQ(closure_of_falls("kEpsilon"), Closure::k_epsilon);
    EXPECT_THROW(static_cast<void>(closure_of_falls("SpalartAllmaras")), Error);
}

TEST(FallSpeed, IsTheTerminalSpeedOfABodyThatStartsFromRest) {
    Planned planned(of_density(1200.0));
    planned.plan();
    const double expected = terminal_speed(planned.body, water, planned.immersed.mass, 9.81);
    EXPECT_EQ(fall_speed(planned.body, planned.immersed, planned.start, water, 9.81), expected);
}

TEST(FallSpeed, IsThatOfTheStartWhereThatIsFaster) {
    SceneBody body = of_density(1200.0);
    body.velocity = {0, 3, 4};
    Planned planned(body);
    planned.plan();
    EXPECT_NEAR(fall_speed(planned.body, planned.immersed, planned.start, water, 9.81), 5.0, 1e-12);
    EXPECT_NEAR(fall_speed(planned.body, planned.immersed, planned.start, water, 0.0), 5.0, 1e-12);
    planned.scene_body.velocity.setZero();
    planned.scene_body.angular_velocity = {0, 0, 1000};
    planned.plan();
    EXPECT_NEAR(fall_speed(planned.body, planned.immersed, planned.start, water, 9.81),
                500.0 * planned.fall.length, 1e-9);
}

TEST(FallSpeed, IsZeroForABodyAsDenseAsTheFluid) {
    Planned planned(of_density(1000.0));
    planned.plan();
    EXPECT_EQ(fall_speed(planned.body, planned.immersed, planned.start, water, 9.81), 0.0);
}

// omega^2 = rho V g r / I, with the body's own inertia, for the test body has no added one about its
// centroid.
TEST(FallSpeed, OfAFloatingBodyHungOffItsCentroidIsThatOfItsSwings) {
    SceneBody body = of_density(1000.0);
    body.mass = {};
    Planned planned(body);
    planned.body = test::sphere(0.02);
    planned.scene_body.mass.mass = 1000.0 * planned.body.moments.volume;
    planned.scene_body.mass.center_of_mass = Vector3d(0, 0, -1e-4);
    planned.plan();
    const double inertia = 0.4 * *planned.scene_body.mass.mass * 0.02 * 0.02;
    const double swing = std::sqrt(*planned.scene_body.mass.mass * 9.81 * 1e-4 / inertia);
    EXPECT_NEAR(fall_speed(planned.body, planned.immersed, planned.start, water, 9.81),
                swing * planned.fall.length, 0.01 * swing * planned.fall.length);
}

TEST(FallPlan, TakesTheMeshWhoseCellsAreNearestAsARatio) {
    Planned planned(of_density(1200.0));
    planned.plan();
    planned.model = fall_model_of(Closure::k_epsilon);
    const auto mesh_at = [&](double cells) {
        return plan_falls(planned.body, cells, {planned.fall}, planned.model);
    };
    for (const double cells : {6000.0, 20'000.0, 40'000.0}) {
        EXPECT_NEAR(std::log(mesh_at(cells).cells.front() / cells), 0.0, 0.2);
    }
    const BakePlan plan = mesh_at(1e7);
    EXPECT_EQ(plan.falls.front().mesh, "mesh_64");
    EXPECT_TRUE(plan.cases.empty());
    ASSERT_EQ(plan.quality.meshes.size(), 1u);
    EXPECT_FALSE(plan.quality.meshes.front().resolves_boundary_layer);
    const double of_fall = estimated_fall_seconds(plan.falls.front(), plan.cells.front());
    EXPECT_GT(plan.cpu_seconds, of_fall);
    EXPECT_LT(plan.cpu_seconds, 2.0 * of_fall);
}

// One mesh in ever smaller cells, whose layers begin as thin in all.
TEST(FallPlan, TakesAsManyCellsAsAreAskedForWhereTheBoundaryLayerIsResolved) {
    Planned planned(of_density(1200.0));
    planned.plan();
    const auto plan_at = [&](double cells) {
        return plan_falls(planned.body, cells, {planned.fall}, planned.model);
    };
    for (const double cells : {6000.0, 20'000.0, 40'000.0, 120'000.0, 400'000.0}) {
        const BakePlan plan = plan_at(cells);
        ASSERT_EQ(plan.quality.meshes.size(), 1u);
        EXPECT_NEAR(plan.cells.front(), cells, 0.2 * cells);
        const FlowMesh& mesh = plan.quality.meshes.front();
        EXPECT_EQ(plan.falls.front().mesh, mesh.name);
        EXPECT_TRUE(mesh.resolves_boundary_layer);
        const double last = 0.5 * mesh.background_cell / std::ldexp(1.0, mesh.surface_level);
        EXPECT_NEAR(std::log(470.0 * last / std::pow(1.4, mesh.layers - 1)), 0.0, 0.2) << cells;
    }
    EXPECT_GT(plan_at(120'000.0).quality.meshes.front().background_cells(),
              1.35 * plan_at(40'000.0).quality.meshes.front().background_cells());
}

TEST(FallPlan, HasThinnerLayersAtHigherReynoldsNumbers) {
    EXPECT_EQ(meshes_of_falls(1e3, true).front().layers, meshes_of_falls(2e4, true).front().layers);
    EXPECT_EQ(meshes_of_falls(1e5, true).front().layers, meshes_of_falls(2e4, true).front().layers + 4);
}

BakePlan bake_with_falls(const Body& body, const BakeQuality& quality) {
    MassSpecification mass;
    mass.density = 1200.0;
    BakePlan plan = plan_bake(body, quality, 1e4);
    add_falls(body, water, {mass}, 9.81, plan);
    return plan;
}

TEST(FallPlan, IsOfItsOwnTypeNotOfAQuality) {
    Planned planned(of_density(1200.0));
    planned.plan();
    const BakePlan plan = plan_falls(planned.body, 5000.0, {planned.fall}, planned.model);
    EXPECT_EQ(plan.type, CaseType::fall);
    EXPECT_EQ(plan_json(plan)["quality"], "fall");
    EXPECT_EQ(type_of_plan(plan_json(plan)), CaseType::fall);
    const BakePlan bake = bake_with_falls(planned.body, bake_quality("standard"));
    EXPECT_EQ(type_of_plan(plan_json(bake)), CaseType::bake);
}

TEST(IdentificationFalls, AreTwoAtStandardAndAtHighOnAMeshOfTheirOwn) {
    const Body body = test::ellipsoid({0.01, 0.02, 0.04});
    EXPECT_TRUE(bake_with_falls(body, bake_quality("smoke")).falls.empty());
    EXPECT_TRUE(bake_with_falls(body, bake_quality("preview")).falls.empty());
    const BakePlan standard = bake_with_falls(body, bake_quality("standard"));
    ASSERT_EQ(standard.falls.size(), 2u);
    EXPECT_EQ(standard.falls[0].name, "fall_00");
    EXPECT_NEAR(cells_of(standard, standard.falls[0].mesh), 20'000.0, 2000.0);
    const BakePlan high = bake_with_falls(body, bake_quality("high"));
    ASSERT_EQ(high.falls.size(), 2u);
    for (const FreeFall& fall : high.falls) EXPECT_NEAR(cells_of(high, fall.mesh), 60'000.0, 6000.0);
    EXPECT_EQ(high.falls[1].name, "fall_01");
    EXPECT_GT((high.falls[0].gravity - high.falls[1].gravity).norm(), 0.3 * high.falls[0].gravity.norm());
}

TEST(IdentificationFalls, AreNoneOfABodyThatHasNoTimeToReachItsSpeed) {
    const Body body = test::ellipsoid({0.01, 0.02, 0.04});
    const auto falls_of = [&](double density) {
        std::vector<MassSpecification> masses(2);
        masses[0].density = 1200.0;
        masses[1].density = density;
        BakePlan plan = plan_bake(body, bake_quality("standard"), 1e4);
        add_falls(body, water, masses, 9.81, plan);
        return plan.falls.size();
    };
    EXPECT_EQ(falls_of(20e3), 2u);
    EXPECT_EQ(falls_of(1e6), 0u);
    EXPECT_TRUE(has_time_to_fall(1.0, 0.1, 9.81));
    EXPECT_FALSE(has_time_to_fall(20.0, 0.1, 9.81));
}

TEST(IdentificationFalls, OfTwoDensitiesHaveThemInTurnEachInItsOwnTime) {
    const Body body = test::ellipsoid({0.01, 0.02, 0.04});
    std::vector<MassSpecification> masses(2);
    masses[0].density = 1200.0;
    masses[1].density = 4800.0;
    BakePlan plan = plan_bake(body, bake_quality("standard"), 1e4);
    add_falls(body, water, masses, 9.81, plan);
    ASSERT_EQ(plan.falls.size(), 2u);
    const auto& [light, heavy] = std::tie(plan.falls[0], plan.falls[1]);
    EXPECT_NEAR(light.mass / light.volume, 1200.0 / water.density, 1e-9);
    EXPECT_NEAR(heavy.mass / heavy.volume, 4800.0 / water.density, 1e-9);
    EXPECT_DOUBLE_EQ(light.duration, heavy.duration);
    // But for the drag's dependence on the Reynolds number.
    const double faster = std::sqrt((4800.0 - water.density) / (1200.0 - water.density));
    EXPECT_NEAR(heavy.speed / light.speed, faster, 0.3 * faster);
}

TEST(IdentificationFalls, HaveStepsOfTheirOwnTimesTheFactorThatIsAskedFor) {
    const Body body = test::ellipsoid({0.01, 0.02, 0.04});
    BakeQuality quality = bake_quality("standard");
    const BakePlan plan = bake_with_falls(body, quality);
    quality.fall_step = 0.5;
    const BakePlan halved = bake_with_falls(body, quality);
    ASSERT_EQ(halved.falls.size(), plan.falls.size());
    for (std::size_t i = 0; i < plan.falls.size(); ++i) {
        EXPECT_EQ(halved.falls[i].time_step, 0.5 * plan.falls[i].time_step);
        EXPECT_EQ(halved.falls[i].acceleration_relaxation, plan.falls[i].acceleration_relaxation);
    }
    EXPECT_GT(halved.cpu_seconds, plan.cpu_seconds);
}

TEST(IdentificationFalls, ByAnotherClosureHaveAMeshOfTheirOwnOfAsManyCells) {
    const Body body = test::ellipsoid({0.01, 0.02, 0.04});
    const BakePlan plan =
        bake_with_falls(body, with_falls_by(Closure::k_omega_sst_lm, bake_quality("standard")));
    EXPECT_EQ(plan.falls[0].closure, Closure::k_omega_sst_lm);
    EXPECT_EQ(plan.cases.front().closure, Closure::k_epsilon);
    ASSERT_EQ(plan.quality.fall_meshes.size(), 1u);
    EXPECT_TRUE(plan.quality.fall_meshes.front().resolves_boundary_layer);
    for (const FreeFall& fall : plan.falls) EXPECT_EQ(fall.mesh, plan.quality.fall_meshes.front().name);
    EXPECT_NEAR(cells_of(plan, plan.falls[0].mesh), 20'000.0, 4000.0);
    EXPECT_EQ(plan_json(plan)["meshes"].size(), 4u);
    EXPECT_THROW(static_cast<void>(with_falls_by(Closure::laminar, bake_quality("standard"))), Error);
}

TEST(IdentificationFalls, AreByTheClosureOfTheLoadsOnTheMeshOfValidation) {
    const Body body = test::ellipsoid({0.01, 0.02, 0.04});
    const BakePlan plan =
        bake_with_falls(body, with_loads_by(Closure::k_omega_sst_lm, bake_quality("standard")));
    EXPECT_EQ(plan.falls[0].closure, Closure::k_omega_sst_lm);
    EXPECT_GT(plan.falls[0].time_step, fall_model_of(Closure::k_epsilon).time_step(1.0));
    ASSERT_EQ(plan.quality.fall_meshes.size(), 1u);
    const FlowMesh mesh = mesh_of(plan, plan.falls[0].mesh);
    EXPECT_EQ(mesh.name, plan.quality.fall_meshes.front().name);
    EXPECT_TRUE(mesh.resolves_boundary_layer);
    const BakePlan validation =
        plan_falls(body, ValidationRequest().cells, plan.falls, fall_model_of(plan.falls[0].closure));
    EXPECT_EQ(cells_of(plan, mesh.name), validation.cells.front());
}

TEST(IdentificationFalls, StartFromRestWithTheBodysMassAndLastThirtyUnits) {
    const Body body = test::ellipsoid({0.01, 0.02, 0.04});
    const BakePlan plan = bake_with_falls(body, bake_quality("standard"));
    const FreeFall& fall = plan.falls[0];
    EXPECT_EQ(fall.velocity, Vector3d::Zero());
    EXPECT_EQ(fall.angular_velocity, Vector3d::Zero());
    EXPECT_NEAR(fall.mass, 1.2 * fall.volume, 1e-12);
    EXPECT_NEAR(fall.duration, 30.0, 1e-12);
    EXPECT_EQ(fall.speed, bake_speed(body, water, 1200.0 * body.moments.volume, 9.81));
}

TEST(IdentificationFalls, CountInTheCostOfTheBake) {
    const Body body = test::ellipsoid({0.01, 0.02, 0.04});
    const BakePlan plan = bake_with_falls(body, bake_quality("standard"));
    const double without = plan_bake(body, bake_quality("standard"), 1e4).cpu_seconds;
    const double falls = 2.0 * estimated_fall_seconds(plan.falls[0], cells_of(plan, plan.falls[0].mesh));
    EXPECT_NEAR(plan.cpu_seconds - without, falls, 0.01 * falls);  // and their mesh
    BakePlan again = plan;
    estimate_cost(again);
    EXPECT_EQ(again.cpu_seconds, plan.cpu_seconds);
}

TEST(IdentificationFalls, StandInThePlanWithTheirMeshes) {
    const nlohmann::json json =
        plan_json(bake_with_falls(test::ellipsoid({0.01, 0.02, 0.04}), bake_quality("high")));
    EXPECT_EQ(json["falls"], (nlohmann::json{{{"name", "fall_00"}, {"mesh", "mesh_falls"}},
                                             {{"name", "fall_01"}, {"mesh", "mesh_falls"}}}));
}

TEST(IdentificationStart, IsObliqueToAllPrincipalAxesHoweverTheShapeLies) {
    Body body = test::ellipsoid({0.01, 0.02, 0.04});
    const Matrix3d turn = Eigen::AngleAxisd(0.9, Vector3d(1, -2, 1).normalized()).toRotationMatrix();
    for (int turned = 0; turned < 2; ++turned) {
        for (int index = 0; index < 3; ++index) {
            const BodyState start = identification_start(body, index);
            EXPECT_EQ(start.velocity, Vector6d::Zero());
            const Vector3d down = start.orientation.conjugate() * -Vector3d::UnitZ();
            const Vector3d along = (principal_axes(body.moments).transpose() * down).cwiseAbs();
            // No axis is nearer than 15 degrees to the horizontal, or than 30 to the vertical.
            EXPECT_GT(along.minCoeff(), std::sin(0.26)) << index;
            EXPECT_LT(along.maxCoeff(), std::cos(0.52)) << index;
        }
        body.moments.second_moments = turn * body.moments.second_moments * turn.transpose();
    }
}

}  // namespace
}  // namespace samara
