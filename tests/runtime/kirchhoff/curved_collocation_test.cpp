#include "samara/kirchhoff/panels/curved_collocation.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hwy/highway.h>

#include "samara/kirchhoff/panels/curved_panels.hpp"
#include "samara/kirchhoff/solvers/tensor_error.hpp"
#include "support/expect_error.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

using test::curved_ellipsoid;
using test::error_of;

Matrix6d tensor_of(const Surface& surface, int threads = 0) {
    return solve_curved_collocation(surface, {threads, {}}).tensor;
}

/// Exact tensor of an ellipsoid whose factors alpha_0, beta_0, gamma_0 are known (Lamb, Hydrodynamics, 6th
/// ed., art. 114 and 115).
Matrix6d ellipsoid_tensor(const Vector3d& semi_axes, const Vector3d& factors) {
    const double volume = 4.0 / 3.0 * std::numbers::pi * semi_axes.prod();
    const Vector3d squares = semi_axes.cwiseAbs2();
    Matrix6d tensor = Matrix6d::Zero();
    for (Eigen::Index k = 0; k < 3; ++k) {
        tensor(3 + k, 3 + k) = volume * factors[k] / (2.0 - factors[k]);
        const Eigen::Index i = (k + 1) % 3;
        const Eigen::Index j = (k + 2) % 3;
        const double difference = squares[i] - squares[j];
        const double factor = factors[j] - factors[i];
        const double below = 2.0 * difference - (squares[i] + squares[j]) * factor;
        if (difference != 0.0) tensor(k, k) = volume / 5.0 * difference * difference * factor / below;
    }
    return tensor;
}

/// The exact tensor of the spheroid with the semi-axes (1, 1, polar).
Matrix6d spheroid_tensor(double polar) {
    double along = 0.0;
    if (polar < 1.0) {
        const double e = std::sqrt(1.0 - polar * polar);
        along = 2.0 / (e * e) * (1.0 - polar * std::asin(e) / e);
    } else {
        const double e = std::sqrt(1.0 - 1.0 / (polar * polar));
        along = 2.0 / (polar * polar * e * e * e) * (std::atanh(e) - e);
    }
    const double across = 0.5 * (2.0 - along);  // the three factors sum to 2
    return ellipsoid_tensor({1.0, 1.0, polar}, {across, across, along});
}

Matrix6d ellipsoid_124() {
    Matrix6d tensor = Matrix6d::Zero();
    tensor.diagonal() << 19.46017908431, 111.0440372296, 13.6118310185, 50.87072167736, 13.34287626884,
        4.241425456327;
    return tensor;
}

double error_of_tensor(const Surface& surface, const Matrix6d& exact) {
    const VolumeMoments moments = test::moments_of(surface);
    return relative_tensor_error(tensor_of(surface), exact, {moments.volume, moments.surface_area});
}

/// A body without any symmetry, with smooth curved panels.
Surface lopsided_surface(int level) {
    return test::lopsided(curved_ellipsoid({1.0, 0.7, 0.5}, level));
}

/// The surface as one of order 2 with the middles of its straight edges.
Surface with_middles(Surface surface) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> known;
    const auto middle = [&](std::int32_t a, std::int32_t b) {
        const auto next = static_cast<std::int32_t>(surface.vertices.size());
        const auto [place, is_new] = known.try_emplace(std::minmax(a, b), next);
        if (is_new) {
            const Vector3d sum =
                surface.vertices[static_cast<std::size_t>(a)] + surface.vertices[static_cast<std::size_t>(b)];
            surface.vertices.push_back(0.5 * sum);
        }
        return place->second;
    };
    for (const auto& [a, b, c] : surface.corners) {
        surface.edge_nodes.push_back({middle(a, b), middle(b, c), middle(c, a)});
    }
    return surface;
}

/// A unit cube whose faces are cut into 2 n^2 flat triangles, smaller towards the edges.
Surface graded_cube(int n) {
    Surface surface = test::box(Vector3d::Ones(), n);
    for (Vector3d& vertex : surface.vertices) {
        for (double& x : vertex) x = std::copysign(0.5 - 0.5 * std::pow(1.0 - 2.0 * std::abs(x), 2.0), x);
    }
    return with_middles(surface);
}

Surface without_last_triangle(Surface surface) {
    surface.corners.pop_back();
    surface.edge_nodes.pop_back();
    return surface;
}

Surface with_flipped_triangle(Surface surface) {
    std::swap(surface.corners[7][1], surface.corners[7][2]);
    std::swap(surface.edge_nodes[7][0], surface.edge_nodes[7][2]);
    return surface;
}

Surface with_repeated_triangle(Surface surface) {
    surface.corners.push_back(surface.corners[7]);
    surface.edge_nodes.push_back(surface.edge_nodes[7]);
    return surface;
}

/// K' = X^T K X for a reference point moved by `shift` (docs/explanation/added-mass.md).
Matrix6d about_point(const Matrix6d& tensor, const Vector3d& shift) {
    Matrix6d change = Matrix6d::Identity();
    change.bottomLeftCorner<3, 3>() = skew(shift);
    return change.transpose() * tensor * change;
}

double difference(const Matrix6d& a, const Matrix6d& b) {
    return (a - b).norm() / b.norm();
}

TEST(CurvedCollocation, ErrorFallsWithTheFourthPowerOfThePanelSize) {
    const double coarse = error_of_tensor(curved_ellipsoid({1, 2, 4}, 1), ellipsoid_124());
    const double middle = error_of_tensor(curved_ellipsoid({1, 2, 4}, 2), ellipsoid_124());
    const double fine = error_of_tensor(curved_ellipsoid({1, 2, 4}, 3), ellipsoid_124());
    EXPECT_GT(coarse / middle, 13.0);
    EXPECT_GT(middle / fine, 14.0);
    EXPECT_LT(middle / fine, 18.0);
}

TEST(CurvedCollocation, IsRightToFourDigitsOnSmoothBodies) {
    EXPECT_LT(error_of_tensor(curved_ellipsoid({1, 2, 4}, 2), ellipsoid_124()), 1e-3);
    EXPECT_LT(error_of_tensor(curved_ellipsoid({1, 2, 4}, 3), ellipsoid_124()), 1e-4);
    EXPECT_LT(error_of_tensor(curved_ellipsoid({1, 1, 4}, 3), spheroid_tensor(4.0)), 5e-5);
    EXPECT_LT(error_of_tensor(curved_ellipsoid({1, 1, 0.1}, 3), spheroid_tensor(0.1)), 1e-4);
    Matrix6d sphere = Matrix6d::Zero();
    sphere.diagonal().tail<3>().setConstant(2.0 / 3.0 * std::numbers::pi);
    EXPECT_LT(error_of_tensor(curved_ellipsoid({1, 1, 1}, 3), sphere), 2e-5);
}

TEST(CurvedCollocation, IsRightOnBodiesMuchThinnerThanTheirPanels) {
    EXPECT_LT(error_of_tensor(curved_ellipsoid({1, 1, 1e-2}, 3), spheroid_tensor(1e-2)), 1e-3);
    for (const double thickness : {1e-3, 1e-4}) {
        const Matrix6d tensor = tensor_of(curved_ellipsoid({1, 1, thickness}, 3));
        const Matrix6d exact = spheroid_tensor(thickness);
        // Broadside and edgewise, though one is a millionth of the other and less.
        EXPECT_NEAR(tensor(5, 5) / exact(5, 5), 1.0, 3e-3) << thickness;
        EXPECT_NEAR(tensor(0, 0) / exact(0, 0), 1.0, 4e-3) << thickness;
        EXPECT_NEAR(tensor(3, 3) / exact(3, 3), 1.0, 3e-4) << thickness;
    }
}

TEST(CurvedCollocation, IsRightOnNeedles) {
    for (const double length : {20.0, 100.0}) {
        const Surface needle =
            test::mapped(curved_ellipsoid({1, 1, length}, 3), Matrix3d::Identity() / length);
        const Matrix6d tensor = tensor_of(needle);
        const Matrix6d exact = spheroid_tensor(length);
        EXPECT_NEAR(tensor(3, 3) * std::pow(length, 3) / exact(3, 3), 1.0, 1e-4) << length;
        EXPECT_NEAR(tensor(5, 5) * std::pow(length, 3) / exact(5, 5), 1.0, 1e-4) << length;
        EXPECT_NEAR(tensor(0, 0) * std::pow(length, 5) / exact(0, 0), 1.0, 1e-4) << length;
    }
}

TEST(CurvedCollocation, IsNearlySymmetricAndPositiveDefinite) {
    const Matrix6d tensor = tensor_of(lopsided_surface(3));
    EXPECT_LT(difference(tensor.transpose(), tensor), 1e-5);
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix6d>(tensor).eigenvalues().minCoeff(), 0.0);
    EXPECT_LT(difference(tensor_of(lopsided_surface(2)), tensor), 1e-3);
}

TEST(CurvedCollocation, TurnsWithTheBody) {
    const Surface surface = lopsided_surface(2);
    const Matrix3d turn = Eigen::AngleAxisd(0.8, Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
    Matrix6d both = Matrix6d::Zero();
    both.topLeftCorner<3, 3>() = turn;
    both.bottomRightCorner<3, 3>() = turn;
    const Matrix6d turned = both * tensor_of(surface) * both.transpose();
    EXPECT_LT(difference(tensor_of(test::mapped(surface, turn)), turned), 1e-5);
}

TEST(CurvedCollocation, MirrorsWithTheBody) {
    const Surface surface = lopsided_surface(2);
    const Matrix3d mirror = Vector3d(1, 1, -1).asDiagonal();
    Matrix6d both = Matrix6d::Zero();
    both.topLeftCorner<3, 3>() = -mirror;  // angular velocity is an axial vector
    both.bottomRightCorner<3, 3>() = mirror;
    const Matrix6d mirrored = both * tensor_of(surface) * both.transpose();
    EXPECT_LT(difference(tensor_of(test::mapped(surface, mirror)), mirrored), 1e-5);
}

TEST(CurvedCollocation, FollowsTheLawForAnotherReferencePoint) {
    const Surface surface = lopsided_surface(3);
    const Vector3d shift(0.4, -0.3, 0.5);
    const Matrix6d moved = tensor_of(test::mapped(surface, Matrix3d::Identity(), shift));
    EXPECT_LT(difference(moved, about_point(tensor_of(surface), -shift)), 2e-5);
}

TEST(CurvedCollocation, TwoFarSpheresAreTheSumOfBoth) {
    const Surface sphere = curved_ellipsoid({1, 1, 1}, 2);
    const Vector3d arm(10.0, 0.0, 0.0);
    const Surface pair = test::together(
        {test::mapped(sphere, Matrix3d::Identity(), arm), test::mapped(sphere, Matrix3d::Identity(), -arm)});
    const Matrix6d one = tensor_of(sphere);
    const Matrix6d sum = about_point(one, -arm) + about_point(one, arm);
    const double interaction = 3.0 * std::pow(1.0 / 20.0, 3);  // of the nearest order, a share of each mass
    EXPECT_LT(difference(tensor_of(pair), sum), interaction);
}

TEST(CurvedCollocation, DoesNotDependOnTheNumberOfThreads) {
    const Surface surface = lopsided_surface(2);
    const Matrix6d one = tensor_of(surface, 1);
    for (const int threads : {2, 3, 7}) EXPECT_EQ(tensor_of(surface, threads), one) << threads;
}

TEST(CurvedCollocation, DoesNotDependOnTheOrderOfTheTriangles) {
    const Surface surface = lopsided_surface(2);
    Surface reversed = surface;
    std::reverse(reversed.corners.begin(), reversed.corners.end());
    std::reverse(reversed.edge_nodes.begin(), reversed.edge_nodes.end());
    EXPECT_LT(difference(tensor_of(reversed), tensor_of(surface)), 1e-12);
}

TEST(CurvedCollocation, AgreesOnAllInstructionSetsOfTheMachine) {
    const Surface surface = lopsided_surface(2);
    const Matrix6d best = tensor_of(surface);
    int sets = 0;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        EXPECT_LT(difference(tensor_of(surface), best), 1e-6) << hwy::TargetName(target);
        ++sets;
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    EXPECT_GE(sets, 1);
}

TEST(CurvedCollocation, FlatPanelsConvergeOnACube) {
    const BoundaryElementResult coarse = solve_curved_collocation(graded_cube(4), {});
    const BoundaryElementResult fine = solve_curved_collocation(graded_cube(8), {});
    EXPECT_LT(fine.closure_error, 1e-4);
    EXPECT_LT(difference(fine.tensor.transpose(), fine.tensor), 1e-5);
    // Extrapolated from meshes of up to 6912 triangles that are smaller still towards the edges.
    EXPECT_NEAR(fine.tensor(3, 3), 0.6385, 0.0025);
    EXPECT_LT(std::abs(fine.tensor(3, 3) - 0.6385), 0.3 * std::abs(coarse.tensor(3, 3) - 0.6385));
}

TEST(CurvedCollocation, ShowsHolesFlippedAndRepeatedTriangles) {
    const Surface surface = curved_ellipsoid({1.0, 0.7, 0.5}, 2);
    EXPECT_LT(solve_curved_collocation(surface, {}).closure_error, 1e-5);
    EXPECT_GT(solve_curved_collocation(without_last_triangle(surface), {}).closure_error, 0.1);
    EXPECT_GT(solve_curved_collocation(with_flipped_triangle(surface), {}).closure_error, 0.1);
    EXPECT_GT(solve_curved_collocation(with_repeated_triangle(surface), {}).closure_error, 0.1);
}

TEST(CurvedCollocation, SaysWhatItTook) {
    double progress = 0.0;
    const BoundaryElementResult result = solve_curved_collocation(
        curved_ellipsoid({1.0, 0.7, 0.5}, 2), {1, [&](double share) { progress = share; }});
    EXPECT_EQ(result.unknowns, 642U);
    EXPECT_EQ(result.memory, std::size_t{656} * 642 * sizeof(float));  // rows in groups of 16
    EXPECT_GT(result.iterations, 0);
    EXPECT_EQ(progress, 1.0);
}

TEST(CurvedCollocation, RefusesDegenerateTriangles) {
    const Surface sound = curved_ellipsoid({1.0, 0.7, 0.5}, 1);
    const auto first = static_cast<std::size_t>(sound.corners[3][0]);
    Surface surface = sound;
    surface.vertices[static_cast<std::size_t>(surface.corners[3][1])] = sound.vertices[first];
    surface.vertices[static_cast<std::size_t>(surface.edge_nodes[3][0])] = sound.vertices[first];
    EXPECT_THAT(error_of([&] { solve_curved_collocation(surface, {}); }), testing::HasSubstr("no area"));
    surface = sound;
    surface.vertices[first].x() = std::nan("");
    EXPECT_THAT(error_of([&] { solve_curved_collocation(surface, {}); }), testing::HasSubstr("not finite"));
}

TEST(CurvedPanels, InteriorSharesAreThoseOfTheBodysAngles) {
    const CurvedPanels panels = make_curved_panels(graded_cube(2));
    const std::vector<double> shares = interior_shares(panels);
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const auto faces = (panels.nodes[i].cwiseAbs().array() > 0.4999).count();
        EXPECT_NEAR(shares[i], std::pow(0.5, static_cast<double>(faces)), 1e-12);
    }
}

TEST(CurvedPanels, InteriorSharesSeeReentrantAngles) {
    // Turned inside out, the cube's outside is the body.
    Surface hollow = graded_cube(2);
    for (auto& corners : hollow.corners) std::swap(corners[1], corners[2]);
    for (auto& nodes : hollow.edge_nodes) std::swap(nodes[0], nodes[2]);
    const CurvedPanels panels = make_curved_panels(hollow);
    const std::vector<double> shares = interior_shares(panels);
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const auto faces = (panels.nodes[i].cwiseAbs().array() > 0.4999).count();
        EXPECT_NEAR(shares[i], 1.0 - std::pow(0.5, static_cast<double>(faces)), 1e-12);
    }
}

}  // namespace
}  // namespace samara
