#include "converter/falls/free_fall.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "samara/core/files/content_hash.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using testing::HasSubstr;

FreeFall some_fall() {
    FreeFall fall;
    fall.name = "fall_07";
    fall.mesh = "mesh_fine";
    fall.closure = Closure::laminar;
    fall.reynolds_number = 123.4;
    fall.length = 0.05;
    fall.speed = 0.3;
    fall.fluid_density = 998.2;
    fall.axes << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    fall.volume = 0.31;
    fall.mass = 0.1 / 3.0;
    fall.center_of_mass = {0.01, -0.02, 0.03};
    fall.principal_axes = Eigen::AngleAxisd(0.3, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    fall.principal_moments = {0.02, 0.03, 0.04};
    fall.gravity = {1, -2, -7.5};
    fall.velocity = {0.1, 0.2, 0.3};
    fall.angular_velocity = {-0.4, 0.5, 0.6};
    fall.duration = 27.5;
    fall.time_step = 0.02;
    fall.outer_correctors = 3;
    fall.acceleration_relaxation = 0.35;
    return fall;
}

TEST(FreeFall, IsTheSameAfterAWriteAndARead) {
    const test::TemporaryFolder folder;
    const FreeFall fall = some_fall();
    const std::string text = free_fall_json(fall);
    static_cast<void>(folder.file("fall.json", text));
    const FreeFall read = read_free_fall(folder.path());
    EXPECT_EQ(free_fall_json(read), text);
    EXPECT_EQ(read.name, fall.name);
    EXPECT_EQ(read.mesh, fall.mesh);
    EXPECT_EQ(read.closure, fall.closure);
    EXPECT_EQ(read.mass, fall.mass);
    EXPECT_EQ(read.axes, fall.axes);
    EXPECT_EQ(read.principal_axes, fall.principal_axes);
    EXPECT_EQ(read.angular_velocity, fall.angular_velocity);
    EXPECT_EQ(read.outer_correctors, fall.outer_correctors);
    EXPECT_DOUBLE_EQ(read.time_unit(), 0.05 / 0.3);
}

TEST(FreeFall, HasItsInertiaInCaseAxes) {
    FreeFall fall = some_fall();
    fall.principal_axes = Eigen::AngleAxisd(0.5, Vector3d::UnitZ()).toRotationMatrix();
    const double c = std::cos(0.5);
    const double s = std::sin(0.5);
    EXPECT_NEAR(fall.inertia()(0, 0), 0.02 * c * c + 0.03 * s * s, 1e-15);
    EXPECT_NEAR(fall.inertia()(0, 1), (0.02 - 0.03) * c * s, 1e-15);
    EXPECT_NEAR(fall.inertia()(2, 2), 0.04, 1e-15);
}

TEST(FreeFall, ErrorsNameTheFileAndTheEntry) {
    const test::TemporaryFolder folder;
    const auto error = [&] { return test::error_of([&] { read_free_fall(folder.path()); }); };
    const auto error_of = [&](const std::string& text) {
        static_cast<void>(folder.file("fall.json", text));
        return error();
    };
    EXPECT_THAT(error(), HasSubstr("fall.json: is missing"));
    EXPECT_THAT(error_of("{"), HasSubstr("fall.json: "));
    const nlohmann::json whole = nlohmann::json::parse(free_fall_json(some_fall()));
    for (const auto& [name, value] : whole.items()) {
        nlohmann::json lacking = whole;
        lacking.erase(name);
        EXPECT_THAT(error_of(lacking.dump()), HasSubstr("'" + name + "'"));
    }
    for (const char* name :
         {"length", "speed", "fluid_density", "volume", "mass", "time_step", "duration", "reynolds_number"}) {
        nlohmann::json wrong = whole;
        wrong[name] = 0.0;
        EXPECT_THAT(error_of(wrong.dump()), HasSubstr(std::string("'") + name + "' is not positive"));
    }
    nlohmann::json word = whole;
    word["gravity"] = "down";
    EXPECT_THAT(error_of(word.dump()), HasSubstr("make the case again"));
}

}  // namespace
}  // namespace samara
