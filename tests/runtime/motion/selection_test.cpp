#include "samara/motion/selection.hpp"

#include <gtest/gtest.h>

#include "synthetic_motion.hpp"

namespace samara {
namespace {

/// Two runs of five wandering copies of a leaf in five sizes, a seed and a roof.
Motion leaves_seed_and_roof() {
    Motion motion = test::motion_of(test::wander, 0.1);
    motion.bodies.push_back(motion.bodies[0]);
    motion.bodies[0].name = "seed";
    motion.bodies[1].name = "leaf";
    motion.runs = 2;
    BodyMotion& leaf = motion.bodies[1];
    leaf.copies = 5;
    leaf.poses.clear();
    for (int i = 0; i < 2 * motion.frames() * 5; ++i) leaf.poses.push_back(test::wander(0.1 * i));
    leaf.sizes = {1.0, 1.1, 1.2, 1.3, 1.4, 2.0, 2.1, 2.2, 2.3, 2.4};
    motion.bodies[0].poses.resize(static_cast<std::size_t>(2 * motion.frames()));
    motion.obstacles = {{.name = "roof", .surface = {}, .keys = {{}}}};
    return motion;
}

TEST(Selection, TakesTheNamedBodiesAndObstaclesInTheMotionsOrder) {
    const Motion both = selected(leaves_seed_and_roof(), {"roof", "leaf", "seed"}, std::nullopt);
    ASSERT_EQ(both.bodies.size(), 2U);
    EXPECT_EQ(both.bodies[0].name, "seed");
    EXPECT_EQ(both.obstacles.size(), 1U);
    const Motion leaf = selected(leaves_seed_and_roof(), {"leaf"}, std::nullopt);
    ASSERT_EQ(leaf.bodies.size(), 1U);
    EXPECT_EQ(leaf.bodies[0].copies, 5);
    EXPECT_TRUE(leaf.obstacles.empty());
    EXPECT_EQ(selected(leaves_seed_and_roof(), {}, std::nullopt).obstacles.size(), 1U);
}

TEST(Selection, CopiesKeepTheirPosesAndSizesInAllRuns) {
    const Motion all = leaves_seed_and_roof();
    const Motion part = selected(all, {"leaf"}, CopyRange{1, 3});
    const BodyMotion& leaf = part.bodies[0];
    ASSERT_EQ(leaf.copies, 3);
    ASSERT_EQ(leaf.poses.size(), static_cast<std::size_t>(2 * all.frames() * 3));
    for (int run = 0; run < 2; ++run) {
        for (int copy = 0; copy < 3; ++copy) {
            EXPECT_EQ(leaf.size(run, copy), all.bodies[1].size(run, copy + 1));
            for (int frame = 0; frame < all.frames(); ++frame) {
                EXPECT_EQ(part.pose(leaf, run, frame, copy).position,
                          all.pose(all.bodies[1], run, frame, copy + 1).position);
            }
        }
    }
}

}  // namespace
}  // namespace samara
