// Values that are not numbers are rejected where they come in: scene file and body file.

#include <limits>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samara/core/body/body_file.hpp"
#include "support/known_bodies.hpp"
#include "support/program_run.hpp"
#include "support/stability_row.hpp"

namespace samara {
namespace {

using testing::HasSubstr;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

std::string scene_text(const std::string& scene_keys, const std::string& body_keys) {
    return "[scene]\nduration = 0.1\n" + scene_keys +
           "[[body]]\nname = \"ball\"\nshape = \"ball.body.h5\"\nturbulence = \"none\"\n" + body_keys;
}

Body baked_ball() {
    Body body = test::rubber_ellipsoid();
    body.tables = test::blunt_tables(body, 2);
    return body;
}

/// Whether `samara simulate` ends with status 1 and one line that holds the words.
bool refuses(const test::TemporaryFolder& folder, const std::string& words) {
    const test::ProgramRun run =
        test::run_program_in(folder, {"samara", "simulate", "scene.toml", "-o", "out.h5"});
    EXPECT_EQ(run.status, 1) << words;
    EXPECT_TRUE(test::is_one_line(run.error)) << run.error;
    EXPECT_THAT(run.error, HasSubstr(words));
    return run.status == 1 && test::is_one_line(run.error) && run.error.find(words) != std::string::npos;
}

TEST(UnsoundNumbers, ASceneWithNaNOrInfinityIsRefusedInOneLine) {
    const test::TemporaryFolder folder;
    write_body_file(folder.path() / "ball.body.h5", baked_ball());
    const std::string mass = "density = 1200\n";
    int accepted = 0;
    int count = 0;
    const auto check = [&](const std::string& text, const std::string& key) {
        ++count;
        (void)folder.file("scene.toml", text);
        accepted += refuses(folder, key) ? 0 : 1;
    };
    for (const char* value : {"nan", "inf", "-inf"}) {
        for (const char* key : {"step", "frame_rate"})
            check(scene_text(fmt::format("{} = {}\n", key, value), mass), key);
        check(scene_text(fmt::format("gravity = [0, 0, {}]\n", value), mass), "gravity");
        check(scene_text("", fmt::format("density = {}\n", value)), "density");
        check(scene_text("", fmt::format("mass = {}\n", value)), "mass");
        check(scene_text("", fmt::format("mass = 1.0\ninertia = [1.0, 1.0, {}]\n", value)), "inertia");
        for (const char* key : {"position", "velocity", "angular_velocity"}) {
            check(scene_text("", mass + fmt::format("{} = [{}, 0, 0]\n", key, value)), key);
        }
        check(scene_text("", mass + fmt::format("orientation = [1, {}, 0, 0]\n", value)), "orientation");
        check(scene_text("", mass + fmt::format("loads = \"coefficients\"\ndrag_coefficient = {}\n", value)),
              "drag_coefficient");
    }
    test::expect_row({fmt::format("NaN or infinity in {} scene files", count), "-",
                      "files not refused with one line and status 1", 0.0, static_cast<double>(accepted)});
}

TEST(UnsoundNumbers, ABodyFileWithNaNIsRefusedInOneLine) {
    const test::TemporaryFolder folder;
    (void)folder.file("scene.toml", scene_text("", "density = 1200\n"));
    int accepted = 0;
    int count = 0;
    const auto check = [&](const Body& body) {
        ++count;
        write_body_file(folder.path() / "ball.body.h5", body);
        accepted += refuses(folder, "ball.body.h5") ? 0 : 1;
    };
    Body body = baked_ball();
    body.tables->entries[7].force.y() = not_a_number;
    check(body);
    body = baked_ball();
    body.tables->entries[3].moment.z() = std::numeric_limits<double>::infinity();
    check(body);
    body = baked_ball();
    body.tables->reynolds_numbers[1] = not_a_number;
    check(body);
    body = baked_ball();
    body.kirchhoff->matrix(2, 4) = not_a_number;
    check(body);
    body = baked_ball();
    body.moments.volume = not_a_number;
    check(body);
    body = baked_ball();
    body.moments.centroid.x() = not_a_number;
    check(body);
    body = baked_ball();
    body.surface.vertices[5].x() = not_a_number;
    check(body);
    body = baked_ball();
    body.dynamic = IdentifiedCoefficients{};
    body.dynamic->values.half_length = not_a_number;
    check(body);
    body.dynamic->values.half_length = 0.04;
    body.dynamic->values.rotational_transport = not_a_number;
    check(body);
    body.dynamic->values.rotational_transport = 1.0;
    for (const TensorOfMotion& tensor : tensors_of_motion) {
        (body.dynamic->values.*tensor.member)(0, 0) = not_a_number;
        check(body);
        (body.dynamic->values.*tensor.member)(0, 0) = 0.0;
    }
    test::expect_row({fmt::format("NaN or infinity in {} body files", count), "-",
                      "files not refused with one line and status 1", 0.0, static_cast<double>(accepted)});
}

}  // namespace
}  // namespace samara
