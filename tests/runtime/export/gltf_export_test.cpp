#include <cstring>
#include <fstream>
#include <utility>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <tiny_gltf.h>

#include "paths.hpp"
#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/base/version.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/surface/curved_surface.hpp"
#include "samara/export/gltf_file.hpp"
#include "samara/export/shaded_mesh.hpp"
#include "samara/export/shape_pose.hpp"
#include "samara/motion/motion_file.hpp"
#include "support/temporary_folder.hpp"
#include "synthetic_motion.hpp"

namespace samara {
namespace {

using test::TemporaryFolder;

Motion leaves(int copies, double duration, int runs = 1) {
    Motion motion = test::motion_of([](double t) { return test::tumble(t, 9.0, 0.3); }, duration);
    motion.runs = runs;
    BodyMotion& body = motion.bodies[0];
    body.copies = copies;
    body.center_of_mass = Vector3d(0.01, 0.02, -0.03);
    body.poses.clear();
    for (int run = 0; run < runs; ++run) {
        for (const double time : motion.times) {
            for (int copy = 0; copy < copies; ++copy) {
                body.poses.push_back(test::tumble(time + run, 9.0 + copy, 0.3));
            }
        }
    }
    BodyMotion cube = body;
    cube.name = "cube";
    cube.surface = test::box({2.0, 2.0, 2.0}, 1);
    motion.bodies.push_back(cube);
    return motion;
}

tinygltf::Model read_glb(const std::filesystem::path& file) {
    tinygltf::Model model;
    std::string error;
    std::string warning;
    EXPECT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromFile(&model, &error, &warning, file.string())) << error;
    EXPECT_EQ(warning, "");
    return model;
}

std::vector<float> floats_of(const tinygltf::Model& model, int index, std::size_t components) {
    const auto& accessor = model.accessors[static_cast<std::size_t>(index)];
    const auto& view = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
    std::vector<float> values(accessor.count * components);
    std::memcpy(values.data(), model.buffers[0].data.data() + view.byteOffset + accessor.byteOffset,
                values.size() * sizeof(float));
    return values;
}

/// The Khronos validator's report; a test that runs it fails where it is not installed.
nlohmann::json validate(const std::filesystem::path& file, const std::filesystem::path& report) {
    const auto node = find_program("node");
    if (!node) {
        ADD_FAILURE() << "Node.js is not installed";
        return {};
    }
    const int status = run_subprocess(
        {*node, SAMARA_SOURCE_DIRECTORY "/tests/tools/validate_gltf.mjs", SAMARA_NODE_TOOLS, file}, report);
    const std::string text = read_bytes(report);
    EXPECT_EQ(status, 0) << text << "\n(gltf-validator is expected in " SAMARA_NODE_TOOLS ")";
    return nlohmann::json::parse(text, nullptr, false);
}

void expect_valid(const std::filesystem::path& file, const TemporaryFolder& folder) {
    const nlohmann::json report = validate(file, folder / "report.json");
    ASSERT_TRUE(report.is_object());
    EXPECT_EQ(report["issues"]["numErrors"], 0);
    EXPECT_EQ(report["issues"]["numWarnings"], 0);
    EXPECT_EQ(report["issues"]["numInfos"], 0);
}

TEST(GltfExport, PassesTheKhronosValidator) {
    const TemporaryFolder folder;
    write_glb(folder / "motion.glb", leaves(3, 2.0));
    expect_valid(folder / "motion.glb", folder);
}

TEST(GltfExport, OneFrameIsAStillSceneThatPassesTheValidator) {
    const TemporaryFolder folder;
    write_glb(folder / "still.glb", leaves(1, 0.0));
    expect_valid(folder / "still.glb", folder);
    EXPECT_TRUE(read_glb(folder / "still.glb").animations.empty());
}

TEST(GltfExport, ValidatorFindsErrors) {
    const TemporaryFolder folder;
    write_glb(folder / "motion.glb", leaves(1, 0.1));
    std::string bytes = read_bytes(folder / "motion.glb");
    bytes.resize(bytes.size() - 4);
    std::ofstream(folder / "cut.glb", std::ios::binary) << bytes;
    const int status = run_subprocess({"node", SAMARA_SOURCE_DIRECTORY "/tests/tools/validate_gltf.mjs",
                                       SAMARA_NODE_TOOLS, folder / "cut.glb"},
                                      folder / "report.json");
    EXPECT_EQ(status, 1);
    const auto report = nlohmann::json::parse(read_bytes(folder / "report.json"), nullptr, false);
    ASSERT_TRUE(report.is_object());
    EXPECT_GT(report["issues"]["numErrors"].get<int>(), 0);
}

TEST(GltfExport, CopiesShareTheirBodysMesh) {
    const TemporaryFolder folder;
    write_glb(folder / "motion.glb", leaves(1000, 0.05));
    expect_valid(folder / "motion.glb", folder);
    const tinygltf::Model model = read_glb(folder / "motion.glb");
    EXPECT_EQ(model.asset.generator, std::string("samara ") + version);
    EXPECT_EQ(model.meshes.size(), 2U);
    ASSERT_EQ(model.nodes.size(), 2000U);
    EXPECT_EQ(model.nodes[0].name, "ellipsoid");
    EXPECT_EQ(model.nodes[1].name, "ellipsoid.001");
    EXPECT_EQ(model.nodes[999].name, "ellipsoid.999");
    EXPECT_EQ(model.nodes[999].mesh, 0);
    EXPECT_EQ(model.nodes[1000].name, "cube");
    EXPECT_EQ(model.nodes[1000].mesh, 1);
}

TEST(GltfExport, KeysAreThePosesOfTheRunInAxesWithYUp) {
    const TemporaryFolder folder;
    Motion motion = leaves(2, 1.0, 2);
    for (std::size_t i = 0; i < motion.bodies[0].poses.size(); i += 5) {
        motion.bodies[0].poses[i].orientation.coeffs() *= -1.0;
    }
    write_glb(folder / "motion.glb", motion, 1, 0.0);
    const tinygltf::Model model = read_glb(folder / "motion.glb");
    ASSERT_EQ(model.animations.size(), 1U);
    const tinygltf::Animation& animation = model.animations[0];
    ASSERT_EQ(animation.channels.size(), 8U);
    const Matrix3d up = Eigen::AngleAxisd(-std::numbers::pi / 2.0, Vector3d::UnitX()).toRotationMatrix();
    for (const tinygltf::AnimationChannel& channel : animation.channels) {
        const auto& sampler = animation.samplers[static_cast<std::size_t>(channel.sampler)];
        EXPECT_EQ(sampler.interpolation, "LINEAR");
        const std::vector<float> times = floats_of(model, sampler.input, 1);
        ASSERT_EQ(times.size(), 61U);
        const bool rotates = channel.target_path == "rotation";
        const std::size_t components = rotates ? 4 : 3;
        const std::vector<float> keys = floats_of(model, sampler.output, components);
        ASSERT_EQ(keys.size(), components * times.size());
        const BodyMotion& body = motion.bodies[static_cast<std::size_t>(channel.target_node / 2)];
        for (std::size_t frame = 0; frame < times.size(); ++frame) {
            EXPECT_NEAR(times[frame], motion.times[frame], 1e-6);
            const Pose& pose = motion.pose(body, 1, static_cast<int>(frame), channel.target_node % 2);
            const float* key = &keys[components * frame];
            if (rotates) {
                const Quaterniond is(key[3], key[0], key[1], key[2]);
                const Matrix3d expected = up * pose.orientation.toRotationMatrix() * up.transpose();
                EXPECT_LT((is.toRotationMatrix() - expected).norm(), 1e-6);
                if (frame > 0) {
                    const Quaterniond before(key[-1], key[-4], key[-3], key[-2]);
                    EXPECT_GT(is.dot(before), 0.0);
                }
            } else {
                const Vector3d expected = up * shape_origin(pose, body.center_of_mass);
                EXPECT_LT((Vector3d(key[0], key[1], key[2]) - expected).norm(), 1e-6);
            }
        }
    }
}

/// Times and values of a channel.
struct Track {
    std::vector<float> times;
    std::vector<float> values;
};

Track track_of(const tinygltf::Model& model, const std::string& path) {
    for (const tinygltf::AnimationChannel& channel : model.animations[0].channels) {
        if (channel.target_path != path) continue;
        const auto& sampler = model.animations[0].samplers[static_cast<std::size_t>(channel.sampler)];
        return {floats_of(model, sampler.input, 1),
                floats_of(model, sampler.output, path == "rotation" ? 4 : 3)};
    }
    return {};
}

/// The key before a time, and the fraction of the time to the next.
std::pair<std::size_t, double> place_of(const Track& track, double time) {
    std::size_t key = 0;
    while (key + 2 < track.times.size() && track.times[key + 1] < time) ++key;
    return {key, (time - track.times[key]) / (track.times[key + 1] - track.times[key])};
}

TEST(GltfExport, ObstaclesAreNodesSeenFromBothSidesAndMoveByTheirKeys) {
    const TemporaryFolder folder;
    Motion motion = leaves(1, 1.0);
    const Surface sheet{
        .vertices = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, .corners = {{0, 1, 2}}, .edge_nodes = {}};
    motion.obstacles = {
        {.name = "roof", .surface = sheet, .keys = {{{Vector3d(1, 2, 3)}, 0.0}}},
        {.name = "hand", .surface = sheet, .keys = {{{Vector3d(0, 0, 0)}, 0.0}, {{Vector3d(0, 0, 5)}, 0.5}}}};
    write_glb(folder / "obstacles.glb", motion);
    const tinygltf::Model model = read_glb(folder / "obstacles.glb");
    ASSERT_EQ(model.nodes.size(), 4U);
    const tinygltf::Node& roof = model.nodes[2];
    EXPECT_EQ(roof.name, "roof");
    EXPECT_EQ(roof.translation, (std::vector<double>{1.0, 3.0, -2.0}));
    const int material = model.meshes[static_cast<std::size_t>(roof.mesh)].primitives[0].material;
    EXPECT_TRUE(model.materials[static_cast<std::size_t>(material)].doubleSided);
    std::vector<float> heights;
    for (const auto& channel : model.animations[0].channels) {
        EXPECT_NE(channel.target_node, 2);
        if (channel.target_node != 3 || channel.target_path != "translation") continue;
        const auto& sampler = model.animations[0].samplers[static_cast<std::size_t>(channel.sampler)];
        heights = floats_of(model, sampler.output, 3);
    }
    ASSERT_EQ(heights.size(), 9U);  // at its keys and at the end
    EXPECT_EQ(heights[1], 0.0F);
    EXPECT_EQ(heights[4], 5.0F);
    EXPECT_EQ(heights[7], 5.0F);
}

TEST(GltfExport, KeptKeysGiveEveryFrameWithinTheTolerance) {
    const TemporaryFolder folder;
    Motion motion = test::motion_of([](double t) { return test::flutter(t, 0.7, 0.6, 0.2); }, 4.0, 240.0);
    motion.bodies[0].center_of_mass = Vector3d(0.01, 0.0, 0.002);
    const Matrix3d up = Eigen::AngleAxisd(-std::numbers::pi / 2.0, Vector3d::UnitX()).toRotationMatrix();
    std::size_t before = 2 * motion.times.size() + 1;
    for (const double tolerance : {1e-6, 1e-5, 1e-4, 1e-3}) {
        const std::size_t keys = write_glb(folder / "motion.glb", motion, 0, tolerance);
        EXPECT_LT(keys, before) << tolerance;
        before = keys;
        const tinygltf::Model model = read_glb(folder / "motion.glb");
        const Track positions = track_of(model, "translation");
        const Track rotations = track_of(model, "rotation");
        EXPECT_EQ(positions.times.size() + rotations.times.size(), keys);
        for (std::size_t frame = 0; frame < motion.times.size(); ++frame) {
            const Pose& pose = motion.bodies[0].poses[frame];
            const auto [k, s] = place_of(positions, motion.times[frame]);
            const auto position = [&](std::size_t key) {
                return Eigen::Map<const Eigen::Vector3f>(&positions.values[3 * key]).cast<double>().eval();
            };
            const Vector3d place = (1.0 - s) * position(k) + s * position(k + 1);
            EXPECT_LE((place - up * shape_origin(pose, motion.bodies[0].center_of_mass)).norm(),
                      tolerance * (1.0 + 1e-9));
            const auto [r, u] = place_of(rotations, motion.times[frame]);
            const auto rotation = [&](std::size_t key) {
                return Quaterniond(
                    Eigen::Map<const Eigen::Vector4f>(&rotations.values[4 * key]).cast<double>().eval());
            };
            const Matrix3d exact = up * pose.orientation.toRotationMatrix() * up.transpose();
            const Quaterniond by_arc = rotation(r).slerp(u, rotation(r + 1)).normalized();
            const Quaterniond by_components =
                Quaterniond((1.0 - u) * rotation(r).coeffs() + u * rotation(r + 1).coeffs()).normalized();
            for (const Vector3d& vertex : motion.bodies[0].surface.vertices) {
                const Vector3d point = up * vertex;
                EXPECT_LE((by_arc * point - exact * point).norm(), tolerance * (1.0 + 1e-6));
                EXPECT_LE((by_components * point - exact * point).norm(), tolerance * (1.0 + 1e-6));
            }
        }
    }
}

TEST(GltfExport, ABodyAtRestHasTwoKeysAndTheToleranceZeroKeepsAll) {
    const TemporaryFolder folder;
    const Motion motion = test::motion_of([](double) { return Pose{}; }, 1.0);
    EXPECT_EQ(write_glb(folder / "motion.glb", motion), 2U + 2U);
    expect_valid(folder / "motion.glb", folder);
    EXPECT_EQ(write_glb(folder / "motion.glb", motion, 0, 0.0), 2U * 61U);
    expect_valid(folder / "motion.glb", folder);
}

TEST(GltfExport, TheDefaultToleranceIsA500thOfTheBodysRadius) {
    const TemporaryFolder folder;
    const Motion motion = test::motion_of([](double t) { return test::flutter(t, 0.7, 0.6, 0.2); }, 2.0);
    write_glb(folder / "default.glb", motion);
    write_glb(folder / "stated.glb", motion, 0, 0.04 / 500.0);
    EXPECT_EQ(read_bytes(folder / "default.glb"), read_bytes(folder / "stated.glb"));
}

TEST(GltfExport, EqualMotionsGiveEqualBytes) {
    const TemporaryFolder folder;
    write_glb(folder / "one.glb", leaves(2, 0.5));
    write_glb(folder / "other.glb", leaves(2, 0.5));
    EXPECT_EQ(read_bytes(folder / "one.glb"), read_bytes(folder / "other.glb"));
}

TEST(GltfExport, RefusesTimesThatGltfCannotHold) {
    const TemporaryFolder folder;
    Motion motion = leaves(1, 0.1);
    motion.times.front() = -1.0;
    EXPECT_THROW(write_glb(folder / "motion.glb", motion), Error);
    motion = leaves(1, 0.1);
    for (double& time : motion.times) time += 1e7;
    EXPECT_THROW(write_glb(folder / "motion.glb", motion), Error);
    EXPECT_FALSE(std::filesystem::exists(folder / "motion.glb"));
}

TEST(GltfExport, CommandWritesTheRunAskedFor) {
    const TemporaryFolder folder;
    const Motion motion = leaves(1, 0.2, 2);
    write_motion_file(folder / "motion.h5", motion);
    write_glb(folder / "expected.glb", motion, 1);
    ASSERT_EQ(run_subprocess({SAMARA_PROGRAMS "/samara", "export", folder / "motion.h5", "-o",
                              folder / "motion.glb", "--run", "1"},
                             folder / "log"),
              0)
        << read_bytes(folder / "log");
    EXPECT_EQ(read_bytes(folder / "motion.glb"), read_bytes(folder / "expected.glb"));
}

TEST(ShadedMesh, IsSmoothOnAnEllipsoidAndSharpOnACube) {
    const Vector3d semi_axes(0.04, 0.02, 0.01);
    const Surface surface = test::ellipsoid(semi_axes, 3);
    const ShadedMesh smooth = shaded_mesh(surface);
    EXPECT_EQ(smooth.positions.size(), surface.vertices.size());
    EXPECT_EQ(smooth.triangles.size(), surface.corners.size());
    for (std::size_t i = 0; i < smooth.normals.size(); ++i) {
        const Vector3d exact =
            smooth.positions[i].cwiseQuotient(semi_axes.cwiseProduct(semi_axes)).normalized();
        EXPECT_GT(smooth.normals[i].dot(exact), 0.99);
    }
    const ShadedMesh cube = shaded_mesh(test::box({2.0, 2.0, 2.0}, 1));
    EXPECT_EQ(cube.positions.size(), 24U);
    for (std::size_t i = 0; i < cube.normals.size(); ++i) {
        EXPECT_NEAR(cube.normals[i].lpNorm<Eigen::Infinity>(), 1.0, 1e-12);
        EXPECT_NEAR(cube.normals[i].dot(cube.positions[i]), 1.0, 1e-12);
    }
}

TEST(ShadedMesh, TakesTheMiddleNodesOfOrderTwoAndLeavesOutTrianglesWithoutArea) {
    Surface surface;
    surface.vertices = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    surface.corners = {{0, 1, 2}};
    surface.edge_nodes = {{3, 4, 5}};
    EXPECT_EQ(shaded_mesh(surface).triangles.size(), 4U);
    EXPECT_NEAR(surface_area(flattened_surface(surface)), 2.0, 1e-12);
    surface.edge_nodes.clear();
    surface.corners.push_back({0, 3, 1});
    EXPECT_EQ(shaded_mesh(surface).triangles.size(), 1U);
}

TEST(GltfExport, ColorsAreMeshesThatShareTheirBodysAccessors) {
    const TemporaryFolder folder;
    const CopyStyle style{.first = 1, .colors = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    write_glb(folder / "motion.glb", leaves(4, 0.1), 0, std::nullopt, style);
    expect_valid(folder / "motion.glb", folder);
    const tinygltf::Model model = read_glb(folder / "motion.glb");
    ASSERT_EQ(model.nodes.size(), 8U);
    EXPECT_EQ(model.nodes[0].name, "ellipsoid.001");
    EXPECT_EQ(model.meshes.size(), 6U);
    EXPECT_EQ(model.materials.size(), 3U) << "all bodies share them";
    for (std::size_t copy = 0; copy < 4; ++copy) {
        const auto& mesh = model.meshes[static_cast<std::size_t>(model.nodes[copy].mesh)];
        const auto& first = model.meshes[static_cast<std::size_t>(model.nodes[0].mesh)];
        EXPECT_EQ(mesh.primitives[0].attributes, first.primitives[0].attributes);
        EXPECT_EQ(mesh.primitives[0].indices, first.primitives[0].indices);
        const auto& material = model.materials[static_cast<std::size_t>(mesh.primitives[0].material)];
        std::vector<double> expected = {0.0, 0.0, 0.0, 1.0};
        expected[(copy + 1) % 3] = 1.0;
        EXPECT_EQ(material.pbrMetallicRoughness.baseColorFactor, expected);
    }
}

TEST(GltfExport, InstancesAreThoseOfOneFrame) {
    const TemporaryFolder folder;
    EXPECT_THROW(write_glb(folder / "motion.glb", leaves(3, 0.1), 0, std::nullopt, {}, true), Error);
    EXPECT_EQ(folder.file_count(), 0);
    write_glb(folder / "still.glb", leaves(3, 0.0), 0, std::nullopt, {}, true);
    const nlohmann::json report = validate(folder / "still.glb", folder / "report.json");
    EXPECT_EQ(report["issues"]["numErrors"], 0);
    const tinygltf::Model model = read_glb(folder / "still.glb");
    EXPECT_EQ(model.extensionsRequired, std::vector<std::string>{"EXT_mesh_gpu_instancing"});
    EXPECT_EQ(model.nodes.size(), 2U);
}

TEST(GltfExport, EachCopyIsShownAtItsSize) {
    const TemporaryFolder folder;
    Motion motion = leaves(3, 0.1);
    motion.bodies[0].sizes = {0.5, 1.0, 2.0};
    write_glb(folder.path() / "sizes.glb", motion, 0, {});
    const tinygltf::Model model = read_glb(folder.path() / "sizes.glb");
    for (std::size_t copy = 0; copy < 3; ++copy) {
        const double size = motion.bodies[0].sizes[copy];
        EXPECT_EQ(model.nodes[copy].scale, std::vector<double>(3, size));
        // The shape's origin lies beside the centre of mass by that of the size.
        const Pose& pose = motion.pose(motion.bodies[0], 0, 0, static_cast<int>(copy));
        const Vector3d origin = shape_poses(motion, motion.bodies[0], 0, static_cast<int>(copy))[0].position;
        EXPECT_NEAR((origin - pose.position).norm(), size * motion.bodies[0].center_of_mass.norm(), 1e-12);
    }
    EXPECT_TRUE(model.nodes[3].scale.empty());
}

}  // namespace
}  // namespace samara
