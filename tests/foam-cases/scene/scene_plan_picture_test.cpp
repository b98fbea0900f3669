#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "converter/tables/direction_sampling.hpp"
#include "foam-cases/scene/scene_plan_report.hpp"
#include "samara/pictures/draw.hpp"
#include "support/temporary_folder.hpp"
#include "test_bodies.hpp"

namespace samara {
namespace {

TEST(ScenePlanPicture, HoldsEachVisitAndEachImageOfACase) {
    const Symmetry symmetry = test::ellipsoid({0.01, 0.02, 0.04}).symmetry;
    ScenePlan plan;
    plan.candidates.directions = required_directions(symmetry, 4);
    plan.chosen = {0, 1};
    std::vector<FlowVisit> visits(100);
    for (FlowVisit& visit : visits) visit.direction = symmetry.axes * Vector3d(0.6, 0.0, 0.8);
    const nlohmann::json picture = plan_picture("leaf", visits, symmetry, plan);
    ASSERT_EQ(picture["visited"].size(), 100U);
    EXPECT_NEAR(picture["visited"][0][0].get<double>(), 0.6, 1e-12);
    EXPECT_EQ(picture["cases"].size(), 2 * elements_in_map_axes(symmetry).size());
    const test::TemporaryFolder folder;
    draw_picture(folder / "plan.svg", picture);
    EXPECT_GT(std::filesystem::file_size(folder / "plan.svg"), 5000U);
}

}  // namespace
}  // namespace samara
