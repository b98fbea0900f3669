#include "samara/core/surface/octahedral_map.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace samara {
namespace {

TEST(OctahedralMap, DirectionOfCoordinatesIsTheInverse) {
    for (int i = 0; i < 200; ++i) {
        const double azimuth = 0.1 * i;
        const double height = -1.0 + 2.0 * (i + 0.5) / 200.0;
        const double radius = std::sqrt(1.0 - height * height);
        const Vector3d direction(radius * std::cos(azimuth), radius * std::sin(azimuth), height);
        EXPECT_LT((octahedral_direction(octahedral_coordinates(direction)) - direction).norm(), 1e-14);
    }
}

TEST(OctahedralMap, NodesOnOppositeHalvesOfAnEdgeAreTheSameDirection) {
    constexpr int n = 5;
    for (int i = 0; i <= 2 * n; ++i) {
        EXPECT_EQ(octahedral_node(n, 0, i), octahedral_node(n, 0, 2 * n - i));
        EXPECT_EQ(octahedral_node(n, 2 * n, i), octahedral_node(n, 2 * n, 2 * n - i));
        EXPECT_EQ(octahedral_node(n, i, 0), octahedral_node(n, 2 * n - i, 0));
        EXPECT_EQ(octahedral_node(n, i, 2 * n), octahedral_node(n, 2 * n - i, 2 * n));
    }
}

TEST(OctahedralMap, CentreAndCornersAreThePoles) {
    EXPECT_EQ(octahedral_node(3, 3, 3), Vector3d(0, 0, 1));
    EXPECT_EQ(octahedral_node(3, 0, 0), Vector3d(0, 0, -1));
    EXPECT_EQ(octahedral_node(3, 6, 6), Vector3d(0, 0, -1));
}

}  // namespace
}  // namespace samara
