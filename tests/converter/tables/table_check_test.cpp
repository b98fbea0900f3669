#include "converter/tables/table_check.hpp"

#include <cmath>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "converter/cases/samples_csv.hpp"
#include "samara/core/base/error.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

LoadTables uniform_tables(const LoadEntry& entry, const LoadEntryError& error) {
    LoadTables tables;
    tables.reference_length = 1.0;
    tables.subdivisions = 1;
    tables.reynolds_numbers = {1e4};
    tables.entries.assign(9, entry);
    tables.errors.assign(9, error);
    return tables;
}

SolvedCase solved(const Vector3d& direction, const LoadEntry& entry,
                  CasePurpose purpose = CasePurpose::table) {
    SolvedCase one;
    one.name = "probe, one";
    one.reynolds_number = 1e4;
    one.purpose = purpose;
    one.mesh = "mesh_fine";
    one.closure = Closure::k_epsilon;
    one.sample.direction = direction;
    one.sample.entry = entry;
    return one;
}

TEST(TableCheck, ComparesErrorsWithThoseStated) {
    const LoadEntry entry{Vector3d(-1.0, 0.0, 0.0), Vector3d(0.0, 0.2, 0.0), 0.01, 0.02};
    const LoadEntryError error{Vector3d::Constant(0.1), Vector3d::Constant(0.01), 0.002, 0.002};
    const LoadTables tables = uniform_tables(entry, error);
    LoadEntry near = entry;
    near.force.x() = -1.15;                // off by one and a half of its standard error
    near.turbulent_kinetic_energy = 0.02;  // by five
    const TableCheck check = check_tables(
        tables, {solved(Vector3d::UnitX(), near), solved(Vector3d::UnitY(), LoadEntry(), CasePurpose::mesh)});
    ASSERT_EQ(check.cases.size(), 1u);
    EXPECT_NEAR(check.force.error, 0.15 / 1.15, 1e-12);
    EXPECT_NEAR(check.force.stated, 0.1 * std::sqrt(3.0) / 1.15, 1e-12);
    EXPECT_EQ(check.force.within_two, 1.0);
    EXPECT_NEAR(check.turbulent_kinetic_energy.error, std::log(2.0), 1e-12);
    EXPECT_EQ(check.turbulent_kinetic_energy.within_two, 0.0);
    EXPECT_EQ(check.dissipation_rate.error, 0.0);
    EXPECT_NEAR(check.within_two, 7.0 / 8.0, 1e-12);
}

TEST(TableCheck, NeedsACase) {
    EXPECT_THROW(check_tables(uniform_tables({}, {}), {}), Error);
}

TEST(SamplesCsv, IsReadBackToTheLastDigit) {
    const test::TemporaryFolder folder;
    const LoadEntry entry{Vector3d(-1.0 / 3.0, 1e-17, 2.0), Vector3d(0.1, 0.2, 0.3), 0.01, 0.02};
    SolvedCase before = solved(Vector3d(1.0, 2.0, 3.0).normalized(), entry, CasePurpose::closure);
    before.sample.error = {Vector3d(0.1, 0.2, 0.3), Vector3d::Zero(), 0.1, 0.2};
    const auto file = folder.path() / "cases.csv";
    std::ofstream(file) << samples_csv({before}, Matrix3d::Identity());
    const std::vector<SolvedCase> cases = read_samples_csv(file);
    ASSERT_EQ(cases.size(), 1u);
    EXPECT_EQ(cases[0].name, before.name);
    EXPECT_EQ(cases[0].purpose, CasePurpose::closure);
    EXPECT_EQ(cases[0].sample.direction, before.sample.direction);
    EXPECT_EQ(cases[0].sample.entry.force, entry.force);
    EXPECT_EQ(cases[0].sample.error.force, before.sample.error.force);
    EXPECT_EQ(cases[0].sample.error.dissipation_rate, 0.2);
}

TEST(SamplesCsv, NamesTheLineThatIsCutShort) {
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "cases.csv";
    std::string text = samples_csv({solved(Vector3d::UnitX(), {})}, Matrix3d::Identity());
    text.resize(text.size() - 8);
    std::ofstream(file) << text;
    try {
        read_samples_csv(file);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("cases.csv:2: has"));
    }
}

}  // namespace
}  // namespace samara
