// Bodies whose exact shape is known, as files of triangles and as exact geometry: the mesh keeps to the
// shape, and the estimate of the added mass's error is above the true error.

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "meshes/make_body.hpp"
#include "meshes/shape_files.hpp"
#include "samara/kirchhoff/kirchhoff_solver.hpp"
#include "samara/kirchhoff/solvers/tensor_error.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

using std::numbers::pi;
using Profile = std::vector<std::array<double, 2>>;  // radius and height, anticlockwise; a first or last
                                                     // radius of 0 closes it at the axis

// The arc about (radius, height) from one angle (degrees) to another, in n steps, both ends included.
void add_arc(Profile& profile, double radius, double height, double arc, double from, double to, int n) {
    for (int i = 0; i <= n; ++i) {
        const double angle = (from + (to - from) * i / n) * pi / 180.0;
        profile.push_back({radius + arc * std::cos(angle), height + arc * std::sin(angle)});
    }
}

Surface revolved(const Profile& profile, int around) {
    Surface surface;
    std::vector<std::vector<std::int32_t>> rings;
    for (const auto& [radius, height] : profile) {
        std::vector<std::int32_t>& ring = rings.emplace_back();
        for (int i = 0; i < around; ++i) {
            const double angle = 2.0 * pi * i / around;
            if (radius > 0.0 || i == 0) {
                surface.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), height);
            }
            ring.push_back(static_cast<std::int32_t>(surface.vertices.size()) - 1);
        }
    }
    const bool open = profile.front()[0] <= 0.0;
    const auto n = static_cast<std::size_t>(around);
    for (std::size_t k = 0; k + (open ? 1 : 0) < rings.size(); ++k) {
        const auto& one = rings[k];
        const auto& two = rings[(k + 1) % rings.size()];
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t j = (i + 1) % n;
            if (one[i] != one[j]) surface.corners.push_back({one[i], one[j], two[j]});
            if (two[i] != two[j]) surface.corners.push_back({one[i], two[j], two[i]});
        }
    }
    return surface;
}

Surface torus(double radius, int around, int across) {
    Profile profile;
    add_arc(profile, 1.0, 0.0, radius, 0.0, 360.0 - 360.0 / across, across - 1);
    return revolved(profile, around);
}

// Radius 1, height 0.1, its rims rounded by 0.02.
Surface coin(int around, int steps) {
    Profile profile = {{0.0, -0.05}};
    add_arc(profile, 0.98, -0.03, 0.02, -90.0, 0.0, steps);
    add_arc(profile, 0.98, 0.03, 0.02, 0.0, 90.0, steps);
    profile.push_back({0.0, 0.05});
    return revolved(profile, around);
}

struct ExactShape {
    const char* name;
    std::function<Surface()> triangles;
    double volume;
    // Added mass for a fluid of density 1: J and M across and along the axis. J along it is nothing.
    double angular;
    double across;
    double along;
    double uncertainty = 0.002;  // of these, relative
};

constexpr double coin_rim = 0.02;
const double coin_volume =
    // A disc less its rims (Pappus): squares of the rounding's side without their quarters of a circle.
    pi * 0.1 - 2.0 * 2.0 * pi *
                   (coin_rim * coin_rim * (1.0 - coin_rim / 2.0) -
                    pi / 4.0 * coin_rim * coin_rim * (1.0 - coin_rim + 4.0 * coin_rim / (3.0 * pi)));

class ShapeKnownExactly : public ::testing::TestWithParam<ExactShape> {};

TEST_P(ShapeKnownExactly, IsKeptWithinHalfAPercentAndTheEstimateIsAboveTheError) {
    const ExactShape& shape = GetParam();
    const test::TemporaryFolder folder;
    const Surface triangles = shape.triangles();
    test::write_binary_stl(folder / "shape.stl", triangles);
    const Body body = make_body(folder / "shape.stl");
    const double given = test::moments_of(triangles).volume;
    EXPECT_NEAR(body.moments.volume, given, (0.005 + body.shape_error->faceting) * given);
    EXPECT_LT(std::abs(body.moments.volume - shape.volume),
              0.005 * shape.volume + std::abs(given - shape.volume));
    EXPECT_LT(body.shape_error->distance, 0.005);

    const KirchhoffTensor found = kirchhoff_tensor(body);
    Matrix6d exact = Matrix6d::Zero();
    // The coupling depends on the place of the centroid, and is not known exactly.
    exact.topRightCorner<3, 3>() = found.matrix.topRightCorner<3, 3>();
    exact.bottomLeftCorner<3, 3>() = found.matrix.bottomLeftCorner<3, 3>();
    exact.diagonal() << shape.angular, shape.angular, 0.0, shape.across, shape.across, shape.along;
    const double error =
        relative_tensor_error(found.matrix, exact, {body.moments.volume, body.moments.surface_area});
    EXPECT_LT(error, found.error_estimate + shape.uncertainty);
    EXPECT_LT(found.error_estimate, std::max(0.02, 30.0 * std::max(error, 0.001)));
}

// The added masses are of `samara mesh --triangles 5600` and `samara kirchhoff` on files of 100,000 triangles
// or, of cone and washer, on exact geometry, whose estimates are 0.04 to 0.2 %.
INSTANTIATE_TEST_SUITE_P(
    , ShapeKnownExactly,
    ::testing::Values(ExactShape{"FineTorus", [] { return torus(0.25, 192, 96); }, 2.0 * pi* pi * 0.0625,
                                 0.55909, 0.56439, 1.26702},
                      ExactShape{"CoarseTorus", [] { return torus(0.25, 32, 12); }, 2.0 * pi* pi * 0.0625,
                                 0.55909, 0.56439, 1.26702},
                      ExactShape{"ThinTorus", [] { return torus(0.1, 128, 32); }, 2.0 * pi* pi * 0.01,
                                 0.096511, 0.096638, 0.198684},
                      ExactShape{"Cone",
                                 [] {
                                     return revolved({{0.0, 0.0}, {1.0, 0.0}, {0.2, 2.0}, {0.0, 2.0}}, 64);
                                 },
                                 2.0 * pi * 1.24 / 3.0, 0.467415, 1.523159, 2.067714},
                      ExactShape{"ConeOfFewFacets",
                                 [] {
                                     return revolved({{0.0, 0.0}, {1.0, 0.0}, {0.2, 2.0}, {0.0, 2.0}}, 14);
                                 },
                                 2.0 * pi * 1.24 / 3.0, 0.467415, 1.523159, 2.067714},
                      ExactShape{"Washer",
                                 [] {
                                     return revolved({{0.5, 0.0}, {1.0, 0.0}, {1.0, 0.3}, {0.5, 0.3}}, 48);
                                 },
                                 0.225 * pi, 0.332197, 0.248215, 1.334808},
                      ExactShape{"CoinWithARoundedRim", [] { return coin(240, 5); }, coin_volume, 0.38826,
                                 0.02451, 2.89594, 0.004}),
    [](const auto& shape) { return std::string(shape.param.name); });

TEST(ExactShapes, ARingOfExactGeometryIsGivenTheTrianglesThatItNeeds) {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "ring.geo") << "SetFactory(\"OpenCASCADE\");\nTorus(1) = {0, 0, 0, 1, 0.05};\n";
    const Body ring = make_body(folder / "ring.geo");
    const double volume = 2.0 * pi * pi * 0.0025;
    EXPECT_NEAR(ring.moments.volume, volume, 0.005 * volume);
    EXPECT_NEAR(ring.moments.centroid.norm(), 0.0, 1e-3);
    EXPECT_EQ(ring.symmetry.type, Symmetry::Type::axial);
    EXPECT_GT(ring.surface.triangle_count(), 2000U);
}

TEST(ExactShapes, FansAboutAMiddleAreMeshedEvenly) {
    const test::TemporaryFolder folder;
    const Surface disc = revolved({{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.05}, {0.0, 0.05}}, 300);
    test::write_binary_stl(folder / "disc.stl", disc);
    const Body body = make_body(folder / "disc.stl");
    EXPECT_NEAR(static_cast<double>(body.surface.triangle_count()), 1280.0, 300.0);
    double longest = 0.0;
    for (std::size_t t = 0; t < body.surface.triangle_count(); ++t)
        longest = std::max(longest, longest_edge(body.surface, t));
    EXPECT_LT(longest, 0.35);
    EXPECT_LT(kirchhoff_tensor(body).error_estimate, 0.01);
}

TEST(ExactShapes, BodiesOfFewFacetsAndBevelsHaveAnAddedMass) {
    const test::TemporaryFolder folder;
    std::vector<std::filesystem::path> files;
    for (const int facets : {24, 32, 40}) {
        files.push_back(folder / fmt::format("cylinder{}.stl", facets));
        test::write_binary_stl(files.back(),
                               revolved({{0.0, 0.0}, {0.02, 0.0}, {0.02, 0.003}, {0.0, 0.003}}, facets));
    }
    for (const char* name : {"bevelled_slab.stl", "bevelled_tile.stl"})
        files.push_back(test::shape_of_tests(name));
    for (const std::filesystem::path& file : files) {
        const Body body = make_body(file);
        EXPECT_LT(body.shape_error->distance, 0.005) << file;
        EXPECT_LT(kirchhoff_tensor(body).error_estimate, 0.05) << file;
    }
}

}  // namespace
}  // namespace samara
