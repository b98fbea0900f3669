#include "foam-cases/farm/disk_need.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "test_bodies.hpp"

namespace samara {
namespace {

using testing::HasSubstr;

TEST(DiskNeed, IsOfWhatIsNotSolvedYet) {
    const test::TemporaryFolder folder;
    const BakePlan plan = plan_bake(test::sphere(0.01), bake_quality("preview"), 1e4);
    ASSERT_EQ(plan.cases.size(), 2u);
    const double all = bytes_to_solve(folder.path(), plan);
    // A bake of this sphere left 14 MB.
    EXPECT_GT(all, 7e6);
    EXPECT_LT(all, 28e6);
    static_cast<void>(folder.file(plan.quality.meshes.back().name + "/mesh.json", "{}"));
    const double without_mesh = bytes_to_solve(folder.path(), plan);
    EXPECT_LT(without_mesh, all);
    static_cast<void>(folder.file(plan.cases.back().name + "/provenance.json", "{}"));
    EXPECT_LT(bytes_to_solve(folder.path(), plan), without_mesh);
}

TEST(DiskNeed, BeyondTheDiskIsRefusedInOneLine) {
    const test::TemporaryFolder folder;
    require_room(folder.path(), 1e6);
    const std::string error = test::error_of([&] { require_room(folder.path(), 1e18); });
    EXPECT_THAT(
        error, HasSubstr(folder.path().string() + ": what is to be solved takes about 1e+12 MB there, and "));
    EXPECT_THAT(error, HasSubstr("make room, or name an output elsewhere"));
    EXPECT_EQ(error.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace samara
