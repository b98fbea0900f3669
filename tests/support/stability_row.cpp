#include "support/stability_row.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace samara::test {

void expect_row(const StabilityRow& row) {
    // A comparison that a NaN fails.
    EXPECT_LE(row.metric, row.bound) << row.subject << ", step " << row.step << ": " << row.checked;
    const nlohmann::json line = {{"subject", row.subject},
                                 {"step", row.step},
                                 {"checked", row.checked},
                                 {"bound", fmt::format("{:.3g}", row.bound)},
                                 {"figure", fmt::format("{:.2g}", row.metric)}};
    const int number = testing::UnitTest::GetInstance()->current_test_info()->result()->test_property_count();
    testing::Test::RecordProperty(fmt::format("row_{}", number), line.dump());
}

}  // namespace samara::test
