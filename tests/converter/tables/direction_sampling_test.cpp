#include "converter/tables/direction_sampling.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "samara/core/base/error.hpp"
#include "samara/core/surface/octahedral_map.hpp"
#include "symmetry_groups.hpp"

namespace samara {
namespace {

TEST(RequiredDirections, ThreeMirrorsLeaveOneOctant) {
    const Symmetry box = test::box_symmetry();
    EXPECT_EQ(required_directions(box, 1).size(), 3U);
    EXPECT_EQ(required_directions(box, 2).size(), 6U);
    EXPECT_EQ(required_directions(box, 3).size(), 10U);
    EXPECT_EQ(required_directions(box, 4).size(), 15U);
    for (const Vector3d& direction : required_directions(box, 4)) EXPECT_GE(direction.minCoeff(), 0.0);
}

TEST(RequiredDirections, ABodyWithoutSymmetryNeedsEveryNodeOnce) {
    for (const int n : {1, 2, 3, 5}) {
        EXPECT_EQ(required_directions(Symmetry{}, n).size(), static_cast<std::size_t>(4 * n * n + 2));
    }
}

TEST(RequiredDirections, OneMirrorLeavesHalfTheNodesAndThoseOnIt) {
    // Of the 4 n^2 + 2 nodes, 4 n lie on a coordinate plane.
    constexpr int n = 3;
    const Symmetry symmetry = test::generated_by({Vector3d(1, -1, 1).asDiagonal()});
    EXPECT_EQ(required_directions(symmetry, n).size(), static_cast<std::size_t>((4 * n * n + 2 + 4 * n) / 2));
}

TEST(RequiredDirections, ASquarePrismNeedsHalfAnOctant) {
    // Swapping x and y pairs the 15 nodes of the octant but for the 3 on the plane x = y.
    const Symmetry symmetry = test::square_prism_symmetry();
    ASSERT_EQ(symmetry.elements.size(), 16U);
    EXPECT_EQ(required_directions(symmetry, 4).size(), 9U);
}

TEST(RequiredDirections, ACubeNeedsOneForEachPartitionOfTheSubdivisions) {
    // Orbits under all signed permutations: 4 = 4+0+0 = 3+1+0 = 2+2+0 = 2+1+1.
    const Symmetry symmetry = test::cube_symmetry();
    ASSERT_EQ(symmetry.elements.size(), 48U);
    EXPECT_EQ(required_directions(symmetry, 4).size(), 4U);
}

TEST(RequiredDirections, FivefoldRotationsMergeNoNodesBetweenNodes) {
    const double turn = 2.0 * std::numbers::pi / 5.0;
    const Symmetry symmetry =
        test::generated_by({Eigen::AngleAxisd(turn, Vector3d::UnitZ()).toRotationMatrix()});
    ASSERT_EQ(symmetry.elements.size(), 5U);
    EXPECT_EQ(required_directions(symmetry, 3).size(), 38U);
}

TEST(RequiredDirections, DoNotDependOnTheAxesOfTheShapeFile) {
    const Matrix3d axes = test::some_rotation();
    const Symmetry turned = test::turned(test::square_prism_symmetry(), axes);
    EXPECT_EQ(required_directions(turned, 5), required_directions(test::square_prism_symmetry(), 5));
}

TEST(RequiredDirections, SurviveTheRoundingOfSinglePrecisionShapes) {
    Symmetry symmetry = test::square_prism_symmetry();
    for (Matrix3d& element : symmetry.elements) {
        element = Eigen::AngleAxisd(3e-7, Vector3d(1, 2, 3).normalized()) * element;
    }
    EXPECT_EQ(required_directions(symmetry, 4), required_directions(test::square_prism_symmetry(), 4));
}

TEST(RequiredDirections, ASphereNeedsOne) {
    Symmetry symmetry;
    symmetry.type = Symmetry::Type::spherical;
    EXPECT_EQ(required_directions(symmetry, 8).size(), 1U);
}

TEST(RequiredDirections, AnAxialBodyNeedsAnArcFromItsAxisWhicheverColumnThatIs) {
    for (int column = 0; column < 3; ++column) {
        Symmetry symmetry;
        symmetry.type = Symmetry::Type::axial;
        symmetry.axes = test::some_rotation();
        symmetry.axis = symmetry.axes.col(column);
        const std::vector<Vector3d> cone = required_directions(symmetry, 4);
        ASSERT_EQ(cone.size(), 9U);
        for (std::size_t i = 0; i < cone.size(); ++i) {
            EXPECT_NEAR(std::acos(cone[i][column]), std::numbers::pi * static_cast<double>(i) / 8.0, 1e-12);
            EXPECT_NEAR(cone[i].norm(), 1.0, 1e-15);
        }
        EXPECT_EQ(cone.front(), Vector3d(Vector3d::Unit(column)));

        symmetry.elements.push_back(Matrix3d::Identity() - 2.0 * symmetry.axis * symmetry.axis.transpose());
        const std::vector<Vector3d> cylinder = required_directions(symmetry, 4);
        ASSERT_EQ(cylinder.size(), 5U);
        EXPECT_EQ(cylinder.back()[column], 0.0);
    }
}

TEST(RequiredDirections, NoSubdivisionsAreRejected) {
    EXPECT_THROW(required_directions(Symmetry{}, 0), Error);
}

TEST(NodeImages, EveryNodeIsTheImageOfARequiredDirection) {
    const Symmetry symmetry = test::square_prism_symmetry();
    constexpr int n = 4;
    const std::vector<Vector3d> required = required_directions(symmetry, n);
    const std::vector<NodeImage> images = node_images(symmetry, n);
    ASSERT_EQ(images.size(), 81U);
    for (int row = 0; row <= 2 * n; ++row) {
        for (int column = 0; column <= 2 * n; ++column) {
            const NodeImage& image =
                images[static_cast<std::size_t>(row) * (2 * n + 1) + static_cast<std::size_t>(column)];
            EXPECT_NE(std::find(required.begin(), required.end(), image.source), required.end());
            EXPECT_LT((image.element * image.source - octahedral_node(n, row, column)).norm(), 1e-15);
        }
    }
}

}  // namespace
}  // namespace samara
