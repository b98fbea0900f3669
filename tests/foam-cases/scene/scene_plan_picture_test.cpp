#include "foam-cases/scene/scene_plan_picture.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "converter/tables/direction_sampling.hpp"
#include "support/picture_faults.hpp"
#include "support/temporary_folder.hpp"
#include "test_bodies.hpp"

namespace samara {
namespace {

using testing::IsEmpty;

/// A plan of every second direction of an ellipsoid.
ScenePlan plan_of(const Symmetry& symmetry) {
    ScenePlan plan;
    plan.candidates.directions = required_directions(symmetry, 4);
    for (std::size_t i = 0; i < plan.candidates.directions.size(); i += 2) plan.chosen.push_back(i);
    return plan;
}

std::vector<FlowVisit> visits_about(const Vector3d& direction, int count) {
    std::vector<FlowVisit> visits;
    for (int i = 0; i < count; ++i) {
        FlowVisit visit{};
        visit.direction =
            (direction + 0.3 * Vector3d(std::sin(0.7 * i), std::cos(1.3 * i), std::sin(2.1 * i)))
                .normalized();
        visits.push_back(visit);
    }
    return visits;
}

test::SvgPicture drawn(const std::string& name, const std::vector<FlowVisit>& visits) {
    const test::TemporaryFolder folder;
    const Symmetry symmetry = test::ellipsoid({0.01, 0.02, 0.04}).symmetry;
    draw_plan(folder / "plan.svg", name, visits, symmetry, plan_of(symmetry));
    return test::read_svg(folder / "plan.svg");
}

TEST(ScenePlanPicture, CanBeReadOff) {
    EXPECT_THAT(test::faults_of(drawn("leaf", visits_about({0.2, 0.1, 1.0}, 500))), IsEmpty());
    EXPECT_THAT(test::faults_of(drawn("leaf", visits_about({1.0, 0.0, 0.0}, 20000))), IsEmpty());
    EXPECT_THAT(test::faults_of(
                    drawn("it's_{a} leaf with \\n a long & unusual name of its own, " + std::string(80, 'W'),
                          visits_about({0.0, 0.0, -1.0}, 50))),
                IsEmpty());
    EXPECT_THAT(test::faults_of(drawn("still", {})), IsEmpty());
}

TEST(ScenePlanPicture, ShowsEachVisitOnItsHalfAndEachImageOfACase) {
    const test::SvgPicture picture = drawn("leaf", visits_about(Vector3d::UnitZ(), 100));
    std::vector<std::size_t> visited;
    for (const test::SvgCurve& curve : picture.curves) {
        if (curve.title == "visited") visited.push_back(curve.marks.size());
    }
    EXPECT_THAT(visited, testing::ElementsAre(100U, 0U));
}

}  // namespace
}  // namespace samara
