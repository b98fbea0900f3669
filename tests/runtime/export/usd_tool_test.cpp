// .usda files in two readers that know nothing of samara: three.js and TinyUSDZ (tests/tools/read_usd.mjs).

#include <algorithm>
#include <fstream>
#include <map>
#include <regex>
#include <utility>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "paths.hpp"
#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/export/shape_pose.hpp"
#include "samara/export/usd_file.hpp"
#include "samara/motion/resample.hpp"
#include "support/temporary_folder.hpp"
#include "synthetic_motion.hpp"

namespace samara {
namespace {

using nlohmann::json;
using test::TemporaryFolder;

/// An ellipsoid and a cube whose copies start at other times.
Motion ellipsoid_and_cubes(int copies) {
    Motion motion = test::motion_of(test::wander, 1.0);
    motion.bodies[0].center_of_mass = Vector3d(0.01, 0.02, -0.03);
    BodyMotion cube = motion.bodies[0];
    cube.name = "die, red";
    cube.surface = test::box({2.0, 2.0, 2.0}, 1);
    test::let_wander(cube, copies, motion.times);
    motion.bodies.push_back(cube);
    return motion;
}

json read_by_others(const std::filesystem::path& file, const TemporaryFolder& folder,
                    int expected_status = 0) {
    const int status =
        run_subprocess({"node", SAMARA_SOURCE_DIRECTORY "/tests/tools/read_usd.mjs", SAMARA_NODE_TOOLS, file},
                       folder / "found.json");
    EXPECT_EQ(status, expected_status) << read_bytes(folder / "found.json").substr(0, 2000);
    return json::parse(read_bytes(folder / "found.json"), nullptr, false);
}

/// The values at each time code, the first component running fastest.
using Samples = std::map<double, std::vector<double>>;

Samples samples_of(const json& time_samples) {
    Samples samples;
    for (std::size_t i = 0; i < time_samples["times"].size(); ++i) {
        std::vector<double>& values = samples[time_samples["times"][i].get<double>()];
        for (const json& value : time_samples["values"][i]) values.push_back(value.get<double>());
    }
    return samples;
}

/// The samples that TinyUSDZ printed after `name` below the prim of this name.
Samples samples_in(const std::string& text, const std::string& prim, const std::string& name) {
    const std::size_t place = text.find(name + ".timeSamples", text.find('"' + prim + '"'));
    EXPECT_NE(place, std::string::npos) << prim << " " << name;
    const std::string block = text.substr(place, text.find('}', place) - place);
    const std::regex line_form(R"(\n\s*([-0-9.e+]+):([^\n]*))");
    const std::regex number_form(R"([-+]?[0-9]*\.?[0-9]+(e[-+]?[0-9]+)?)");
    Samples samples;
    for (std::sregex_iterator line(block.begin(), block.end(), line_form), end; line != end; ++line) {
        const std::string values = (*line)[2];
        for (std::sregex_iterator number(values.begin(), values.end(), number_form); number != end;
             ++number) {
            samples[std::stod((*line)[1])].push_back(std::stod(number->str()));
        }
    }
    return samples;
}

Quaterniond quaternion_of(const std::vector<double>& values, std::size_t at, bool scalar_first) {
    return scalar_first ? Quaterniond(values[at], values[at + 1], values[at + 2], values[at + 3])
                        : Quaterniond(values[at + 3], values[at], values[at + 1], values[at + 2]);
}

/// That the samples, one for every frame, are the poses of the copies beside one another.
void expect_poses(const Samples& positions, const Samples& orientations, bool scalar_first,
                  const Motion& motion, const BodyMotion& body, int first_copy, int copies,
                  double position_error, double angle_error) {
    ASSERT_EQ(positions.size(), motion.times.size());
    ASSERT_EQ(orientations.size(), motion.times.size());
    for (int copy = 0; copy < copies; ++copy) {
        const auto poses = shape_poses(motion, body, 0, first_copy + copy);
        for (std::size_t frame = 0; frame < poses.size(); ++frame) {
            const auto place = static_cast<std::size_t>(copy);
            const std::vector<double>& p = positions.at(static_cast<double>(frame));
            const std::vector<double>& q = orientations.at(static_cast<double>(frame));
            ASSERT_EQ(p.size() % 3, 0U);
            ASSERT_GE(p.size(), 3 * (place + 1));
            ASSERT_GE(q.size(), 4 * (place + 1));
            const Vector3d position(p[3 * place], p[3 * place + 1], p[3 * place + 2]);
            EXPECT_LE((position - poses[frame].position).norm(), position_error);
            const Quaterniond turn = quaternion_of(q, 4 * place, scalar_first).normalized();
            EXPECT_LE(turn.angularDistance(poses[frame].orientation), angle_error);
        }
    }
}

TEST(UsdExport, TwoReadersFindThePosesOfEveryCopy) {
    const TemporaryFolder folder;
    const Motion motion = ellipsoid_and_cubes(3);
    write_usda(folder / "motion.usda", motion, 0, 0.0);
    const json found = read_by_others(folder / "motion.usda", folder);
    ASSERT_TRUE(found.is_object());
    const auto& samples = found["three"]["samples"];
    const auto text = found["tinyusdz"]["text"].get<std::string>();
    const auto expect_copy = [&](const std::string& prim, const BodyMotion& body, int copy) {
        expect_poses(samples_of(samples["/motion/" + prim + ".xformOp:translate"]),
                     samples_of(samples["/motion/" + prim + ".xformOp:orient"]), false, motion, body, copy, 1,
                     0.0, 2e-7);
        expect_poses(samples_in(text, prim, "xformOp:translate"), samples_in(text, prim, "xformOp:orient"),
                     true, motion, body, copy, 1, 1e-15, 2e-7);
    };
    expect_copy("ellipsoid", motion.bodies[0], 0);
    expect_copy("die__red", motion.bodies[1], 0);
    expect_copy("die__red_001", motion.bodies[1], 1);
    expect_copy("die__red_002", motion.bodies[1], 2);
}

TEST(UsdExport, APlayerShowsThemAtTheirTimes) {
    const TemporaryFolder folder;
    const Motion motion = ellipsoid_and_cubes(1);
    write_usda(folder / "motion.usda", motion, 0, 0.0);
    const json three = read_by_others(folder / "motion.usda", folder)["three"];
    const json& track = three["tracks"]["die__red.position"];
    ASSERT_EQ(track["times"].size(), motion.times.size());
    const auto poses = shape_poses(motion, motion.bodies[1], 0, 0);
    for (std::size_t frame = 0; frame < poses.size(); ++frame) {
        EXPECT_NEAR(track["times"][frame].get<double>(), motion.times[frame], 1e-6) << "seconds";
        EXPECT_NEAR(track["values"][3 * frame + 2].get<double>(), poses[frame].position.z(), 1e-6)
            << "metres";
    }
    EXPECT_NEAR(three["turned_upright"].get<double>(), -std::numbers::pi / 2.0, 1e-12)
        << "z up, to three's y";
    EXPECT_EQ(three["root"]["metersPerUnit"], 1);
    EXPECT_EQ(three["root"]["timeCodesPerSecond"], 60);
    EXPECT_EQ(three["root"]["defaultPrim"], "motion");
}

TEST(UsdExport, CopiesShareTheirBodysMesh) {
    const TemporaryFolder folder;
    const Motion motion = ellipsoid_and_cubes(3);
    write_usda(folder / "motion.usda", motion);
    const std::string written = read_bytes(folder / "motion.usda");
    const auto count_of = [](const std::string& text, const std::string& words) {
        std::size_t count = 0;
        for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1))
            ++count;
        return count;
    };
    EXPECT_EQ(count_of(written, "def Mesh"), 2U);
    EXPECT_EQ(count_of(written, "instanceable = true"), 2U);
    const json found = read_by_others(folder / "motion.usda", folder);
    EXPECT_EQ(count_of(found["tinyusdz"]["text"], "def Mesh"), 4U) << "once the references are resolved";
    const json& meshes = found["three"]["meshes"];
    ASSERT_EQ(meshes.size(), 2U);
    EXPECT_EQ(meshes[0]["triangles"], motion.bodies[0].surface.triangle_count());
    EXPECT_EQ(meshes[1]["triangles"], 12);
    EXPECT_EQ(meshes[1]["box"], json::parse("[[-1,-1,-1],[1,1,1]]"));
}

TEST(UsdExport, ACrowdIsAPointInstancer) {
    const TemporaryFolder folder;
    const Motion motion = ellipsoid_and_cubes(most_usd_transforms + 1);
    write_usda(folder / "motion.usda", motion);
    const json found = read_by_others(folder / "motion.usda", folder);
    const auto& samples = found["three"]["samples"];
    const auto text = found["tinyusdz"]["text"].get<std::string>();
    const BodyMotion& cube = motion.bodies[1];
    EXPECT_NE(text.find("def PointInstancer \"die__red\""), std::string::npos);
    EXPECT_NE(text.find("rel prototypes = </motion/die__red/prototypes/shape>"), std::string::npos);
    const auto written_positions = samples_in(text, "die__red", "positions");
    EXPECT_EQ(written_positions.at(0.0).size(), 3U * (most_usd_transforms + 1));
    expect_poses(written_positions, samples_in(text, "die__red", "orientationsf"), true, motion, cube, 0,
                 cube.copies, 3e-6, 3e-7);
    expect_poses(written_positions, samples_in(text, "die__red", "orientations"), true, motion, cube, 0,
                 cube.copies, 3e-6, 1e-3);
    EXPECT_EQ(samples["/motion/die__red.positions"]["times"].size(), motion.times.size());
}

TEST(UsdExport, ACrowdHasTheVelocitiesOfItsPlacesAndTurnsInDegreesASecond) {
    const TemporaryFolder folder;
    const Motion motion = ellipsoid_and_cubes(most_usd_transforms + 1);
    write_usda(folder / "motion.usda", motion);
    const json found = read_by_others(folder / "motion.usda", folder);
    const auto text = found["tinyusdz"]["text"].get<std::string>();
    const Samples positions = samples_in(text, "die__red", "positions");
    const Samples velocities = samples_in(text, "die__red", "velocities");
    const Samples rates = samples_in(text, "die__red", "angularVelocities");
    ASSERT_EQ(velocities.size(), motion.times.size());
    ASSERT_EQ(rates.size(), motion.times.size());
    for (std::size_t frame = 1; frame + 1 < motion.times.size(); ++frame) {
        const auto at = [&](const Samples& samples, double code, std::size_t place) {
            return Vector3d(&samples.at(code)[3 * place]);
        };
        const auto code = static_cast<double>(frame);
        for (const std::size_t copy : {std::size_t{0}, std::size_t{7}}) {
            const Vector3d by_places =
                (at(positions, code + 1, copy) - at(positions, code - 1, copy)) * (0.5 * motion.frame_rate);
            EXPECT_LT((at(velocities, code, copy) - by_places).norm(), 0.01 * by_places.norm() + 0.01);
            const Pose& pose =
                motion.pose(motion.bodies[1], 0, static_cast<int>(frame), static_cast<int>(copy));
            EXPECT_LT((at(rates, code, copy) * (std::numbers::pi / 180.0) - pose.angular_velocity).norm(),
                      1e-5 * (1.0 + pose.angular_velocity.norm()));
        }
    }
}

TEST(UsdExport, EachCopyHasItsColorAndItsMeshNone) {
    const TemporaryFolder folder;
    const CopyStyle style{.first = 1, .colors = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const auto colors_in = [&](int copies) {
        write_usda(folder / "motion.usda", ellipsoid_and_cubes(copies), 0, std::nullopt, style);
        const auto text =
            read_by_others(folder / "motion.usda", folder)["tinyusdz"]["text"].get<std::string>();
        std::vector<std::string> colors;
        const std::regex form(R"(primvars:displayColor = (\[[^\]]*\]))");
        for (std::sregex_iterator found(text.begin(), text.end(), form), end; found != end; ++found) {
            colors.push_back((*found)[1]);
        }
        return std::pair(colors, text);
    };
    const auto [few, of_few] = colors_in(2);
    EXPECT_EQ(few, (std::vector<std::string>{"[(0, 1, 0)]", "[(0, 1, 0)]", "[(0, 0, 1)]"}));
    const auto [many, of_many] = colors_in(most_usd_transforms + 1);
    ASSERT_EQ(many.size(), 2U) << "of the ellipsoid and of the instancer";
    EXPECT_EQ(many[1].substr(0, 37), "[(0, 1, 0), (0, 0, 1), (1, 0, 0), (0,");
    EXPECT_EQ(std::count(many[1].begin(), many[1].end(), '('), most_usd_transforms + 1);
    EXPECT_NE(of_many.find("interpolation = \"vertex\"", of_many.find(many[1])), std::string::npos);
}

TEST(UsdExport, ObstaclesStandWhereTheyAreAndMoveByTheirKeys) {
    const TemporaryFolder folder;
    Motion motion = ellipsoid_and_cubes(1);
    const Surface sheet{
        .vertices = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, .corners = {{0, 1, 2}}, .edge_nodes = {}};
    motion.obstacles = {
        {.name = "roof", .surface = sheet, .keys = {{{Vector3d(1, 2, 3)}, 0.0}}},
        {.name = "hand", .surface = sheet, .keys = {{{Vector3d(0, 0, 0)}, 0.0}, {{Vector3d(0, 0, 5)}, 0.5}}}};
    write_usda(folder / "motion.usda", motion, 0, 0.0);
    const json found = read_by_others(folder / "motion.usda", folder);
    const auto& samples = found["three"]["samples"];
    const Samples roof = samples_of(samples["/motion/roof.xformOp:translate"]);
    EXPECT_EQ(roof.begin()->second, (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(roof.rbegin()->second, (std::vector<double>{1, 2, 3}));
    const Samples hand = samples_of(samples["/motion/hand.xformOp:translate"]);
    EXPECT_NEAR(hand.at(15.0)[2], 2.5, 1e-6);
    EXPECT_EQ(hand.rbegin()->second[2], 5.0);
    EXPECT_EQ(found["three"]["meshes"].size(), 4U);
    EXPECT_NE(found["tinyusdz"]["text"].get<std::string>().find("doubleSided = 1"), std::string::npos);
}

TEST(UsdExport, KeptSamplesGiveEveryFrameWithinTheTolerance) {
    const TemporaryFolder folder;
    Motion motion = test::motion_of([](double t) { return test::flutter(t, 0.7, 0.6, 0.2); }, 2.0, 240.0);
    const double tolerance = 1e-4;
    const std::size_t count = write_usda(folder / "motion.usda", motion, 0, tolerance);
    EXPECT_LT(count, motion.times.size());
    const json samples = read_by_others(folder / "motion.usda", folder)["three"]["samples"];
    const Samples positions = samples_of(samples["/motion/ellipsoid.xformOp:translate"]);
    const Samples orientations = samples_of(samples["/motion/ellipsoid.xformOp:orient"]);
    EXPECT_EQ(positions.size() + orientations.size(), count);
    for (std::size_t frame = 0; frame < motion.times.size(); ++frame) {
        const auto code = static_cast<double>(frame);
        const auto around = [&](const Samples& all) {
            const auto after = all.lower_bound(std::max(code, 0.5));
            return std::pair(std::prev(after), after);
        };
        const Pose& pose = motion.bodies[0].poses[frame];
        const auto [p, p_after] = around(positions);
        const double s = (code - p->first) / (p_after->first - p->first);
        const Vector3d place = (1.0 - s) * Vector3d(p->second.data()) + s * Vector3d(p_after->second.data());
        EXPECT_LE((place - pose.position).norm(), tolerance);
        const auto [q, q_after] = around(orientations);
        const double u = (code - q->first) / (q_after->first - q->first);
        const Quaterniond turn = quaternion_of(q->second, 0, false)
                                     .normalized()
                                     .slerp(u, quaternion_of(q_after->second, 0, false).normalized());
        EXPECT_LE(2.0 * std::sin(0.5 * turn.angularDistance(pose.orientation)) * 0.04,
                  tolerance * (1.0 + 1e-6));
    }
}

TEST(UsdExport, ReadersRefuseWhatIsBroken) {
    const TemporaryFolder folder;
    write_usda(folder / "motion.usda", ellipsoid_and_cubes(1));
    const std::string bytes = read_bytes(folder / "motion.usda");
    std::ofstream(folder / "cut.usda", std::ios::binary) << bytes.substr(0, bytes.size() / 2);
    read_by_others(folder / "cut.usda", folder, 1);
}

TEST(UsdExport, EqualMotionsGiveEqualBytesAndOneFrameIsAStillScene) {
    const TemporaryFolder folder;
    write_usda(folder / "one.usda", ellipsoid_and_cubes(2));
    write_usda(folder / "other.usda", ellipsoid_and_cubes(2));
    EXPECT_EQ(read_bytes(folder / "one.usda"), read_bytes(folder / "other.usda"));
    write_usda(folder / "still.usda", test::motion_of(test::wander, 0.0));
    const json still = read_by_others(folder / "still.usda", folder);
    EXPECT_EQ(still["three"]["meshes"].size(), 1U);
    Motion crowd = ellipsoid_and_cubes(most_usd_transforms + 1);
    crowd = still_at(crowd, 0.5);
    write_usda(folder / "crowd.usda", crowd);
    const std::string text = read_by_others(folder / "crowd.usda", folder)["tinyusdz"]["text"];
    EXPECT_EQ(text.find("timeSamples"), std::string::npos) << "a still is the same at all times";
    EXPECT_EQ(text.find("velocities"), std::string::npos) << "readers would go on by them";
    EXPECT_NE(text.find("point3f[] positions = [("), std::string::npos);
}

}  // namespace
}  // namespace samara
