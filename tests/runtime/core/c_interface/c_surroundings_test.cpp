// Obstacles, wind and ground of the C interface.
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "runtime/c_interface_calls.hpp"
#include "samara/core/simulation/simulation.hpp"
#include "samara/core/wind/wind_file.hpp"
#include "support/obstacles.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double half_height = 0.01;  // m, of the rubber ellipsoid, as it comes to lie

/// A mesh as a caller holds it, and the obstacle that points to it.
struct CallersObstacle {
    std::vector<double> vertices;
    std::vector<std::int32_t> triangles;
    samara_obstacle obstacle{};

    explicit CallersObstacle(const Surface& surface) {
        EXPECT_EQ(samara_default_obstacle(&obstacle, sizeof obstacle, nullptr, 0), SAMARA_OK);
        for (const Vector3d& vertex : surface.vertices) {
            vertices.insert(vertices.end(), vertex.begin(), vertex.end());
        }
        for (const auto& corners : surface.corners) {
            triangles.insert(triangles.end(), corners.begin(), corners.end());
        }
        obstacle.vertices = vertices.data();
        obstacle.vertex_count = vertices.size() / 3;
        obstacle.triangles = triangles.data();
        obstacle.triangle_count = triangles.size() / 3;
    }
    CallersObstacle(const CallersObstacle&) = delete;
    CallersObstacle& operator=(const CallersObstacle&) = delete;
};

samara_obstacle_key key_at(double time, double height, double angle = 0.0) {
    return {time, {0.0, 0.0, height}, {std::cos(0.5 * angle), 0.0, std::sin(0.5 * angle), 0.0}};
}

Surface table_top() {
    return box({0.5, 0.5, 0.05}, 2);
}

SimulationPointer simulation_with(const samara_obstacle& obstacle,
                                  const samara_settings& settings = default_settings()) {
    SimulationPointer simulation = empty_simulation(settings);
    Text error;
    EXPECT_EQ(CALL(samara_simulation_add_obstacle, simulation.get(), &obstacle, nullptr), SAMARA_OK)
        << error.text();
    return simulation;
}

/// Bodies that lie nearly flat, 2 cm over height 0.
samara_body_group lying_group() {
    samara_body_group group = rubber_group(6);
    group.orientation[0] = group.orientation[2] = std::sqrt(0.5);
    group.spread_angle = 0.1;
    group.position[2] = 0.03;
    group.turbulence = SAMARA_TURBULENCE_NONE;
    return group;
}

void add(const SimulationPointer& simulation, const BodyOnDisk& body, const samara_body_group& group) {
    Text error;
    ASSERT_EQ(CALL(samara_simulation_add, simulation.get(), body.get(), &group, nullptr), SAMARA_OK)
        << error.text();
}

void set_key(const SimulationPointer& simulation, const samara_obstacle_key& key) {
    Text error;
    ASSERT_EQ(CALL(samara_set_obstacle_keys, simulation.get(), 0, &key, 1), SAMARA_OK) << error.text();
}

void set_wind(const SimulationPointer& simulation, const char* wind) {
    Text error;
    ASSERT_EQ(CALL(samara_set_wind, simulation.get(), wind), SAMARA_OK) << error.text();
}

/// The poses of the same bodies in a simulation with these settings.
std::vector<Vector3d> velocities_in(const SimulationSettings& settings, const BodyOnDisk& body,
                                    const samara_body_group& group, double time) {
    Simulation simulation(settings);
    BodyPhysics physics;
    physics.mass.density = group.density;
    physics.turbulence = Turbulence::none;
    Release release{.position = Vector3d(group.position),
                    .orientation = Quaterniond(group.orientation[0], 0.0, group.orientation[2], 0.0),
                    .count = static_cast<int>(group.count),
                    .spread_position = Vector3d(group.spread_position),
                    .spread_angle = group.spread_angle};
    simulation.add(load_body_file(body.file()), physics, release);
    simulation.advance_to(time);
    std::vector<Vector3d> velocities;
    for (std::size_t i = 0; i < simulation.size(); ++i) velocities.push_back(simulation.pose(i).velocity);
    return velocities;
}

std::vector<Vector3d> velocities_of(const std::vector<samara_pose>& poses) {
    std::vector<Vector3d> velocities;
    for (const samara_pose& pose : poses) velocities.emplace_back(pose.velocity);
    return velocities;
}

TEST(CObstacle, IsMetAsTheFlightsOwn) {
    const BodyOnDisk body;
    CallersObstacle slope(table_top());
    slope.obstacle.friction = 0.2;
    slope.obstacle.position[2] = -0.08;
    slope.obstacle.orientation[0] = 2.0;  // made one of length one
    slope.obstacle.orientation[2] = 0.4;
    const SimulationPointer simulation = simulation_with(slope.obstacle);
    EXPECT_EQ(samara_simulation_obstacle_count(simulation.get()), 1U);
    add(simulation, body, lying_group());
    SimulationSettings settings;
    settings.obstacles = {obstacle(
        table_top(), {Vector3d(0.0, 0.0, -0.08), Quaterniond(2.0, 0.0, 0.4, 0.0).normalized()}, 0.2)};
    const auto poses = poses_at(simulation, 0.6);
    EXPECT_EQ(velocities_of(poses), velocities_in(settings, body, lying_group(), 0.6));
    EXPECT_NE(velocities_of(poses), velocities_in({}, body, lying_group(), 0.6)) << "they touched it";
}

TEST(CObstacle, MovesByTheKeysItWasGiven) {
    const BodyOnDisk body;
    CallersObstacle lift(table_top());
    const std::vector<samara_obstacle_key> keys = {key_at(0.0, -0.1), key_at(1.0, 0.1, 0.2)};
    lift.obstacle.keys = keys.data();
    lift.obstacle.key_count = keys.size();
    const SimulationPointer simulation = simulation_with(lift.obstacle);
    add(simulation, body, lying_group());
    SimulationSettings settings;
    settings.obstacles = {obstacle(table_top())};
    settings.obstacles[0].keys = {
        {{Vector3d(0.0, 0.0, -0.1), Quaterniond::Identity()}, 0.0},
        {{Vector3d(0.0, 0.0, 0.1), Quaterniond(std::cos(0.1), 0.0, std::sin(0.1), 0.0)}, 1.0}};
    EXPECT_EQ(velocities_of(poses_at(simulation, 0.9)), velocities_in(settings, body, lying_group(), 0.9));
}

TEST(CObstacle, CarriesBodiesWhereAnEngineMovesItFrameByFrame) {
    const BodyOnDisk body;
    CallersObstacle lift(table_top());
    lift.obstacle.position[2] = -0.025;  // its top at 0
    const SimulationPointer simulation = simulation_with(lift.obstacle);
    add(simulation, body, lying_group());
    poses_at(simulation, 2.0);
    for (int frame = 1; frame <= 100; ++frame) {
        const double time = 2.0 + frame / 60.0;
        set_key(simulation, key_at(time, -0.025 + 0.002 * frame));
        for (const samara_pose& pose : poses_at(simulation, time)) {
            // They may rock, but neither sink into it nor stay behind.
            EXPECT_GT(pose.position[2], 0.002 * frame + half_height - 2e-4) << "frame " << frame;
            EXPECT_LT(pose.position[2], 0.002 * frame + 2.0 * half_height) << "frame " << frame;
        }
    }
    // Behind its key it stands, and so do they.
    for (const samara_pose& pose : poses_at(simulation, 5.0)) {
        EXPECT_NEAR(pose.position[2], 0.2 + half_height, 2e-3);
        EXPECT_LT(Vector3d(pose.velocity).norm(), 0.02) << "but for some rocking";
    }
    // It sinks faster than they fall in water, and they follow.
    set_key(simulation, key_at(5.1, -0.425));
    for (const samara_pose& pose : poses_at(simulation, 5.2)) EXPECT_GT(pose.position[2], 0.0);
    for (const samara_pose& pose : poses_at(simulation, 9.0))
        EXPECT_NEAR(pose.position[2], -0.4 + half_height, 2e-3);
}

TEST(CObstacle, ThatIsMovedInFlightIsInTheState) {
    const BodyOnDisk body;
    CallersObstacle lift(table_top());
    lift.obstacle.position[2] = -0.025;
    const SimulationPointer simulation = simulation_with(lift.obstacle);
    add(simulation, body, lying_group());
    poses_at(simulation, 0.501);
    const std::string before = state_of(simulation);
    set_key(simulation, key_at(1.0, 0.1, 0.3));
    poses_at(simulation, 0.7013);
    const std::string state = state_of(simulation);
    EXPECT_GT(state.size(), before.size());
    const auto poses = poses_at(simulation, 1.5);
    Text error;
    const SimulationPointer other = simulation_with(lift.obstacle);
    add(other, body, lying_group());
    for (const SimulationPointer& one : {std::cref(simulation), std::cref(other)}) {
        EXPECT_EQ(set_state(one, state, error), SAMARA_OK) << error.text();
        poses_at(one, 0.8);
        EXPECT_TRUE(same_bytes(poses_at(one, 1.5), poses));
    }
    // From before, it is moved otherwise.
    EXPECT_EQ(set_state(simulation, before, error), SAMARA_OK) << error.text();
    EXPECT_FALSE(same_bytes(poses_at(simulation, 1.5), poses));
    // One with another shape is another simulation.
    CallersObstacle larger(box({0.5, 0.5, 0.06}, 2));
    larger.obstacle.position[2] = -0.03;
    const SimulationPointer foreign = simulation_with(larger.obstacle);
    add(foreign, body, lying_group());
    EXPECT_EQ(set_state(foreign, before, error), SAMARA_FOREIGN_STATE);
}

TEST(CObstacle, OutOfRangeIsRefusedByName) {
    using Change = void (*)(samara_obstacle&);
    static const samara_obstacle_key unordered[] = {key_at(1.0, 0.0), key_at(1.0, 1.0)};
    static const samara_obstacle_key jumping[] = {key_at(1.0, 0.0), key_at(1.01, 2.0)};
    static const samara_obstacle_key endless[] = {key_at(not_a_number, 0.0)};
    static const std::int32_t far_corners[] = {0, 1, 5000};
    const std::vector<std::pair<const char*, Change>> changes = {
        {"obstacle.size", [](samara_obstacle& o) { o.size = 8; }},
        {"name", [](samara_obstacle& o) { o.name = "a roof"; }},
        {"friction", [](samara_obstacle& o) { o.friction = -0.1; }},
        {"position", [](samara_obstacle& o) { o.position[1] = not_a_number; }},
        {"orientation", [](samara_obstacle& o) { o.orientation[0] = 0.0; }},
        {"vertices", [](samara_obstacle& o) { o.vertices = nullptr; }},
        {"triangles", [](samara_obstacle& o) { o.triangles = nullptr; }},
        {"triangle_count", [](samara_obstacle& o) { o.triangle_count = 1'000'000'000'000; }},
        {"keys", [](samara_obstacle& o) { o.key_count = 2; }},
        {"keys of obstacle 'obstacle-0' are out of order: the time of key 1",
         [](samara_obstacle& o) { o.keys = unordered, o.key_count = 2; }},
        {"time", [](samara_obstacle& o) { o.keys = endless, o.key_count = 1; }},
        {"keys of obstacle 'obstacle-0' are too fast: from 1 s to 1.01 s",
         [](samara_obstacle& o) { o.keys = jumping, o.key_count = 2; }},
        {"obstacle 'obstacle-0' is not a valid surface",
         [](samara_obstacle& o) { o.triangles = far_corners, o.triangle_count = 1; }},
        {"obstacle 'obstacle-0' is not a valid surface", [](samara_obstacle& o) { o.triangle_count = 0; }},
    };
    const SimulationPointer simulation = empty_simulation();
    for (const auto& [member, change] : changes) {
        CallersObstacle given(table_top());
        change(given.obstacle);
        Text error;
        EXPECT_EQ(CALL(samara_simulation_add_obstacle, simulation.get(), &given.obstacle, nullptr),
                  SAMARA_INVALID_ARGUMENT)
            << member;
        EXPECT_THAT(error.text(), StartsWith(member));
    }
    EXPECT_EQ(samara_simulation_obstacle_count(simulation.get()), 0U);
}

TEST(CObstacle, HasANameOfItsOwnAndBodiesStartAndAreOutsideOfIt) {
    const BodyOnDisk body;
    CallersObstacle top(table_top());
    top.obstacle.name = "table";
    const SimulationPointer simulation = simulation_with(top.obstacle);
    Text error;
    EXPECT_EQ(CALL(samara_simulation_add_obstacle, simulation.get(), &top.obstacle, nullptr),
              SAMARA_INVALID_ARGUMENT);
    EXPECT_THAT(error.text(), HasSubstr("already has the name 'table'"));
    samara_body_group group = lying_group();
    group.position[2] = 0.02;
    EXPECT_EQ(CALL(samara_simulation_add, simulation.get(), body.get(), &group, nullptr),
              SAMARA_INVALID_ARGUMENT);
    EXPECT_THAT(error.text(), HasSubstr("inside obstacle 'table'"));
    group.position[2] = 0.1;
    add(simulation, body, group);
    top.obstacle.name = "shelf";
    top.obstacle.position[2] = 0.1;
    EXPECT_EQ(CALL(samara_simulation_add_obstacle, simulation.get(), &top.obstacle, nullptr),
              SAMARA_INVALID_ARGUMENT);
    EXPECT_THAT(error.text(), HasSubstr("is inside obstacle 'shelf'"));
    EXPECT_EQ(samara_simulation_obstacle_count(simulation.get()), 1U);
}

TEST(CObstacle, ThatIsAddedInFlightBearsBodiesAndLetsThemFallOnceItIsRemoved) {
    const BodyOnDisk body;
    const SimulationPointer simulation = empty_simulation();
    samara_body_group group = lying_group();
    group.position[2] = 0.3;
    add(simulation, body, group);
    Text error;
    const auto advance = [&](double time) { CALL(samara_advance_to, simulation.get(), time); };
    const auto lowest = [&] {
        samara_pose poses[6];
        EXPECT_EQ(CALL(samara_get_poses, simulation.get(), 0, 6, poses, 0), SAMARA_OK);
        double height = 1.0;
        for (const samara_pose& pose : poses) height = std::min(height, pose.position[2]);
        return height;
    };
    advance(0.1);
    CallersObstacle top(table_top());
    std::size_t number = 7;
    ASSERT_EQ(CALL(samara_simulation_add_obstacle, simulation.get(), &top.obstacle, &number), SAMARA_OK)
        << error.text();
    EXPECT_EQ(number, 0U);
    advance(4.0);
    EXPECT_GT(lowest(), 0.025);
    ASSERT_EQ(CALL(samara_remove_obstacle, simulation.get(), 0), SAMARA_OK) << error.text();
    advance(5.0);
    EXPECT_LT(lowest(), -0.1);
    EXPECT_EQ(CALL(samara_remove_obstacle, simulation.get(), 0), SAMARA_INVALID_ARGUMENT);
    EXPECT_THAT(error.text(), HasSubstr("is removed"));
    EXPECT_EQ(CALL(samara_remove_obstacle, simulation.get(), 1), SAMARA_INVALID_ARGUMENT);
    // Its name is free again, and it has a number of its own.
    top.obstacle.name = "obstacle-0";
    ASSERT_EQ(CALL(samara_simulation_add_obstacle, simulation.get(), &top.obstacle, &number), SAMARA_OK)
        << error.text();
    EXPECT_EQ(number, 1U);
}

TEST(CObstacle, ThatWasRemovedIsPartOfAState) {
    const BodyOnDisk body;
    const CallersObstacle top(table_top());
    const SimulationPointer one = simulation_with(top.obstacle);
    const SimulationPointer other = simulation_with(top.obstacle);
    samara_body_group group = lying_group();
    group.position[2] = 0.1;
    for (const SimulationPointer* simulation : {&one, &other}) add(*simulation, body, group);
    Text error;
    std::vector<char> state(samara_state_size(one.get()));
    ASSERT_EQ(CALL(samara_get_state, one.get(), state.data(), state.size()), SAMARA_OK);
    EXPECT_EQ(CALL(samara_set_state, other.get(), state.data(), state.size()), SAMARA_OK);
    ASSERT_EQ(CALL(samara_remove_obstacle, other.get(), 0), SAMARA_OK);
    EXPECT_NE(CALL(samara_set_state, other.get(), state.data(), state.size()), SAMARA_OK);
}

TEST(CObstacle, IsMovedByItsNumberAndByKeysInOrder) {
    const CallersObstacle top(table_top());
    const SimulationPointer simulation = simulation_with(top.obstacle);
    samara_obstacle_key keys[] = {key_at(1.0, 0.0), key_at(0.5, 0.0)};
    Text error;
    const auto set = [&](std::size_t obstacle, const samara_obstacle_key* given, std::size_t count) {
        return CALL(samara_set_obstacle_keys, simulation.get(), obstacle, given, count);
    };
    EXPECT_EQ(set(1, keys, 1), SAMARA_INVALID_ARGUMENT);
    EXPECT_THAT(error.text(), StartsWith("obstacle is 1"));
    EXPECT_EQ(set(0, keys, 2), SAMARA_INVALID_ARGUMENT);
    EXPECT_THAT(error.text(), StartsWith("keys are out of order: the time of key 1"));
    EXPECT_EQ(set(0, keys, 0), SAMARA_INVALID_ARGUMENT);
    EXPECT_EQ(set(0, nullptr, 1), SAMARA_INVALID_ARGUMENT);
    keys[0].orientation[0] = 0.0;
    EXPECT_EQ(set(0, keys, 1), SAMARA_INVALID_ARGUMENT);
    EXPECT_THAT(error.text(), StartsWith("orientation"));
    EXPECT_EQ(CALL(samara_set_obstacle_keys, nullptr, 0, keys, 1), SAMARA_INVALID_ARGUMENT);
}

TEST(CSetWind, BlowsAsTheFlightsOwn) {
    const BodyOnDisk body;
    const SimulationPointer simulation = empty_simulation();
    set_wind(simulation,
             "velocity = [0.2, 0, 0]\nprofile = { law = \"log\", height = 2 }\ngusts = { rms = 0.1, length = "
             "0.5 }\n"
             "[[fan]]\nposition = [-1, 0, 0]\ndirection = [1, 0, 0]\nspeed = 0.5\n");
    add(simulation, body, lying_group());
    SimulationSettings settings;
    settings.wind.velocity = Vector3d(0.2, 0.0, 0.0);
    settings.wind.profile = WindProfile{.height = 2.0};
    settings.wind.gusts = WindGusts{.rms = 0.1, .length = 0.5};
    settings.wind.fans = {{.position = Vector3d(-1.0, 0.0, 0.0), .speed = 0.5}};
    EXPECT_EQ(velocities_of(poses_at(simulation, 0.4)), velocities_in(settings, body, lying_group(), 0.4));
}

TEST(CSetWind, TakesAFileThatNeedNotLast) {
    const BodyOnDisk body;
    const test::TemporaryFolder folder;
    WindGrid grid;
    grid.frames = 2;
    grid.interval = 0.05;
    grid.velocities.assign(grid.size(), 0.2F);
    write_wind_file(folder / "gust.h5", grid);
    const std::string text = "[file]\npath = \"" + (folder / "gust.h5").string() + "\"";
    const SimulationPointer simulation = empty_simulation();
    set_wind(simulation, text.c_str());
    add(simulation, body, lying_group());
    SimulationSettings settings;
    settings.wind.file.emplace().grid = std::make_shared<const WindGrid>(read_wind_file(folder / "gust.h5"));
    const auto velocities = velocities_of(poses_at(simulation, 0.4));
    EXPECT_EQ(velocities, velocities_in(settings, body, lying_group(), 0.4));
    EXPECT_NE(velocities, velocities_in({}, body, lying_group(), 0.4));
}

TEST(CSetWind, ChangesInFlightWithoutAJumpOfTheBodies) {
    const BodyOnDisk body;
    const SimulationPointer simulation = simulation_of(body, lying_group());
    const auto before = poses_at(simulation, 1.0013);
    set_wind(simulation, "velocity = [0.5, 0, 0]");
    const auto after = poses_of(simulation);
    for (std::size_t i = 0; i < before.size(); ++i) {
        EXPECT_LT((Vector3d(after[i].position) - Vector3d(before[i].position)).norm(), 1e-9);
        EXPECT_LT((Vector3d(after[i].velocity) - Vector3d(before[i].velocity)).norm(), 1e-4);
    }
    for (const samara_pose& pose : poses_at(simulation, 4.0)) EXPECT_NEAR(pose.velocity[0], 0.5, 0.1);
    const std::string windy = state_of(simulation);
    set_wind(simulation, "");
    Text error;
    EXPECT_EQ(set_state(simulation, windy, error), SAMARA_FOREIGN_STATE) << "of another wind";
    for (const samara_pose& pose : poses_at(simulation, 8.0)) EXPECT_NEAR(pose.velocity[0], 0.0, 0.1);
    set_wind(simulation, "velocity = [0.5, 0, 0]");
    EXPECT_EQ(set_state(simulation, windy, error), SAMARA_OK);
}

TEST(CSetWind, IsRefusedWithTheLineAtError) {
    const SimulationPointer simulation = empty_simulation();
    Text error;
    for (const auto& [text, what] : std::vector<std::pair<const char*, const char*>>{
             {"velocity = [1, 0, 0]\nspeed = 3", "wind:2: unknown key 'speed'"},
             {"velocity = [1, 0]", "wind:1: velocity"},
             {"velocity = 1 2", "wind:1: "},
             {"gusts = { length = 1 }", "rms"}}) {
        EXPECT_EQ(CALL(samara_set_wind, simulation.get(), text), SAMARA_INVALID_ARGUMENT);
        EXPECT_THAT(error.text(), AllOf(StartsWith("wind:"), HasSubstr(what)));
    }
    EXPECT_EQ(CALL(samara_set_wind, simulation.get(), nullptr), SAMARA_INVALID_ARGUMENT);
    EXPECT_EQ(CALL(samara_set_wind, nullptr, ""), SAMARA_INVALID_ARGUMENT);
}

TEST(CSetGround, LiftsAndDropsWhatLiesOnIt) {
    const BodyOnDisk body;
    samara_settings settings = default_settings();
    settings.has_ground = 1;
    const SimulationPointer simulation = simulation_of(body, lying_group(), settings);
    const auto expect_lying_at = [&](double height, double time) {
        for (const samara_pose& pose : poses_at(simulation, time)) {
            EXPECT_NEAR(pose.position[2], height + half_height, 2e-3);
            EXPECT_LT(Vector3d(pose.velocity).norm(), 0.02) << "but for some rocking";
        }
    };
    const auto set_ground = [&](int has, double height) {
        Text error;
        return CALL(samara_set_ground, simulation.get(), has, height);
    };
    expect_lying_at(0.0, 3.0);
    EXPECT_EQ(set_ground(1, -0.2), SAMARA_OK);
    expect_lying_at(-0.2, 6.0);
    EXPECT_EQ(set_ground(1, 0.1), SAMARA_OK);
    expect_lying_at(0.1, 8.0);
    EXPECT_EQ(set_ground(0, 0.0), SAMARA_OK);
    for (const samara_pose& pose : poses_at(simulation, 10.0)) EXPECT_LT(pose.position[2], -0.2);
    EXPECT_EQ(set_ground(1, not_a_number), SAMARA_INVALID_ARGUMENT);
}

TEST(CSimulation, TakesBodiesInFlightThatStartNowOrLater) {
    const BodyOnDisk body;
    const SimulationPointer simulation = simulation_of(body, rubber_group(3));
    poses_at(simulation, 1.0);
    samara_body_group group = rubber_group(2);
    group.name = "late";
    Text error;
    EXPECT_EQ(CALL(samara_simulation_add, simulation.get(), body.get(), &group, nullptr),
              SAMARA_INVALID_ARGUMENT);
    EXPECT_THAT(error.text(), HasSubstr("the simulation is at 1 s"));
    group.start = 1.0;
    std::size_t first = 0;
    ASSERT_EQ(CALL(samara_simulation_add, simulation.get(), body.get(), &group, &first), SAMARA_OK);
    EXPECT_EQ(first, 3U);
    const auto poses = poses_at(simulation, 1.5);
    ASSERT_EQ(poses.size(), 5U);
    // As if they had been there from the beginning.
    const SimulationPointer other = simulation_of(body, rubber_group(3));
    add(other, body, group);
    EXPECT_TRUE(same_bytes(poses_at(other, 1.5), poses));
}

}  // namespace
}  // namespace samara
