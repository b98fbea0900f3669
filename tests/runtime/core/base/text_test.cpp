#include "samara/core/base/text.hpp"

#include <gtest/gtest.h>

namespace samara {
namespace {

TEST(Printable, LeavesTextOfAllScriptsAsItIs) {
    for (const char* text : {"", "leaf 3", "Blatt 20°", "落叶", "\xf0\x9f\x8d\x82", "a\\b 'c' \"d\" <e>"}) {
        EXPECT_EQ(printable(text), text);
    }
}

TEST(Printable, ShowsWhatATerminalWouldObey) {
    EXPECT_EQ(printable("\x1b[2Ja\nb\tc\rd\x07"), R"(\x1b[2Ja\x0ab\x09c\x0dd\x07)");
    EXPECT_EQ(printable("a\x7f"), R"(a\x7f)");
    EXPECT_EQ(printable(std::string_view("a\0b", 3)), R"(a\x00b)");
    EXPECT_EQ(printable("\xc2\x9b"
                        "31m"),
              R"(\xc2\x9b31m)")
        << "the C1 control that begins a sequence";
    EXPECT_EQ(printable("exe.\xe2\x80\xaegnp"), R"(exe.\xe2\x80\xaegnp)")
        << "a turn of the writing's direction";
    EXPECT_EQ(printable("a\xe2\x80\xa8"), R"(a\xe2\x80\xa8)") << "a line's end";
}

TEST(Printable, ShowsBytesThatAreNoUtf8) {
    EXPECT_EQ(printable("caf\xe9"), R"(caf\xe9)") << "Latin-1";
    EXPECT_EQ(printable("\xc0\xaf"), R"(\xc0\xaf)") << "two bytes for what one says";
    EXPECT_EQ(printable("\xe0\x80\xaf"), R"(\xe0\x80\xaf)");
    EXPECT_EQ(printable("\xed\xa0\x80"), R"(\xed\xa0\x80)") << "a surrogate";
    EXPECT_EQ(printable("\xf4\x90\x80\x80"), R"(\xf4\x90\x80\x80)") << "beyond the last character";
    EXPECT_EQ(printable("a\xe2\x82"), R"(a\xe2\x82)") << "cut short";
    EXPECT_EQ(printable("\xff\xc3\xa9"), "\\xff\xc3\xa9") << "and goes on behind them";
}

TEST(Printable, TwiceIsTheSameAsOnce) {
    const std::string once = printable("\x1b[2J\xff\\x1b");
    EXPECT_EQ(printable(once), once);
}

TEST(Printable, LinesKeepTheirBreaksAndTabsAlone) {
    EXPECT_EQ(printable_lines("a\tb\nc\r\x1b\n"), "a\tb\nc\\x0d\\x1b\n");
}

const std::vector<std::string> keys = {"name", "shape", "scale", "mass", "density", "center_of_mass"};

TEST(NearestWord, IsTheOneThatWasMisspelt) {
    for (const char* written : {"densty", "desnity", "Density", "densitty", "denzity", "DENSTY"}) {
        EXPECT_EQ(nearest_word(written, keys), "density") << written;
    }
    EXPECT_EQ(nearest_word("center-of-mas", keys), "center_of_mass");
    EXPECT_EQ(nearest_word("nmae", keys), "name");
    EXPECT_EQ(did_you_mean("shap", keys), "; did you mean 'shape'?");
}

TEST(NearestWord, IsNoneWhereNoneIsNear) {
    for (const char* written : {"colour", "radius", "x", "", "viscosity"}) {
        EXPECT_EQ(nearest_word(written, keys), "") << written;
        EXPECT_EQ(did_you_mean(written, keys), "") << written;
    }
    EXPECT_EQ(nearest_word("scale", {"shape"}), "") << "two letters of five are another word";
    EXPECT_EQ(nearest_word(std::string(100000, 'a'), keys), "");
}

TEST(NearestWord, IsTheNearestOfSeveral) {
    EXPECT_EQ(nearest_word("--trheads", {"--three", "--threads", "--thread"}), "--threads");
    EXPECT_EQ(nearest_word("anything", {}), "");
}

}  // namespace
}  // namespace samara
