// The case of a fall: its parameters and its folder.

#include <fstream>
#include <regex>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "foam-cases/falls/fall_plan.hpp"
#include "foam-cases/farm/case_folder.hpp"
#include "paths.hpp"
#include "samara/core/files/content_hash.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "test_bodies.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const fs::path foam_cases = fs::path(SAMARA_SOURCE_DIRECTORY) / "foam-cases";

FreeFall some_fall() {
    FreeFall fall;
    fall.reynolds_number = 12345.0;
    fall.volume = 0.31;
    fall.mass = 0.4;
    fall.center_of_mass = {0.01, 0.02, -0.03};
    fall.principal_axes = Eigen::AngleAxisd(0.3, Vector3d::UnitZ()).toRotationMatrix();
    fall.principal_moments = {0.02, 0.03, 0.04};
    fall.gravity = {0.0, -3.0, -4.0};
    fall.velocity = {0.1, 0.2, 0.3};
    fall.angular_velocity = {1.0, 2.0, 3.0};
    fall.duration = 27.5;
    fall.time_step = 0.01;
    fall.outer_correctors = 3;
    fall.acceleration_relaxation = 0.35;
    return fall;
}

std::string entry_of(const std::string& parameters, const std::string& name) {
    std::smatch match;
    const std::regex line("(?:^|\\n)" + name + " +([^;]*);");
    return std::regex_search(parameters, match, line) ? match[1].str() : "";
}

std::vector<double> numbers_of(const std::string& parameters, const std::string& name) {
    std::string text = entry_of(parameters, name);
    std::erase_if(text, [](char letter) { return letter == '(' || letter == ')'; });
    std::istringstream stream(text);
    std::vector<double> numbers;
    for (double number = 0.0; stream >> number;) numbers.push_back(number);
    return numbers;
}

Vector3d vector_of(const std::string& parameters, const std::string& name) {
    const std::vector<double> numbers = numbers_of(parameters, name);
    EXPECT_EQ(numbers.size(), 3u) << name;
    return {numbers.at(0), numbers.at(1), numbers.at(2)};
}

class FallCase : public testing::Test {
  protected:
    const Body body_ = test::ellipsoid({0.01, 0.02, 0.04});
    const BakePlan plan_ = plan_falls(body_, 6000.0, {some_fall()}, fall_model_of(Closure::k_epsilon));
    const test::TemporaryFolder temporary_;
    const fs::path folder_ = temporary_.path() / "body.cases";

    [[nodiscard]] std::string parameters() const {
        return fall_parameters(read_bytes(foam_cases / "templates/free-fall/parameters"), plan_,
                               plan_.falls.front());
    }
    std::string hash_after(const BakePlan& plan) {
        write_case_folder(folder_, body_, plan, foam_cases);
        return nlohmann::json::parse(read_bytes(folder_ / "plan.json"))["falls"][0]["inputs_hash"];
    }
    void pretend_solved(const std::string& hash) {
        std::ofstream(folder_ / "fall_00/provenance.json") << nlohmann::json({{"inputs_hash", hash}}).dump();
        std::ofstream(folder_ / "fall_00/attempts.json") << "{}";
        fs::create_directories(folder_ / "fall_00/postProcessing/state/0");
    }
    [[nodiscard]] bool is_solved() const { return fs::exists(folder_ / "fall_00/provenance.json"); }
};

TEST_F(FallCase, HasTheNumbersOfTheFall) {
    const std::string text = parameters();
    const FreeFall fall = some_fall();
    EXPECT_EQ(numbers_of(text, "reynoldsNumber").at(0), 12345.0);
    EXPECT_NEAR(numbers_of(text, "viscosity").at(0), 1.0 / 12345.0, 1e-18);
    EXPECT_EQ(numbers_of(text, "mass").at(0), 0.4);
    EXPECT_EQ(vector_of(text, "centreOfMass"), fall.center_of_mass);
    EXPECT_EQ(vector_of(text, "momentsOfInertia"), fall.principal_moments);
    EXPECT_EQ(vector_of(text, "gravity"), fall.gravity);
    EXPECT_EQ(vector_of(text, "startVelocity"), fall.velocity);
    EXPECT_EQ(numbers_of(text, "timeStep").at(0), 0.01);
    EXPECT_EQ(numbers_of(text, "duration").at(0), 27.5);
    EXPECT_EQ(numbers_of(text, "outerCorrectors").at(0), 3.0);
    EXPECT_EQ(numbers_of(text, "accelerationRelaxation").at(0), 0.35);
    EXPECT_EQ(entry_of(text, "simulationType"), "RAS");
    EXPECT_EQ(entry_of(text, "closure"), "kEpsilon");
    const std::vector<double> axes = numbers_of(text, "principalAxes");
    ASSERT_EQ(axes.size(), 9u);
    // Row by row; columns are the axes.
    EXPECT_EQ(axes[1], fall.principal_axes(0, 1));
    EXPECT_EQ(axes[3], fall.principal_axes(1, 0));
}

TEST_F(FallCase, IsOfSecondOrderInTimeAndSpaceWhereTheMeshResolvesTheBoundaryLayer) {
    const std::string text = read_bytes(foam_cases / "templates/free-fall/parameters");
    EXPECT_EQ(entry_of(parameters(), "rateOfChange"), "Euler");
    EXPECT_EQ(entry_of(parameters(), "convection"), "limitedLinear 1");
    for (const Closure closure : {Closure::k_omega_sst_lm, Closure::laminar}) {
        FreeFall fall = some_fall();
        fall.closure = closure;
        const BakePlan plan = plan_falls(body_, 6000.0, {fall}, fall_model_of(closure));
        const std::string resolved = fall_parameters(text, plan, plan.falls.front());
        EXPECT_EQ(entry_of(resolved, "rateOfChange"), "backward");
        EXPECT_EQ(entry_of(resolved, "convection"), "linearUpwind grad(U)");
        EXPECT_EQ(entry_of(resolved, "nutAtWall"), "nutLowReWallFunction");
        EXPECT_EQ(entry_of(resolved, "simulationType"), closure == Closure::laminar ? "laminar" : "RAS");
    }
}

TEST_F(FallCase, ResolvesEddiesByDdes) {
    const std::string text = read_bytes(foam_cases / "templates/free-fall/parameters");
    FreeFall fall = some_fall();
    fall.closure = Closure::k_omega_sst_ddes;
    const BakePlan plan = plan_falls(body_, 6000.0, {fall}, fall_model_of(fall.closure));
    const std::string resolved = fall_parameters(text, plan, plan.falls.front());
    EXPECT_EQ(entry_of(resolved, "simulationType"), "LES");
    EXPECT_EQ(entry_of(resolved, "closure"), "kOmegaSSTDDES");
    EXPECT_EQ(entry_of(resolved, "convection"), "LUST grad(U)");
    EXPECT_EQ(entry_of(resolved, "nutAtWall"), "nutLowReWallFunction");
}

// sixDoFRigidBodyMotion keeps the angular momentum along its principal axes.
TEST_F(FallCase, StartsWithTheAngularMomentumAlongThePrincipalAxes) {
    const FreeFall fall = some_fall();
    const Vector3d in_case = fall.inertia() * fall.angular_velocity;
    const Vector3d along = vector_of(parameters(), "startAngularMomentum");
    EXPECT_LT((fall.principal_axes * along - in_case).norm(), 1e-15);
}

// The spring pulls with stiffness times its length, from the anchor.
TEST_F(FallCase, PullsTheCentroidUpWithTheWeightOfTheFluidWhereverItFalls) {
    const FreeFall fall = some_fall();
    const Vector3d anchor = vector_of(parameters(), "buoyancyAnchor");
    const double stiffness = numbers_of(parameters(), "buoyancyStiffness").at(0);
    for (const Vector3d& place : {Vector3d(0, 0, 0), Vector3d(30, -50, -100)}) {
        const Vector3d pull = stiffness * (anchor - place);
        EXPECT_LT((pull + fall.volume * fall.gravity).norm(), 2e-5 * pull.norm());
    }
}

TEST_F(FallCase, HasNoBuoyancyWithoutGravity) {
    FreeFall fall = plan_.falls.front();
    fall.gravity.setZero();
    const std::string text =
        fall_parameters(read_bytes(foam_cases / "templates/free-fall/parameters"), plan_, fall);
    EXPECT_EQ(numbers_of(text, "buoyancyStiffness").at(0), 0.0);
}

TEST_F(FallCase, NamesAnEntryThatTheTemplateLacks) {
    const std::string text = read_bytes(foam_cases / "templates/free-fall/parameters");
    for (const char* name :
         {"reynoldsNumber", "viscosity", "inflowK", "mass", "centreOfMass", "momentsOfInertia",
          "principalAxes", "startVelocity", "startAngularMomentum", "gravity", "buoyancyAnchor",
          "buoyancyStiffness", "simulationType", "closure", "rateOfChange", "timeStep", "duration",
          "outerCorrectors", "accelerationRelaxation"}) {
        const std::regex line(fmt::format("\\n{} ", name));
        const std::string lacking = std::regex_replace(text, line, "\nx ");
        EXPECT_THAT(
            test::error_of([&] { static_cast<void>(fall_parameters(lacking, plan_, plan_.falls.front())); }),
            HasSubstr(fmt::format("'{}'", name)));
    }
}

TEST_F(FallCase, HoldsAllThatItNeedsToBeRunByHand) {
    hash_after(plan_);
    const fs::path fall = folder_ / "fall_00";
    for (const char* name :
         {"Allrun", "Allclean", "fall.py", "case_files.py", "fall.json", "parameters", "0.orig/U", "0.orig/k",
          "0.orig/pointDisplacement", "constant/dynamicMeshDict", "constant/transportProperties",
          "constant/turbulenceProperties", "system/controlDict"}) {
        EXPECT_TRUE(fs::exists(fall / name)) << name;
    }
    EXPECT_EQ(fs::read_symlink(fall / "constant/polyMesh"),
              "../../" + plan_.falls.front().mesh + "/constant/polyMesh");
    EXPECT_EQ(free_fall_json(read_free_fall(fall)), free_fall_json(plan_.falls.front()));
    EXPECT_NE((fs::status(fall / "fall.py").permissions() & fs::perms::owner_exec), fs::perms::none);
}

TEST_F(FallCase, IsKeptOnEqualInputs) {
    const std::string hash = hash_after(plan_);
    pretend_solved(hash);
    EXPECT_EQ(hash_after(plan_), hash);
    EXPECT_TRUE(is_solved());
    EXPECT_TRUE(fs::exists(folder_ / "fall_00/attempts.json"));
}

TEST_F(FallCase, IsSolvedAgainWithAnotherStepOrMesh) {
    const std::string hash = hash_after(plan_);
    pretend_solved(hash);
    BakePlan other = plan_;
    other.falls.front().time_step = 0.005;
    const std::string finer = hash_after(other);
    EXPECT_NE(finer, hash);
    EXPECT_FALSE(is_solved());
    // The files of an earlier run would count as progress.
    EXPECT_FALSE(fs::exists(folder_ / "fall_00/attempts.json"));
    EXPECT_FALSE(fs::exists(folder_ / "fall_00/postProcessing"));

    pretend_solved(finer);
    BakePlan on_other_mesh = other;
    on_other_mesh.quality.meshes.front().layers += 1;
    EXPECT_NE(hash_after(on_other_mesh), finer);
    EXPECT_FALSE(is_solved());
}

TEST_F(FallCase, IsNotMixedWithTheCasesOfABake) {
    require_cases_of(CaseType::fall, folder_);
    write_case_folder(folder_, body_, plan_, foam_cases);
    require_cases_of(CaseType::fall, folder_);
    EXPECT_THAT(test::error_of([&] { require_cases_of(CaseType::bake, folder_); }),
                HasSubstr("samara validate"));
    write_case_folder(folder_, body_, plan_bake(body_, bake_quality("smoke"), 1e4), foam_cases);
    EXPECT_FALSE(fs::exists(folder_ / "fall_00"));
    require_cases_of(CaseType::bake, folder_);
    EXPECT_THAT(test::error_of([&] { require_cases_of(CaseType::fall, folder_); }), HasSubstr("samara bake"));
}

}  // namespace
}  // namespace samara
