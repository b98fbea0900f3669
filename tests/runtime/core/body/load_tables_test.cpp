#include "samara/core/body/load_tables.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "samara/core/body/body_file.hpp"
#include "samara/core/body/planned_region.hpp"
#include "samara/core/surface/octahedral_map.hpp"
#include "samara/scene/table_errors_on_path.hpp"
#include "support/known_bodies.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

double difference(const LoadEntry& a, const LoadEntry& b) {
    return (a.force - b.force).norm() + (a.moment - b.moment).norm() +
           std::abs(a.turbulent_kinetic_energy - b.turbulent_kinetic_energy) +
           std::abs(a.dissipation_rate - b.dissipation_rate);
}

TEST(LoadTables, LookUpGivesTheEntryAtEachNode) {
    const LoadTables tables = test::smooth_tables(3);
    for (int reynolds = 0; reynolds < 3; ++reynolds) {
        for (int row = 0; row < tables.map_size(); ++row) {
            for (int column = 0; column < tables.map_size(); ++column) {
                const Vector3d direction = tables.axes * octahedral_node(3, row, column);
                const LoadEntry found =
                    look_up(tables, direction, tables.reynolds_numbers[static_cast<std::size_t>(reynolds)]);
                EXPECT_LT(difference(found, tables.entries[tables.index(reynolds, row, column)]), 1e-12);
            }
        }
    }
}

TEST(LoadTables, OfOneReynoldsNumberAreTheWholeOnesThere) {
    const LoadTables tables = test::smooth_tables(4);
    const std::vector<double>& numbers = tables.reynolds_numbers;
    const double between = std::sqrt(numbers[0] * numbers[1]);
    for (const double reynolds : {numbers.front(), between, numbers[1], numbers.back()}) {
        const LoadTables one = at_reynolds_number(tables, reynolds);
        ASSERT_EQ(one.reynolds_numbers, std::vector<double>{reynolds});
        for (int i = 0; i < 50; ++i) {
            const Vector3d direction = Vector3d(std::cos(i), std::sin(2.3 * i), 0.02 * i - 0.5).normalized();
            EXPECT_LT(difference(look_up(one, direction, 7.0), look_up(tables, direction, reynolds)), 1e-12);
            EXPECT_LT(
                difference(look_up_error(one, direction, 7.0), look_up_error(tables, direction, reynolds)),
                1e-12);
        }
    }
    EXPECT_EQ(at_reynolds_number(tables, 0.1 * numbers.front()).reynolds_numbers.front(), numbers.front());
    EXPECT_EQ(at_reynolds_number(tables, 10.0 * numbers.back()).reynolds_numbers.front(), numbers.back());
}

TEST(LoadTables, LookUpIsContinuousOverSeamsAndPoles) {
    const LoadTables tables = test::smooth_tables(4);
    constexpr double step = 1e-7;
    double greatest = 0.0;
    for (int i = 0; i < 20000; ++i) {
        // Great circles through both poles and over the seams, in the map's axes.
        const double angle = 2.0 * 3.14159265358979 * i / 20000.0;
        const double azimuth = 0.37 * (i % 17);
        const Vector3d level(std::cos(azimuth), std::sin(azimuth), 0.0);
        const auto at = [&](double place) {
            const Vector3d direction = std::cos(place) * level + std::sin(place) * Vector3d::UnitZ();
            return look_up(tables, tables.axes * direction, 70.0);
        };
        greatest = std::max(greatest, difference(at(angle), at(angle + step)));
    }
    EXPECT_LT(greatest, 100.0 * step);
}

TEST(LoadTables, LookUpIsContinuousWhereTheMapFolds) {
    const LoadTables tables = test::smooth_tables(4);
    for (int i = 0; i < 400; ++i) {
        const double azimuth = 0.0157 * i;
        for (const double height : {0.0, -0.3, -0.999}) {
            const double radius = std::sqrt(1.0 - height * height);
            const auto at = [&](double a, double z) {
                return look_up(
                    tables,
                    tables.axes * Vector3d(radius * std::cos(a), radius * std::sin(a), z).normalized(),
                    500.0);
            };
            EXPECT_LT(difference(at(azimuth, height + 1e-9), at(azimuth, height - 1e-9)), 1e-6);
            // The seams of the lower half lie in the planes x = 0 and y = 0.
            const double seam = 0.5 * 3.14159265358979323846 * (i % 4);
            EXPECT_LT(difference(at(seam + 1e-9, height), at(seam - 1e-9, height)), 1e-6);
        }
    }
}

TEST(LoadTables, LookUpIsLinearInTheLogarithmOfTheReynoldsNumber) {
    const LoadTables tables = test::smooth_tables(2);
    const Vector3d direction = Vector3d(0.3, -0.5, 0.8).normalized();
    const LoadEntry low = look_up(tables, direction, 10.0);
    const LoadEntry high = look_up(tables, direction, 200.0);
    const LoadEntry middle = look_up(tables, direction, std::sqrt(10.0 * 200.0));
    EXPECT_LT((middle.force - 0.5 * (low.force + high.force)).norm(), 1e-12);
    EXPECT_LT((middle.moment - 0.5 * (low.moment + high.moment)).norm(), 1e-12);
    EXPECT_GT(difference(low, high), 0.1);
}

TEST(LoadTables, LookUpIsHeldBeyondTheReynoldsNumbers) {
    const LoadTables tables = test::smooth_tables(2);
    const Vector3d direction = Vector3d(0.3, 0.5, -0.8).normalized();
    EXPECT_EQ(difference(look_up(tables, direction, 1e-9), look_up(tables, direction, 10.0)), 0.0);
    EXPECT_EQ(difference(look_up(tables, direction, 0.0), look_up(tables, direction, 10.0)), 0.0);
    EXPECT_EQ(difference(look_up(tables, direction, 1e9), look_up(tables, direction, 3000.0)), 0.0);
}

TEST(LoadTables, LookUpWithOneReynoldsNumberIsTheSameAtAll) {
    LoadTables tables = test::smooth_tables(2);
    tables.reynolds_numbers.resize(1);
    tables.entries.resize(tables.index(1, 0, 0));
    const Vector3d direction = Vector3d::UnitX();
    EXPECT_EQ(difference(look_up(tables, direction, 1.0), look_up(tables, direction, 1e6)), 0.0);
}

/// The half of the sphere with x > 0.
PlannedRegion ahead() {
    PlannedRegion region;
    region.subdivisions = 6;
    for (const Vector3d& node : octahedral_nodes(6)) region.planned.push_back(node.x() > 0.0 ? 1 : 0);
    region.report = R"({"tolerance": 0.1})";
    return region;
}

TEST(PlannedRegion, HoldsTheDirectionsNearItsNodes) {
    EXPECT_TRUE(ahead().holds(Vector3d(1, 0.2, -0.3).normalized()));
    EXPECT_FALSE(ahead().holds(Vector3d(-1, 0.2, -0.3).normalized()));
    EXPECT_TRUE(ahead().holds(Vector3d(0.5, 0, -1).normalized()));
    EXPECT_FALSE(ahead().holds(Vector3d(-0.5, 0, -1).normalized()));
}

TEST(PlannedRegion, IsEveryDirectionWithoutAMap) {
    EXPECT_TRUE(PlannedRegion().holds(Vector3d::UnitX()));
}

TEST(PlannedRegion, IsReadAsItWasWritten) {
    const test::TemporaryFolder folder;
    Body body = test::full_body();
    body.tables->plan = ahead();
    const auto file = folder.path() / "planned.body.h5";
    write_body_file(file, body);
    const PlannedRegion read = read_body_file(file).tables->plan;
    EXPECT_EQ(read.subdivisions, 6);
    EXPECT_EQ(read.planned, ahead().planned);
    EXPECT_EQ(read.report, ahead().report);
}

TEST(PlannedRegion, IsEveryDirectionInAFileWithoutOne) {
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "all.body.h5";
    write_body_file(file, test::full_body());
    EXPECT_EQ(read_body_file(file).tables->plan.subdivisions, 0);
}

TEST(TableErrorsOnPath, CountThePosesOutsideOfThePlan) {
    Body body = test::rubber_ellipsoid();
    body.tables = test::blunt_tables(body, 4);
    body.tables->errors.resize(body.tables->entries.size());
    body.tables->plan = ahead();
    const ImmersedBody immersed = make_immersed_body(body, test::scene_body(1200.0), Fluid{});
    TableErrorsOnPath met;
    for (const Vector3d& velocity : {Vector3d(1, 0, 0), Vector3d(-1, 0, 0), Vector3d(-1, 0.1, 0),
                                     Vector3d(0.9, 0.1, 0), Vector3d(0, 0, 0)}) {
        Pose pose;
        pose.velocity = velocity;
        met.add(table_errors_on_path(immersed, pose));
    }
    EXPECT_EQ(met.poses, 4u);
    EXPECT_EQ(met.strayed, 2u);
    EXPECT_EQ(met.share_strayed(), 0.5);
}

}  // namespace
}  // namespace samara
