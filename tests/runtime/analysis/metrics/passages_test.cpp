#include "samara/analysis/metrics/passages.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace samara {
namespace {

/// Down a slope, and up again for a while: 0, 2, 1, 4 m deep.
FallSeries record_with_a_rise() {
    FallSeries record;
    record.down = Vector3d(0.6, 0.0, -0.8);
    const Vector3d aside(0, 1, 0);
    record.times = {0.0, 1.0, 2.0, 3.0};
    record.displacements = {Vector3d::Zero(), 2.0 * record.down + aside, record.down + 2.0 * aside,
                            4.0 * record.down + 5.0 * aside};
    return record;
}

TEST(Passages, AreWhereAFallFirstComesSoDeep) {
    const FallSeries record = record_with_a_rise();
    const std::vector<Passage> passages = passages_of(record, {0.5, 1.5, 2.5});
    ASSERT_EQ(passages.size(), 3u);
    EXPECT_DOUBLE_EQ(passages[0].time, 0.25);
    EXPECT_LT((passages[0].place - Vector3d(0, 0.25, 0)).norm(), 1e-15);
    EXPECT_DOUBLE_EQ(passages[1].time, 0.75);
    EXPECT_DOUBLE_EQ(passages[2].time, 2.5);
    EXPECT_LT((passages[2].place - Vector3d(0, 3.5, 0)).norm(), 1e-14);
}

TEST(Passages, AreNoneOfLevelsThatAFallDoesNotReach) {
    const FallSeries record = record_with_a_rise();
    EXPECT_EQ(passages_of(record, {1.0, 4.0, 4.1}).size(), 2u);
    EXPECT_TRUE(passages_of(record, {}).empty());
}

}  // namespace
}  // namespace samara
