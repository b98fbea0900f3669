// .glb and .chan files in real Blender (tests/tools/read_in_blender.py).

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "paths.hpp"
#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/export/chan_file.hpp"
#include "samara/export/gltf_file.hpp"
#include "samara/export/shape_pose.hpp"
#include "support/temporary_folder.hpp"
#include "synthetic_motion.hpp"

namespace samara {
namespace {

using nlohmann::json;
using test::TemporaryFolder;

/// What Blender has after it read the files, at a frame rate and up to a frame.
json read_in_blender(const TemporaryFolder& folder, int frame_rate, int last_frame,
                     const std::vector<std::string>& files) {
    std::vector<std::string> words = {"blender",
                                      "-b",
                                      "--factory-startup",
                                      "--python",
                                      SAMARA_SOURCE_DIRECTORY "/tests/tools/read_in_blender.py",
                                      "--",
                                      std::to_string(frame_rate),
                                      std::to_string(last_frame)};
    words.insert(words.end(), files.begin(), files.end());
    EXPECT_EQ(run_subprocess(words, folder / "log"), 0);
    const std::string log = read_bytes(folder / "log");
    const std::size_t place = log.find("\nFOUND ");
    EXPECT_NE(place, std::string::npos) << log;
    if (place == std::string::npos) return {};
    return json::parse(log.substr(place + 7, log.find('\n', place + 7) - place - 7));
}

Eigen::Matrix4d matrix_of(const json& rows) {
    Eigen::Matrix4d matrix;
    for (std::size_t row = 0; row < 4; ++row) {
        const auto values = rows[row].get<std::vector<double>>();
        matrix.row(static_cast<Eigen::Index>(row)) = Eigen::Map<const Eigen::RowVector4d>(values.data());
    }
    return matrix;
}

Eigen::Matrix4d matrix_of(const ShapePose& pose) {
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    matrix.topLeftCorner<3, 3>() = pose.orientation.toRotationMatrix();
    matrix.topRightCorner<3, 1>() = pose.position;
    return matrix;
}

Motion wandering(int copies) {
    Motion motion = test::motion_of(test::wander, 1.0);
    BodyMotion& body = motion.bodies[0];
    body.center_of_mass = Vector3d(0.01, 0.02, -0.03);
    test::let_wander(body, copies, motion.times);
    return motion;
}

TEST(Blender, ShowsTheMotionsPosesFromGlb) {
    const TemporaryFolder folder;
    const Motion motion = wandering(2);
    write_glb(folder / "motion.glb", motion, 0, 0.0);
    const json found = read_in_blender(folder, 60, 60, {folder / "motion.glb"});
    ASSERT_EQ(found["objects"].size(), 2U);
    for (int copy = 0; copy < 2; ++copy) {
        const json& object = found["objects"][copy_name(motion.bodies[0], copy)];
        EXPECT_EQ(object["mesh"], "ellipsoid") << "one mesh for all copies";
        const auto poses = shape_poses(motion, motion.bodies[0], 0, copy);
        ASSERT_EQ(object["matrices"].size(), poses.size());
        for (std::size_t frame = 0; frame < poses.size(); ++frame) {
            const Eigen::Matrix4d error = matrix_of(object["matrices"][frame]) - matrix_of(poses[frame]);
            EXPECT_LT(error.lpNorm<Eigen::Infinity>(), 1e-5) << "frame " << frame;
        }
    }
}

TEST(Blender, ShowsTheShapeInItsOwnAxesAndSizeFromGlb) {
    const TemporaryFolder folder;
    write_glb(folder / "motion.glb", wandering(1));
    const json found = read_in_blender(folder, 60, 1, {folder / "motion.glb"});
    Eigen::AlignedBox3d box;
    for (const json& vertex : found["objects"]["ellipsoid"]["vertices"]) {
        box.extend(Vector3d(vertex[0].get<double>(), vertex[1].get<double>(), vertex[2].get<double>()));
    }
    EXPECT_LT((box.max() - Vector3d(0.04, 0.02, 0.01)).norm(), 2e-4);
    EXPECT_LT((box.min() + Vector3d(0.04, 0.02, 0.01)).norm(), 2e-4);
}

TEST(Blender, StaysWithinTheToleranceWhereKeysAreLeftOut) {
    const TemporaryFolder folder;
    Motion motion = wandering(1);
    const double tolerance = 2e-3;
    ASSERT_LT(write_glb(folder / "motion.glb", motion, 0, tolerance), 100U);
    const json found = read_in_blender(folder, 60, 60, {folder / "motion.glb"});
    const auto poses = shape_poses(motion, motion.bodies[0], 0, 0);
    for (std::size_t frame = 0; frame < poses.size(); ++frame) {
        const Eigen::Matrix4d is = matrix_of(found["objects"]["ellipsoid"]["matrices"][frame]);
        const Eigen::Matrix4d shall = matrix_of(poses[frame]);
        const Vector3d shift = (is - shall).topRightCorner<3, 1>();
        EXPECT_LE(shift.norm(), tolerance + 1e-6);
        const Matrix3d turn = (is - shall).topLeftCorner<3, 3>();
        for (const Vector3d& vertex : motion.bodies[0].surface.vertices) {
            EXPECT_LE((turn * vertex).norm(), tolerance + 1e-6);
        }
    }
}

TEST(Blender, ShowsTheMotionsPosesFromChan) {
    const TemporaryFolder folder;
    const Motion motion = wandering(1);
    write_glb(folder / "motion.glb", motion);
    write_chan(folder / "motion.chan", motion);
    const json found = read_in_blender(folder, 60, 60, {folder / "motion.glb", folder / "motion.chan"});
    const auto poses = shape_poses(motion, motion.bodies[0], 0, 0);
    // Its importer turns the world's y up to z up and leaves the shape's as it is.
    Eigen::Matrix4d shape_to_y_up = Eigen::Matrix4d::Identity();
    shape_to_y_up.topLeftCorner<3, 3>() =
        Eigen::AngleAxisd(-std::numbers::pi / 2.0, Vector3d::UnitX()).toRotationMatrix();
    for (std::size_t frame = 0; frame < poses.size(); ++frame) {
        const Eigen::Matrix4d is =
            matrix_of(found["objects"][(folder / "motion.chan").string()]["matrices"][frame]);
        const Eigen::Matrix4d error = is * shape_to_y_up - matrix_of(poses[frame]);
        EXPECT_LT(error.lpNorm<Eigen::Infinity>(), 1e-5) << "frame " << frame;
    }
}

}  // namespace
}  // namespace samara
