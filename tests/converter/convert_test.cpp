// The tables that solved cases become.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "converted_box.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/surface/octahedral_map.hpp"
#include "symmetry_groups.hpp"

namespace samara {
namespace {

using testing::HasSubstr;
using Convert = test::ConvertedBox;

Body turned_box() {
    Body body = test::box_body(Vector3d(0.01, 0.02, 0.04));
    body.symmetry = test::turned(body.symmetry, test::some_rotation());
    for (Vector3d& vertex : body.surface.vertices) vertex = test::some_rotation() * vertex;
    return body;
}

TEST_F(Convert, FillsTheTablesInBodyAxesWhateverTheyAre) {
    const test::SolvedFolder folder(turned_box(), 2, {1e4, 1e3}, test::box_law_by_reynolds_number);
    const Body body = convert_folder(folder.path()).body;
    ASSERT_TRUE(body.tables);
    const LoadTables& tables = *body.tables;
    EXPECT_EQ(tables.reynolds_numbers, (std::vector<double>{1e3, 1e4}));
    EXPECT_EQ(tables.entries.size(), 2U * 25U);
    EXPECT_EQ(tables.subdivisions, 2);
    EXPECT_EQ(tables.quality, "smoke");
    EXPECT_EQ(tables.reference_length, reference_length(body.moments.surface_area));
    for (const double reynolds_number : tables.reynolds_numbers) {
        for (const Vector3d& node : octahedral_nodes(2)) {
            const LoadEntry exact =
                transformed(test::box_law_by_reynolds_number(node, reynolds_number), tables.axes);
            const LoadEntry found = look_up(tables, tables.axes * node, reynolds_number);
            EXPECT_LT(test::difference(found, exact), 1e-8);
        }
    }
}

TEST_F(Convert, GivesTheTailOfTheIterationsAsError) {
    const Conversion conversion = convert_folder(folder_.path());
    const auto& [direction, entry, error] = conversion.cases.front().sample;
    EXPECT_EQ(direction, Vector3d(1, 0, 0));
    // Of 11 iterations the last 9 make three batches, whose means are off by 1/3, -1/3 and 0 of 0.01 F; the
    // last 10 make two halves, whose means are off by -1/5 and 0 of it. Ten of the eleven are off by 0.01 F
    // themselves.
    const double relative = 0.01 * std::hypot(1.0 / std::sqrt(27.0), 0.1, std::sqrt(10.0 / 11.0));
    EXPECT_NEAR(error.force.x(), relative * std::abs(entry.force.x()), 1e-8);
    EXPECT_EQ(error.force.y(), 0.0);
    EXPECT_NEAR(error.turbulent_kinetic_energy, relative * entry.turbulent_kinetic_energy, 1e-10);
    EXPECT_NEAR(error.dissipation_rate, relative * entry.dissipation_rate, 1e-10);
    const LoadTables& tables = *conversion.body.tables;
    ASSERT_EQ(tables.error_sources.front().source, ErrorSource::tail);
    EXPECT_NEAR(tables.error_sources.front().turbulent_kinetic_energy,
                std::pow(1.0 + 0.5 * relative, 2.0) - 1.0, 1e-8);
    EXPECT_GT(tables.errors[tables.index(0, 2, 4)].force.x(), error.force.x());
}

TEST_F(Convert, TakesWhatSymmetryForbidsAsError) {
    const auto lopsided = [](const Vector3d& direction, double reynolds_number) {
        LoadEntry entry = test::box_law_by_reynolds_number(direction, reynolds_number);
        if (direction.x() == 1.0) entry.force.y() += 0.08;
        return entry;
    };
    const test::SolvedFolder folder(test::box_body(Vector3d(0.01, 0.02, 0.04)), 2, {1e4}, lopsided);
    const Conversion conversion = convert_folder(folder.path());
    const DirectionSample& broadside = conversion.cases.front().sample;
    EXPECT_EQ(broadside.entry.force.y(), 0.0);
    EXPECT_GT(broadside.error.force.y(), 0.08 / std::sqrt(2.0));
    EXPECT_LT(broadside.error.force.y(), 1.01 * 0.08 / std::sqrt(2.0));
}

TEST_F(Convert, KeepsTheRestOfTheBodyAndTheProvenance) {
    const Body body = convert_folder(folder_.path()).body;
    EXPECT_EQ(body.name, "box");
    EXPECT_EQ(surface_hash(body.surface), surface_hash(folder_.body().surface));
    const nlohmann::json provenance = nlohmann::json::parse(body.tables->provenance);
    ASSERT_EQ(provenance.size(), 12U);
    EXPECT_EQ(provenance[0]["name"], "case_00");
    EXPECT_EQ(provenance[0]["closure"], "kEpsilon");
    EXPECT_EQ(provenance[0]["direction"], (nlohmann::json{1.0, 0.0, 0.0}));
    EXPECT_EQ(provenance[11]["reynolds_number"], 1e4);
}

TEST_F(Convert, SaysHowFarItIs) {
    std::size_t last = 0;
    convert_folder(folder_.path(), [&](std::size_t done, std::size_t total) {
        EXPECT_EQ(done, ++last);
        EXPECT_EQ(total, 12U);
    });
    EXPECT_EQ(last, 12U);
}

TEST_F(Convert, NamesTheFirstCaseThatIsNotSolved) {
    std::filesystem::remove(folder_.case_path(3) / "provenance.json");
    std::filesystem::remove(folder_.case_path(5) / "provenance.json");
    EXPECT_EQ(error(), folder_.path().string() +
                           ": the case case_03 is not solved (2 of 12 are not); run 'samara bake' again, "
                           "which continues where it stopped");
}

TEST_F(Convert, FillsADirectionThatCouldNotBeSolvedAndSaysSo) {
    std::filesystem::remove(folder_.case_path(2) / "provenance.json");
    folder_.write("case_02/failed.json", R"({"reason": "never settled"})");
    const Conversion conversion = convert_folder(folder_.path());
    EXPECT_EQ(conversion.cases.size(), 11U);
    const LoadTables& tables = *conversion.body.tables;
    ASSERT_EQ(conversion.left_out.size(), 1U);
    EXPECT_EQ(conversion.left_out[0].name, "case_02");
    EXPECT_EQ(conversion.left_out[0].reason, "never settled");
    const Vector3d lost = octahedral_node(2, 2, 3);
    EXPECT_LT(test::difference(look_up(tables, lost, 1e3), test::box_law_by_reynolds_number(lost, 1e3)), 0.5);
}

TEST_F(Convert, RejectsWhereMoreThanOneDirectionInFiveCouldNotBeSolved) {
    for (const std::size_t index : {6U, 7U, 8U, 9U, 0U, 1U, 2U, 3U}) {
        std::filesystem::remove(folder_.case_path(index) / "provenance.json");
        folder_.write(folder_.names()[index] + "/failed.json", R"({"reason": "never settled"})");
    }
    EXPECT_EQ(error(),
              (folder_.path() / "plan.json").string() +
                  ": 4 of the 6 directions at Reynolds number 1000 could not be solved, more than one "
                  "in five; the first is case_00: never settled; run 'samara bake' again");
}

// The case of a sphere, which has one direction.
TEST(ConvertOneDirection, TheMainReynoldsNumberIsThePlansWhateverCouldNotBeSolved) {
    const test::SolvedFolder folder(test::box_body(Vector3d(0.01, 0.02, 0.04)), 1, {1e3, 1e4, 1e4},
                                    test::box_law_by_reynolds_number);
    folder.change_plan([](nlohmann::json& plan) {
        const nlohmann::json cases = plan["cases"];
        plan["cases"] = {cases[0], cases[3], cases[6]};
        plan["cases"][1]["purpose"] = "mesh";
        plan["covers"] = "scene";
    });
    EXPECT_EQ(convert_folder(folder.path()).body.tables->reynolds_numbers, (std::vector<double>{1e3, 1e4}));
    std::filesystem::remove(folder.case_path(6) / "provenance.json");
    folder.write("case_06/failed.json", R"({"reason": "never settled"})");
    EXPECT_THAT(test::error_of([&] { convert_folder(folder.path()); }),
                HasSubstr("plan.json: 1 of the 1 directions at Reynolds number 10000 could not be solved"));
}

// The cases are of the octant opposite to that of the table.
TEST(ConvertBySymmetry, BringsADirectionToTheOneThatTheTableHas) {
    Body body = test::box_body(Vector3d(0.01, 0.02, 0.04));
    const Symmetry symmetry = body.symmetry;
    body.symmetry = {};
    const test::SolvedFolder folder(body, 2, {1e4}, test::box_law_by_reynolds_number);
    body.symmetry = symmetry;
    write_body_file(folder.path() / "body.body.h5", body);
    folder.change_plan([](nlohmann::json& plan) {
        nlohmann::json kept = nlohmann::json::array();
        for (const nlohmann::json& one : plan["cases"]) {
            if (std::ranges::all_of(one["direction"],
                                    [](const nlohmann::json& x) { return x.get<double>() <= 0.0; })) {
                kept.push_back(one);
            }
        }
        plan["cases"] = kept;
    });
    const LoadTables tables = *convert_folder(folder.path()).body.tables;
    for (const Vector3d& node : octahedral_nodes(2)) {
        EXPECT_LT(test::difference(look_up(tables, node, 1e4), test::box_law_by_reynolds_number(node, 1e4)),
                  1e-8);
    }
}

}  // namespace
}  // namespace samara
