#include "foam-cases/bake/bake_plan.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "converter/tables/direction_sampling.hpp"
#include "paths.hpp"
#include "samara/core/base/error.hpp"
#include "samara/scene/terminal_speed.hpp"
#include "support/expect_error.hpp"
#include "test_bodies.hpp"

namespace samara {
namespace {

using testing::AllOf;
using testing::HasSubstr;

BakePlan preview_of(const Body& body) {
    return plan_bake(body, bake_quality("preview"), 1e4);
}

/// With loads by the closure with transition.
BakePlan plan_with_transition(const std::string& quality, double reynolds_number) {
    return plan_bake(test::ellipsoid({0.01, 0.02, 0.04}),
                     with_loads_by(Closure::k_omega_sst_lm, bake_quality(quality)), reynolds_number);
}

std::vector<BakeCase> of_purpose(const BakePlan& plan, CasePurpose purpose) {
    std::vector<BakeCase> found;
    std::ranges::copy_if(plan.cases, std::back_inserter(found),
                         [&](const BakeCase& entry) { return entry.purpose == purpose; });
    return found;
}

TEST(BakePlan, SolvesSixteenDirectionsOfOneOctantOfAnEllipsoid) {
    const BakePlan plan = preview_of(test::ellipsoid({0.01, 0.02, 0.04}));
    EXPECT_EQ(plan.subdivisions, 8);
    const std::vector<BakeCase> cases = of_purpose(plan, CasePurpose::mesh);
    EXPECT_EQ(cases.size(), 16u);
    for (const BakeCase& entry : cases) {
        EXPECT_NEAR(entry.direction.norm(), 1.0, 1e-12);
        EXPECT_GE(entry.direction.minCoeff(), 0.0);
        EXPECT_EQ(entry.reynolds_number, 1e4);
        EXPECT_EQ(entry.mesh, plan.quality.meshes.front().name);
    }
}

TEST(BakePlan, SolvesTwoInFiveDirectionsOnTheLastMesh) {
    const Body body = test::ellipsoid({0.01, 0.02, 0.04});
    const BakePlan plan = preview_of(body);
    const std::vector<BakeCase> cases = of_purpose(plan, CasePurpose::table);
    EXPECT_EQ(cases.size(), 7u);
    for (const BakeCase& entry : cases) {
        EXPECT_EQ(entry.mesh, plan.quality.meshes.back().name);
        const auto start = std::ranges::find(plan.cases, entry.start_from, &BakeCase::name);
        ASSERT_NE(start, plan.cases.end());
        EXPECT_EQ(start->purpose, CasePurpose::mesh);
    }
    for (const Vector3d& end : required_directions(body.symmetry, 1)) {
        EXPECT_TRUE(std::ranges::any_of(
            cases, [&](const BakeCase& entry) { return (entry.direction - end).norm() < 1e-9; }));
    }
}

TEST(BakePlan, SolvesEveryDirectionOnItsOneMesh) {
    const BakePlan plan = plan_bake(test::ellipsoid({0.01, 0.02, 0.04}), bake_quality("smoke"), 1e4);
    EXPECT_EQ(of_purpose(plan, CasePurpose::table).size(), plan.cases.size());
    EXPECT_EQ(plan.cases.size(), 6u);
}

TEST(BakePlan, SolvesOneDirectionOfASphere) {
    EXPECT_EQ(of_purpose(preview_of(test::sphere(0.01)), CasePurpose::table).size(), 1u);
}

TEST(BakePlan, SolvesSixteenDirectionsOfABodyWithoutSymmetry) {
    Body body = test::ellipsoid({0.01, 0.02, 0.04});
    body.symmetry.elements = {Matrix3d::Identity()};
    EXPECT_EQ(of_purpose(preview_of(body), CasePurpose::mesh).size(), 16u);
}

TEST(BakePlan, StandardSolvesMoreDirectionsWhereTheSymmetryMakesFewOfThemEquivalent) {
    const auto directions_on = [](const Body& body, std::size_t mesh) {
        const BakePlan plan = plan_bake(body, bake_quality("standard"), 1e4);
        return std::ranges::count_if(plan.cases, [&](const BakeCase& entry) {
            return entry.mesh == plan.quality.meshes[mesh].name &&
                   entry.reynolds_number == plan.main_reynolds_number;
        });
    };
    Body body = test::ellipsoid({0.01, 0.02, 0.04});
    EXPECT_EQ(directions_on(body, 1), 16);
    EXPECT_EQ(directions_on(body, 2), 7);
    body.symmetry.elements = {Matrix3d::Identity(), Vector3d(1.0, -1.0, 1.0).asDiagonal()};
    EXPECT_EQ(directions_on(body, 1), 28);
    EXPECT_EQ(directions_on(body, 2), 7);
}

TEST(BakePlan, StartsEachMainCaseFromTheSameDirectionOnTheNextCoarserMesh) {
    const BakePlan plan = plan_bake(test::ellipsoid({0.01, 0.02, 0.04}), bake_quality("standard"), 1e4);
    ASSERT_EQ(plan.quality.meshes.size(), 3u);
    for (const BakeCase& entry : of_purpose(plan, CasePurpose::start)) EXPECT_EQ(entry.start_from, "");
    EXPECT_EQ(of_purpose(plan, CasePurpose::start).size(), 16u);
    EXPECT_EQ(of_purpose(plan, CasePurpose::mesh).size(), 16u);
    for (std::size_t i = 0; i < plan.cases.size(); ++i) {
        const BakeCase& entry = plan.cases[i];
        if (entry.start_from.empty()) continue;
        const auto start = std::ranges::find(plan.cases, entry.start_from, &BakeCase::name);
        ASSERT_LT(start - plan.cases.begin(), static_cast<std::ptrdiff_t>(i));
        EXPECT_EQ(start->direction, entry.direction);
        EXPECT_EQ(start->closure, entry.closure);
    }
}

TEST(BakePlan, TakesTheTurbulenceOfEveryTurbulentFlowFromACaseOfItsOwn) {
    const BakePlan plan = plan_with_transition("high", 2000.0);
    std::size_t turbulent = 0;
    for (const BakeCase& entry : plan.cases) {
        if (entry.purpose == CasePurpose::start || entry.purpose == CasePurpose::turbulence) {
            EXPECT_EQ(entry.turbulence_from, "");
            continue;
        }
        EXPECT_EQ(entry.turbulence_from.empty(), entry.reynolds_number < 300.0);
        if (entry.purpose != CasePurpose::closure && !entry.turbulence_from.empty()) {
            EXPECT_EQ(entry.closure, Closure::k_omega_sst_lm);
        }
        if (entry.turbulence_from.empty()) continue;
        ++turbulent;
        const auto other = std::ranges::find(plan.cases, entry.turbulence_from, &BakeCase::name);
        ASSERT_NE(other, plan.cases.end());
        EXPECT_EQ(other->purpose, CasePurpose::turbulence);
        EXPECT_EQ(other->direction, entry.direction);
        EXPECT_EQ(other->reynolds_number, entry.reynolds_number);
        EXPECT_THAT(other->mesh, testing::EndsWith("_turbulence"));
        EXPECT_THAT(std::string(name_of(other->closure)),
                    testing::AnyOf("kEpsilon", "realizableKE", "kOmegaSST"));
    }
    EXPECT_EQ(of_purpose(plan, CasePurpose::turbulence).size(), turbulent);
}

TEST(BakePlan, StartsTheTurbulenceOfAFasterFlowAfreshWhereTheMainOneIsLaminar) {
    const BakePlan plan = plan_with_transition("high", 200.0);
    const std::vector<BakeCase> turbulence = of_purpose(plan, CasePurpose::turbulence);
    ASSERT_FALSE(turbulence.empty());
    for (const BakeCase& entry : turbulence) {
        EXPECT_EQ(entry.reynolds_number, 600.0);
        EXPECT_EQ(entry.start_from, "");
    }
}

TEST(BakePlan, WithLoadsByAnotherClosureHasTwiceTheMeshesAndCases) {
    const BakePlan plain = plan_bake(test::ellipsoid({0.01, 0.02, 0.04}), bake_quality("standard"), 1e4);
    const BakePlan plan = plan_with_transition("standard", 1e4);
    EXPECT_EQ(plan.cases.size(), 2 * plain.cases.size());
    ASSERT_EQ(plan.all_meshes().size(), 2 * plain.quality.meshes.size());
    EXPECT_EQ(plan.all_meshes().size(), plan.cells.size());
    for (std::size_t i = 0; i < plain.cells.size(); ++i) {
        const FlowMesh& mesh = plan.quality.meshes[i];
        EXPECT_TRUE(mesh.resolves_boundary_layer);
        EXPECT_EQ(plan.quality.turbulence_meshes[i].layers, plain.quality.meshes[i].layers);
        EXPECT_EQ(cells_of(plan, plain.quality.meshes[i].name + "_turbulence"), plain.cells[i]);
        const double last = 0.5 * mesh.background_cell / std::ldexp(1.0, mesh.surface_level);
        EXPECT_NEAR(last / std::pow(1.4, mesh.layers - 1), 1.0 / 1800.0, 0.2 / 1800.0);
    }
    EXPECT_GT(plan.cpu_seconds, 1.5 * plain.cpu_seconds);
}

TEST(BakePlan, SolvesFurtherReynoldsNumbersInTheDirectionsOfTheLastMeshFromTheMainOne) {
    const BakePlan plan = plan_bake(test::ellipsoid({0.01, 0.02, 0.04}), bake_quality("standard"), 10200.0);
    EXPECT_THAT(plan.reynolds_numbers(), testing::ElementsAre(10200.0, 1020.0, 3060.0));
    std::size_t further = 0;
    for (const BakeCase& entry : plan.cases) {
        if (entry.reynolds_number == 10200.0) continue;
        ++further;
        EXPECT_EQ(entry.purpose, CasePurpose::table);
        EXPECT_EQ(entry.mesh, "mesh_uniform_14");
        const auto start = std::ranges::find(plan.cases, entry.start_from, &BakeCase::name);
        ASSERT_NE(start, plan.cases.end());
        EXPECT_EQ(start->mesh, entry.mesh);
        EXPECT_EQ(start->direction, entry.direction);
        EXPECT_EQ(start->purpose, CasePurpose::mesh);
        EXPECT_TRUE(std::ranges::any_of(plan.cases, [&](const BakeCase& other) {
            return other.start_from == start->name && other.mesh == plan.quality.meshes.back().name;
        }));
    }
    EXPECT_EQ(further, 2u * 7u);
}

TEST(BakePlan, ComparesClosuresAtHighQuality) {
    const BakePlan plan = plan_bake(test::ellipsoid({0.01, 0.02, 0.04}), bake_quality("high"), 1e4);
    const std::vector<BakeCase> cases = of_purpose(plan, CasePurpose::closure);
    EXPECT_EQ(cases.size(), 2u * 12u);
    for (const BakeCase& entry : cases) EXPECT_NE(entry.closure, Closure::k_epsilon);
}

TEST(BakePlan, IsLaminarBelowTheStatedReynoldsNumber) {
    const Body body = test::ellipsoid({0.01, 0.02, 0.04});
    const BakePlan plan = plan_bake(body, bake_quality("standard"), 1000.0);
    for (const BakeCase& entry : plan.cases) {
        EXPECT_EQ(entry.closure, entry.reynolds_number < 300.0 ? Closure::laminar : Closure::k_epsilon);
    }
    EXPECT_TRUE(
        std::ranges::any_of(plan.cases, [](const BakeCase& one) { return one.closure == Closure::laminar; }));
}

TEST(BakePlan, GivesEachCaseItsOwnName) {
    const BakePlan plan = preview_of(test::ellipsoid({0.01, 0.02, 0.04}));
    std::vector<std::string> names;
    for (const BakeCase& entry : plan.cases) names.push_back(entry.name);
    std::sort(names.begin(), names.end());
    EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
}

TEST(BakePlan, DoesNotDependOnTheBodysSize) {
    const BakePlan small = preview_of(test::ellipsoid({0.01, 0.02, 0.04}));
    const BakePlan large = preview_of(test::ellipsoid({1.0, 2.0, 4.0}));
    EXPECT_NEAR(small.cells.back(), large.cells.back(), 1e-9 * small.cells.back());
    EXPECT_NEAR(100.0 * small.reference_length, large.reference_length, 1e-9);
}

TEST(BakePlan, WidensTheBoxAndRefinesTheSurfaceOfARod) {
    const BakePlan cube = preview_of(test::box_body({0.02, 0.02, 0.02}));
    const BakePlan sheet = preview_of(test::box_body({0.1, 0.1, 0.0001}));
    const BakePlan rod = preview_of(test::box_body({0.002, 0.002, 0.1}));
    EXPECT_EQ(cube.quality.meshes.back().box_half_width, 10);
    EXPECT_EQ(cube.quality.meshes.back().surface_level, 4);
    EXPECT_EQ(sheet.quality.meshes.back().surface_level, 4);
    const double reach = 0.05 / rod.reference_length;
    EXPECT_GE(rod.quality.meshes.back().box_half_width, 4.0 * reach);
    const double cell = 1.0 / (1 << rod.quality.meshes.back().surface_level);
    EXPECT_LE(3.0 * cell * rod.reference_length, 0.002);
}

TEST(BakePlan, ReachesTheSurfaceLevelThroughShellsThatThinInwards) {
    const FlowMesh mesh = preview_of(test::ellipsoid({0.001, 0.001, 0.05})).quality.meshes.back();
    EXPECT_GT(mesh.surface_level, 4);
    EXPECT_EQ(mesh.refinement_shells.front().second, mesh.surface_level);
    for (std::size_t i = 1; i < mesh.refinement_shells.size(); ++i) {
        EXPECT_LT(mesh.refinement_shells[i - 1].first, mesh.refinement_shells[i].first);
        EXPECT_EQ(mesh.refinement_shells[i - 1].second, mesh.refinement_shells[i].second + 1);
    }
}

TEST(BakePlan, CostsMoreAtAHigherQuality) {
    const Body body = test::ellipsoid({0.01, 0.02, 0.04});
    double before = 0.0;
    for (const std::string& name : bake_quality_names()) {
        const double seconds = plan_bake(body, bake_quality(name), 1e4).cpu_seconds;
        EXPECT_GT(seconds, 2.0 * before) << name;
        before = seconds;
    }
}

TEST(BakePlan, HalvesTheCellsAtTheSurfaceFromMeshToMesh) {
    const BakePlan plan = plan_bake(test::sphere(0.01), bake_quality("high"), 1e4);
    for (std::size_t i = 1; i < plan.cells.size(); ++i) EXPECT_GT(plan.cells[i], 2.0 * plan.cells[i - 1]);
}

TEST(BakePlan, CountsTheCellsOfALongBodyAlikeWhicheverWayItLies) {
    const FlowMesh mesh = bake_quality("preview").meshes.back();
    const double along_x = estimated_cells(test::ellipsoid({0.1, 0.005, 0.005}), mesh);
    const double along_z = estimated_cells(test::ellipsoid({0.005, 0.005, 0.1}), mesh);
    EXPECT_NEAR(along_z, along_x, 1e-6 * along_x);
}

TEST(BakePlan, CountsTheCellsOfABoxWithoutRefinementExactly) {
    FlowMesh mesh;
    mesh.layers = 0;
    mesh.refinement_shells = {};
    EXPECT_DOUBLE_EQ(estimated_cells(test::sphere(1.0), mesh), 8000.0);
}

TEST(BakePlan, IsWrittenWithAxesAsRowsAndDirectionsInCaseAxes) {
    Body body = test::ellipsoid({0.01, 0.02, 0.04});
    body.symmetry.axes << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    const BakePlan plan = plan_bake(body, bake_quality("smoke"), 5000.0);
    const nlohmann::json json = plan_json(plan);
    EXPECT_EQ(json["quality"], "smoke");
    EXPECT_EQ(json["subdivisions"], plan.subdivisions);
    EXPECT_EQ(json["axes"][0], nlohmann::json({0.0, 0.0, 1.0}));
    EXPECT_EQ(json["cases"].size(), plan.cases.size());
    EXPECT_EQ(json["cases"][1]["direction"][0], plan.cases[1].direction.x());
    EXPECT_EQ(json["cases"][1]["reynolds_number"], 5000.0);
    EXPECT_EQ(json["cases"][1]["purpose"], "table");
    EXPECT_EQ(json["cases"][1]["turbulence_from"], "");
    EXPECT_EQ(json["meshes"][0]["name"], "mesh_coarse");
}

/// Returns the speed of a sphere in water; density in kg/m^3.
double speed_of(double density, double gravity = 9.81) {
    const Body body = test::sphere(0.01);
    return bake_speed(body, *fluid_preset("water"), density * body.moments.volume, gravity);
}

TEST(BakeSpeed, IsTheTerminalSpeed) {
    const Body body = test::sphere(0.01);
    EXPECT_EQ(speed_of(2000.0),
              terminal_speed(body, *fluid_preset("water"), 2000.0 * body.moments.volume, 9.81));
}

TEST(BakeSpeed, OfABodyThatFloatsInTheFluidOrWithoutGravityIsRejectedWithItsName) {
    const std::string neutral = test::error_of([] { (void)speed_of(fluid_preset("water")->density); });
    EXPECT_THAT(neutral, AllOf(HasSubstr("sphere"), HasSubstr("give another density")));
    const std::string weightless = test::error_of([] { (void)speed_of(2000.0, 0.0); });
    EXPECT_THAT(weightless, AllOf(HasSubstr("sphere"), HasSubstr("give another gravity")));
}

TEST(BakeReynoldsNumber, HasThreeDigits) {
    EXPECT_NEAR(rounded_reynolds_number(9963.7), 9960.0, 1e-9);
    EXPECT_NEAR(rounded_reynolds_number(0.123456), 0.123, 1e-12);
}

TEST(BakeQuality, OfAnUnknownNameIsRejected) {
    EXPECT_THROW(bake_quality("perfect"), Error);
}

TEST(BakeQuality, ExpectsTheErrorsOfTheAccuracyPage) {
    std::ifstream file(SAMARA_SOURCE_DIRECTORY "/docs/explanation/accuracy.md");
    const std::string page((std::istreambuf_iterator<char>(file)), {});
    for (const char* quality : {"surface", "preview", "standard"}) {
        const auto errors = errors_on_held_out_falls(quality);
        ASSERT_TRUE(errors);
        const std::string_view bake = std::string_view(quality) == "surface" ? "no" : quality;
        const auto row = page.find(fmt::format("| held-out falls | {} bake |", bake));
        ASSERT_NE(row, std::string::npos);
        EXPECT_THAT(page.substr(row, page.find('\n', row) - row),
                    testing::EndsWith(fmt::format("| {:.0f} % | {:.0f} % |", 100.0 * errors->descent,
                                                  100.0 * errors->worst_metric)));
    }
    EXPECT_FALSE(errors_on_held_out_falls("high"));
}

TEST(BakeQuality, HasTheLoadsByTheClosureWithTransitionFromStandardOn) {
    EXPECT_EQ(usual_loads_closure("smoke"), Closure::k_epsilon);
    EXPECT_EQ(usual_loads_closure("preview"), Closure::k_epsilon);
    EXPECT_EQ(usual_loads_closure("standard"), Closure::k_omega_sst_lm);
    EXPECT_EQ(usual_loads_closure("high"), Closure::k_omega_sst_lm);
}

TEST(BakeQuality, WithLoadsByAClosureWithoutOmegaIsRejected) {
    EXPECT_THROW((void)with_loads_by(Closure::launder_sharma_k_epsilon, bake_quality("smoke")), Error);
    EXPECT_TRUE(with_loads_by(Closure::k_epsilon, bake_quality("smoke")).turbulence_meshes.empty());
}

}  // namespace
}  // namespace samara
