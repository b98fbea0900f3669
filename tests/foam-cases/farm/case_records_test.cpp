#include "foam-cases/farm/case_records.hpp"

#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "test_bodies.hpp"

namespace samara {
namespace {

TEST(CaseRecord, OfAMissingOrDamagedFileIsEmpty) {
    const test::TemporaryFolder folder;
    EXPECT_TRUE(read_record(folder / "failed.json").empty());
    EXPECT_TRUE(read_record(folder.path()).empty());
    for (const char* text : {"", "{\"reason\": ", "[1, 2]", "null", "\xff"}) {
        EXPECT_TRUE(read_record(folder.file("failed.json", text)).empty()) << text;
    }
}

TEST(CaseRecord, EntriesOfAnotherTypeAreIgnored) {
    const test::TemporaryFolder folder;
    const nlohmann::json record = read_record(
        folder.file("failed.json", R"({"reason": "diverged", "cpu_seconds": 2.5, "cells": "many"})"));
    EXPECT_EQ(text_in(record, "reason"), "diverged");
    EXPECT_EQ(text_in(record, "cpu_seconds"), "");
    EXPECT_EQ(text_in(record, "absent"), "");
    EXPECT_EQ(number_in(record, "cpu_seconds"), 2.5);
    EXPECT_EQ(number_in(record, "cells"), 0.0);
    EXPECT_EQ(number_in(record, "absent"), 0.0);
}

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Two meshes, a case on each and a fall on the second.
BakePlan small_plan() {
    BakePlan plan;
    plan.quality = bake_quality("preview");
    plan.cases.resize(2);
    plan.cases[0].name = "a_coarse";
    plan.cases[0].mesh = "mesh_coarse";
    plan.cases[1].name = "a_medium";
    plan.cases[1].mesh = "mesh_medium";
    plan.falls.resize(1);
    plan.falls[0].name = "fall";
    plan.falls[0].mesh = "mesh_medium";
    return plan;
}

void write_record(const test::TemporaryFolder& folder, const std::string& name, const std::string& file,
                  double seconds) {
    fs::create_directories(folder / name);
    std::ignore = folder.file(name + "/" + file, nlohmann::json({{"cpu_seconds", seconds}}).dump());
}

TEST(CpuAccount, SumsTheRecordsByMeshAndPart) {
    const test::TemporaryFolder folder;
    write_record(folder, "mesh_coarse", "mesh.json", 1.0);
    write_record(folder, "mesh_medium", "mesh.json", 2.0);
    write_record(folder, "a_coarse", "provenance.json", 4.0);
    write_record(folder, "a_medium", "provenance.json", 8.0);
    write_record(folder, "fall", "provenance.json", 16.0);
    const CpuAccount account = cpu_account(folder.path(), small_plan());
    EXPECT_EQ(account_as_json(account), nlohmann::json::parse(R"([
        {"part": "meshes", "count": 2, "cpu_seconds": 3.0},
        {"part": "cases on mesh_coarse", "count": 1, "cpu_seconds": 4.0},
        {"part": "cases on mesh_medium", "count": 1, "cpu_seconds": 8.0},
        {"part": "falls on mesh_medium", "count": 1, "cpu_seconds": 16.0}])"));
    EXPECT_EQ(cpu_seconds_of(account), 31.0);
}

TEST(CpuAccount, LeavesOutWhatIsNotSolved) {
    const test::TemporaryFolder folder;
    write_record(folder, "a_medium", "provenance.json", 8.0);
    const CpuAccount account = cpu_account(folder.path(), small_plan());
    ASSERT_EQ(account.size(), 2u);
    EXPECT_EQ(account[0].count, 0u);
    EXPECT_EQ(account[1].what, "cases on mesh_medium");
    EXPECT_EQ(cpu_seconds_of(account), 8.0);
}

TEST(CpuAccount, AsTextHasTheShares) {
    const std::string text = account_as_text({{"meshes", 2, 1.0}, {"tables", 0, 3.0}});
    EXPECT_THAT(text, HasSubstr("  meshes                           2       1.0    25 %\n"));
    EXPECT_THAT(text, HasSubstr("  tables                                   3.0    75 %\n"));
    EXPECT_THAT(text, HasSubstr("  all                                      4.0   100 %\n"));
}

TEST(CpuAccount, CountsThisProcess) {
    const double before = cpu_seconds_so_far();
    volatile double sum = 0.0;
    while (cpu_seconds_so_far() < before + 0.02) sum = sum + 1.0;
    EXPECT_GT(sum, 0.0);
}

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

TEST(DiskNeed, BeyondTheDiskIsRejectedInOneLine) {
    const test::TemporaryFolder folder;
    require_room(folder.path(), 1e6);
    const std::string error = test::error_of([&] { require_room(folder.path(), 1e18); });
    EXPECT_THAT(error, HasSubstr(folder.path().string() + ": the cases need about 1e+12 MB, but "));
    EXPECT_THAT(error, HasSubstr("free some space, or choose another output"));
    EXPECT_EQ(error.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace samara
