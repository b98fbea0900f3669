#include "meshes/checks/sound_surface.hpp"

#include <array>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshes/checks/shape_error.hpp"
#include "meshes/make_body.hpp"
#include "meshes/shape_files.hpp"
#include "samara/core/surface/surface_check.hpp"
#include "samara/core/surface/welded_surface.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

void append(Surface& surface, const Surface& more) {
    const auto first = static_cast<std::int32_t>(surface.vertices.size());
    surface.vertices.insert(surface.vertices.end(), more.vertices.begin(), more.vertices.end());
    for (const auto& [a, b, c] : more.corners) surface.corners.push_back({a + first, b + first, c + first});
}

Surface reversed(Surface surface) {
    for (auto& triangle : surface.corners) std::swap(triangle[1], triangle[2]);
    return surface;
}

// The message for the surface, read back from a file of its own.
std::string error_of(const Surface& surface) {
    const test::TemporaryFolder folder;
    test::write_stl(folder / "defect.stl", surface);
    const std::string error = test::error_of([&] { make_body(folder / "defect.stl"); });
    EXPECT_THAT(error, StartsWith((folder / "defect.stl").string() + ": "));
    EXPECT_THAT(error, Not(HasSubstr("\n")));
    EXPECT_THAT(error, HasSubstr("; ")) << "the remedy";
    return error;
}

TEST(SoundSurface, PassesAClosedSurface) {
    const Surface box = welded(test::box(Vector3d::Ones(), 3));
    EXPECT_NO_THROW(require_sound_surface(box));
}

TEST(SoundSurface, FindsAnEmptyFile) {
    EXPECT_THAT(error_of({}), HasSubstr("holds no triangles"));
}

TEST(SoundSurface, FindsAHoleAndSaysWhere) {
    Surface sphere = test::ellipsoid(Vector3d(1.0, 2.0, 4.0), 2);
    const auto corner = [&](std::size_t i) {
        return place(sphere.vertices[static_cast<std::size_t>(sphere.corners[0][i])]);
    };
    const std::array<std::string, 3> places = {corner(0), corner(1), corner(2)};
    sphere.corners.erase(sphere.corners.begin());
    const std::string error = error_of(sphere);
    EXPECT_THAT(error, AllOf(HasSubstr("is not closed: 3 edges have a face on one side only"),
                             HasSubstr("fill the hole")));
    EXPECT_THAT(error, ::testing::AnyOf(HasSubstr(places[0]), HasSubstr(places[1])));
}

TEST(SoundSurface, FindsAnInsideOutSurface) {
    EXPECT_THAT(error_of(reversed(test::box(Vector3d::Ones(), 2))),
                AllOf(HasSubstr("inside out"), HasSubstr("--flip")));
}

TEST(SoundSurface, FlipReversesAnInsideOutSurface) {
    const test::TemporaryFolder folder;
    test::write_stl(folder / "box.stl", reversed(test::box(Vector3d::Ones(), 2)));
    MeshOptions options;
    options.sizing = MeshOptions::Sizing::keep;
    options.flip = true;
    EXPECT_NEAR(make_body(folder / "box.stl", options).moments.volume, 1.0, 1e-12);
}

TEST(SoundSurface, FindsTheOneFaceThatIsReversed) {
    Surface box = test::box(Vector3d::Ones(), 2);
    std::swap(box.corners[16][0], box.corners[16][1]);
    EXPECT_THAT(error_of(box), AllOf(HasSubstr("1 of 48 faces is oriented against the others"),
                                     HasSubstr("face 17 at"), HasSubstr(place(triangle_centroid(box, 16)))));
}

TEST(SoundSurface, FindsTheFewFacesThatAreReversedEvenIfTheFirstIsAmongThem) {
    Surface box = test::box(Vector3d::Ones(), 2);
    for (const std::size_t t : {0U, 5U}) std::swap(box.corners[t][0], box.corners[t][1]);
    EXPECT_THAT(error_of(box), AllOf(HasSubstr("2 of 48 faces are oriented"), HasSubstr("face 1 at")));
}

TEST(SoundSurface, FindsADuplicateFace) {
    Surface box = test::box(Vector3d::Ones(), 2);
    box.corners.push_back(box.corners[6]);
    EXPECT_THAT(error_of(box), HasSubstr("faces 7 and 49"));
}

TEST(SoundSurface, FindsADuplicateFaceThatIsReversed) {
    Surface box = test::box(Vector3d::Ones(), 2);
    box.corners.push_back({box.corners[6][1], box.corners[6][0], box.corners[6][2]});
    EXPECT_THAT(error_of(box), HasSubstr("are the same"));
}

TEST(SoundSurface, FindsAFaceOnItsOwn) {
    Surface box = test::box(Vector3d::Ones(), 2);
    Surface stray;
    stray.vertices = {Vector3d(5, 5, 5), Vector3d(6, 5, 5), Vector3d(5, 6, 5)};
    stray.corners = {{0, 1, 2}};
    append(box, stray);
    EXPECT_THAT(error_of(box), AllOf(HasSubstr("face 49 at (5.333, 5.333, 5) is not part of the surface"),
                                     HasSubstr("delete it")));
}

TEST(SoundSurface, FindsAFaceThatHangsOnByAnEdge) {
    Surface box = test::box(Vector3d::Ones(), 2);
    box.vertices.emplace_back(2.0, 2.0, 2.0);
    const auto tip = static_cast<std::int32_t>(box.vertices.size()) - 1;
    box.corners.push_back({box.corners[0][0], box.corners[0][1], tip});
    EXPECT_THAT(error_of(box),
                AllOf(HasSubstr("face 49"), HasSubstr("is not part of the surface: it shares an edge that")));
}

TEST(SoundSurface, FindsAnInnerWall) {
    // Two boxes that share a face: the wall between them stays in neither or in both.
    Surface boxes = test::box(Vector3d::Ones(), 1);
    append(boxes,
           test::mapped(test::box(Vector3d::Ones(), 1), Matrix3d::Identity(), Vector3d(0.0, 1.0, 1.0)));
    EXPECT_THAT(error_of(boxes), HasSubstr("4 faces share the edge"));
}

TEST(SoundSurface, FindsACornerWhereSheetsTouch) {
    Surface boxes = test::box(Vector3d::Ones(), 1);
    append(boxes, test::mapped(test::box(Vector3d::Ones(), 1), Matrix3d::Identity(), Vector3d::Ones()));
    EXPECT_THAT(error_of(boxes), HasSubstr("touch at the corner (0.5, 0.5, 0.5)"));
}

TEST(SoundSurface, FindsNumbersThatAreNotFinite) {
    Surface box = test::box(Vector3d::Ones(), 2);
    box.vertices[static_cast<std::size_t>(box.corners[3][0])].y() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(error_of(box), AllOf(HasSubstr("not finite"), HasSubstr("nan")));
}

TEST(SoundSurface, FindsSizesThatNoBodyHas) {
    Surface box = test::box(Vector3d::Ones(), 2);
    box.vertices[static_cast<std::size_t>(box.corners[3][0])].z() = 1e300;
    EXPECT_THAT(error_of(box), AllOf(HasSubstr("1e+300"), HasSubstr("farther than 1e+12")));
    EXPECT_THAT(error_of(test::box(Vector3d::Constant(1e-13), 1)), HasSubstr("within 1e-12 of each other"));
}

TEST(SoundSurface, FindsAFaceWithoutArea) {
    Surface box = test::box(Vector3d::Ones(), 2);
    const auto [a, b, c] = box.corners[4];
    const auto middle = static_cast<std::int32_t>(box.vertices.size());
    box.vertices.push_back(
        0.5 * (box.vertices[static_cast<std::size_t>(a)] + box.vertices[static_cast<std::size_t>(b)]));
    box.corners.push_back({a, b, middle});
    EXPECT_THAT(error_of(box), AllOf(HasSubstr("face 49"), HasSubstr("has no area")));
}

TEST(SoundSurface, FindsASheetWithoutThickness) {
    Surface sheet;
    sheet.vertices = {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(1, 1, 0), Vector3d(0, 1, 0)};
    sheet.corners = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
    EXPECT_THAT(error_of(sheet), AllOf(HasSubstr("enclose no volume"), HasSubstr("thickness")));
}

TEST(SoundSurface, FindsASurfaceThatPassesThroughItself) {
    // A dent from the top goes out through the bottom.
    Surface box = test::box(Vector3d::Ones(), 4);
    for (Vector3d& vertex : box.vertices) {
        if ((vertex - Vector3d(0.25, 0.0, 0.5)).norm() < 1e-9) vertex = Vector3d(0.2, 0.07, -0.7);
    }
    EXPECT_THAT(error_of(box), HasSubstr("intersects itself"));
}

TEST(SoundSurface, RejectsACavityAndSaysWhatToDo) {
    Surface shell = test::box(Vector3d::Ones(), 2);
    append(shell, reversed(test::box(Vector3d::Constant(0.5), 2)));
    EXPECT_THAT(error_of(shell),
                AllOf(HasSubstr("the 48 faces around"), HasSubstr("enclose a cavity"),
                      HasSubstr("delete them"), HasSubstr("mass, center_of_mass and inertia in the scene")));
}

TEST(SoundSurface, FindsAHollowBodyThatIsInsideOut) {
    Surface shell = reversed(test::box(Vector3d::Ones(), 2));
    append(shell, test::box(Vector3d::Constant(0.5), 2));
    EXPECT_THAT(error_of(shell), AllOf(HasSubstr("inside out"), HasSubstr("--flip")));
}

TEST(SoundSurface, TakesABodyOfSeveralPieces) {
    Surface bodies = test::box(Vector3d::Ones(), 2);
    append(bodies,
           test::mapped(test::box(Vector3d::Ones(), 2), Matrix3d::Identity(), Vector3d(3.0, 0.0, 0.0)));
    const Surface sound = welded(bodies);
    EXPECT_NO_THROW(require_sound_surface(sound));
    EXPECT_NEAR(volume_moments(sound).volume, 2.0, 1e-12);
}

TEST(SoundSurface, FindsABodyWithinABody) {
    Surface bodies = test::box(Vector3d::Ones(), 2);
    append(bodies, test::box(Vector3d::Constant(0.5), 2));
    EXPECT_THAT(error_of(bodies), HasSubstr("inside another part"));
}

TEST(SoundSurface, FindsTheOnePieceThatIsInsideOut) {
    Surface bodies = test::box(Vector3d::Ones(), 2);
    append(bodies, test::mapped(reversed(test::box(Vector3d::Ones(), 2)), Matrix3d::Identity(),
                                Vector3d(3.0, 0.0, 0.0)));
    EXPECT_THAT(error_of(bodies), HasSubstr("is inside out, the others are not"));
}

TEST(SoundSurface, WeldsWhatLiesWithinTheTolerance) {
    Surface box = test::box(Vector3d::Ones(), 4);
    Surface soup;
    double nudge = 0.0;
    for (const auto& triangle : box.corners) {
        const auto first = static_cast<std::int32_t>(soup.vertices.size());
        for (const std::int32_t vertex : triangle) {
            nudge = nudge > 0.0 ? -2e-7 : 2e-7;
            soup.vertices.push_back(box.vertices[static_cast<std::size_t>(vertex)] +
                                    Vector3d::Constant(nudge));
        }
        soup.corners.push_back({first, first + 1, first + 2});
    }
    const Surface sound = welded(soup);
    EXPECT_EQ(sound.vertices.size(), 6U * 16U + 2U);
    EXPECT_NO_THROW(require_sound_surface(sound));
}

}  // namespace
}  // namespace samara
