#include "converter/openfoam/foam_dictionary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using testing::EndsWith;

class FoamDictionaryTest : public testing::Test {
  protected:
    FoamDictionary read(const char* text) { return FoamDictionary(folder_.file("parameters", text)); }
    std::string number_error(const char* text) {
        return test::error_of([&] { static_cast<void>(read(text).number("a")); });
    }
    std::string vector_error(const char* text) {
        return test::error_of([&] { static_cast<void>(read(text).vector("a")); });
    }

    test::TemporaryFolder folder_;
};

TEST_F(FoamDictionaryTest, ReadsNumbersVectorsAndTextBesideWhatItPassesOver) {
    const FoamDictionary dictionary = read(
        "// All that differs\nFoamFile { version 2.0; }\n#include \"other\"\n"
        "direction           (1 0 -2.5e-1);    // unit vector\nreynoldsNumber      10000;\n"
        "shells ((0.2 4) (0.6 3));\nRAS { model kEpsilon; coefficients { C1 1.44; } }\nlast 1e-4;");
    EXPECT_EQ(dictionary.vector("direction"), Vector3d(1.0, 0.0, -0.25));
    EXPECT_EQ(dictionary.number("reynoldsNumber"), 1e4);
    EXPECT_EQ(dictionary.text("shells"), "((0.2 4) (0.6 3))");
    EXPECT_EQ(dictionary.number("last"), 1e-4);
}

TEST_F(FoamDictionaryTest, ErrorsNameFileAndEntry) {
    EXPECT_THAT(number_error("b 1;"), EndsWith("parameters: entry 'a' is missing"));
    EXPECT_THAT(number_error("a one;"), EndsWith("parameters: entry 'a' should be a number, is 'one'"));
    EXPECT_THAT(number_error("a 1 2;"), EndsWith("parameters: entry 'a' should be a number, is '1 2'"));
    EXPECT_THAT(number_error("a $b;"), EndsWith("parameters: entry 'a' should be a number, is '$b'"));
    EXPECT_THAT(vector_error("a (1 2);"), EndsWith("should be three numbers in brackets, is '(1 2)'"));
    EXPECT_THAT(vector_error("a (1 2 3 4);"),
                EndsWith("should be three numbers in brackets, is '(1 2 3 4)'"));
    EXPECT_THAT(vector_error("a 1;"), EndsWith("should be three numbers in brackets, is '1'"));
    EXPECT_THAT(number_error("b 1;\na 2"), EndsWith("parameters:2: this entry does not end with ';'"));
    EXPECT_THAT(number_error("b (1;\n"), EndsWith("parameters:1: this entry does not end with ';'"));
}

}  // namespace
}  // namespace samara
