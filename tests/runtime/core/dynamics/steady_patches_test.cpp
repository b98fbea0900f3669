#include "samara/core/dynamics/steady_patches.hpp"

#include <algorithm>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "samara/core/dynamics/dynamic_coefficients.hpp"
#include "samara/core/surface/octahedral_map.hpp"
#include "support/known_bodies.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

/// The direction of entry i of the tables.
Vector3d direction_of(const LoadTables& tables, std::size_t i) {
    const std::vector<Vector3d> nodes = octahedral_nodes(tables.subdivisions);
    return tables.axes * nodes[i % nodes.size()];
}

TEST(SteadyPatches, ShareTheWholeBodysSteadyLoadsAmongThem) {
    const Body body = test::lopsided_shape();
    for (const int count : {2, 5, 8}) {
        const DividedSurface divided = divided_surface(body, *body.tables, count);
        ASSERT_EQ(divided.patches.size(), static_cast<std::size_t>(count));
        for (std::size_t i = 0; i < body.tables->entries.size(); ++i) {
            Vector3d sum = Vector3d::Zero();
            for (const SteadyPatch& patch : divided.patches) sum += patch.force[i];
            EXPECT_LT((sum - body.tables->entries[i].force).norm(), 1e-13);
        }
    }
}

TEST(SteadyPatches, EachHaveADragAndAForceOfTheirOwn) {
    const Body body = test::lopsided_shape();
    const DividedSurface divided = divided_surface(body, *body.tables, 6);
    double departure = 0.0;
    for (const SteadyPatch& patch : divided.patches) {
        for (std::size_t i = 0; i < patch.force.size(); ++i) {
            const Vector3d& whole = body.tables->entries[i].force;
            EXPECT_LT(patch.force[i].dot(direction_of(*body.tables, i)), 0.0);
            departure = std::max(departure, (patch.force[i] - patch.share * whole).norm());
        }
    }
    EXPECT_GT(departure, 0.02);
}

TEST(SteadyPatches, FeelTheirShareWhereTheBodyHoldsNoLoadsOfItsSurface) {
    Body body = test::lopsided_shape();
    body.surface_loads.reset();
    for (const SteadyPatch& patch : divided_surface(body, *body.tables, 4).patches) {
        EXPECT_TRUE(patch.force.empty());
        EXPECT_NEAR(patch.share, 0.25, 0.05);
    }
}

TEST(SteadyPatches, OfAPitchedPairOfWingsPushThemOppositeWays) {
    // Two flat wings along x, the one at x > 0 pitched by 30 degrees about x, the other by -30.
    const auto wing = [](double side) {
        const Matrix3d pitch = Eigen::AngleAxisd(side * std::numbers::pi / 6.0, Vector3d::UnitX()).matrix();
        return test::mapped(test::box({1.0, 0.5, 0.02}, 8), pitch, {0.6 * side, 0.0, 0.0});
    };
    const Surface wings = test::together({wing(1.0), wing(-1.0)});
    Body body;
    body.surface = wings;
    body.moments = test::moments_of(wings);
    body.surface_loads = test::made_up_surface_loads(wings, body.moments);
    const LoadTables tables = as_tables(*body.surface_loads, reference_length(body.moments.surface_area));
    const DividedSurface divided = divided_surface(body, tables, 2);
    const auto down = static_cast<std::size_t>(tables.map_size() * tables.map_size() - 1);  // a corner: -z
    ASSERT_LT((direction_of(tables, down) + Vector3d::UnitZ()).norm(), 1e-12);
    for (const SteadyPatch& patch : divided.patches) {
        // The face that looks down looks to -y on the right, to +y on the left, and is pushed off from there.
        EXPECT_LT(patch.force[down].y() * patch.place.x(), -0.01);
        EXPECT_GT(patch.force[down].z(), 0.1);
    }
}

TEST(SteadyPatches, LeaveLessAndLessOfTheTurningToTheCoefficients) {
    const Body body = test::lopsided_shape();
    double drag = 1.0;
    double reach = 1.0;
    for (const int count : {2, 8, 32}) {
        const DividedSurface divided = divided_surface(body, count);
        DynamicCoefficients turning;
        turning.rotational_drag = rotational_drag_tensor(body.surface, body.moments.centroid);
        turning.half_length = 1.0;
        const DynamicCoefficients left = within_patches(turning, divided);
        const double part = left.rotational_drag.trace() / turning.rotational_drag.trace();
        EXPECT_LT(part, 0.8 * drag);
        EXPECT_LT(left.half_length, 0.95 * reach);
        EXPECT_GE(Eigen::SelfAdjointEigenSolver<Matrix3d>(left.rotational_drag).eigenvalues().minCoeff(),
                  0.0);
        drag = part;
        reach = left.half_length;
    }
    const DividedSurface one = divided_surface(body, 1);
    EXPECT_NEAR(one.reach_within, 1.0, 1e-12);
    EXPECT_LT((one.rotation_within - Matrix3d::Identity()).norm(), 1e-6);
}

}  // namespace
}  // namespace samara
