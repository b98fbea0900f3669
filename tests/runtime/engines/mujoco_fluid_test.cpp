// MuJoCo's bodies in samara's fluid, by the library that gives it to them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "runtime/engines/mujoco_model.hpp"
#include "samara.h"

namespace samara::test {
namespace {

constexpr double water = 998.2;
constexpr double gravity = 9.81;

double volume_of(const std::string& name) {
    samara_body* body = nullptr;
    EXPECT_EQ(samara_body_load(body_file(name).c_str(), &body, nullptr, 0), SAMARA_OK);
    const double volume = samara_body_volume(body);
    samara_body_free(body);
    return volume;
}

/// A ball of a density relative to water; <body/> lets MuJoCo keep its whole inertia.
std::string ball(const std::string& name, double density, const std::string& joint = "<freejoint/>",
                 const std::string& inside = "") {
    const double mass = density * water * volume_of("sphere");
    const std::string inertia =
        std::to_string(1e6 * 0.4 * mass * std::pow(volume_of("sphere") / 4.18879, 2.0 / 3.0)) + "e-6";
    return "<body name='" + name + "'>" + joint + "<inertial pos='0 0 0' mass='" +
           std::to_string(1e6 * mass) + "e-6' diaginertia='" + inertia + " " + inertia + " " + inertia +
           "'/><body/>{fluid}" + inside + "</body>";
}

/// Without turbulence.
FluidModel still(const std::string& shape, std::vector<std::string> bodies, std::string worldbody) {
    return {.settings = {{"file", body_file(shape)}, {"turbulence", "off"}},
            .bodies = std::move(bodies),
            .worldbody = std::move(worldbody)};
}

std::vector<mjtNum> positions(const ModelPointer& model, const DataPointer& data) {
    return {data->qpos, data->qpos + model->nq};
}

TEST(MujocoFluid, ABallStartsWithHalfItsDisplacedMassAdded) {
    for (const double density : {0.1, 0.5, 2.0}) {
        const ModelPointer model = load(still("sphere", {"ball"}, ball("ball", density)));
        const DataPointer data = start(model);
        run(model, data, 1);
        const double exact = (1.0 - density) * gravity / (density + 0.5);
        EXPECT_NEAR(data->qvel[2] / model->opt.timestep, exact, 2e-3 * std::abs(exact)) << density;
    }
}

TEST(MujocoFluid, AnArmCarriesTheAddedMassOfTheBallAtItsEnd) {
    FluidModel level =
        still("sphere", {"ball"}, ball("ball", 0.5, "<joint name='arm' axis='0 1 0' pos='-1 0 0'/>"));
    const ModelPointer model = load(level);
    const DataPointer data = start(model);
    run(model, data, 1);
    const double radius = std::cbrt(volume_of("sphere") / 4.18879);
    const double exact = -0.5 * gravity / (0.5 + 0.5 + 0.5 * 0.4 * radius * radius);
    EXPECT_NEAR(data->qvel[0] / model->opt.timestep, exact, 2e-3 * std::abs(exact));
}

TEST(MujocoFluid, ABallOfATenthOfTheFluidsDensityRisesSteadily) {
    const ModelPointer model = load(still("sphere", {"ball"}, ball("ball", 0.1)));
    const DataPointer data = start(model);
    run(model, data, 2000);
    const double speed = data->qvel[2];
    run(model, data, 500);
    EXPECT_GT(speed, 0.2);
    EXPECT_NEAR(data->qvel[2], speed, 0.02 * speed);
    EXPECT_LT(std::abs(data->qvel[0]), 0.1 * speed);
}

/// How far MuJoCo and samara's own flight of the same body are apart after a second, relative to its way.
double distance_from_own_flight(double step, const std::string& integrator) {
    samara_settings settings;
    samara_default_settings(&settings, sizeof settings, nullptr, 0);
    settings.step = step;
    samara_simulation* simulation = nullptr;
    samara_simulation_create(&settings, &simulation, nullptr, 0);
    samara_body* body = nullptr;
    samara_body_load(body_file("ellipsoid").c_str(), &body, nullptr, 0);
    samara_body_group group;
    samara_default_body_group(&group, sizeof group, nullptr, 0);
    group.density = 1200.0;
    group.turbulence = SAMARA_TURBULENCE_NONE;
    const std::array<double, 4> turn{0.9045340337332909, 0.30151134457776363, 0.30151134457776363, 0.0};
    std::copy(turn.begin(), turn.end(), group.orientation);
    samara_simulation_add(simulation, body, &group, nullptr, nullptr, 0);
    samara_mass_properties own;
    samara_get_mass_properties(simulation, 0, &own, nullptr, 0);
    samara_advance_to(simulation, 1.0, nullptr, 0);
    samara_pose flown;
    EXPECT_EQ(samara_get_poses(simulation, 0, 1, &flown, 0, nullptr, 0), SAMARA_OK);
    samara_simulation_free(simulation);
    samara_body_free(body);

    char text[512];
    const double* c = own.center_of_mass;
    const double* j = own.inertia;
    std::snprintf(
        text, sizeof text,
        "<body name='rubber' quat='%.17g %.17g %.17g 0'><freejoint/><inertial pos='%.17g %.17g %.17g' "
        "mass='%.17g' fullinertia='%.17g %.17g %.17g %.17g %.17g %.17g'/><body/>{fluid}</body>",
        turn[0], turn[1], turn[2], c[0], c[1], c[2], own.mass, j[0], j[4], j[8], j[1], j[2], j[5]);
    FluidModel fall = still("ellipsoid", {"rubber"}, text);
    fall.option = "timestep='" + std::to_string(step) + "' integrator='" + integrator + "'";
    const ModelPointer model = load(fall);
    const DataPointer data = start(model);
    run(model, data, static_cast<int>(std::lround(1.0 / step)));
    double apart = 0.0, way = 0.0;
    for (int i = 0; i < 3; ++i) {
        apart += std::pow(data->qpos[i] - flown.position[i], 2);
        way += std::pow(flown.position[i], 2);
    }
    return std::sqrt(apart / way);
}

TEST(MujocoFluid, ABodyComesCloserToSamarasOwnFlightInProportionToTheStep) {
    for (const char* integrator : {"Euler", "implicit", "RK4"}) {
        const double coarse = distance_from_own_flight(0.002, integrator);
        const double fine = distance_from_own_flight(0.001, integrator);
        EXPECT_LT(coarse, 0.006) << integrator;
        EXPECT_LT(fine, 0.6 * coarse) << integrator;
        RecordProperty(integrator, std::to_string(coarse) + " " + std::to_string(fine));
    }
}

TEST(MujocoFluid, FreeAndHingedHeavyAndLightBodiesFlyTogether) {
    FluidModel three = still("ellipsoid", {"low", "high", "alone"}, "");
    three.settings.erase("turbulence");
    const auto ellipsoid = [](const char* name, double mass, const char* place, const std::string& inside) {
        return "<body name='" + std::string(name) + "' " + place + ">" + inside +
               "<inertial pos='0 0 0' mass='" + std::to_string(mass) +
               "' diaginertia='2e-5 2e-5 1e-5'/>{fluid}";
    };
    const std::string light =
        ellipsoid("high", 0.004, "pos='0 0 0.1'", "<joint name='hinge' axis='1 0 0' pos='0 0 -0.05'/>") +
        "<body/></body>";
    three.worldbody = ellipsoid("low", 0.09, "quat='0.9 0.3 0.3 0'", "<freejoint/>") + light + "</body>" +
                      ellipsoid("alone", 0.004, "pos='1 0 0'", "<freejoint/>") + "<body/></body>";
    const ModelPointer model = load(three);
    const DataPointer data = start(model);
    for (int i = 0; i < 2500; ++i) {
        mj_step(model.get(), data.get());
        ASSERT_TRUE(std::all_of(data->qvel, data->qvel + model->nv, [](mjtNum v) {
            return std::abs(v) < 60.0;
        })) << i;
    }
    EXPECT_LT(data->xpos[3 * mj_name2id(model.get(), mjOBJ_BODY, "low") + 2], -0.5);
    EXPECT_GT(data->xpos[3 * mj_name2id(model.get(), mjOBJ_BODY, "alone") + 2], 0.5);
    EXPECT_EQ(data->warning[mjWARN_BADQACC].number, 0);
}

TEST(MujocoFluid, AGroundBearsTheWeightThatTheWaterLeavesWithEverySolver) {
    for (const char* solver : {"PGS", "CG", "Newton"}) {
        const double radius = std::cbrt(volume_of("sphere") / 4.18879);
        const std::string geometry = "<geom type='sphere' size='" + std::to_string(radius) + "' mass='0'/>";
        FluidModel rest = still(
            "sphere", {"ball"},
            "<geom type='plane' size='1 1 1' pos='0 0 -0.1'/>" + ball("ball", 2.0, "<freejoint/>", geometry));
        rest.option += " solver='" + std::string(solver) + "' iterations='200' tolerance='1e-12'";
        const ModelPointer model = load(rest);
        const DataPointer data = start(model);
        run(model, data, 2500);
        const double exact = water * volume_of("sphere") * gravity;
        EXPECT_NEAR(data->qfrc_constraint[2], exact, 0.01 * exact) << solver;
        EXPECT_NEAR(data->qpos[2], radius - 0.1, 2e-3) << solver;
    }
}

class MujocoState : public testing::Test {
  protected:
    ModelPointer model_ =
        load({.settings = {{"file", body_file("ellipsoid")}},
              .bodies = {"rubber"},
              .worldbody =
                  "<body name='rubber' quat='0.9 0.3 0.3 0'><freejoint/><inertial pos='0 0 0' mass='0.05' "
                  "diaginertia='2e-5 2e-5 1e-5'/><body/>{fluid}</body>"});
};

TEST_F(MujocoState, ResetDataFallsAgainToTheLastBit) {
    const DataPointer data = start(model_);
    run(model_, data, 300);
    const std::vector<mjtNum> first = positions(model_, data);
    mj_resetData(model_.get(), data.get());
    run(model_, data, 300);
    EXPECT_EQ(positions(model_, data), first);
}

TEST_F(MujocoState, EachDataHasAFluidOfItsOwn) {
    const DataPointer alone = start(model_), one = start(model_), other = start(model_);
    run(model_, alone, 300);
    for (int i = 0; i < 300; ++i) {
        mj_step(model_.get(), one.get());
        if (i % 3 == 0) mj_step(model_.get(), other.get());
    }
    EXPECT_EQ(positions(model_, one), positions(model_, alone));
    run(model_, other, 200);
    EXPECT_EQ(positions(model_, other), positions(model_, alone));
}

TEST_F(MujocoState, ACopyGoesOnAsTheOriginalDoes) {
    const DataPointer data = start(model_);
    run(model_, data, 150);
    const DataPointer copy(mj_copyData(nullptr, model_.get(), data.get()), mj_deleteData);
    run(model_, data, 150);
    run(model_, copy, 150);
    EXPECT_EQ(positions(model_, copy), positions(model_, data));
}

TEST_F(MujocoState, ForwardInBetweenChangesNothing) {
    const DataPointer data = start(model_), watched = start(model_);
    run(model_, data, 150);
    for (int i = 0; i < 150; ++i) {
        mj_forward(model_.get(), watched.get());
        mj_step(model_.get(), watched.get());
        mj_forward(model_.get(), watched.get());
    }
    EXPECT_EQ(positions(model_, watched), positions(model_, data));
}

TEST_F(MujocoState, TheBodysTurbulenceGoesOnWithTheSteps) {
    const DataPointer data = start(model_);
    run(model_, data, 600);
    FluidModel calm =
        still("ellipsoid", {"rubber"},
              "<body name='rubber' quat='0.9 0.3 0.3 0'><freejoint/><inertial pos='0 0 0' mass='0.05' "
              "diaginertia='2e-5 2e-5 1e-5'/><body/>{fluid}</body>");
    const ModelPointer without = load(calm);
    const DataPointer undisturbed = start(without);
    run(without, undisturbed, 600);
    EXPECT_GT(std::hypot(data->qpos[0] - undisturbed->qpos[0], data->qpos[1] - undisturbed->qpos[1]), 1e-3);
}

class MujocoRefusal : public testing::Test {
  protected:
    void SetUp() override {
        mju_user_error =
            mju_user_warning = [](const char* text) { std::fprintf(stderr, "%s\n", text), std::_Exit(1); };
    }
    static void step(const FluidModel& refused) {
        const ModelPointer model = load(refused);
        mj_step(model.get(), start(model).get());
    }
};

TEST_F(MujocoRefusal, SaysWhatIsWrongInOneLine) {
    FluidModel model = still("sphere", {"ball"}, ball("ball", 2.0));
    FluidModel wrong = model;
    wrong.settings["file"] = "nowhere.body.h5";
    EXPECT_EXIT(step(wrong), testing::ExitedWithCode(1), "samara: .*nowhere.body.h5");
    wrong = model;
    wrong.settings["fluid"] = "honey";
    EXPECT_EXIT(step(wrong), testing::ExitedWithCode(1), "fluid is .honey., but must be water or air");
    wrong = model;
    wrong.settings["turbulence"] = "much";
    EXPECT_EXIT(step(wrong), testing::ExitedWithCode(1), "turbulence is .much., but must be on or off");
    wrong = model;
    wrong.settings["density"] = "1e3 kg";
    EXPECT_EXIT(step(wrong), testing::ExitedWithCode(1), "density is .1e3 kg., but must be a number");
    wrong = model;
    wrong.settings["wind"] = "velocity = [1, 0";
    EXPECT_EXIT(step(wrong), testing::ExitedWithCode(1), "samara: ");
    wrong = model;
    wrong.worldbody.erase(wrong.worldbody.find("<body/>"), 7);
    EXPECT_EXIT(step(wrong), testing::ExitedWithCode(1),
                "inertia of body .ball. as a diagonal.*write <body/> inside");
}

}  // namespace
}  // namespace samara::test

int main(int count, char** words) {
#if mjVERSION_HEADER >= 230
    mj_loadPluginLibrary(SAMARA_MUJOCO);
#endif
    testing::InitGoogleTest(&count, words);
    return RUN_ALL_TESTS();
}
