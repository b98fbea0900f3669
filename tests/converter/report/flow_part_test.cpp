#include "converter/report/flow_part.hpp"

#include <cmath>
#include <numbers>
#include <tuple>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/known_bodies.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using testing::HasSubstr;

/// A sphere's flow in a box of 20 L, solved on three meshes whose drag falls with the square of the cells'
/// edge.
class FlowPart : public testing::Test {
  protected:
    FlowPart() {
        plan_.reference_length = 0.02;
        plan_.case_axes = plan_.axes = Matrix3d::Identity();
        mesh_.mesh.points = {Vector3d(-10.0, -10.0, -10.0), Vector3d(10.0, 10.0, 10.0)};
        for (const auto& [name, purpose, cells] : {std::tuple{"coarse", CasePurpose::start, 1000},
                                                   {"medium", CasePurpose::mesh, 8000},
                                                   {"fine", CasePurpose::table, 64000}}) {
            PlannedCase planned{name, Vector3d::UnitX(), 1e4};
            planned.purpose = purpose;
            plan_.cases.push_back(planned);
            const double drag = 0.4 + 10.0 * std::pow(cells, -2.0 / 3.0);
            static_cast<void>(folder_.file(
                std::string(name) + "/provenance.json",
                fmt::format(R"({{"closure": "kOmegaSST", "drag_coefficient": {}, "averaged_iterations": 150,
                    "iterations": 300, "verdict": "stationary", "final_residuals": {{"p": 2e-4}},
                    "mesh": {{"cells": {}}}}})",
                            drag, cells)));
        }
    }
    /// Returns the text of each row whose first cell is the name.
    [[nodiscard]] std::string row(const std::string& name) const {
        const ReportPart part = part_of_flow(folder_.path(), plan_, test::exact_sphere(0.01), {mesh_});
        for (const auto& block : part.blocks) {
            if (!block.contains("table")) continue;
            for (const auto& row : block["table"]["rows"]) {
                if (row[0] == name) return row.dump();
            }
        }
        return "";
    }

    test::TemporaryFolder folder_;
    CasePlan plan_;
    SolvedMesh mesh_{"mesh_fine", {}, {}};
};

TEST_F(FlowPart, HasTheDomainAndTheShareThatTheBodyBlocks) {
    EXPECT_THAT(row("domain"), HasSubstr("20 x 20 x 20 L; its boundary is at least 10 L"));
    EXPECT_THAT(row("blockage ratio"),
                HasSubstr(fmt::format("{:.1g} %", 100.0 * std::numbers::pi / 4.0 / 400.0)));
}

TEST_F(FlowPart, HasTheWindowAndTheResidualOfTheCasesThatTheTablesAreMadeOf) {
    EXPECT_THAT(row("closure"), HasSubstr("kOmegaSST"));
    EXPECT_THAT(row("averaging window"), HasSubstr("150, 150, 150 last iterations"));
    EXPECT_THAT(row("initial residual of the pressure, at the end"), HasSubstr("0.0002"));
    EXPECT_THAT(row("means that settled"), HasSubstr("2 of 2"));
}

TEST_F(FlowPart, HasTheObservedOrderOfADirectionOnThreeMeshes) {
    const std::string family = row("drag along (1.00, 0.00, 0.00) at 10000, kOmegaSST");
    EXPECT_THAT(family, HasSubstr("0.425 on 8000"));
    EXPECT_THAT(family, HasSubstr("\"2\""));
}

TEST_F(FlowPart, HasTheLeastMeanAndMostWallSpacing) {
    mesh_.spacings = {{.wall_functions = true, .least = 1.0, .mean = 5.0, .median = 4.0, .most = 9.0},
                      {.wall_functions = true, .least = 2.0, .mean = 7.0, .median = 4.0, .most = 20.0}};
    EXPECT_THAT(row("y+ on mesh_fine"),
                HasSubstr("1, 6, 20 (least, mean, most; cases: 2), with wall functions"));
}

}  // namespace
}  // namespace samara
