#include "foam-cases/bake/bake_schedule.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "foam-cases/farm/case_folder.hpp"
#include "test_bodies.hpp"

namespace samara {
namespace {

FarmWork work_of(std::vector<FarmTask> tasks) {
    return {std::move(tasks), 0};
}

FarmWork ellipsoid_work() {
    const Body body = test::ellipsoid({0.01, 0.02, 0.04});
    const BakePlan plan = plan_bake(body, bake_quality("preview"), 1e4);
    return farm_work("no such folder", body, plan, foam_cases_folder());
}

double sum_of(const FarmWork& work) {
    return std::accumulate(work.tasks.begin(), work.tasks.end(), 0.0,
                           [](double sum, const FarmTask& task) { return sum + task.seconds; });
}

TEST(BakeSchedule, OfOneSlotTakesTheSumOfAllTasks) {
    EXPECT_DOUBLE_EQ(seconds_with(work_of({{1.0, {}}, {2.0, {0}}, {4.0, {}}}), 1), 7.0);
    const FarmWork work = ellipsoid_work();
    EXPECT_NEAR(seconds_with(work, 1), sum_of(work), 1e-9 * sum_of(work));
}

TEST(BakeSchedule, WaitsForWhatACaseStartsFrom) {
    const FarmWork chain = work_of({{1.0, {}}, {2.0, {0}}, {4.0, {1}}, {3.0, {}}});
    EXPECT_DOUBLE_EQ(longest_chain(chain), 7.0);
    EXPECT_DOUBLE_EQ(seconds_with(chain, 2), 7.0);
    // Two and two on two slots, then the fifth: in the order of the list, not the best one.
    const FarmWork five = work_of({{2.0, {}}, {2.0, {}}, {2.0, {}}, {2.0, {}}, {4.0, {}}});
    EXPECT_DOUBLE_EQ(seconds_with(five, 2), 8.0);
    EXPECT_DOUBLE_EQ(longest_chain(five), 4.0);
}

TEST(BakeSchedule, IsBetweenTheLongestChainOrAnEvenShareAndGrahamsBound) {
    const FarmWork work = ellipsoid_work();
    for (const std::size_t slots : {2u, 3u, 8u, 64u}) {
        const double least = std::max(longest_chain(work), sum_of(work) / static_cast<double>(slots));
        const double seconds = seconds_with(work, slots);
        EXPECT_GE(seconds, least * (1.0 - 1e-12));
        EXPECT_LE(seconds, (2.0 - 1.0 / static_cast<double>(slots)) * least);
    }
}

TEST(BakeSchedule, OfManyBodiesTakesThemSideBySide) {
    FarmWork both = ellipsoid_work();
    both.add(ellipsoid_work());
    EXPECT_DOUBLE_EQ(longest_chain(both), longest_chain(ellipsoid_work()));
    EXPECT_NEAR(seconds_with(both, 1), 2.0 * seconds_with(ellipsoid_work(), 1), 1e-9);
}

}  // namespace
}  // namespace samara
