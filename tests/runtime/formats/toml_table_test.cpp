#include "samara/formats/toml_table.hpp"

#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samara/core/base/error.hpp"

namespace samara {
namespace {

using testing::HasSubstr;

/// What parse_toml says of a text: "accepted", or its rejection.
std::string verdict(const std::string& text) {
    try {
        (void)parse_toml(text, "scene.toml");
    } catch (const Error& error) {
        return error.what();
    }
    return "accepted";
}

std::string repeated(std::string_view piece, int times) {
    std::string text;
    for (int i = 0; i < times; ++i) text += piece;
    return text;
}

TEST(TomlKeys, OfFiftyThousandPartsAreRefusedWithTheirLine) {
    const std::string many = repeated("a.", 50'000) + "a";
    std::vector<std::string> texts;
    for (const char* place :
         {"\n{} = 1\n", "\n[{}]\n", "\n[[{}]]\n", "\nx = {{ {} = 1 }}\n", "\nx = [ {{ {} = 1 }} ]\n"}) {
        texts.push_back(fmt::format(fmt::runtime(place), many));
    }
    for (const char* part : {"\"a\".", "'a' . ", "'#\\'.", "\"#\\\"\"."}) {
        texts.push_back(fmt::format("\n{}a = 1\n", repeated(part, 50'000)));
    }
    for (const std::string& text : texts) {
        EXPECT_THAT(verdict(text), HasSubstr("scene.toml:2: a key has more than 8 parts"))
            << text.substr(0, 40);
    }
}

TEST(TomlKeys, DeepTablesWithinTablesAreRefused) {
    for (const char* piece : {"[", "{ a = ", "{ a.a.a.a.a.a.a.a = ", "[ { a = "}) {
        const std::string text = fmt::format("x = {}", repeated(piece, 50'000));
        EXPECT_THAT(verdict(text), HasSubstr("scene.toml:1:")) << text.substr(0, 40);
    }
    const std::string nested =
        fmt::format("x = {}1{}\n", repeated("{ a.a.a.a.a.a.a.a = ", 200), repeated(" }", 200));
    EXPECT_EQ(verdict(nested), "accepted") << "as deep as the limits let it be";
}

TEST(TomlKeys, DotsElsewhereAreNoneOfAKey) {
    EXPECT_EQ(
        verdict("a.b.c.d.e.f.g.h = 1\n"
                "shape = \"../../../../../../../../../a.geo\"\n"
                "x = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 1.0e-3]  # and so on . . . . . . . . .\n"
                "literal = 'c:\\.\\.\\.\\.\\.\\.\\.\\.\\.'  # it's\n"
                "long = \"\"\"a \"quoted\" . . . . . . . . . \\\" . word\"\"\"\"\n"
                "other = '''\n. . . . . . . . . .''\n'''\n"
                "empty = \"\"\nnone = ''\n"
                "date = 1979-05-27T07:32:00.999\n"),
        "accepted");
}

}  // namespace
}  // namespace samara
