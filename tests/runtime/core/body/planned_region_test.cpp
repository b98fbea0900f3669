#include "samara/core/body/planned_region.hpp"

#include <gtest/gtest.h>

#include "samara/core/body/body_file.hpp"
#include "samara/core/surface/octahedral_map.hpp"
#include "samara/scene/table_errors_on_path.hpp"
#include "support/known_bodies.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

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
