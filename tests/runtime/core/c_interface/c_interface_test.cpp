#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "c_interface_calls.hpp"
#include "paths.hpp"
#include "samara.h"
#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/files/hdf5_writer.hpp"

namespace samara {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

TEST(CBody, TellsWhatItsFileHolds) {
    const Body exact = rubber();
    const BodyOnDisk body;
    EXPECT_STREQ(samara_body_name(body.get()), "rubber");
    EXPECT_STREQ(samara_body_source(body.get()), "invented");
    EXPECT_EQ(samara_body_volume(body.get()), exact.moments.volume);
    EXPECT_EQ(samara_body_mass(body.get()), 0.0) << "it says nothing";
    EXPECT_EQ(samara_body_has_added_mass(body.get()), 1);
    EXPECT_EQ(samara_body_has_tables(body.get()), 1);
    EXPECT_EQ(samara_body_has_surface_loads(body.get()), exact.surface_loads ? 1 : 0);
    std::vector<double> coordinates(3 * samara_body_vertex_count(body.get()));
    std::vector<std::int32_t> corners(3 * samara_body_triangle_count(body.get()));
    ASSERT_EQ(coordinates.size(), 3 * exact.surface.vertices.size());
    ASSERT_EQ(corners.size(), 3 * exact.surface.corners.size());
    Text error;
    ASSERT_EQ(CALL(samara_body_get_vertices, body.get(), coordinates.data(), coordinates.size()), SAMARA_OK);
    ASSERT_EQ(CALL(samara_body_get_triangles, body.get(), corners.data(), corners.size()), SAMARA_OK);
    EXPECT_EQ(coordinates[3 * 5 + 1], exact.surface.vertices[5].y());
    EXPECT_EQ(corners[3 * 7 + 2], exact.surface.corners[7][2]);
    EXPECT_EQ(CALL(samara_body_get_vertices, body.get(), coordinates.data(), coordinates.size() - 1),
              SAMARA_INVALID_ARGUMENT);
    EXPECT_THAT(error.text(), HasSubstr("capacity"));
}

TEST(CBody, RefusesFilesThatAreMissingCutShortForeignOrFromANewerVersion) {
    const BodyOnDisk body;
    const test::TemporaryFolder folder;
    const std::string whole = read_bytes(body.file());
    samara_body* loaded = nullptr;
    Text error;
    const auto rejected = [&](const std::filesystem::path& file) {
        loaded = reinterpret_cast<samara_body*>(&error);
        const samara_status status = CALL(samara_body_load, file.c_str(), &loaded);
        EXPECT_EQ(loaded, nullptr);
        EXPECT_THAT(error.text(), AllOf(HasSubstr(file.filename().string()), Not(HasSubstr("\n"))));
        return status == SAMARA_UNREADABLE_FILE;
    };
    EXPECT_TRUE(rejected(folder.path() / "missing.body.h5"));
    EXPECT_TRUE(rejected(folder.file("short.body.h5", whole.substr(0, whole.size() / 2))));
    EXPECT_TRUE(rejected(folder.file("text.body.h5", "no HDF5")));
    EXPECT_TRUE(rejected(folder.path()));
    write_hdf5(folder.path() / "newer.body.h5", [](Hdf5Writer& file) {
        file.attribute("/", "format_version", std::int64_t{1000});
        file.attribute("/surface", "source", std::string_view("x"));
        file.attribute("/moments", "volume", 1.0);
    });
    EXPECT_TRUE(rejected(folder.path() / "newer.body.h5"));
    EXPECT_THAT(error.text(), HasSubstr("newer"));
}

TEST(CInterface, TheExampleOfTheDocumentationRuns) {
    const BodyOnDisk body;
    const test::TemporaryFolder folder;
    const std::string program = std::string(SAMARA_EXAMPLES) + "/example-fall";
    const std::filesystem::path output = folder / "output";
    const auto run = [&](const std::string& file) {
        return run_subprocess({"/bin/sh", "-c", program + " '" + file + "' > " + output.string() + " 2>&1"});
    };
    ASSERT_EQ(run(body.file().string()), 0) << read_bytes(output);
    EXPECT_THAT(read_bytes(output), AllOf(HasSubstr("rubber: 33.51 cm^3"), HasSubstr("1.0000 s  body 2"),
                                          HasSubstr("1500 steps")));
    EXPECT_EQ(run("missing.body.h5"), 1);
    EXPECT_THAT(read_bytes(output), AllOf(testing::StartsWith("fall: "), HasSubstr("missing.body.h5")));
}

TEST(CInterface, NullPointersAreRefused) {
    const BodyOnDisk body;
    const SimulationPointer simulation = simulation_of(body, rubber_group());
    const samara_settings settings = default_settings();
    const samara_body_group group = rubber_group();
    samara_body* loaded = nullptr;
    samara_simulation* created = nullptr;
    samara_pose pose{};
    char byte = 0;
    double number = 0.0;
    std::int32_t corner = 0;
    samara_report report{};
    report.size = sizeof report;
    Text error;
    const samara_status rejected = SAMARA_INVALID_ARGUMENT;
    EXPECT_EQ(CALL(samara_body_load, nullptr, &loaded), rejected);
    EXPECT_EQ(CALL(samara_body_load, body.file().c_str(), nullptr), rejected);
    EXPECT_EQ(CALL(samara_body_get_vertices, nullptr, &number, 1), rejected);
    EXPECT_EQ(CALL(samara_body_get_vertices, body.get(), nullptr, 1), rejected);
    EXPECT_EQ(CALL(samara_body_get_triangles, nullptr, &corner, 1), rejected);
    EXPECT_EQ(CALL(samara_body_get_triangles, body.get(), nullptr, 1), rejected);
    EXPECT_EQ(CALL(samara_default_settings, nullptr, sizeof settings), rejected);
    EXPECT_EQ(CALL(samara_default_body_group, nullptr, sizeof group), rejected);
    EXPECT_EQ(CALL(samara_simulation_create, nullptr, &created), rejected);
    EXPECT_EQ(CALL(samara_simulation_create, &settings, nullptr), rejected);
    EXPECT_EQ(CALL(samara_simulation_add, nullptr, body.get(), &group, nullptr), rejected);
    EXPECT_EQ(CALL(samara_simulation_add, simulation.get(), nullptr, &group, nullptr), rejected);
    EXPECT_EQ(CALL(samara_simulation_add, simulation.get(), body.get(), nullptr, nullptr), rejected);
    EXPECT_EQ(CALL(samara_advance_to, nullptr, 1.0), rejected);
    EXPECT_EQ(CALL(samara_get_poses, nullptr, 0, 1, &pose, 0), rejected);
    EXPECT_EQ(CALL(samara_get_poses, simulation.get(), 0, 1, nullptr, 0), rejected);
    EXPECT_EQ(CALL(samara_set_poses, nullptr, 0, 1, &pose, 0), rejected);
    EXPECT_EQ(CALL(samara_set_poses, simulation.get(), 0, 1, nullptr, 0), rejected);
    EXPECT_EQ(CALL(samara_set_seed, nullptr, 1, 1), rejected);
    EXPECT_EQ(CALL(samara_get_state, nullptr, &byte, 1), rejected);
    EXPECT_EQ(CALL(samara_get_state, simulation.get(), nullptr, 1), rejected);
    EXPECT_EQ(CALL(samara_set_state, nullptr, &byte, 1), rejected);
    EXPECT_EQ(CALL(samara_set_state, simulation.get(), nullptr, 1), rejected);
    EXPECT_EQ(CALL(samara_get_report, nullptr, &report), rejected);
    EXPECT_EQ(CALL(samara_get_report, simulation.get(), nullptr), rejected);
    EXPECT_THAT(error.text(), HasSubstr("null"));
    samara_body_free(nullptr);
    samara_simulation_free(nullptr);
    EXPECT_STREQ(samara_body_name(nullptr), "");
    EXPECT_STREQ(samara_body_source(nullptr), "");
    EXPECT_EQ(samara_body_volume(nullptr), 0.0);
    EXPECT_EQ(samara_body_has_added_mass(nullptr) + samara_body_has_tables(nullptr) +
                  samara_body_has_surface_loads(nullptr),
              0);
    EXPECT_EQ(samara_body_vertex_count(nullptr) + samara_body_triangle_count(nullptr), 0U);
    EXPECT_EQ(samara_simulation_count(nullptr) + samara_state_size(nullptr), 0U);
    EXPECT_EQ(samara_simulation_time(nullptr), 0.0);
}

TEST(CInterface, ErrorTextsFitAnyBuffer) {
    std::array<char, 16> buffer{};
    buffer.fill('x');
    const samara_status status = SAMARA_INVALID_ARGUMENT;
    EXPECT_EQ(samara_advance_to(nullptr, 0.0, nullptr, 100), status);
    EXPECT_EQ(samara_advance_to(nullptr, 0.0, buffer.data(), 0), status);
    EXPECT_EQ(buffer[0], 'x');
    EXPECT_EQ(samara_advance_to(nullptr, 0.0, buffer.data(), 1), status);
    EXPECT_EQ(std::string(buffer.data()), "");
    EXPECT_EQ(buffer[1], 'x');
    EXPECT_EQ(samara_advance_to(nullptr, 0.0, buffer.data(), 5), status);
    EXPECT_STREQ(buffer.data(), "simu");
    EXPECT_EQ(buffer[5], 'x');
    // A letter of two bytes is not cut in half.
    samara_body* body = nullptr;
    EXPECT_EQ(samara_body_load("\xc3\xa4\xc3\xb6.body.h5", &body, buffer.data(), 4), SAMARA_UNREADABLE_FILE);
    EXPECT_STREQ(buffer.data(), "\xc3\xa4");
    // What went well leaves no text behind.
    samara_settings settings;
    EXPECT_EQ(samara_default_settings(&settings, sizeof settings, buffer.data(), buffer.size()), SAMARA_OK);
    EXPECT_STREQ(buffer.data(), "");
}

TEST(CInterface, StructsOfOtherVersionsAreKnownByTheirSize) {
    samara_settings settings;
    Text error;
    EXPECT_EQ(CALL(samara_default_settings, &settings, sizeof settings + 8), SAMARA_INVALID_ARGUMENT);
    settings = default_settings();
    samara_simulation* simulation = nullptr;
    for (const std::size_t size : {std::size_t{0}, std::size_t{8}, sizeof settings + 8}) {
        settings.size = size;
        EXPECT_EQ(CALL(samara_simulation_create, &settings, &simulation), SAMARA_INVALID_ARGUMENT);
        EXPECT_THAT(error.text(), HasSubstr("samara_default_settings"));
        EXPECT_EQ(simulation, nullptr);
    }
    const BodyOnDisk body;
    samara_body_group group = rubber_group();
    group.size = 0;
    EXPECT_EQ(CALL(samara_simulation_add, empty_simulation().get(), body.get(), &group, nullptr),
              SAMARA_INVALID_ARGUMENT);
    EXPECT_GE(samara_api_version(), SAMARA_API_VERSION);
    EXPECT_STRNE(samara_version(), "");
}

TEST(CInterface, SettingsOutOfRangeAreRefusedByName) {
    using Change = void (*)(samara_settings&);
    const std::vector<std::pair<const char*, Change>> changes = {
        {"fluid_density", [](samara_settings& s) { s.fluid_density = not_a_number; }},
        {"fluid_density", [](samara_settings& s) { s.fluid_density = 0.0; }},
        {"fluid_viscosity", [](samara_settings& s) { s.fluid_viscosity = -1.0; }},
        {"current", [](samara_settings& s) { s.current[1] = not_a_number; }},
        {"gust_amplitude", [](samara_settings& s) { s.gust_amplitude[2] = INFINITY; }},
        {"gust_period", [](samara_settings& s) { s.gust_period = 0.0; }},
        {"gravity", [](samara_settings& s) { s.gravity[0] = not_a_number; }},
        {"step", [](samara_settings& s) { s.step = 0.0; }},
        {"step", [](samara_settings& s) { s.step = not_a_number; }},
        {"threads", [](samara_settings& s) { s.threads = -1; }},
    };
    for (const auto& [member, change] : changes) {
        samara_settings settings = default_settings();
        change(settings);
        samara_simulation* simulation = nullptr;
        Text error;
        EXPECT_EQ(CALL(samara_simulation_create, &settings, &simulation), SAMARA_INVALID_ARGUMENT) << member;
        EXPECT_THAT(error.text(), testing::StartsWith(member));
    }
}

TEST(CInterface, KindsOutOfRangeAreRefusedByName) {
    using Change = void (*)(samara_body_group&);
    const std::vector<std::pair<const char*, Change>> changes = {
        {"name", [](samara_body_group& k) { k.name = "a b"; }},
        {"count", [](samara_body_group& k) { k.count = 0; }},
        {"count", [](samara_body_group& k) { k.count = 4'000'000'000; }},
        {"count is 1, but", [](samara_body_group& k) { k.spread_position[1] = 0.1; }},
        {"count is 1, but", [](samara_body_group& k) { k.spread_angle = 0.1; }},
        {"count is 1, but", [](samara_body_group& k) { k.spread_start = 0.1; }},
        {"density", [](samara_body_group& k) { k.density = not_a_number; }},
        {"density", [](samara_body_group& k) { k.density = 0.0; }},
        {"density", [](samara_body_group& k) { k.mass = 1.0; }},
        {"center_of_mass", [](samara_body_group& k) { k.has_center_of_mass = 1; }},
        {"inertia", [](samara_body_group& k) { k.inertia[4] = not_a_number; }},
        {"inertia", [](samara_body_group& k) { k.inertia[1] = 1.0; }},
        {"position", [](samara_body_group& k) { k.position[0] = not_a_number; }},
        {"orientation", [](samara_body_group& k) { k.orientation[0] = k.orientation[2] = 0.0; }},
        {"orientation", [](samara_body_group& k) { k.orientation[3] = not_a_number; }},
        {"velocity", [](samara_body_group& k) { k.velocity[0] = not_a_number; }},
        {"angular_velocity", [](samara_body_group& k) { k.angular_velocity[0] = not_a_number; }},
        {"start", [](samara_body_group& k) { k.start = -1.0; }},
        {"spread_position", [](samara_body_group& k) { k.spread_position[0] = not_a_number; }},
        {"spread_angle", [](samara_body_group& k) { k.spread_angle = 4.0; }},
        {"spread_start", [](samara_body_group& k) { k.spread_start = -1.0; }},
        {"smallest_size and largest_size", [](samara_body_group& k) { k.largest_size = 2000.0; }},
        {"loads", [](samara_body_group& k) { k.loads = 5; }},
        {"drag_coefficient", [](samara_body_group& k) { k.drag_coefficient = -1.0; }},
        {"lift_coefficient", [](samara_body_group& k) { k.lift_coefficient = not_a_number; }},
        {"reference_area", [](samara_body_group& k) { k.reference_area = -1.0; }},
        {"normal", [](samara_body_group& k) { k.normal[0] = not_a_number; }},
        {"center_of_pressure", [](samara_body_group& k) { k.center_of_pressure[0] = not_a_number; }},
        {"turbulence", [](samara_body_group& k) { k.turbulence = -1; }},
        {"dissipation_rate",
         [](samara_body_group& k) {
             k.turbulence = SAMARA_TURBULENCE_CONSTANT;
             k.turbulent_kinetic_energy = 1.0;
         }},
        {"langevin", [](samara_body_group& k) { k.langevin = 3; }},
        {"table_reynolds_number", [](samara_body_group& k) { k.table_reynolds_number = -1.0; }},
        {"table_reynolds_number", [](samara_body_group& k) { k.table_reynolds_number = not_a_number; }},
        {"dynamic_coefficients", [](samara_body_group& k) { k.dynamic_coefficients = 3; }},
        {"patches", [](samara_body_group& k) { k.patches = -1; }},
        {"patches", [](samara_body_group& k) { k.patches = 33; }},
    };
    const BodyOnDisk body;
    const SimulationPointer simulation = empty_simulation();
    for (const auto& [member, change] : changes) {
        samara_body_group group = rubber_group();
        change(group);
        Text error;
        EXPECT_EQ(CALL(samara_simulation_add, simulation.get(), body.get(), &group, nullptr),
                  SAMARA_INVALID_ARGUMENT)
            << member;
        EXPECT_THAT(error.text(), testing::StartsWith(member));
    }
    EXPECT_EQ(samara_simulation_count(simulation.get()), 0U);
}

TEST(CInterface, ABodyThatLacksWhatIsAskedOfItIsRefused) {
    Body bare = rubber();
    bare.tables.reset();
    const BodyOnDisk without_tables(bare);
    bare.kirchhoff.reset();
    const BodyOnDisk without_added_mass(bare);
    const SimulationPointer simulation = empty_simulation();
    samara_body_group group = rubber_group();
    Text error;
    EXPECT_EQ(CALL(samara_simulation_add, simulation.get(), without_tables.get(), &group, nullptr),
              SAMARA_MISSING_DATA);
    EXPECT_THAT(error.text(), HasSubstr("samara bake"));
    group.loads = SAMARA_LOADS_SURFACE;
    EXPECT_EQ(CALL(samara_simulation_add, simulation.get(), without_tables.get(), &group, nullptr),
              SAMARA_MISSING_DATA);
    EXPECT_THAT(error.text(), HasSubstr("holds no surface loads"));
    group.loads = SAMARA_LOADS_NONE;
    EXPECT_EQ(CALL(samara_simulation_add, simulation.get(), without_added_mass.get(), &group, nullptr),
              SAMARA_MISSING_DATA);
    EXPECT_THAT(error.text(), HasSubstr("samara kirchhoff"));
    EXPECT_EQ(CALL(samara_simulation_add, simulation.get(), without_tables.get(), &group, nullptr),
              SAMARA_OK);
    group = rubber_group();
    group.density = 0.0;
    group.mass = 0.04;
    for (const int i : {0, 4, 8}) group.inertia[i] = i == 8 ? 1.0 : 0.1;
    group.name = "impossible";
    group.loads = SAMARA_LOADS_NONE;
    EXPECT_EQ(CALL(samara_simulation_add, simulation.get(), without_tables.get(), &group, nullptr),
              SAMARA_INVALID_ARGUMENT);
    EXPECT_THAT(error.text(), HasSubstr("moments of inertia"));
}

}  // namespace
}  // namespace samara
