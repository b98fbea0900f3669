#include "samara/formats/json_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samara/core/files/input_file.hpp"
#include "support/expect_error.hpp"

namespace samara {
namespace {

using testing::HasSubstr;

std::string nested(std::size_t depth) {
    return std::string(depth, '[') + std::string(depth, ']');
}

TEST(JsonText, IsReadUpToADepth) {
    EXPECT_EQ(parse_json(nested(100)).dump(), nested(100));
    EXPECT_EQ(test::error_of([] { (void)parse_json(nested(101)); }),
              "nests lists and objects more than 100 deep");
    EXPECT_EQ(test::error_of([] { (void)parse_json(R"({"a":)" + nested(1'000'000) + "}"); }),
              "nests lists and objects more than 100 deep");
    EXPECT_TRUE(parse_json_or_discard(nested(101)).is_discarded());
    EXPECT_EQ(parse_json_or_discard(nested(100)).dump(), nested(100));
}

TEST(JsonText, CountsNoBracketsOfStrings) {
    const std::string text = R"(["\"[[[[\\", ")" + std::string(500, '{') + R"("])";
    EXPECT_EQ(parse_json(text).size(), 2U);
    EXPECT_TRUE(error_of_json_size(std::string(500, '"') + nested(50)).empty());
}

TEST(JsonText, ThatIsNoneSaysWhere) {
    EXPECT_THAT(test::error_of([] { (void)parse_json("[1,"); }), HasSubstr("is not valid JSON ("));
    EXPECT_TRUE(parse_json_or_discard("[1,").is_discarded());
    EXPECT_TRUE(parse_json_or_discard("").is_discarded());
    EXPECT_TRUE(parse_json_or_discard("]]]][[[[").is_discarded());
    EXPECT_TRUE(parse_json_or_discard(std::string("\"\\")).is_discarded());
}

}  // namespace
}  // namespace samara
