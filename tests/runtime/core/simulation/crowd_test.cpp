#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samara/motion/motion_file.hpp"
#include "samara/scene/scene_simulation.hpp"
#include "samara/scene/terminal_speed.hpp"
#include "support/expect_error.hpp"
#include "support/known_bodies.hpp"
#include "support/obstacles.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using testing::AllOf;
using testing::HasSubstr;

bool go_on(double /*done*/, double /*total*/) {
    return true;
}

Body rubber() {
    Body body = test::rubber_ellipsoid();
    body.tables = test::blunt_tables(body, 4);
    return body;
}

Scene crowd(int count) {
    Scene scene;
    scene.duration = 1.0;
    SceneBody body = test::scene_body(1200.0);
    body.name = "rubber";
    body.count = count;
    body.orientation = Quaterniond(Eigen::AngleAxisd(-1.2, Vector3d::UnitY()));
    scene.bodies.push_back(body);
    return scene;
}

Motion flown(const Scene& scene, const Body& body, int threads = 1) {
    return simulate(scene, {LoadedBody(body, "hash")}, 1, go_on, threads).motion;
}

const Pose& last_pose(const Motion& motion, int copy) {
    return motion.pose(motion.bodies[0], 0, motion.frames() - 1, copy);
}

void expect_moves_like_a_file_of_twice_the_size(Scene scene, double tolerance) {
    scene.bodies[0].smallest_size = 1.0;
    scene.bodies[0].largest_size = 1.0;
    const Motion of_file = flown(scene, test::scaled(rubber(), 2.0));
    scene.bodies[0].smallest_size = 2.0;
    scene.bodies[0].largest_size = 2.0;
    const Motion of_size = flown(scene, rubber());
    ASSERT_EQ(of_size.bodies[0].sizes, std::vector<double>(2, 2.0));
    for (int copy = 0; copy < 2; ++copy) {
        const Pose& a = last_pose(of_file, copy);
        const Pose& b = last_pose(of_size, copy);
        EXPECT_LT((a.position - b.position).norm(), tolerance);
        EXPECT_LT((a.velocity - b.velocity).norm(), tolerance);
        EXPECT_LT(a.orientation.angularDistance(b.orientation), 1e-6 + 100.0 * tolerance);
    }
}

TEST(Crowd, ASizeOfTwoMovesLikeABodyFileOfTwiceTheSize) {
    expect_moves_like_a_file_of_twice_the_size(crowd(2), 1e-9);
}

TEST(Crowd, SoItDoesWithACentreOfMassBesideTheCentroid) {
    Body body = rubber();
    Scene scene = crowd(2);
    scene.bodies[0].mass = {};
    scene.bodies[0].mass.mass = 1200.0 * body.moments.volume;
    scene.bodies[0].mass.center_of_mass = Vector3d(0.001, 0.002, 0.003);
    scene.bodies[0].smallest_size = scene.bodies[0].largest_size = 2.0;
    const Motion of_size = flown(scene, body);
    scene.bodies[0].mass.mass = 8.0 * *scene.bodies[0].mass.mass;
    scene.bodies[0].mass.center_of_mass = Vector3d(0.002, 0.004, 0.006);
    scene.bodies[0].smallest_size = scene.bodies[0].largest_size = 1.0;
    const Motion of_file = flown(scene, test::scaled(body, 2.0));
    EXPECT_LT((last_pose(of_size, 1).position - last_pose(of_file, 1).position).norm(), 1e-9);
}

TEST(Crowd, WithAMassByAreaItHasTheThicknessOfTheShape) {
    // A file of twice the size has four times the area, and half of the density. Equal within the step's own
    // error: its weights of begin and end go by the inertia of the shape.
    Scene scene = crowd(2);
    scene.bodies[0].mass = {};
    scene.bodies[0].mass.area_density = 12.0;
    expect_moves_like_a_file_of_twice_the_size(scene, 2e-5);
    // At size 1 it is the density that has this mass.
    const Motion by_area = flown(scene, rubber());
    scene.bodies[0].mass = {};
    scene.bodies[0].mass.density = 12.0 * 0.5 * rubber().moments.surface_area / rubber().moments.volume;
    EXPECT_EQ(last_pose(flown(scene, rubber()), 1).position, last_pose(by_area, 1).position);
    // And a body of that density and twice the size, eight times as heavy, falls elsewhere.
    scene.bodies[0].smallest_size = scene.bodies[0].largest_size = 2.0;
    const Motion heavy = flown(scene, rubber());
    scene.bodies[0].mass = {};
    scene.bodies[0].mass.area_density = 12.0;
    EXPECT_GT((last_pose(flown(scene, rubber()), 1).position - last_pose(heavy, 1).position).norm(), 0.05);
}

TEST(Crowd, SoItDoesInTurbulenceOfTheTable) {
    Scene scene = crowd(2);
    scene.bodies[0].turbulence = Turbulence::table;
    scene.duration = 0.3;
    expect_moves_like_a_file_of_twice_the_size(scene, 1e-8);
}

TEST(Crowd, SoItDoesInConstantTurbulence) {
    Scene scene = crowd(2);
    scene.bodies[0].turbulence = Turbulence::constant;
    scene.bodies[0].turbulent_kinetic_energy = 1e-3;
    scene.bodies[0].dissipation_rate = 1e-3;
    scene.duration = 0.3;
    expect_moves_like_a_file_of_twice_the_size(scene, 1e-8);
}

TEST(Crowd, SoItDoesInAGustAndAWind) {
    Scene scene = crowd(2);
    scene.fluid.current = Vector3d(0.1, 0.0, 0.0);
    scene.fluid.gust = {.amplitude = Vector3d(0.2, 0.1, 0.0), .period = 0.7};
    WindVortex vortex;
    vortex.position = Vector3d(0.2, 0.0, 0.0);
    vortex.circulation = 0.3;
    vortex.core = 0.1;
    scene.wind.vortices.push_back(vortex);
    scene.duration = 0.3;
    expect_moves_like_a_file_of_twice_the_size(scene, 1e-8);
}

TEST(Crowd, SoItDoesOnTheGroundAndThereItLiesStill) {
    Scene scene = crowd(2);
    scene.ground = -0.2;
    scene.duration = 12.0;
    scene.step = 0.005;
    scene.bodies[0].smallest_size = scene.bodies[0].largest_size = 2.0;
    const Motion motion = flown(scene, rubber());
    // On its broad side, twice 1 cm above the ground, to 1 % of its longest radius.
    EXPECT_NEAR(last_pose(motion, 0).position.z(), -0.18, 8e-4);
    EXPECT_EQ(last_pose(motion, 0).velocity.norm(), 0.0);
    EXPECT_EQ(last_pose(motion, 0).position,
              motion.pose(motion.bodies[0], 0, motion.frames() - 30, 0).position);
}

TEST(Crowd, SizesLandOnAnObstacleAtTheirOwnHeights) {
    Scene scene = crowd(8);
    scene.duration = 10.0;
    scene.step = 0.005;
    scene.obstacles = {test::obstacle(test::sheet(4.0, 4.0), {.position = {0.0, 0.0, -0.2}})};
    scene.bodies[0].smallest_size = 0.5;
    scene.bodies[0].largest_size = 2.0;
    const Motion motion = flown(scene, rubber());
    for (int copy = 0; copy < 8; ++copy) {
        const double size = motion.bodies[0].size(0, copy);
        EXPECT_NEAR(last_pose(motion, copy).position.z(), -0.2 + 0.01 * size, 6e-4 * size);
    }
}

TEST(Crowd, SizesAreUniformInTheirLogarithmAndTheSameForASeed) {
    Scene scene = crowd(2000);
    scene.duration = 0.01;
    scene.bodies[0].smallest_size = 0.5;
    scene.bodies[0].largest_size = 2.0;
    const Motion motion = flown(scene, rubber());
    const std::vector<double>& sizes = motion.bodies[0].sizes;
    ASSERT_EQ(sizes.size(), 2000U);
    double sum = 0.0;
    double squares = 0.0;
    for (const double size : sizes) {
        EXPECT_TRUE(size >= 0.5 && size <= 2.0);
        sum += std::log2(size);
        squares += std::log2(size) * std::log2(size);
    }
    EXPECT_NEAR(sum / 2000.0, 0.0, 4.0 / std::sqrt(3.0 * 2000.0));
    EXPECT_NEAR(squares / 2000.0, 1.0 / 3.0, 0.03);
    EXPECT_EQ(flown(scene, rubber(), 2).bodies[0].sizes, sizes);
    scene.seed = 2;
    EXPECT_NE(flown(scene, rubber()).bodies[0].sizes, sizes);
}

TEST(Crowd, ThreadsAndAStateSavedOnTheWayDoNotChangeABit) {
    Scene scene = crowd(40);
    scene.bodies[0].turbulence = Turbulence::table;
    scene.bodies[0].smallest_size = 0.7;
    scene.bodies[0].largest_size = 1.4;
    scene.bodies[0].spread_start = 0.3;
    const LoadedBody body(rubber(), "hash");
    const auto made = [&](int threads) {
        Simulation simulation(simulation_settings(scene, 1, threads));
        simulation.add(body, scene.bodies[0], scene.bodies[0], "rubber");
        return simulation;
    };
    Simulation whole = made(1);
    whole.advance_to(0.8);
    Simulation first = made(3);
    first.advance_to(0.15);
    Simulation second = made(1);
    second.set_state(first.state());
    second.advance_to(0.8);
    for (std::size_t i = 0; i < 40; ++i) {
        EXPECT_EQ(whole.pose(i).position, second.pose(i).position);
        EXPECT_EQ(whole.pose(i).velocity, second.pose(i).velocity);
    }
    scene.seed = 2;  // other sizes and starts
    EXPECT_THROW(made(1).set_state(first.state()), SimulationError);
}

TEST(Crowd, CopiesWaitForTheirOwnStartAndThenMoveAsIfTheyHadNot) {
    Scene scene = crowd(30);
    scene.bodies[0].spread_start = 0.5;
    scene.frame_rate = 500.0;  // a frame for each step
    const Motion spread = flown(scene, rubber());
    scene.bodies[0].spread_start = 0.0;
    const Motion together = flown(scene, rubber());
    int latest = 0;
    for (int copy = 0; copy < 30; ++copy) {
        const Pose& start = spread.pose(spread.bodies[0], 0, 0, copy);
        int begin = 0;
        while (spread.pose(spread.bodies[0], 0, begin + 1, copy).position == start.position) ++begin;
        latest = std::max(latest, begin);
        for (int frame = begin; frame < spread.frames(); frame += 25) {
            const Pose& late = spread.pose(spread.bodies[0], 0, frame, copy);
            const Pose& early = together.pose(together.bodies[0], 0, frame - begin, copy);
            ASSERT_LT((late.position - early.position).norm(), 1e-12);
        }
    }
    EXPECT_GT(latest, 200);
    EXPECT_LE(latest, 250);
}

TEST(Crowd, ASizeBeyondTheTablesReynoldsNumbersIsRefusedWithTheSizesThatCanBeHad) {
    Scene scene = crowd(5);
    scene.file = "crowd.toml";
    const LoadedBody body(rubber(), "hash");
    scene.bodies[0].smallest_size = 0.8;
    scene.bodies[0].largest_size = 1.2;
    EXPECT_NO_THROW(require_sizes_in_tables(scene, scene.bodies[0], body));
    scene.bodies[0].largest_size = 100.0;
    EXPECT_THAT(test::error_of([&] { require_sizes_in_tables(scene, scene.bodies[0], body); }),
                AllOf(HasSubstr("crowd.toml: body 'rubber'"), HasSubstr("spread.size 100"),
                      HasSubstr("from 1e+03 to 1e+05"), HasSubstr("keep the sizes within"),
                      HasSubstr("bake this scene")));
    scene.bodies[0].largest_size = 1.2;
    scene.bodies[0].smallest_size = 0.001;
    EXPECT_THAT(test::error_of([&] { require_sizes_in_tables(scene, scene.bodies[0], body); }),
                HasSubstr("spread.size 0.001"));
}

TEST(Crowd, AMotionFileKeepsTheSizes) {
    const test::TemporaryFolder folder;
    Scene scene = crowd(6);
    scene.duration = 0.1;
    scene.bodies[0].smallest_size = 0.5;
    scene.bodies[0].largest_size = 2.0;
    const Motion motion = flown(scene, rubber());
    write_motion_file(folder.path() / "a.h5", motion);
    EXPECT_EQ(read_motion_file(folder.path() / "a.h5").bodies[0].sizes, motion.bodies[0].sizes);
    Motion wrong = motion;
    wrong.bodies[0].sizes[2] = -1.0;
    EXPECT_THAT(test::error_of([&] { write_motion_file(folder.path() / "b.h5", wrong); }),
                AllOf(HasSubstr("b.h5"), HasSubstr("size")));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "b.h5"));
}

}  // namespace
}  // namespace samara
