#include "samara/internal/plot/heading.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samara/internal/plot/axis_scale.hpp"
#include "support/text_extent.hpp"

namespace samara {
namespace {

TEST(TextWidth, IsThatOfTheBoldFontForAscii) {
    const std::string text = "Leaf No. 7 (\"WIDE\"): 12.5 m/s, 95 % @ ~1 {a_b}";
    EXPECT_NEAR(text_width(text, 24.0), test::text_extent(text, 24.0, true).width,
                0.01 * text_width(text, 24.0));
    EXPECT_GE(text_width("größer ± 2 °", 24.0), test::text_extent("größer ± 2 °", 24.0, true).width);
}

TEST(Shortened, KeepsWhatFitsOfEitherEndAndWholeLetters) {
    EXPECT_EQ(shortened("short", 24.0, 200.0), "short");
    const std::string text = "größer äußerst überflüssig";
    for (double width = 30.0; width < 400.0; width += 7.0) {
        for (const Keep keep : {Keep::beginning, Keep::end}) {
            const std::string kept = shortened(text, 24.0, width, keep);
            EXPECT_LE(text_width(kept, 24.0), width);
            if (kept == text) continue;
            const std::string part =
                keep == Keep::beginning ? kept.substr(0, kept.size() - 3) : kept.substr(3);
            EXPECT_EQ(keep == Keep::beginning ? text.substr(0, part.size())
                                              : text.substr(text.size() - part.size()),
                      part);
            EXPECT_FALSE(!part.empty() && (part.front() & 0xc0) == 0x80) << kept;
        }
    }
    EXPECT_EQ(shortened(text, 24.0, 1.0), "…");
}

TEST(AxisScale, LeavesNumbersAsTheyAreWhereTheyAreShort) {
    for (const Range range : {Range{-1.0, 0.1}, Range{0.0, 0.03}, Range{-940.0, 10.0}}) {
        const AxisScale scale = axis_scale(range, 985.0, 70.0, 95.0);
        EXPECT_EQ(scale.number(range.low), range.low);
        EXPECT_EQ(scale.title("z"), "z (m)");
    }
}

TEST(AxisScale, TakesAnOriginFarAwayAndAPowerOfTenForTheLargeAndTheSmall) {
    const AxisScale far = axis_scale({98765.1, 98765.9}, 985.0, 70.0, 95.0);
    EXPECT_EQ(far.exponent, 0);
    EXPECT_LT(std::abs(far.number(98765.5)), 1.0);
    EXPECT_EQ(far.title("z"), "z − 98766 (m)");
    EXPECT_EQ(axis_scale({-98765.9, -98765.1}, 985.0, 70.0, 95.0).title("z"), "z + 98766 (m)");
    const AxisScale huge = axis_scale({-4e6, 0.0}, 985.0, 70.0, 95.0);
    EXPECT_EQ(huge.title("z"), "z (10⁶ m)");
    EXPECT_DOUBLE_EQ(huge.number(-3e6), -3.0);
    EXPECT_EQ(axis_scale({-4e-7, 0.0}, 985.0, 70.0, 95.0).title("z"), "z (10⁻⁹ m)");
}

TEST(TicStep, LeavesTwoTicsWhereThereIsRoomForThem) {
    const auto tics = [](const Range& range, double step) {
        return std::floor(range.high / step + 1e-9) - std::ceil(range.low / step - 1e-9) + 1.0;
    };
    for (double low = -1.0; low < 1.0; low += 0.0173) {
        for (double size = 0.1; size < 1.0; size *= 1.07) {
            const Range range{low, low + size};
            EXPECT_GE(tics(range, tic_step(range, 250.0, 85.0)), 2.0) << low << " " << size;
        }
    }
    EXPECT_DOUBLE_EQ(tic_step({0.0, 1.0}, 1000.0, 90.0), 0.1);
}

}  // namespace
}  // namespace samara
