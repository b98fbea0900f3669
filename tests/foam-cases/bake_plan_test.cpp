#include "foam-cases/bake_plan.hpp"

#include <algorithm>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "samara/base/error.hpp"
#include "test_bodies.hpp"

namespace samara {
namespace {

BakePlan preview_of(const Body& body) {
    return plan_bake(body, bake_quality("preview"), 1e4);
}

TEST(BakePlan, SolvesOneOctantOfAnEllipsoid) {
    const BakePlan plan = preview_of(test::ellipsoid({0.01, 0.02, 0.04}));
    EXPECT_EQ(plan.subdivisions, 4);
    EXPECT_EQ(plan.cases.size(), 15u);  // the nodes of one face of the octahedron, its edges cut into four
    for (const BakeCase& entry : plan.cases) {
        EXPECT_NEAR(entry.direction.norm(), 1.0, 1e-12);
        EXPECT_GE(entry.direction.minCoeff(), 0.0);
        EXPECT_EQ(entry.reynolds_number, 1e4);
    }
}

TEST(BakePlan, SolvesOneDirectionOfASphere) {
    EXPECT_EQ(preview_of(test::sphere(0.01)).cases.size(), 1u);
}

TEST(BakePlan, SolvesEveryDirectionOfABodyWithoutSymmetry) {
    Body body = test::ellipsoid({0.01, 0.02, 0.04});
    body.symmetry.elements = {Matrix3d::Identity()};
    const BakePlan plan = preview_of(body);
    EXPECT_EQ(plan.subdivisions, 2);
    EXPECT_EQ(plan.cases.size(), 18u);  // 6 corners and 12 edge middles of the octahedron
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
    EXPECT_NEAR(small.cells, large.cells, 1e-9 * small.cells);
    EXPECT_NEAR(100.0 * small.reference_length, large.reference_length, 1e-9);
}

TEST(BakePlan, WidensTheBoxAndRefinesTheSurfaceOfARod) {
    const BakePlan cube = preview_of(test::box({0.02, 0.02, 0.02}));
    const BakePlan sheet = preview_of(test::box({0.1, 0.1, 0.0001}));
    const BakePlan rod = preview_of(test::box({0.002, 0.002, 0.1}));
    EXPECT_EQ(cube.quality.mesh.box_half_width, 10);
    EXPECT_EQ(cube.quality.mesh.surface_level, 4);
    EXPECT_EQ(sheet.quality.mesh.surface_level, 4);
    const double reach = 0.05 / rod.reference_length;
    EXPECT_GE(rod.quality.mesh.box_half_width, 4.0 * reach);
    const double cell = 1.0 / (1 << rod.quality.mesh.surface_level);
    EXPECT_LE(3.0 * cell * rod.reference_length, 0.002);
}

TEST(BakePlan, CostsMoreAtAHigherQuality) {
    const Body body = test::ellipsoid({0.01, 0.02, 0.04});
    const BakePlan smoke = plan_bake(body, bake_quality("smoke"), 1e4);
    EXPECT_LT(5.0 * smoke.cpu_seconds, preview_of(body).cpu_seconds);
    EXPECT_LT(smoke.cells, preview_of(body).cells);
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
}

TEST(BakeQuality, OfAnUnknownNameIsRefused) {
    EXPECT_THROW(bake_quality("perfect"), Error);
}

}  // namespace
}  // namespace samara
