// The terms that a body group may leave out of the equations, as a body of a scene may.

#include <cstddef>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "c_interface_calls.hpp"
#include "samara/scene/scene_simulation.hpp"

namespace samara {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

struct Models {
    const char* name;
    std::function<void(samara_body_group&)> of_kind;
    std::function<void(SceneBody&)> of_scene;
};

const std::vector<Models>& models() {
    static const std::vector<Models> all = {
        {"all of them", [](samara_body_group&) {}, [](SceneBody&) {}},
        {"no added mass", [](samara_body_group& group) { group.added_mass = 0; },
         [](SceneBody& body) { body.added_mass = false; }},
        {"coefficients by default",
         [](samara_body_group& group) { group.dynamic_coefficients = SAMARA_DYNAMIC_DEFAULT; },
         [](SceneBody& body) { body.dynamic = Dynamic::by_default; }},
        {"a steady tow's loads alone",
         [](samara_body_group& group) { group.dynamic_coefficients = SAMARA_DYNAMIC_NONE; },
         [](SceneBody& body) { body.dynamic = Dynamic::none; }},
        {"one Reynolds number", [](samara_body_group& group) { group.table_reynolds_number = 1e5; },
         [](SceneBody& body) { body.table_reynolds_number = 1e5; }},
        {"patches", [](samara_body_group& group) { group.patches = 8; },
         [](SceneBody& body) { body.patches = 8; }},
    };
    return all;
}

std::vector<samara_pose> flown(const BodyOnDisk& body, const Models& given) {
    samara_body_group group = rubber_group();
    given.of_kind(group);
    return poses_at(simulation_of(body, group), 0.5);
}

TEST(CModels, FlyAsTheSameKeysOfASceneDo) {
    const Body rubber = rubber_with_own_coefficients();
    const BodyOnDisk on_disk(rubber);
    for (const Models& given : models()) {
        SCOPED_TRACE(given.name);
        const samara_body_group group = rubber_group();
        Scene scene;
        scene.duration = 0.5;
        scene.frame_rate = 2.0;
        SceneBody body = test::scene_body(group.density);
        body.name = rubber.name;
        body.turbulence = Turbulence::table;
        const auto& q = group.orientation;
        body.orientation = Quaterniond(q[0], q[1], q[2], q[3]);
        given.of_scene(body);
        scene.bodies.push_back(body);
        const Motion motion =
            simulate(scene, {{rubber, "hash"}}, 1, [](double, double) { return true; }).motion;
        const Pose& expected = motion.pose(motion.bodies[0], 0, 1, 0);
        const samara_pose pose = flown(on_disk, given)[0];
        EXPECT_EQ(Vector3d(pose.velocity), expected.velocity);
        EXPECT_EQ(Vector3d(pose.angular_velocity), expected.angular_velocity);
        EXPECT_GT(expected.velocity.norm(), 0.05);
    }
}

TEST(CModels, EachIsAnotherMotionAndItsStateIsOfNoOther) {
    const BodyOnDisk body(rubber_with_own_coefficients());
    std::vector<std::vector<samara_pose>> motions;
    std::vector<std::string> states;
    for (const Models& given : models()) {
        samara_body_group group = rubber_group();
        given.of_kind(group);
        const SimulationPointer simulation = simulation_of(body, group);
        Text error;
        for (const std::string& other : states) {
            EXPECT_EQ(set_state(simulation, other, error), SAMARA_FOREIGN_STATE) << given.name;
        }
        motions.push_back(poses_at(simulation, 0.5));
        states.push_back(state_of(simulation));
        for (std::size_t i = 0; i + 1 < motions.size(); ++i) {
            EXPECT_FALSE(same_bytes(motions[i], motions.back())) << given.name << ", " << models()[i].name;
        }
    }
}

TEST(CModels, ABodyFlownByWhatItsFileRecommendsFliesAsIfThatWereGiven) {
    Body body = rubber_with_own_coefficients();
    samara_body_group group = rubber_group();
    group.patches = 8;
    group.turbulence = SAMARA_TURBULENCE_NONE;
    const std::vector<samara_pose> given = poses_at(simulation_of(BodyOnDisk(body), group), 0.5);
    body.recommended = RecommendedModels{.patches = 8, .turbulence = Turbulence::none};
    const BodyOnDisk on_disk(body);
    EXPECT_EQ(samara_body_recommended_loads(on_disk.get()), SAMARA_LOADS_TABLE);
    EXPECT_EQ(samara_body_recommended_loads(nullptr), SAMARA_LOADS_NONE);
    EXPECT_TRUE(same_bytes(poses_at(simulation_of(on_disk, rubber_group()), 0.5), given));
    group = rubber_group();
    group.patches = 1;
    group.turbulence = SAMARA_TURBULENCE_TABLE;
    EXPECT_TRUE(
        same_bytes(poses_at(simulation_of(on_disk, group), 0.5),
                   poses_at(simulation_of(BodyOnDisk(rubber_with_own_coefficients()), rubber_group()), 0.5)));
}

TEST(CModels, WithoutAddedMassABodyFileWithoutItFlies) {
    Body bare = rubber();
    bare.kirchhoff.reset();
    const BodyOnDisk body(bare);
    EXPECT_EQ(samara_body_has_added_mass(body.get()), 0);
    samara_body_group group = rubber_group();
    Text error;
    EXPECT_EQ(CALL(samara_simulation_add, empty_simulation().get(), body.get(), &group, nullptr),
              SAMARA_MISSING_DATA);
    EXPECT_THAT(error.text(), AllOf(HasSubstr("samara kirchhoff"), HasSubstr("added_mass to 0")));
    group.added_mass = 0;
    EXPECT_LT(poses_at(simulation_of(body, group), 0.5)[0].position[2], -0.02);
}

TEST(CModels, AReynoldsNumberForTablesThatAreNotReadIsRefused) {
    const BodyOnDisk body;
    samara_body_group group = rubber_group();
    group.table_reynolds_number = 1e4;
    group.loads = SAMARA_LOADS_COEFFICIENTS;
    Text error;
    EXPECT_EQ(CALL(samara_simulation_add, empty_simulation().get(), body.get(), &group, nullptr),
              SAMARA_INVALID_ARGUMENT);
    EXPECT_THAT(error.text(),
                StartsWith("table_reynolds_number applies only to loads or turbulence by table"));
    group.turbulence = SAMARA_TURBULENCE_TABLE;
    (void)simulation_of(body, group);
}

TEST(CModels, ACallerOfVersion1FliesWithAllOfThem) {
    const BodyOnDisk body(rubber_with_own_coefficients());
    constexpr std::size_t size_of_version_1 = offsetof(samara_body_group, table_reynolds_number);
    samara_body_group group;
    Text error;
    ASSERT_EQ(CALL(samara_default_body_group, &group, size_of_version_1), SAMARA_OK) << error.text();
    const samara_body_group now = rubber_group();
    std::memcpy(reinterpret_cast<char*>(&group) + sizeof group.size,
                reinterpret_cast<const char*>(&now) + sizeof now.size, size_of_version_1 - sizeof now.size);
    // What lies in its padding and behind its struct is not read.
    const std::size_t known = offsetof(samara_body_group, langevin) + sizeof group.langevin;
    std::memset(reinterpret_cast<char*>(&group) + known, 0x7f, sizeof group - known);
    EXPECT_TRUE(same_bytes(poses_at(simulation_of(body, group), 0.5), flown(body, models()[0])));
}

}  // namespace
}  // namespace samara
