// Backgrounds that play for ever.

#include "samara/export/loop.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/expect_error.hpp"
#include "synthetic_motion.hpp"

namespace samara {
namespace {

using testing::HasSubstr;

/// Two copies, one of them 0.3 s behind, of another size; two runs.
Motion crowd() {
    Motion motion = test::motion_of([](double) { return Pose{}; }, 2.5, 24.0);
    BodyMotion& body = motion.bodies[0];
    body.copies = 2;
    body.sizes = {1.0, 1.5, 0.7, 0.8};
    body.poses.clear();
    motion.runs = 2;
    for (int run = 0; run < 2; ++run) {
        for (const double time : motion.times) {
            for (int copy = 0; copy < 2; ++copy) body.poses.push_back(test::wander(time - 0.3 * copy + run));
        }
    }
    return motion;
}

TEST(Loop, BeginsEachPieceWithWhatTheOneBeforeEndedWith) {
    const Motion motion = crowd();
    const Motion loop = looped(motion, 1, 1.0);
    EXPECT_EQ(loop.frames(), 25);
    EXPECT_EQ(loop.runs, 1);
    const BodyMotion& body = loop.bodies[0];
    ASSERT_EQ(body.copies, 4) << "two pieces of a second in 2.5 s";
    for (int copy = 0; copy < 2; ++copy) {
        const Pose& end = loop.pose(body, 0, 24, copy);
        const Pose& begin = loop.pose(body, 0, 0, copy + 2);
        EXPECT_EQ(end.position, begin.position);
        EXPECT_EQ(end.orientation.coeffs(), begin.orientation.coeffs());
        EXPECT_EQ(end.angular_velocity, begin.angular_velocity);
        EXPECT_EQ(body.size(0, copy), motion.bodies[0].size(1, copy));
        EXPECT_EQ(body.size(0, copy + 2), motion.bodies[0].size(1, copy));
        for (int frame = 0; frame <= 24; ++frame) {
            EXPECT_EQ(loop.pose(body, 0, frame, copy).position,
                      motion.pose(motion.bodies[0], 1, frame, copy).position);
            EXPECT_EQ(loop.pose(body, 0, frame, copy + 2).position,
                      motion.pose(motion.bodies[0], 1, 24 + frame, copy).position);
        }
    }
}

TEST(Loop, OfTheWholeMotionIsTheMotion) {
    const Motion motion = crowd();
    const Motion loop = looped(motion, 0, 2.5);
    EXPECT_EQ(loop.frames(), motion.frames());
    EXPECT_EQ(loop.bodies[0].copies, 2);
}

TEST(Loop, NeedsWholeFramesWithinTheMotionAndObstaclesAtRest) {
    Motion motion = crowd();
    EXPECT_THAT(test::error_of([&] { return looped(motion, 0, 0.51); }),
                HasSubstr("is 12.24 frames at 24 frames per second"));
    EXPECT_THAT(test::error_of([&] { return looped(motion, 0, 3.0); }), HasSubstr("the motion lasts 2.5 s"));
    motion.obstacles = {{.name = "hand", .surface = {}, .keys = {{{}, 0.0}, {{Vector3d(0, 0, 1)}, 1.0}}}};
    EXPECT_THAT(test::error_of([&] { return looped(motion, 0, 1.0); }),
                HasSubstr("the obstacle 'hand' moves"));
}

}  // namespace
}  // namespace samara
