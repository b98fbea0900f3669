// [[obstacle]] in a scene file, and what is rejected.

#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "paths.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/motion/motion_file.hpp"
#include "samara/scene/scene_file.hpp"
#include "samara/scene/scene_simulation.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using ::testing::HasSubstr;

using test::TemporaryFolder;

const std::string roof = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n";
const std::string cube =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

/// A scene of one leaf that starts 1 m above the origin, with these lines of its obstacle.
Scene scene_with(const TemporaryFolder& folder, const std::string& obstacle, const std::string& mesh = roof,
                 const std::string& leaf = "") {
    std::ignore = folder.file("mesh.obj", mesh);
    return read_scene_file(folder.file(
        "scene.toml",
        fmt::format("[scene]\nduration = 1.0\nstep = 0.005\nframe_rate = 24\n[fluid]\npreset = \"air\"\n"
                    "[[body]]\nname = \"leaf\"\nshape = \"{}/runtime/bodies/leaf.body.h5\"\ndensity = 600\n"
                    "loads = \"none\"\nposition = [0, 0, 1]\n{}\n[[obstacle]]\nname = \"roof\"\n{}\n",
                    SAMARA_SOURCE_DIRECTORY, leaf, obstacle)));
}

void expect_rejected(const std::string& obstacle, const std::string& message,
                     const std::string& mesh = roof) {
    const TemporaryFolder folder;
    EXPECT_THAT(test::error_of([&] { scene_with(folder, obstacle, mesh); }), HasSubstr(message));
}

SimulationResult flown(const Scene& scene) {
    const LoadedBody leaf{read_body_file(SAMARA_SOURCE_DIRECTORY "/runtime/bodies/leaf.body.h5"), "leaf"};
    return simulate(scene, {leaf}, 1, [](double, double) { return true; });
}

TEST(Obstacle, IsReadWithItsPlaceFrictionAndScale) {
    const TemporaryFolder folder;
    const Scene scene = scene_with(folder,
                                   "shape = \"mesh.obj\"\nscale = 0.5\nfriction = 0.3\n"
                                   "position = [1, 2, 3]\norientation = [2, 0, 0, 0]\n");
    ASSERT_EQ(scene.obstacles.size(), 1U);
    const Obstacle& obstacle = scene.obstacles.front();
    EXPECT_EQ(obstacle.name, "roof");
    EXPECT_EQ(obstacle.friction, 0.3);
    EXPECT_EQ(obstacle.surface.triangle_count(), 2U);
    for (const Vector3d& vertex : obstacle.surface.vertices) {
        EXPECT_EQ(vertex.cwiseAbs(), Vector3d(0.5, 0.5, 0.0));
    }
    EXPECT_FALSE(obstacle.moves());
    EXPECT_EQ(place_of(obstacle, 7.0).position, Vector3d(1, 2, 3));
    EXPECT_EQ(place_of(obstacle, 7.0).orientation.w(), 1.0);
}

TEST(Obstacle, MovesEvenlyBetweenItsKeysAndByTheShortestTurn) {
    const TemporaryFolder folder;
    const Scene scene = scene_with(folder,
                                   "shape = \"mesh.obj\"\nposition = [0, 0, 1]\n"
                                   "keys = [{ time = 1 }, { time = 3, position = [4, 0, 1], "
                                   "orientation = [0.7071067811865476, 0, 0, 0.7071067811865476] }]\n");
    const Obstacle& obstacle = scene.obstacles.front();
    EXPECT_EQ(place_of(obstacle, 0.0).position, Vector3d(0, 0, 1));
    EXPECT_TRUE(place_of(obstacle, 1.5).position.isApprox(Vector3d(1, 0, 1)));
    EXPECT_NEAR(place_of(obstacle, 2.0).orientation.angularDistance(Quaterniond::Identity()), 0.785398163,
                1e-8);
    EXPECT_EQ(place_of(obstacle, 9.0).position, Vector3d(4, 0, 1));
}

TEST(Obstacle, OfBadInputIsRefusedInOneLineThatSaysWhereAndWhatToDo) {
    expect_rejected("shape = \"none.obj\"\n", "shape in [[obstacle]] cannot be read");
    expect_rejected("", "shape in [[obstacle]] is missing; give a mesh, .stl, .obj or .glb");
    expect_rejected("shape = \"mesh.ply\"\n", "must be a mesh, .stl, .obj or .glb, not 'mesh.ply'");
    expect_rejected("shape = \"mesh.obj\"\nfriction = -1\n",
                    "friction in [[obstacle]] must be 0, or a finite number");
    expect_rejected("shape = \"mesh.obj\"\nscale = 0\n",
                    "scale in [[obstacle]] must be a finite number above 0");
    expect_rejected("shape = \"mesh.obj\"\ncolour = 1\n", "unknown key 'colour' in [[obstacle]]");
    expect_rejected("shape = \"mesh.obj\"\norientation = [0, 0, 0, 0]\n", "must be a quaternion");
    expect_rejected("shape = \"mesh.obj\"\nkeys = [{ position = [0, 0, 0] }]\n",
                    "time in [[keys]] is missing");
    expect_rejected("shape = \"mesh.obj\"\nkeys = [{ time = 1 }, { time = 1 }]\n",
                    "must be later than that of the previous key");
    expect_rejected("shape = \"mesh.obj\"\nkeys = [{ time = 1 }, { time = 1.01, position = [2, 0, 0] }]\n",
                    "keys in [[obstacle]] are too fast: from 1 s to 1.01 s the mesh moves at 200 m/s, above "
                    "the limit of 100");
    expect_rejected("shape = \"mesh.obj\"\n", "oriented against the others",
                    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 4 3\nv 2 0 0\nf 2 5 3\n");
    expect_rejected("shape = \"mesh.obj\"\n", "has no area",
                    "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n");
    expect_rejected("shape = \"mesh.obj\"\n", "faces share the edge",
                    roof + "v 0 0 1\nv 0 0 -1\nf 1 2 5\nf 1 2 6\n");
    expect_rejected("shape = \"mesh.obj\"\n[[obstacle]]\nname = \"roof\"\nshape = \"mesh.obj\"\n",
                    "name in [[obstacle]] is 'roof', as of another obstacle");
    std::string inside_out = cube;
    for (std::size_t at = inside_out.find("f "); at != std::string::npos;
         at = inside_out.find("f ", at + 1)) {
        std::swap(inside_out[at + 2], inside_out[at + 6]);
    }
    expect_rejected("shape = \"mesh.obj\"\n", "flip the normals in the modelling program", inside_out);
}

TEST(Obstacle, AroundABodyThatStartsInsideOrAcrossItIsRefused) {
    const TemporaryFolder folder;
    const auto error_of = [&](const std::string& obstacle, const std::string& mesh) {
        return test::error_of([&] { flown(scene_with(folder, obstacle, mesh)); });
    };
    const std::string message = "body 'leaf' starts inside obstacle 'roof', at ";
    EXPECT_THAT(error_of("shape = \"mesh.obj\"\nposition = [-0.5, -0.5, 0.5]\n", cube), HasSubstr(message));
    EXPECT_THAT(error_of("shape = \"mesh.obj\"\nposition = [0, 0, 1]\norientation = [1, 1, 0, 0]\n", roof),
                HasSubstr(message));
}

TEST(Obstacle, ComesFromTheSceneFileIntoTheMotionFileAndHoldsTheLeaf) {
    const TemporaryFolder folder;
    const Scene scene = scene_with(folder,
                                   "shape = \"mesh.obj\"\nfriction = 0.4\nkeys = [{ time = 0, position = [0, "
                                   "0, 0.5] }, { time = 1, position = [0, 0, 0.6] }]\n");
    const Motion motion = flown(scene).motion;
    EXPECT_GT(motion.pose(motion.bodies[0], 0, motion.frames() - 1, 0).position.z(), 0.6);
    write_motion_file(folder / "motion.h5", motion);
    const Motion read = read_motion_file(folder / "motion.h5");
    ASSERT_EQ(read.obstacles.size(), 1U);
    EXPECT_EQ(read.obstacles[0].name, "roof");
    EXPECT_EQ(read.obstacles[0].friction, 0.4);
    EXPECT_EQ(read.obstacles[0].surface.corners, scene.obstacles[0].surface.corners);
    EXPECT_EQ(read.obstacles[0].surface.vertices, scene.obstacles[0].surface.vertices);
    ASSERT_EQ(read.obstacles[0].keys.size(), 2U);
    EXPECT_EQ(place_of(read.obstacles[0], 0.25).position, place_of(scene.obstacles[0], 0.25).position);
}

TEST(Obstacle, DoesNotChangeTheFallOfWhatNeverComesNearIt) {
    const TemporaryFolder folder;
    const Scene scene = scene_with(folder, "shape = \"mesh.obj\"\nposition = [50, 0, 0]\n");
    Scene free = scene;
    free.obstacles.clear();
    const Motion one = flown(scene).motion;
    const Motion other = flown(free).motion;
    for (int frame = 0; frame < one.frames(); ++frame) {
        EXPECT_EQ(one.pose(one.bodies[0], 0, frame, 0).position,
                  other.pose(other.bodies[0], 0, frame, 0).position);
    }
}

TEST(Obstacle, IsPartOfTheFlightThatAStateFits) {
    const LoadedBody leaf{read_body_file(SAMARA_SOURCE_DIRECTORY "/runtime/bodies/leaf.body.h5"), "leaf"};
    const TemporaryFolder folder;
    const Scene scene = scene_with(folder, "shape = \"mesh.obj\"\nposition = [0, 0, 0.5]\n");
    const auto simulation_of = [&](double friction) {
        SimulationSettings settings{.fluid = scene.fluid, .obstacles = scene.obstacles, .step = scene.step};
        settings.obstacles[0].friction = friction;
        auto simulation = std::make_unique<Simulation>(settings);
        simulation->add(leaf, scene.bodies[0], scene.bodies[0]);
        return simulation;
    };
    const auto one = simulation_of(0.5);
    one->advance_to(0.3);
    const std::string state = one->state();
    one->advance_to(1.0);
    const auto again = simulation_of(0.5);
    again->set_state(state);
    again->advance_to(1.0);
    EXPECT_EQ(again->pose(0).position, one->pose(0).position);
    EXPECT_EQ(again->pose(0).orientation.coeffs(), one->pose(0).orientation.coeffs());
    EXPECT_THROW(simulation_of(0.4)->set_state(state), SimulationError);
}

}  // namespace
}  // namespace samara
