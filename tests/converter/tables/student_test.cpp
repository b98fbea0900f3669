#include <gtest/gtest.h>

#include "converter/tables/standard_error.hpp"

namespace samara {
namespace {

TEST(Student, WidensByHalfOfTheTabulatedQuantiles) {
    // t at 95.45 %, two-sided: GUM (JCGM 100:2008), table G.2.
    EXPECT_NEAR(2.0 * student_widening(1), 13.97, 0.005);
    EXPECT_NEAR(2.0 * student_widening(2), 4.53, 0.005);
    EXPECT_NEAR(2.0 * student_widening(3), 3.31, 0.005);
    EXPECT_NEAR(2.0 * student_widening(5), 2.65, 0.005);
    EXPECT_NEAR(2.0 * student_widening(10), 2.28, 0.005);
    EXPECT_NEAR(2.0 * student_widening(45), 2.06, 0.005);
}

TEST(Student, HasNothingToWidenWhereNothingWasEstimated) {
    EXPECT_EQ(student_widening(0), 1.0);
}

TEST(Student, TendsToOne) {
    EXPECT_NEAR(student_widening(100'000), 1.0, 1e-4);
}

}  // namespace
}  // namespace samara
