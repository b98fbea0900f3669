// The gap between two hulls: exact cases.

#include "samara/core/collision/hull_pair.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "samara/core/body/contact_points.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

/// A box of 4, 3 and 1 cm with its edges along the axes.
struct Box {
    ContactPoints points = contact_points(test::box({0.04, 0.03, 0.01}, 1), Vector3d::Zero());
    std::vector<HullFace> faces = hull_faces(points);

    [[nodiscard]] CollisionHull at(const Vector3d& position) const {
        return {{&points, Matrix3d::Identity(), position}, &faces};
    }
};

TEST(HullPair, ThePlaneBetweenBoxesHasTheirDistanceWhateverTheGuess) {
    const Box box;
    const CollisionHull first = box.at({0.005, 0.004, 0.012});
    const CollisionHull second = box.at(Vector3d::Zero());
    for (const Vector3d& guess :
         {Vector3d(0, 0, 1), Vector3d(0, 0, -1), Vector3d(1, 0.3, 0.1), between_middles(first, second)}) {
        const auto plane = plane_between(first, second, 1.0, guess);
        ASSERT_TRUE(plane);
        EXPECT_NEAR(plane->gap, 0.002, 1e-9) << guess.transpose();
        EXPECT_NEAR(plane->normal.z(), 1.0, 1e-9) << guess.transpose();
    }
}

TEST(HullPair, NoPlaneIsBetweenBoxesThatOverlapAndTheyDoSoLeastAlongAFace) {
    const Box box;
    const CollisionHull first = box.at({0.005, 0.004, 0.009});
    const CollisionHull second = box.at(Vector3d::Zero());
    EXPECT_FALSE(plane_between(first, second, 1.0, {1, 0, 0}));
    const PairSeparation apart = pair_separation(first, second, 1.0);
    EXPECT_TRUE(apart.overlap);
    EXPECT_NEAR(apart.gap, -0.001, 1e-9);
    EXPECT_NEAR(apart.normal.z(), 1.0, 1e-9);
}

TEST(HullPair, BoxesComeWithinTheirDistanceAndNoLess) {
    const Box box;
    const CollisionHull second = box.at(Vector3d::Zero());
    // Corner to corner: 3, 4 and 12 mm apart.
    const CollisionHull first = box.at({0.043, 0.034, 0.022});
    const double distance = std::sqrt(9.0 + 16.0 + 144.0) * 1e-3;
    EXPECT_TRUE(come_within(first, second, distance * (1.0 + 1e-6)));
    EXPECT_FALSE(come_within(first, second, distance * (1.0 - 1e-6)));
    EXPECT_TRUE(come_within(box.at({0.01, 0, 0.005}), second, 0.0));
}

}  // namespace
}  // namespace samara
