#include "meshes/symmetry/symmetry.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "support/test_shapes.hpp"

namespace samara {
namespace {

using std::numbers::pi;

Symmetry symmetry_of(const Surface& surface) {
    return find_symmetry(surface, test::moments_of(surface));
}

Matrix3d some_rotation() {
    return Quaterniond(0.83, 0.31, -0.42, 0.27).normalized().toRotationMatrix();
}

Surface rotated(const Surface& surface) {
    return test::mapped(surface, some_rotation(), Vector3d(0.4, -0.3, 0.2));
}

bool is_signed_permutation(const Matrix3d& matrix) {
    return (matrix.array() == matrix.array().round()).all() && (matrix * matrix.transpose()).isIdentity(0.0);
}

// A closed prism or double pyramid over the polygon's points (x, y), from -height to height: flat ends, each
// a fan about the origin's axis.
Surface prism(const std::vector<Eigen::Vector2d>& polygon, double height, double upper_scale = 1.0) {
    Surface surface;
    const auto n = static_cast<std::int32_t>(polygon.size());
    for (const Eigen::Vector2d& p : polygon) surface.vertices.emplace_back(p.x(), p.y(), -height);
    for (const Eigen::Vector2d& p : polygon) {
        surface.vertices.emplace_back(upper_scale * p.x(), upper_scale * p.y(), height);
    }
    surface.vertices.emplace_back(0.0, 0.0, -height);
    surface.vertices.emplace_back(0.0, 0.0, height);
    for (std::int32_t i = 0; i < n; ++i) {
        const std::int32_t next = (i + 1) % n;
        surface.corners.push_back({i, next, n + next});
        surface.corners.push_back({i, n + next, n + i});
        surface.corners.push_back({2 * n, next, i});
        surface.corners.push_back({2 * n + 1, n + i, n + next});
    }
    return surface;
}

std::vector<Eigen::Vector2d> polygon(int corners, double turn) {
    std::vector<Eigen::Vector2d> points;
    for (int i = 0; i < corners; ++i) {
        const double angle = turn + 2.0 * pi * i / corners;
        points.emplace_back(std::cos(angle), std::sin(angle));
    }
    return points;
}

// Corners of a star whose points lean to one side: no mirrors through the axis.
std::vector<Eigen::Vector2d> pinwheel(int blades) {
    std::vector<Eigen::Vector2d> points;
    for (int i = 0; i < blades; ++i) {
        const double angle = 2.0 * pi * i / blades;
        points.emplace_back(std::cos(angle), std::sin(angle));
        points.emplace_back(0.4 * std::cos(angle + 0.3), 0.4 * std::sin(angle + 0.3));
    }
    return points;
}

Surface tetrahedron() {
    Surface surface;
    surface.vertices = {Vector3d(1, 1, 1), Vector3d(1, -1, -1), Vector3d(-1, 1, -1), Vector3d(-1, -1, 1)};
    surface.corners = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    return surface;
}

void expect_group(const Symmetry& symmetry) {
    EXPECT_TRUE(symmetry.elements.front().isIdentity(0.0));
    EXPECT_NEAR(symmetry.axes.determinant(), 1.0, 1e-12);
    const auto has = [&](const Matrix3d& wanted) {
        return std::any_of(symmetry.elements.begin(), symmetry.elements.end(),
                           [&](const Matrix3d& element) { return (element - wanted).norm() < 1e-10; });
    };
    for (const Matrix3d& a : symmetry.elements) {
        EXPECT_TRUE((a * a.transpose()).isIdentity(1e-12));
        for (const Matrix3d& b : symmetry.elements) EXPECT_TRUE(has(a * b));
    }
}

void expect_exact_in_shape_axes(const Symmetry& symmetry) {
    EXPECT_TRUE(symmetry.axes.isIdentity(0.0));
    for (const Matrix3d& element : symmetry.elements) EXPECT_TRUE(is_signed_permutation(element));
}

TEST(Symmetry, AnEllipsoidHasEightElementsThatAreExactInItsAxes) {
    const Symmetry symmetry =
        symmetry_of(test::ellipsoid(Vector3d(1.0, 2.0, 4.0), 3, Vector3d(0.1, 0.2, 0.3)));
    EXPECT_EQ(symmetry.type, Symmetry::Type::finite);
    EXPECT_EQ(symmetry.elements.size(), 8U);
    expect_exact_in_shape_axes(symmetry);
    expect_group(symmetry);
}

TEST(Symmetry, ARotatedEllipsoidHasItsElementsInItsOwnFrame) {
    const Symmetry symmetry = symmetry_of(rotated(test::ellipsoid(Vector3d(1.0, 2.0, 4.0), 3)));
    ASSERT_EQ(symmetry.elements.size(), 8U);
    expect_group(symmetry);
    // Whatever their order and signs, the columns are the ellipsoid's axes.
    const Matrix3d agreement = (symmetry.axes.transpose() * some_rotation()).cwiseAbs();
    EXPECT_TRUE((agreement.rowwise().maxCoeff().array() > 0.9995).all()) << agreement;
    for (const Matrix3d& element : symmetry.elements) {
        EXPECT_LT((symmetry.axes.transpose() * element * symmetry.axes).cwiseAbs().sum() - 3.0, 1e-12);
    }
}

TEST(Symmetry, ASphereIsSphericalHoweverCoarseOrUneven) {
    for (const int level : {2, 3})
        EXPECT_EQ(symmetry_of(test::icosphere(level)).type, Symmetry::Type::spherical);
    EXPECT_EQ(symmetry_of(test::shaken_icosphere(3, 0.2, 1)).type, Symmetry::Type::spherical);
}

TEST(Symmetry, ASpheroidIsAxialWithAMirrorAcross) {
    const Symmetry symmetry = symmetry_of(test::ellipsoid(Vector3d(2.0, 1.0, 2.0), 3));
    EXPECT_EQ(symmetry.type, Symmetry::Type::axial);
    EXPECT_EQ(symmetry.axis, Vector3d::UnitY());
    EXPECT_EQ(symmetry.elements.size(), 4U);
    expect_exact_in_shape_axes(symmetry);
    expect_group(symmetry);
}

TEST(Symmetry, ARotatedSpheroidHasItsAxisWhereItWasTurnedTo) {
    const Symmetry symmetry = symmetry_of(rotated(test::ellipsoid(Vector3d(1.0, 1.0, 3.0), 3)));
    ASSERT_EQ(symmetry.type, Symmetry::Type::axial);
    EXPECT_GT(std::abs(symmetry.axis.dot(some_rotation().col(2))), 0.9999);
    // One of the frame's columns is the axis.
    EXPECT_NEAR((symmetry.axes.transpose() * symmetry.axis).cwiseAbs().maxCoeff(), 1.0, 1e-12);
    expect_group(symmetry);
}

TEST(Symmetry, ACutConeIsAxialWithoutAMirrorAcross) {
    const Symmetry symmetry = symmetry_of(prism(polygon(60, 0.1), 0.3, 0.7));
    EXPECT_EQ(symmetry.type, Symmetry::Type::axial);
    EXPECT_EQ(symmetry.elements.size(), 2U);
}

TEST(Symmetry, ABoxHasEightElementsASquareOneSixteenACube48) {
    EXPECT_EQ(symmetry_of(test::box(Vector3d(1.0, 2.0, 3.0), 2)).elements.size(), 8U);
    EXPECT_EQ(symmetry_of(test::box(Vector3d(1.0, 2.0, 2.0), 2)).elements.size(), 16U);
    const Symmetry cube = symmetry_of(test::box(Vector3d::Ones(), 4));
    EXPECT_EQ(cube.elements.size(), 48U);
    expect_exact_in_shape_axes(cube);
}

TEST(Symmetry, AThinSheetHasSixteenElements) {
    const Symmetry symmetry = symmetry_of(test::box(Vector3d(0.083, 0.083, 0.0001), 8));
    EXPECT_EQ(symmetry.elements.size(), 16U);
    expect_exact_in_shape_axes(symmetry);
}

TEST(Symmetry, ARotatedCubeHas48ElementsInItsOwnFrame) {
    const Symmetry symmetry = symmetry_of(rotated(test::box(Vector3d::Ones(), 4)));
    ASSERT_EQ(symmetry.elements.size(), 48U);
    expect_group(symmetry);
    const Matrix3d agreement = (symmetry.axes.transpose() * some_rotation()).cwiseAbs();
    EXPECT_TRUE((agreement.rowwise().maxCoeff().array() > 0.9995).all()) << agreement;
}

TEST(Symmetry, ATetrahedronHas24Elements) {
    const Symmetry symmetry = symmetry_of(tetrahedron());
    EXPECT_EQ(symmetry.elements.size(), 24U);
    expect_exact_in_shape_axes(symmetry);
    const Symmetry turned = symmetry_of(rotated(tetrahedron()));
    EXPECT_EQ(turned.elements.size(), 24U);
    expect_group(turned);
}

TEST(Symmetry, AnIcosahedronHas120Elements) {
    // The icosphere of level 0 is the icosahedron itself.
    const Symmetry symmetry = symmetry_of(test::icosphere(0));
    EXPECT_EQ(symmetry.elements.size(), 120U);
    expect_group(symmetry);
}

TEST(Symmetry, PrismsOverRegularPolygonsHaveFourElementsForEachCorner) {
    for (const int corners : {3, 5, 6, 8}) {
        const Symmetry symmetry = symmetry_of(prism(polygon(corners, 0.3), 0.2));
        EXPECT_EQ(symmetry.type, Symmetry::Type::finite);
        EXPECT_EQ(symmetry.elements.size(), static_cast<std::size_t>(4 * corners));
        SCOPED_TRACE(corners);
        expect_group(symmetry);
    }
}

TEST(Symmetry, APinwheelHasRotationsAndTheMirrorAcrossOnly) {
    const Symmetry symmetry = symmetry_of(prism(pinwheel(3), 0.2));
    EXPECT_EQ(symmetry.elements.size(), 6U);
    expect_group(symmetry);
    EXPECT_EQ(symmetry_of(prism(pinwheel(3), 0.2, 0.6)).elements.size(), 3U);
}

TEST(Symmetry, AWedgeHasOneMirrorAndAnUnevenBodyNone) {
    const Symmetry wedge = symmetry_of(prism({{-1, -0.5}, {1.5, -0.5}, {-1, 0.9}}, 0.3));
    ASSERT_EQ(wedge.elements.size(), 2U);
    EXPECT_EQ(wedge.elements[1], Matrix3d(Vector3d(1, 1, -1).asDiagonal()));
    EXPECT_TRUE(wedge.axes.isIdentity(0.0));
    const Symmetry none = symmetry_of(prism({{-1, -0.5}, {1.5, -0.5}, {-1, 0.9}}, 0.3, 0.6));
    EXPECT_EQ(none.elements.size(), 1U);
    EXPECT_TRUE(none.axes.isIdentity(0.0));
}

TEST(Symmetry, ABumpAboveTheToleranceBreaksIt) {
    Surface sphere = test::icosphere(3);
    sphere.vertices.front() *= 1.1;
    EXPECT_NE(symmetry_of(sphere).type, Symmetry::Type::spherical);
}

// A ball of 12 by 6 quads, each vertex of which `radius` moves in or out.
template <typename Radius>
Surface coarse_ball(const Radius& radius) {
    Surface ball;
    const auto add = [&](const Vector3d& direction) {
        ball.vertices.push_back(radius(direction) * direction);
        return static_cast<std::int32_t>(ball.vertices.size()) - 1;
    };
    const std::int32_t south = add(-Vector3d::UnitZ());
    for (int row = 1; row < 6; ++row) {
        for (int i = 0; i < 12; ++i) {
            const double height = pi * row / 6.0;
            const double azimuth = 2.0 * pi * i / 12.0;
            add(Vector3d(std::sin(height) * std::cos(azimuth), std::sin(height) * std::sin(azimuth),
                         -std::cos(height)));
        }
    }
    const std::int32_t north = add(Vector3d::UnitZ());
    for (std::int32_t i = 0; i < 12; ++i) {
        const std::int32_t next = (i + 1) % 12;
        ball.corners.push_back({south, 1 + next, 1 + i});
        ball.corners.push_back({north, 49 + i, 49 + next});
        for (std::int32_t row = 0; row < 4; ++row) {
            const std::int32_t first = 1 + 12 * row;
            ball.corners.push_back({first + i, first + next, first + 12 + next});
            ball.corners.push_back({first + i, first + 12 + next, first + 12 + i});
        }
    }
    return ball;
}

TEST(Symmetry, NoToleranceIsAboveAFiveHundredths) {
    const Surface ball = coarse_ball([](const Vector3d& at) { return at.x() > 0.999 ? 1.09 : 1.0; });
    const Symmetry symmetry = find_symmetry(ball, test::moments_of(ball), 0.1);
    EXPECT_EQ(symmetry.tolerance, 0.05);
    const bool about_another_axis =
        symmetry.type == Symmetry::Type::axial && std::abs(symmetry.axis.x()) < 0.99;
    EXPECT_FALSE(symmetry.type == Symmetry::Type::spherical || about_another_axis);
}

TEST(Symmetry, IsFoundSoonWhateverTheShape) {
    const auto seconds = [](const Surface& surface) {
        const std::clock_t start = std::clock();
        (void)symmetry_of(surface);
        return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    };
    // Blobs that nearly all turns take near themselves, a skewed cube, and a round one of many triangles.
    for (const double amount : {0.3, 0.1, 0.05, 0.02}) {
        EXPECT_LT(seconds(coarse_ball([&](const Vector3d& at) {
                      return 1.0 + amount * std::sin(37.0 * at.x() + 91.0 * at.y() + 53.0 * at.z());
                  })),
                  5.0)
            << amount;
    }
    Matrix3d skew;
    skew << 1.0, 0.1, 0.02, 0.0, 1.0, 0.13, 0.05, 0.0, 1.0;
    EXPECT_LT(seconds(test::mapped(test::box(Vector3d::Ones(), 1), skew)), 5.0);
    EXPECT_LT(seconds(test::lopsided(test::icosphere(4))), 5.0);
}

TEST(Symmetry, CurvedTrianglesShowTheShapeThatCoarseFlatOnesHide) {
    const Surface curved = test::curved_ellipsoid(Vector3d(1.0, 1.0, 2.0), 1);
    const Symmetry symmetry = symmetry_of(curved);
    EXPECT_EQ(symmetry.type, Symmetry::Type::axial);
    EXPECT_EQ(symmetry.tolerance, default_symmetry_tolerance);
}

TEST(Symmetry, IsDescribedInWords) {
    EXPECT_EQ(describe(symmetry_of(test::ellipsoid(Vector3d(1, 2, 4), 3))),
              "8 rotations and reflections, 3 mirror planes");
    EXPECT_EQ(describe(symmetry_of(test::ellipsoid(Vector3d(1, 1, 4), 3))),
              "a body of revolution about (0, 0, 1), with a mirror plane across that axis");
}

}  // namespace
}  // namespace samara
