#include "samara/core/physics/emitter.hpp"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samara/core/dynamics/surroundings.hpp"
#include "samara/core/simulation/world_pose.hpp"
#include "support/expect_error.hpp"
#include "support/obstacles.hpp"

namespace samara {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Release from(const Emitter& emitter) {
    Release release;
    release.count = 4000;
    release.emitter = std::make_shared<const Emitter>(emitter);
    return release;
}

Pose start_of(const Release& release, std::uint32_t copy) {
    return start_of_copy(release, 0.002, Noise(1, "leaf", 0, copy)).pose;
}

TEST(Emitter, StartsAreUniformOverTheAreaAndStandOffAlongTheNormal) {
    const Release release = from(make_emitter(test::obstacle(test::sheet(2.0, 1.0)), 0.05, 0.0));
    int left = 0;
    int corner = 0;
    for (std::uint32_t copy = 0; copy < 4000; ++copy) {
        const Vector3d place = start_of(release, copy).position;
        EXPECT_NEAR(std::abs(place.z()), 0.05, 1e-15);
        EXPECT_LE(std::abs(place.x()), 1.0);
        EXPECT_LE(std::abs(place.y()), 0.5);
        left += place.x() < 0.0 ? 1 : 0;
        corner += place.x() > 0.5 && place.y() > 0.25 ? 1 : 0;
    }
    EXPECT_NEAR(left, 2000, 4.0 * std::sqrt(1000.0));
    EXPECT_NEAR(corner, 250, 4.0 * std::sqrt(250.0));
}

TEST(Emitter, BodiesLeaveWithTheMotionOfTheirParentAndTheirOwnSpeed) {
    Obstacle mesh = test::obstacle(test::sheet(2.0, 1.0));
    mesh.keys = {
        {{}, 0.0},
        {{Vector3d(1.0, 0.0, 0.0), Quaterniond(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3d::UnitZ()))},
         2.0}};
    Release release = from(make_emitter(mesh, 0.0, 0.3));
    release.start = 1.0;
    const double turning = 0.25 * std::numbers::pi;
    for (std::uint32_t copy = 0; copy < 20; ++copy) {
        const Pose start = start_of(release, copy);
        const Vector3d arm = start.position - Vector3d(0.5, 0.0, 0.0);
        EXPECT_NEAR(start.velocity.x(), 0.5 - turning * arm.y(), 1e-12);
        EXPECT_NEAR(start.velocity.y(), turning * arm.x(), 1e-12);
        EXPECT_NEAR(std::abs(start.velocity.z()), 0.3, 1e-15);
        EXPECT_NEAR(start.angular_velocity.z(), turning, 1e-12);
        EXPECT_NEAR(start.orientation.angularDistance(Quaterniond::Identity()), 0.25 * std::numbers::pi,
                    1e-12);
    }
    release.start = 3.0;  // past the last key it stands
    EXPECT_NEAR(start_of(release, 0).velocity.head<2>().norm(), 0.0, 1e-15);
}

TEST(Emitter, KeysThatJumpAreRefused) {
    Obstacle mesh = test::obstacle(test::sheet(2.0, 1.0));
    mesh.keys = {{{}, 0.0}, {{Vector3d(1.0, 0.0, 0.0), Quaterniond::Identity()}, 0.001}};
    EXPECT_THAT(test::error_of([&] { make_emitter(mesh, 0.0, 0.0); }),
                AllOf(HasSubstr("are too fast: from 0 s to 0.001 s the mesh moves at 1e+03 m/s"),
                      HasSubstr("increase the time between")));
}

}  // namespace
}  // namespace samara
