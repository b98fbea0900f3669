#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samara/kirchhoff/kirchhoff_solver.hpp"
#include "samara/kirchhoff/solvers/tensor_error.hpp"
#include "support/exact_bodies.hpp"
#include "support/expect_error.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

using test::error_of;
using test::ExactEllipsoid;
using testing::HasSubstr;

TensorScale scale_of(const VolumeMoments& moments) {
    return {moments.volume, moments.surface_area};
}

KirchhoffTensor tensor_of(const Surface& surface, int threads = 0) {
    return kirchhoff_tensor(surface, test::moments_of(surface), {.threads = threads});
}

double error_against(const ExactEllipsoid& body, const KirchhoffTensor& tensor) {
    return relative_tensor_error(tensor.matrix, exact_tensor(body), scale_of(test::exact_moments(body)));
}

/// How often the error estimate is honest, and how often of use.
struct EstimateTally {
    int count = 0;
    int covered = 0;  ///< the error is not above the estimate
    int close = 0;    ///< the estimate is not above ten times the error

    void add(const ExactEllipsoid& body, const Surface& surface) {
        const KirchhoffTensor result = tensor_of(surface);
        const double error = error_against(body, result);
        ++count;
        covered += error <= result.error_estimate ? 1 : 0;
        close += result.error_estimate <= 10.0 * error ? 1 : 0;
    }
};

/// Without any symmetry.
Surface lopsided_surface() {
    return test::lopsided(test::ellipsoid({1.0, 0.7, 0.5}, 3));
}

TEST(KirchhoffTensor, OfAnEllipsoidOf1280CurvedTrianglesIsWithin1e4) {
    for (const ExactEllipsoid& body : test::exact_ellipsoids()) {
        if (body.semi_axes.minCoeff() < 0.05) continue;
        EXPECT_LT(error_against(body, tensor_of(test::curved_ellipsoid(body.semi_axes, 3))), 1e-4)
            << body.name;
    }
}

TEST(KirchhoffTensor, OfFlatTrianglesKnowsTheSmoothBodyThatTheyStandFor) {
    for (const ExactEllipsoid& body : test::exact_ellipsoids()) {
        if (body.semi_axes.minCoeff() < 0.5) continue;
        const KirchhoffTensor tensor = tensor_of(test::ellipsoid(body.semi_axes, 3));
        EXPECT_LT(error_against(body, tensor), 2e-3) << body.name;
        EXPECT_THAT(tensor.method, HasSubstr("curved"));
    }
}

TEST(KirchhoffTensor, OfAThinOblateApproachesTheDisc) {
    // Lamb, art. 108: M = 8/3 a^3 broadside and J = 16/45 a^5 about a diameter; the sphere's J vanishes.
    const Matrix6d matrix = tensor_of(test::ellipsoid({1.0, 1.0, 1e-3}, 3)).matrix;
    EXPECT_NEAR(matrix(5, 5), 8.0 / 3.0, 0.01 * 8.0 / 3.0);
    EXPECT_NEAR(matrix(0, 0), 16.0 / 45.0, 0.01 * 16.0 / 45.0);
}

TEST(KirchhoffTensor, ErrorEstimateCoversTheErrorAndIsMostlyWithinTenTimes) {
    EstimateTally tally;
    for (const ExactEllipsoid& body : test::exact_ellipsoids()) {
        for (const int level : {2, 3}) {
            const Matrix3d stretch = body.semi_axes.asDiagonal();
            for (const Surface& surface :
                 {test::ellipsoid(body.semi_axes, level), test::curved_ellipsoid(body.semi_axes, level - 1),
                  test::curved_ellipsoid(body.semi_axes, level),
                  test::mapped(test::shaken_icosphere(level, 0.1, 1), stretch),
                  test::mapped(test::shaken_icosphere(level, 0.3, 2), stretch)}) {
                tally.add(body, surface);
            }
        }
    }
    EXPECT_GE(10 * tally.covered, 9 * tally.count);
    EXPECT_GE(2 * tally.close, tally.count);
}

TEST(KirchhoffTensor, ErrorEstimateHoldsForBodiesThatItWasNotMadeOn) {
    EstimateTally tally;
    for (const Vector3d& semi_axes :
         {Vector3d(1.0, 1.5, 3.0), Vector3d(1.0, 3.0, 3.0), Vector3d(0.3, 1.0, 2.0), Vector3d(0.2, 0.9, 1.0),
          Vector3d(1.0, 1.0, 1.3), Vector3d(2.0, 2.5, 9.0), Vector3d(0.05, 1.0, 1.5)}) {
        const ExactEllipsoid body = test::exact_ellipsoid(semi_axes);
        for (const Surface& surface :
             {test::ellipsoid(semi_axes, 3), test::curved_ellipsoid(semi_axes, 2),
              test::curved_ellipsoid(semi_axes, 3),
              test::mapped(test::shaken_icosphere(3, 0.2, 7), semi_axes.asDiagonal())}) {
            tally.add(body, surface);
        }
    }
    EXPECT_GE(10 * tally.covered, 9 * tally.count);
    EXPECT_GE(3 * tally.close, 2 * tally.count);
}

TEST(ExactEllipsoid, NumericalIntegralsGiveTheTabulatedValues) {
    for (const ExactEllipsoid& body : test::exact_ellipsoids()) {
        const ExactEllipsoid found = test::exact_ellipsoid(body.semi_axes);
        EXPECT_LT((found.mass - body.mass).norm(), 1e-9 * body.mass.norm()) << body.name;
        EXPECT_LT((found.inertia - body.inertia).norm(), 1e-9 * (body.inertia.norm() + 1e-3)) << body.name;
    }
}

TEST(KirchhoffTensor, ErrorEstimateOfACubeCoversTheError) {
    for (const int n : {1, 2, 4, 8}) {
        const KirchhoffTensor tensor = tensor_of(test::box({1.0, 1.0, 1.0}, n));
        const double error = relative_tensor_error(tensor.matrix, test::unit_cube_tensor(), {1.0, 6.0});
        EXPECT_LT(error, tensor.error_estimate) << n;
        EXPECT_LT(tensor.error_estimate, 10.0 * error) << n;
        EXPECT_THAT(tensor.method, HasSubstr("hypersingular"));
    }
}

TEST(KirchhoffTensor, OfATwelveTriangleBoxIsWithinAPercentWhereAskedFor) {
    KirchhoffOptions options;
    options.tolerance = 0.01;
    const Surface cube = test::box({1.0, 1.0, 1.0}, 1);
    const KirchhoffTensor tensor = kirchhoff_tensor(cube, test::moments_of(cube), options);
    EXPECT_LE(tensor.error_estimate, 0.01);
    EXPECT_LT(relative_tensor_error(tensor.matrix, test::unit_cube_tensor(), {1.0, 6.0}), 0.01);
}

TEST(KirchhoffTensor, ToleranceTakesTheCoarsestSurfaceThatMeetsIt) {
    const ExactEllipsoid& body = test::exact_ellipsoid("ellipsoid 1:2:4");
    const Surface surface = test::curved_ellipsoid(body.semi_axes, 4);
    int triangles = 0;
    for (const double tolerance : {1e-2, 1e-4}) {
        KirchhoffOptions options;
        options.tolerance = tolerance;
        const KirchhoffTensor tensor = kirchhoff_tensor(surface, test::exact_moments(body), options);
        EXPECT_LE(tensor.error_estimate, tolerance);
        EXPECT_LE(error_against(body, tensor), tolerance);
        EXPECT_GT(tensor.triangles, triangles);
        triangles = tensor.triangles;
    }
}

TEST(KirchhoffTensor, IsSymmetricAndPositiveDefinite) {
    const Matrix6d matrix = tensor_of(lopsided_surface()).matrix;
    EXPECT_EQ(matrix, matrix.transpose());
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix6d>(matrix).eigenvalues().minCoeff(), 0.0);
}

TEST(KirchhoffTensor, OfALopsidedBodyHasSmallAsymmetryAndTrueCoupling) {
    const KirchhoffTensor result = tensor_of(lopsided_surface());
    EXPECT_GT(result.asymmetry, 0.0);
    EXPECT_LT(result.asymmetry, 0.02);
    EXPECT_GT((result.matrix.block<3, 3>(0, 3).norm()), 1e-3 * result.matrix.norm());
}

TEST(KirchhoffTensor, TurnsWithTheBody) {
    const Matrix3d rotation =
        Eigen::AngleAxisd(1.1, Vector3d(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
    const Surface surface = lopsided_surface();
    const Matrix6d turned = tensor_of(test::mapped(surface, rotation)).matrix;
    const Matrix6d expected = in_rotated_axes(tensor_of(surface).matrix, rotation);
    EXPECT_LT((turned - expected).norm(), 1e-7 * expected.norm());  // the far field is in single precision
}

TEST(KirchhoffTensor, DoesNotChangeWhenTheBodyIsMoved) {
    const Surface surface = lopsided_surface();
    const Matrix6d expected = tensor_of(surface).matrix;
    for (const double distance : {1.0, 1e3, 1e6}) {
        const Surface moved =
            test::mapped(surface, Matrix3d::Identity(), distance * Vector3d(1.0, 2.0, -3.0));
        EXPECT_LT((tensor_of(moved).matrix - expected).norm(), (1e-7 + 1e-12 * distance) * expected.norm());
    }
}

TEST(KirchhoffTensor, AboutAnotherPointIsThatOfTheMomentsThere) {
    const Surface surface = lopsided_surface();
    VolumeMoments moments = test::moments_of(surface);
    const Matrix6d about_centroid = kirchhoff_tensor(surface, moments).matrix;
    const Vector3d centroid = moments.centroid;
    moments.centroid += Vector3d(0.3, -0.2, 0.4);
    const Matrix6d expected = about_point(about_centroid, centroid, moments.centroid);
    const Matrix6d found = kirchhoff_tensor(surface, moments).matrix;
    // Not to rounding: the single layer of the rotations is not exact on the translations it now holds.
    EXPECT_LT((found - expected).norm(), 1e-3 * expected.norm());
}

TEST(KirchhoffTensor, AngularBlockGrowsWithTheFifthPowerCouplingFourthTranslationThird) {
    const Surface surface = lopsided_surface();
    const Matrix6d unit = tensor_of(surface).matrix;
    for (const double factor : {1e-6, 0.37, 1e3}) {
        const Matrix6d scaled = tensor_of(test::mapped(surface, factor * Matrix3d::Identity())).matrix;
        Vector6d powers;
        powers << Vector3d::Constant(factor), Vector3d::Ones();
        const Matrix6d expected = std::pow(factor, 3) * powers.asDiagonal() * unit * powers.asDiagonal();
        for (const int row : {0, 3}) {
            for (const int column : {0, 3}) {
                const Matrix3d block = expected.block<3, 3>(row, column);
                EXPECT_LT((scaled.block<3, 3>(row, column) - block).norm(), 1e-6 * block.norm()) << factor;
            }
        }
    }
}

TEST(KirchhoffTensor, OfAMirroredBodyIsMirrored) {
    // Angular velocity is an axial vector: it takes the sign of the determinant.
    const Matrix3d mirror = Vector3d(1.0, -1.0, 1.0).asDiagonal();
    const Surface surface = lopsided_surface();
    const Matrix6d mirrored = tensor_of(test::mapped(surface, mirror)).matrix;
    Matrix6d turn = Matrix6d::Zero();
    turn.block<3, 3>(0, 0) = -mirror;
    turn.block<3, 3>(3, 3) = mirror;
    const Matrix6d expected = turn * tensor_of(surface).matrix * turn.transpose();
    EXPECT_LT((mirrored - expected).norm(), 1e-6 * expected.norm());
}

TEST(KirchhoffTensor, DoesNotDependOnTheNumberOfThreads) {
    const Surface surface = lopsided_surface();
    const KirchhoffTensor one = tensor_of(surface, 1);
    for (const int threads : {0, 2, 3, 7}) {
        const KirchhoffTensor many = tensor_of(surface, threads);
        EXPECT_EQ(one.matrix, many.matrix);
        EXPECT_EQ(one.error_estimate, many.error_estimate);
    }
}

TEST(KirchhoffTensor, ProgressRisesToTheEndAlsoWhereBothMethodsAreTried) {
    for (const Surface& surface : {test::icosphere(2), test::ellipsoid({1.0, 1.0, 0.1}, 2)}) {
        double last = 0.0;
        KirchhoffOptions options;
        options.progress = [&](double share) {
            EXPECT_GE(share, last);
            last = share;
        };
        kirchhoff_tensor(surface, test::moments_of(surface), options);
        EXPECT_EQ(last, 1.0);
    }
}

TEST(KirchhoffTensor, UnweldedVerticesDoNotMatter) {
    const Surface surface = lopsided_surface();
    Surface unwelded;
    for (const auto& triangle : surface.corners) {
        const auto next = static_cast<std::int32_t>(unwelded.vertices.size());
        for (const std::int32_t corner : triangle) {
            unwelded.vertices.push_back(surface.vertices[static_cast<std::size_t>(corner)]);
        }
        unwelded.corners.push_back({next, next + 1, next + 2});
    }
    const Matrix6d expected = tensor_of(surface).matrix;
    const Matrix6d found = tensor_of(unwelded).matrix;
    EXPECT_LT((found - expected).norm(), 1e-12 * expected.norm());
}

TEST(KirchhoffTensor, NamesTheErrorOfABadSurface) {
    const Surface sound = test::icosphere(2);
    const VolumeMoments moments = test::moments_of(sound);
    const auto message_of = [&](const Surface& surface) {
        return error_of([&] { kirchhoff_tensor(surface, moments); });
    };

    Surface holed = sound;
    holed.corners.pop_back();
    EXPECT_THAT(message_of(holed), HasSubstr("fill the hole"));

    Surface one_flipped = sound;
    std::swap(one_flipped.corners[7][0], one_flipped.corners[7][1]);
    EXPECT_THAT(message_of(one_flipped), HasSubstr("oriented against the others"));

    Surface inside_out = sound;
    for (auto& triangle : inside_out.corners) std::swap(triangle[0], triangle[1]);
    EXPECT_THAT(message_of(inside_out), HasSubstr("inside out"));

    Surface repeated = sound;
    repeated.corners.push_back(repeated.corners.front());
    EXPECT_THAT(message_of(repeated), HasSubstr("are the same"));

    EXPECT_THAT(message_of(Surface{}), HasSubstr("holds no triangles"));

    Surface flat = sound;
    flat.vertices[static_cast<std::size_t>(flat.corners[0][0])] =
        flat.vertices[static_cast<std::size_t>(flat.corners[0][1])];
    EXPECT_THAT(message_of(flat), HasSubstr("has no area"));

    Surface not_finite = sound;
    not_finite.vertices[3].x() = std::nan("");
    EXPECT_THAT(message_of(not_finite), HasSubstr("which is not finite"));

    // A sphere within the sphere, whatever its orientation: every edge is sound, and still it is no body.
    Surface nested = sound;
    const Surface inner = test::mapped(sound, 0.5 * Matrix3d::Identity());
    const auto offset = static_cast<std::int32_t>(sound.vertices.size());
    nested.vertices.insert(nested.vertices.end(), inner.vertices.begin(), inner.vertices.end());
    for (const auto& [a, b, c] : inner.corners)
        nested.corners.push_back({a + offset, b + offset, c + offset});
    EXPECT_THAT(message_of(nested), HasSubstr("inside another part"));
}

TEST(TensorError, IsTheWorstBlocksAndMeasuresZeroBlocksByTheScale) {
    Matrix6d reference = Matrix6d::Identity();
    reference.block<3, 3>(0, 0) *= 5.0;
    Matrix6d tensor = reference;
    tensor.block<3, 3>(0, 0) *= 1.01;
    tensor.block<3, 3>(3, 3) *= 0.97;
    const TensorScale scale{2.0, 4.0 * std::numbers::pi};  // L = 2
    EXPECT_NEAR(relative_tensor_error(tensor, reference, scale), 0.03, 1e-12);
    tensor(0, 3) = 0.4;  // against V L = 4
    EXPECT_NEAR(relative_tensor_error(tensor, reference, scale), 0.1, 1e-12);
    reference.block<3, 3>(0, 0).setZero();
    tensor.block<3, 3>(0, 0).setZero();
    tensor(0, 0) = 1.6;  // against V L^2 = 8
    EXPECT_NEAR(relative_tensor_error(tensor, reference, scale), 0.2, 1e-12);
}

}  // namespace
}  // namespace samara
