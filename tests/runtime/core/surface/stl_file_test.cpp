#include "samara/core/surface/stl_file.hpp"

#include <algorithm>
#include <cctype>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/expect_error.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

using ::testing::HasSubstr;

// A tetrahedron of volume 1/6.
std::string tetrahedron(const std::string& end_of_line = "\n", const std::string& blank = " ") {
    const char* corners[4] = {"0 0 0", "1.0E+00 0 0", "0 +1. 0", "0 0 100e-2"};
    const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    std::string text = "solid a solid with a vertex" + end_of_line;
    for (const auto& face : faces) {
        text += "facet normal 0 0 0" + end_of_line + "outer loop" + end_of_line;
        for (const int corner : face) {
            std::string place = corners[corner];
            std::string line = "vertex " + place;
            for (std::size_t at = line.find(' '); at != std::string::npos;
                 at = line.find(' ', at + blank.size()))
                line.replace(at, 1, blank);
            text += blank + line + end_of_line;
        }
        text += "endloop" + end_of_line + "endfacet" + end_of_line;
    }
    return text + "endsolid a" + end_of_line;
}

double volume_of(const std::string& bytes) {
    return test::moments_of(read_stl(bytes, "a.stl")).volume;
}

std::string error_of(const std::string& bytes) {
    return test::error_of([&] { read_stl(bytes, "a.stl"); });
}

TEST(StlFile, ReadsTextHoweverItsLinesEndAndItsWordsAreSpelt) {
    EXPECT_NEAR(volume_of(tetrahedron()), 1.0 / 6.0, 1e-15);
    EXPECT_NEAR(volume_of(tetrahedron("\r\n", "\t")), 1.0 / 6.0, 1e-15);
    EXPECT_NEAR(volume_of(tetrahedron("\r")), 1.0 / 6.0, 1e-15);
    EXPECT_NEAR(volume_of(tetrahedron(" ")), 1.0 / 6.0, 1e-15) << "all on one line";
    EXPECT_NEAR(volume_of("\xEF\xBB\xBF" + tetrahedron()), 1.0 / 6.0, 1e-15) << "with a byte order mark";
    std::string capitals = tetrahedron();
    std::transform(capitals.begin(), capitals.end(), capitals.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
    EXPECT_NEAR(volume_of(capitals), 1.0 / 6.0, 1e-15);
    const std::string nameless = tetrahedron();
    EXPECT_NEAR(volume_of(nameless.substr(nameless.find("facet"))), 1.0 / 6.0, 1e-15);
}

TEST(StlFile, SaysWhatATextIsThatIsNone) {
    EXPECT_THAT(error_of("v 0 0 0\nv 1 0 0\n" + std::string(200, '#')),
                HasSubstr("is not an STL file: a text file begins"));
    using namespace std::string_literals;
    EXPECT_THAT(error_of("\xFF\xFEs\0o\0l\0i\0d\0"s), HasSubstr("UTF-16 or UTF-32; save it as UTF-8"));
    EXPECT_THAT(error_of(tetrahedron() + "facet\nouter loop\nvertex 0 0 x\n"),
                HasSubstr("line 33: 'vertex' needs three numbers, not 'x'"));
    EXPECT_THAT(error_of(tetrahedron() + "facet\nouter loop\nvertex 0 0 0\n"), HasSubstr("is truncated"));
    EXPECT_THAT(error_of(std::string(80, 'a') + std::string("\x02\0\0\0", 4) + std::string(50, '\0')),
                HasSubstr("134 bytes, but 2 triangles need 184"));
}

}  // namespace
}  // namespace samara
