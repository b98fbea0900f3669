#include "samara/kirchhoff/operators/hypersingular.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "samara/core/base/error.hpp"
#include "samara/core/surface/curved_surface.hpp"
#include "samara/kirchhoff/surfaces/refinement.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

constexpr double pi = std::numbers::pi;

/// Lamb's values for the semi-axes 1, 2, 4: J about and M along x, y, z.
Vector6d ellipsoid_124() {
    Vector6d exact;
    exact << 19.46017908431, 111.0440372296, 13.6118310185, 50.87072167736, 13.34287626884, 4.241425456327;
    return exact;
}

HypersingularOptions always_compressed() {
    HypersingularOptions how;
    how.most_dense_nodes = 0;
    return how;
}

Matrix6d tensor_of(const Surface& surface, const HypersingularOptions& how = {}) {
    return solve_hypersingular(surface, {}, how).tensor;
}

/// The surface of two bodies.
Surface both(const Surface& a, const Surface& b) {
    Surface result = a;
    const auto shift = static_cast<std::int32_t>(a.vertices.size());
    result.vertices.insert(result.vertices.end(), b.vertices.begin(), b.vertices.end());
    for (const auto& [i, j, k] : b.corners) result.corners.push_back({i + shift, j + shift, k + shift});
    return result;
}

/// The box with nodes drawn to its edges: x -> sin(pi x) / 2 on -1/2 to 1/2 in the plane of the plate, the
/// rim in one layer.
Surface graded_plate(double length, double width, double thickness, int n) {
    Surface surface;
    const auto node = [&](int i, int j, int side) {
        const auto drawn = [n](int k) { return -0.5 * std::cos(pi * k / n); };
        surface.vertices.emplace_back(length * drawn(i), width * drawn(j), thickness * (side - 0.5));
    };
    for (int side = 0; side < 2; ++side) {
        for (int j = 0; j <= n; ++j) {
            for (int i = 0; i <= n; ++i) node(i, j, side);
        }
    }
    const auto at = [n](int i, int j, int side) { return (side * (n + 1) + j) * (n + 1) + i; };
    const auto quad = [&](int a, int b, int c, int d) {
        surface.corners.push_back({a, b, c});
        surface.corners.push_back({a, c, d});
    };
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            quad(at(i, j, 1), at(i + 1, j, 1), at(i + 1, j + 1, 1), at(i, j + 1, 1));
            quad(at(i, j, 0), at(i, j + 1, 0), at(i + 1, j + 1, 0), at(i + 1, j, 0));
        }
    }
    for (int i = 0; i < n; ++i) {
        quad(at(i, 0, 0), at(i + 1, 0, 0), at(i + 1, 0, 1), at(i, 0, 1));
        quad(at(i + 1, n, 0), at(i, n, 0), at(i, n, 1), at(i + 1, n, 1));
        quad(at(n, i, 0), at(n, i + 1, 0), at(n, i + 1, 1), at(n, i, 1));
        quad(at(0, i + 1, 0), at(0, i, 0), at(0, i, 1), at(0, i + 1, 1));
    }
    return surface;
}

/// The plate with the half x > 0 turned up by `angle` about the y axis; n is even.
Surface folded_plate(double thickness, double angle, int n) {
    Surface surface = graded_plate(1.0, 1.0, thickness, n);
    for (Vector3d& vertex : surface.vertices) {
        // On the fold half the angle, and as far out as keeps the thickness.
        const bool on_fold = std::abs(vertex.x()) < 1e-9;
        const double turn = on_fold ? 0.5 * angle : vertex.x() > 0.0 ? angle : 0.0;
        if (on_fold) vertex.z() /= std::cos(0.5 * angle);
        vertex = (Eigen::AngleAxisd(-turn, Vector3d::UnitY()) * vertex).eval();
    }
    return surface;
}

Matrix6d block_diagonal(const Matrix3d& map, double sign) {
    Matrix6d blocks = Matrix6d::Zero();
    blocks.topLeftCorner<3, 3>() = sign * map;
    blocks.bottomRightCorner<3, 3>() = map;
    return blocks;
}

TEST(Hypersingular, ConvergesWithTheSquareOfTheSizeOnTheEllipsoid) {
    Vector6d last = Vector6d::Ones();
    for (const int level : {2, 3, 4}) {
        const Vector6d diagonal = tensor_of(test::ellipsoid({1.0, 2.0, 4.0}, level)).diagonal();
        const Vector6d error = diagonal.cwiseQuotient(ellipsoid_124()) - Vector6d::Ones();
        if (level > 2) {
            const Vector6d order = error.cwiseQuotient(last).array().log() / std::log(0.5);
            EXPECT_GT(order.minCoeff(), 1.9) << level;
            EXPECT_LT(order.maxCoeff(), 2.1) << level;
        }
        last = error;
    }
    EXPECT_LT(last.cwiseAbs().maxCoeff(), 4e-3);
}

TEST(Hypersingular, IsNotDisturbedByAnUnevenMesh) {
    const Matrix6d tensor = tensor_of(test::shaken_icosphere(3, 0.2, 1));
    const Matrix3d mass = tensor.bottomRightCorner<3, 3>();
    EXPECT_LT((mass - 2.0 * pi / 3.0 * Matrix3d::Identity()).norm(), 0.015 * mass.norm());
}

// What this method's results on graded meshes of 768 to 49,152 triangles extrapolate to, with two gradings
// alike.
constexpr double cube_added_mass = 0.638416;
constexpr double cube_added_inertia = 0.039261;

TEST(Hypersingular, RisesMonotonicallyToTheCubesAddedMass) {
    double last = 0.0;
    Surface surface = test::box({1.0, 1.0, 1.0}, 2);
    for (int step = 0; step < 4; ++step) {
        const Matrix6d tensor = tensor_of(surface);
        EXPECT_GT(tensor(3, 3), last);
        EXPECT_LT(tensor(3, 3), cube_added_mass);
        last = tensor(3, 3);
        surface = without_edge_nodes(
            refined({with_straight_edge_nodes(surface), Creases(surface.triangle_count())}).surface);
    }
    EXPECT_GT(last, 0.633);
}

TEST(Hypersingular, GainsFromTrianglesThatShrinkTowardsEdges) {
    Surface surface = test::box({1.0, 1.0, 1.0}, 16);
    for (Vector3d& vertex : surface.vertices) {
        for (double& x : vertex) x = std::copysign(0.5 - 4.0 * std::pow(0.5 - std::abs(x), 3), x);
    }
    const Matrix6d tensor = tensor_of(surface);
    EXPECT_NEAR(tensor(5, 5), cube_added_mass, 2.5e-4 * cube_added_mass);
    EXPECT_NEAR(tensor(2, 2), cube_added_inertia, 1.1e-3 * cube_added_inertia);
}

TEST(Hypersingular, IsSymmetricAndPositiveDefiniteOnAnyBody) {
    const Matrix3d turn = Eigen::AngleAxisd(0.8, Vector3d(1.0, 2.0, -1.0).normalized()).toRotationMatrix();
    for (const double thickness : {1.0, 1e-2, 1e-4}) {
        const Surface surface =
            test::mapped(test::box({1.0, 0.7, thickness}, 5), turn, Vector3d(0.3, -0.2, 0.1));
        const Matrix6d tensor = tensor_of(surface);
        EXPECT_LT((tensor - tensor.transpose()).norm(), 1e-5 * tensor.norm()) << thickness;
        const Matrix6d symmetric = 0.5 * (tensor + tensor.transpose());
        EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix6d>(symmetric).eigenvalues().minCoeff(), 0.0)
            << thickness;
    }
}

TEST(Hypersingular, IsRightOnThinSpheroidsBroadsideAndEdgewise) {
    // Lamb, art. 108 and 114: the disc's limits, and pi^2/3 t^2 edgewise for semi-axes 1, 1, t.
    for (const double thickness : {1e-2, 1e-3, 1e-4}) {
        const Matrix6d tensor = tensor_of(test::ellipsoid({1.0, 1.0, thickness}, 3));
        const double edgewise = pi * pi / 3.0 * thickness * thickness;
        EXPECT_NEAR(tensor(5, 5), 8.0 / 3.0, 0.02 * 8.0 / 3.0) << thickness;
        EXPECT_NEAR(tensor(0, 0), 16.0 / 45.0, 0.03 * 16.0 / 45.0) << thickness;
        EXPECT_NEAR(tensor(3, 3), edgewise, 0.02 * edgewise) << thickness;
        EXPECT_NEAR(tensor(4, 4), edgewise, 0.02 * edgewise) << thickness;
    }
}

TEST(Hypersingular, ComesWithinAPercentOfThinRectangularPlates) {
    // C pi/4 a^2 b with the plate's shorter edge a.
    const struct {
        double width;
        double coefficient;
    } plates[] = {{1.0, 0.5790}, {2.0, 0.7569}};
    for (const auto& [width, coefficient] : plates) {
        for (const double thickness : {1e-3, 1e-4}) {
            const Matrix6d tensor = tensor_of(graded_plate(1.0, width, thickness, 16));
            const double expected = coefficient * pi / 4.0 * width;
            EXPECT_NEAR(tensor(5, 5), expected, 0.01 * expected) << width << " " << thickness;
        }
    }
}

TEST(Hypersingular, EdgewiseMassOfAPlateGoesWithTheSquareOfItsThickness) {
    // Two rims move fluid like sources of the strength of the thickness: t^2 up to a logarithm.
    const double thick = tensor_of(graded_plate(1.0, 1.0, 1e-3, 8))(3, 3);
    const double thin = tensor_of(graded_plate(1.0, 1.0, 1e-4, 8))(3, 3);
    EXPECT_GT(thick, 2e-6);
    EXPECT_LT(thick, 4e-6);
    EXPECT_GT(thick / thin, 60.0);
    EXPECT_LT(thick / thin, 100.0);
}

TEST(Hypersingular, FollowsTheLawsOfRotationAndMirroring) {
    const Surface surface =
        test::mapped(test::box({1.0, 0.6, 0.2}, 4), Matrix3d::Identity(), {0.2, 0.1, -0.3});
    const Matrix6d tensor = tensor_of(surface);
    const Matrix3d turn = Eigen::AngleAxisd(0.9, Vector3d(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
    const Matrix6d turned = tensor_of(test::mapped(surface, turn));
    const Matrix6d rotation = block_diagonal(turn, 1.0);
    EXPECT_LT((turned - rotation * tensor * rotation.transpose()).norm(), 1e-5 * tensor.norm());
    const Matrix3d mirror = Vector3d(1.0, 1.0, -1.0).asDiagonal();
    const Matrix6d mirrored = tensor_of(test::mapped(surface, mirror));
    const Matrix6d reflection = block_diagonal(mirror, -1.0);
    EXPECT_LT((mirrored - reflection * tensor * reflection.transpose()).norm(), 1e-5 * tensor.norm());
}

TEST(Hypersingular, FollowsTheLawOfTranslation) {
    const Surface surface = test::box({1.0, 0.6, 0.2}, 5);
    const Vector3d shift(0.4, -0.3, 0.2);
    // v = v' + omega cross (old point - new point); the old point is at `shift` in the moved surface's axes.
    Matrix6d transfer = Matrix6d::Identity();
    transfer.bottomLeftCorner<3, 3>() = -skew(shift);
    const Matrix6d expected = transfer.transpose() * tensor_of(surface) * transfer;
    const Matrix6d moved = tensor_of(test::mapped(surface, Matrix3d::Identity(), shift));
    EXPECT_LT((moved - expected).norm(), 1e-3 * expected.norm());
}

TEST(Hypersingular, TwoDistantSpheresAddUp) {
    const Surface sphere = test::icosphere(2);
    const double one = tensor_of(sphere)(4, 4);
    const Surface pair = both(test::mapped(sphere, Matrix3d::Identity(), {50.0, 0.0, 0.0}),
                              test::mapped(sphere, Matrix3d::Identity(), {-50.0, 0.0, 0.0}));
    for (const HypersingularOptions& how : {HypersingularOptions{}, always_compressed()}) {
        const Matrix6d tensor = tensor_of(pair, how);
        EXPECT_NEAR(tensor(4, 4), 2.0 * one, 1e-5);
        EXPECT_NEAR(tensor(2, 2), 2.0 * 2500.0 * one, 1e-3 * 2.0 * 2500.0 * one);
    }
}

TEST(Hypersingular, TwoSheetsMoveTheFluidBetweenThemAlong) {
    // Two plates of thickness 1e-3 at a gap of 1e-2: broadside little more than one; and nearly that of a
    // box.
    const double thickness = 1e-3;
    const Surface sheet = graded_plate(1.0, 1.0, thickness, 8);
    const double one = tensor_of(sheet)(5, 5);
    const Surface upper = test::mapped(sheet, Matrix3d::Identity(), {0.0, 0.0, 0.0055});
    const Surface lower = test::mapped(sheet, Matrix3d::Identity(), {0.0, 0.0, -0.0055});
    const double two = tensor_of(both(upper, lower))(5, 5);
    const double box = tensor_of(graded_plate(1.0, 1.0, 0.012, 8))(5, 5) + 0.01;
    EXPECT_GT(two, 1.01 * one);
    EXPECT_NEAR(two, box, 0.02 * box);
    EXPECT_NEAR(tensor_of(both(upper, lower), always_compressed())(5, 5), two, 1e-4 * two);
}

TEST(Hypersingular, FoldedPlatesConvergeAndKeepTheirMirrorPlanes) {
    for (const double angle : {0.3, 0.5 * pi, 2.5}) {
        const Matrix6d coarse = tensor_of(folded_plate(1e-3, angle, 6));
        const Matrix6d middle = tensor_of(folded_plate(1e-3, angle, 12));
        const Matrix6d fine = tensor_of(folded_plate(1e-3, angle, 24));
        EXPECT_LT((fine - middle).norm(), 0.4 * (middle - coarse).norm()) << angle;
        EXPECT_LT((fine - middle).norm(), 0.02 * fine.norm()) << angle;
        // y = 0 and the plane between the halves: no coupling of the motions in them with those across.
        EXPECT_LT(std::abs(fine(3, 4)) + std::abs(fine(4, 5)), 1e-5 * fine(5, 5)) << angle;
        const Vector3d across(std::cos(0.5 * angle), 0.0, std::sin(0.5 * angle));
        const Vector3d between = across.cross(Vector3d::UnitY());
        const Matrix3d mass = fine.bottomRightCorner<3, 3>();
        EXPECT_LT(std::abs(across.dot(mass * between)), 1e-5 * mass.norm()) << angle;
    }
    // The flat plate is the limit.
    const Matrix6d nearly_flat = tensor_of(folded_plate(1e-3, 1e-3, 8));
    const Matrix6d flat = tensor_of(graded_plate(1.0, 1.0, 1e-3, 8));
    EXPECT_NEAR(nearly_flat(5, 5), flat(5, 5), 1e-4 * flat(5, 5));
}

TEST(Hypersingular, NeedlesHaveTheMassOfTheirCrossSections) {
    // 100:1: nearly pi b^2 a length 4/3 broadside, and 2e-4 of it along.
    const Matrix6d tensor = tensor_of(test::ellipsoid({0.01, 0.01, 1.0}, 3));
    const double displaced = 4.0 / 3.0 * pi * 1e-4;
    EXPECT_NEAR(tensor(3, 3), displaced, 0.04 * displaced);
    EXPECT_NEAR(tensor(4, 4), displaced, 0.04 * displaced);
    EXPECT_GT(tensor(5, 5), 0.0);
    EXPECT_LT(tensor(5, 5), 2e-3 * displaced);
}

TEST(Hypersingular, CompressedIsTheSameAsDense) {
    const struct {
        const char* name;
        Surface surface;
    } bodies[] = {{"ellipsoid", test::ellipsoid({1.0, 2.0, 4.0}, 3)},
                  {"thin ellipsoid", test::ellipsoid({1.0, 1.0, 1e-3}, 3)},
                  {"plate", graded_plate(1.0, 1.0, 1e-3, 14)},
                  {"cube", test::box({1.0, 1.0, 1.0}, 8)}};
    for (const auto& [name, surface] : bodies) {
        const Matrix6d dense = tensor_of(surface);
        const BoundaryElementResult compressed = solve_hypersingular(surface, {}, always_compressed());
        EXPECT_GT(compressed.iterations, 0) << name;
        for (const Eigen::Index block : {0, 3}) {
            const Matrix3d expected = dense.block<3, 3>(block, block);
            const Matrix3d found = compressed.tensor.block<3, 3>(block, block);
            EXPECT_LT((found - expected).norm(), 2e-5 * expected.norm()) << name << " " << block;
        }
    }
}

TEST(Hypersingular, DoesNotDependOnTheNumberOfThreads) {
    const Surface surface = test::ellipsoid({1.0, 0.5, 0.1}, 2);
    for (const HypersingularOptions& how : {HypersingularOptions{}, always_compressed()}) {
        const Matrix6d one = solve_hypersingular(surface, {.threads = 1, .progress = {}}, how).tensor;
        const Matrix6d three = solve_hypersingular(surface, {.threads = 3, .progress = {}}, how).tensor;
        EXPECT_EQ(one, three);
    }
}

TEST(Hypersingular, ClosureErrorTellsBrokenSurfacesFromSoundOnes) {
    const auto error = [](const Surface& surface) { return solve_hypersingular(surface, {}).closure_error; };
    const Surface sound = test::ellipsoid({1.0, 2.0, 0.5}, 3);
    EXPECT_LT(error(sound), 2e-4);
    EXPECT_LT(error(test::box({1.0, 1.0, 1e-3}, 6)), 2e-4);
    Surface flipped = sound;
    std::swap(flipped.corners[7][0], flipped.corners[7][1]);
    EXPECT_GT(error(flipped), 2e-3);
    Surface holed = sound;
    holed.corners.erase(holed.corners.begin() + 7);
    EXPECT_GT(error(holed), 2e-3);
    Surface repeated = sound;
    repeated.corners.push_back(repeated.corners[7]);
    EXPECT_GT(error(repeated), 2e-3);
    const Surface crossing = both(sound, test::mapped(sound, Matrix3d::Identity(), {0.7, 0.0, 0.0}));
    EXPECT_GT(error(crossing), 0.4);
}

TEST(Hypersingular, ReportsProgressThatRises) {
    double last = 0.0;
    bool rises = true;
    const BoundaryElementOptions options{.threads = 1, .progress = [&](double share) {
                                             rises = rises && share >= last && share <= 1.0;
                                             last = share;
                                         }};
    for (const HypersingularOptions& how : {HypersingularOptions{}, always_compressed()}) {
        last = 0.0;
        solve_hypersingular(test::icosphere(3), options, how);
        EXPECT_TRUE(rises);
        EXPECT_GT(last, 0.85);
    }
}

TEST(Hypersingular, SurfaceWithAFlatTriangleIsRefused) {
    Surface surface = test::icosphere(1);
    surface.vertices[static_cast<std::size_t>(surface.corners[3][0])] =
        surface.vertices[static_cast<std::size_t>(surface.corners[3][1])];
    EXPECT_THROW(solve_hypersingular(surface, {}), Error);
}

}  // namespace
}  // namespace samara
