#include "samara/core/surface/obj_file.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samara/core/surface/polygon_triangles.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

using ::testing::ElementsAre;

const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
const std::string faces = "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

Surface read_text(const std::string& text) {
    const test::TemporaryFolder folder;
    return read_obj_file(folder.file("a.obj", text));
}

double volume_of(const std::string& text) {
    return test::moments_of(read_text(text)).volume;
}

std::string error_of(const std::string& text) {
    const std::string error = test::error_of([&] { read_text(text); });
    return error.substr(error.find("a.obj: ") + 7);
}

// A prism over the polygon whose corner i lies at radius(i), of height 1.
template <typename Radius>
std::string prism(std::size_t corners, const Radius& radius) {
    std::string text;
    for (const int z : {0, 1}) {
        for (std::size_t i = 0; i < corners; ++i) {
            const double angle =
                2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners);
            text += fmt::format("v {} {} {}\n", radius(i) * std::cos(angle), radius(i) * std::sin(angle), z);
        }
    }
    std::string bottom = "f";
    std::string top = "f";
    for (std::size_t i = 0; i < corners; ++i) {
        bottom += fmt::format(" {}", corners - i);
        top += fmt::format(" {}", corners + 1 + i);
        const std::size_t next = (i + 1) % corners;
        text += fmt::format("f {} {} {} {}\n", i + 1, next + 1, corners + next + 1, corners + i + 1);
    }
    return text + bottom + "\n" + top + "\n";
}

double area_of_star(std::size_t corners, double outer, double inner) {
    const auto count = static_cast<double>(corners);
    return 0.5 * count * outer * inner * std::sin(2.0 * std::numbers::pi / count);
}

TEST(ObjFile, ReadsFacesInEachWayOfWriting) {
    EXPECT_NEAR(volume_of(vertices + faces), 1.0, 1e-15);
    EXPECT_NEAR(volume_of(vertices + "f -8 -5 -6 -7\n" + faces.substr(10)), 1.0, 1e-15);
    EXPECT_NEAR(volume_of("# cube\nmtllib a.mtl\r\n" + vertices + "vt 0 0\nvn 0 0 1\nf 1/1/1 4//1 3/1 2\n" +
                          faces.substr(10)),
                1.0, 1e-15);
    std::string text = vertices + faces;
    std::replace(text.begin(), text.end(), '\n', '\r');
    EXPECT_NEAR(volume_of(text), 1.0, 1e-15);
    EXPECT_THAT(read_text("v +1.5e0 -2 .5 1.0\nv 0 0 0\nv 0 1 0\nf 1 2 3").vertices.front(),
                ElementsAre(1.5, -2.0, 0.5));
}

TEST(ObjFile, ReadsWhatProgramsPutAroundTheNumbers) {
    EXPECT_NEAR(volume_of("\xEF\xBB\xBF" + vertices + faces), 1.0, 1e-15) << "a byte order mark";
    EXPECT_NEAR(volume_of(vertices + "f 1 4 \\\n3 2\nf 5 6\\  \r\n 7 8\n" + faces.substr(20)), 1.0, 1e-15);
    EXPECT_NEAR(volume_of(vertices + "F 1 4 3 2 # the bottom\nf 5 6 7 8# the top\n" + faces.substr(20)), 1.0,
                1e-15);
    EXPECT_NEAR(volume_of("V\t0 0 1e-400\n" + vertices.substr(8) + faces), 1.0, 1e-15);
    EXPECT_EQ(error_of(vertices + "f 1 4 \\\n3 2\nf 5 6 7 9\n"), "line 11: a face refers to vertex '9' of 8");
    EXPECT_EQ(error_of(vertices + "f 1 4 \\\n3 9\n"), "line 9: a face refers to vertex '9' of 8");
    using namespace std::string_literals;
    EXPECT_THAT(error_of("\xFF\xFEv\0 \0"s), ::testing::HasSubstr("UTF-16 or UTF-32; save it as UTF-8"));
}

TEST(ObjFile, NamesTheLineThatIsWrong) {
    EXPECT_EQ(error_of("v 0 0 0\nv 1 nan 0\n"), "line 2: 'v' needs three numbers, not 'nan'");
    EXPECT_EQ(error_of("v 0 0 1e999\n"), "line 1: 'v' needs three numbers, not '1e999'");
    EXPECT_EQ(error_of("v 0 0\n"), "line 1: 'v' needs three numbers, not ''");
    EXPECT_EQ(error_of("v 0 0 0x\n"), "line 1: 'v' needs three numbers, not '0x'");
    EXPECT_EQ(error_of(vertices + "f 1 2 9\n"), "line 9: a face refers to vertex '9' of 8");
    EXPECT_EQ(error_of(vertices + "\r\nf 1 2 -9\n"), "line 10: a face refers to vertex '-9' of 8");
    EXPECT_EQ(error_of(vertices + "f 0 1 2\n"), "line 9: a face refers to vertex '0' of 8");
    EXPECT_EQ(error_of(vertices + "f 1 2 99999999999999999999\n"),
              "line 9: a face refers to vertex '99999999999999999999' of 8");
    EXPECT_EQ(error_of(vertices + "f 1 two 3\n"), "line 9: a face refers to vertex 'two' of 8");
    EXPECT_EQ(error_of(vertices + "f 1 2\n"), "line 9: a face must have three or more corners, not 2");
}

TEST(ObjFile, CutsPolygonsOfThousandsOfCornersAtOnce) {
    constexpr std::size_t corners = 9'998;
    const auto start = std::chrono::steady_clock::now();
    const double area = area_of_star(corners, 1.0, 1.0);
    EXPECT_NEAR(volume_of(prism(corners, [](std::size_t) { return 1.0; })), area, 1e-9);
    // Half of its corners are reflex.
    const double star = area_of_star(corners, 1.0, 0.9);
    EXPECT_NEAR(volume_of(prism(corners, [](std::size_t i) { return i % 2 == 0 ? 1.0 : 0.9; })), star, 1e-9);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    EXPECT_LT(elapsed.count(), 10.0);
}

TEST(ObjFile, RefusesAFaceOfMoreCornersAndNamesItsLine) {
    EXPECT_EQ(error_of(prism(10'001, [](std::size_t) { return 1.0; })),
              "line 30004: a face has 10001 corners, more than 10000; export the file with triangles");
}

std::vector<std::array<std::int32_t, 3>> cut(const std::vector<Vector3d>& corners) {
    std::vector<std::int32_t> all(corners.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::int32_t>(i);
    return polygon_triangles(corners, all);
}

TEST(PolygonTriangles, CoverAPolygonThatIsNotConvexAndTurnAsItDoes) {
    const std::vector<Vector3d> arrow = {{0, 0, 0}, {2, -1, 0}, {1, 0, 0}, {2, 1, 0}};
    Surface surface{arrow, cut(arrow), {}};
    ASSERT_EQ(surface.triangle_count(), 2U);
    for (std::size_t t = 0; t < 2; ++t) EXPECT_GT(area_vector(surface, t).z(), 0.0);
    EXPECT_NEAR(surface_area(surface), 1.0, 1e-15);
    // Turned into the plane x = 0 and round.
    for (Vector3d& vertex : surface.vertices) vertex = Vector3d(0.0, vertex.y(), vertex.x());
    surface.corners = cut(surface.vertices);
    for (std::size_t t = 0; t < 2; ++t) EXPECT_LT(area_vector(surface, t).x(), 0.0);
    EXPECT_NEAR(surface_area(surface), 1.0, 1e-15);
}

TEST(PolygonTriangles, GiveNoCornerALongRowOfThem) {
    std::vector<Vector3d> circle;
    for (int i = 0; i < 1024; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / 1024.0;
        circle.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    }
    std::vector<int> uses(circle.size());
    for (const auto& triangle : cut(circle)) {
        for (const std::int32_t corner : triangle) ++uses[static_cast<std::size_t>(corner)];
    }
    EXPECT_LE(*std::max_element(uses.begin(), uses.end()), 24);
}

TEST(PolygonTriangles, CoverOnesWithCornersOnALineAndEndOnOnesThatCrossThemselves) {
    const std::vector<Vector3d> square = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0},
                                          {1, 2, 0}, {0, 2, 0}, {0, 1, 0}};
    EXPECT_NEAR(surface_area({square, cut(square), {}}), 4.0, 1e-15);
    const std::vector<Vector3d> star = {
        {1, 0, 0}, {-0.8, 0.6, 0}, {0.3, -0.95, 0}, {0.3, 0.95, 0}, {-0.8, -0.6, 0}};
    EXPECT_EQ(cut(star).size(), 3U);
    EXPECT_EQ(cut(std::vector<Vector3d>(7, Vector3d::Zero())).size(), 5U);
}

}  // namespace
}  // namespace samara
