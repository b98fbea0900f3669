#include "converter/falls/motion_parameters.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "samara/core/base/error.hpp"
#include "samara/core/dynamics/dynamic_coefficients.hpp"
#include "support/exact_bodies.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

using Eigen::VectorXd;

Body ellipsoid_of(const Vector3d& semi_axes) {
    const test::ExactEllipsoid exact = test::exact_ellipsoid(semi_axes);
    Body body;
    body.name = "ellipsoid";
    body.surface = test::ellipsoid(semi_axes, 3);
    body.moments = test::exact_moments(exact);
    body.kirchhoff.emplace();
    body.kirchhoff->matrix = test::exact_tensor(exact);
    return body;
}

const Vector3d uneven(1.0, 2.0, 4.0);

Matrix3d some_turn() {
    return Eigen::AngleAxisd(1.1, Vector3d(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
}

Body rotated(Body body, const Matrix3d& rotation) {
    for (Vector3d& vertex : body.surface.vertices) vertex = rotation * vertex;
    body.moments.centroid = rotation * body.moments.centroid;
    body.moments.second_moments = rotation * body.moments.second_moments * rotation.transpose();
    body.kirchhoff->matrix = in_rotated_axes(body.kirchhoff->matrix, rotation);
    return body;
}

VectorXd numbers_within_bounds(const MotionParameters& parameters, unsigned seed) {
    std::mt19937_64 generator(seed);
    VectorXd numbers(static_cast<Eigen::Index>(parameters.all().size()));
    for (std::size_t i = 0; i < parameters.all().size(); ++i) {
        const MotionParameter& parameter = parameters.all()[i];
        numbers[static_cast<Eigen::Index>(i)] =
            std::uniform_real_distribution<double>(parameter.lower, parameter.upper)(generator);
    }
    return numbers;
}

std::ptrdiff_t count_named(const MotionParameters& parameters, const std::string& term) {
    return std::ranges::count_if(
        parameters.all(), [&](const MotionParameter& one) { return one.name.starts_with(term + " "); });
}

TEST(MotionParameters, AreExpectedWithinTheirBounds) {
    const MotionParameters parameters(ellipsoid_of(uneven));
    for (const MotionParameter& parameter : parameters.all()) {
        EXPECT_LE(parameter.lower, parameter.expected) << parameter.name;
        EXPECT_GE(parameter.upper, parameter.expected) << parameter.name;
        EXPECT_GT(parameter.deviation, 0.0) << parameter.name;
    }
}

TEST(MotionParameters, ExpectTheTransportThatTakesThePotentialFlowsOwnAway) {
    const Body body = rotated(ellipsoid_of(uneven), some_turn());
    const MotionParameters parameters(body);
    const DynamicCoefficients expected = parameters.coefficients(parameters.expected());
    const Matrix3d added_mass = body.kirchhoff->matrix.bottomRightCorner<3, 3>();
    EXPECT_LT((expected.transport - added_mass).norm(), 1e-12 * added_mass.norm());
    EXPECT_EQ(expected.rotational_transport, 1.0);
    EXPECT_EQ(expected.unsteady_factor, 1.0);
    EXPECT_EQ(expected.settling_length, settling_length_of_falls);
    const Matrix3d areas = projected_area_tensor(body);
    EXPECT_LT((expected.drag_in_motion - usual_drag_in_motion * areas).norm(), 1e-12 * areas.norm());
    EXPECT_LT((expected.drag_in_spin - usual_drag_in_spin * areas).norm(), 1e-12 * areas.norm());
    EXPECT_EQ(expected.half_length, default_dynamic_coefficients(body).half_length);
    EXPECT_EQ(error_of(expected), "");
}

TEST(MotionParameters, GiveSymmetricTensorsAndNoNegativeDragAnywhereWithinTheBounds) {
    const MotionParameters parameters(rotated(ellipsoid_of(uneven), some_turn()));
    for (unsigned seed = 0; seed < 20; ++seed) {
        const DynamicCoefficients coefficients =
            parameters.coefficients(numbers_within_bounds(parameters, seed));
        EXPECT_EQ(error_of(coefficients), "") << seed;
    }
}

TEST(MotionParameters, OfABodyWithoutEqualAxesHaveANumberForEach) {
    const MotionParameters parameters(ellipsoid_of(uneven));
    EXPECT_EQ(parameters.all().size(), 3u * 3u + 1u);
    EXPECT_EQ(count_named(parameters, "transport"), 3);
}

TEST(MotionParameters, OfASpheroidHaveOneNumberForBothEqualAxes) {
    for (const Vector3d& semi_axes : {Vector3d(1.0, 4.0, 4.0), Vector3d(1.0, 1.0, 4.0)}) {
        const MotionParameters parameters(ellipsoid_of(semi_axes));
        EXPECT_EQ(parameters.all().size(), 3u * 2u + 1u);
        EXPECT_EQ(count_named(parameters, "rotational drag"), 2 + 2);  // and that in spin
        const int other = semi_axes.y() == semi_axes.z() ? 1 : 0;      // y and z are equal, or x and y
        const DynamicCoefficients coefficients =
            parameters.coefficients(numbers_within_bounds(parameters, 1));
        for (const TensorOfMotion& tensor : tensors_of_motion) {
            const Matrix3d& values = coefficients.*tensor.member;
            // The triangles are not those of a body of revolution.
            EXPECT_NEAR(values(other, other), values(other + 1, other + 1), 0.01 * values.norm())
                << tensor.name;
        }
    }
}

// The added inertia of a sphere, as of a body of revolution about its axis, is zero but for rounding.
TEST(MotionParameters, OfASphereHaveOneNumberForAllAxes) {
    for (const double rounding : {0.0, 1e-9}) {
        Body body = ellipsoid_of(Vector3d(1.0, 1.0, 2.0));
        const test::ExactEllipsoid& sphere = test::exact_ellipsoid("sphere");
        body.surface = test::ellipsoid(sphere.semi_axes, 3);
        body.moments = test::exact_moments(sphere);
        body.kirchhoff->matrix = test::exact_tensor(sphere);
        for (int i = 0; i < 3; ++i) body.kirchhoff->matrix(i, i) += rounding * (i + 1);
        EXPECT_EQ(MotionParameters(body).all().size(), 3u + 1u) << rounding;
    }
}

TEST(MotionParameters, LeaveABodyWhoseAxesAreAllAlikeItsSteadyMoment) {
    EXPECT_EQ(MotionParameters(ellipsoid_of(Vector3d::Ones())).settling_length(),
              settling_length_of_alike_axes);
    for (const Vector3d& semi_axes : {Vector3d(1.0, 4.0, 4.0), Vector3d(1.0, 1.0, 4.0), uneven}) {
        EXPECT_EQ(MotionParameters(ellipsoid_of(semi_axes)).settling_length(), settling_length_of_falls);
    }
}

TEST(MotionParameters, TieNoAxesThatMassAloneMakesEqual) {
    Body body = ellipsoid_of(Vector3d(1.0, 4.0, 4.0));
    body.moments.second_moments(2, 2) *= 1.1;
    EXPECT_EQ(MotionParameters(body).all().size(), 3u * 3u + 1u);
}

TEST(MotionParameters, AreNothingWhereTheTermIsLeftOut) {
    const Body body = ellipsoid_of(uneven);
    for (const std::string& name : MotionParameters::names()) {
        const MotionParameters parameters(body, {name});
        const DynamicCoefficients coefficients = parameters.coefficients(parameters.expected());
        std::ptrdiff_t fixed = 0;
        for (const MotionParameter& one : parameters.all()) fixed += one.lower == one.upper ? 1 : 0;
        const bool is_shared =
            name == "rotational transport" || name == "drag in spin" || name == "drag in motion";
        EXPECT_EQ(fixed, is_shared ? 0 : name == "unsteady factor" ? 1 : 3) << name;
        EXPECT_EQ(coefficients.unsteady_factor, 1.0) << name;
        const bool of_rotation = name == "rotational transport";
        EXPECT_EQ(coefficients.rotational_transport, of_rotation ? 0.0 : 1.0) << name;
        for (const TensorOfMotion& tensor : tensors_of_motion) {
            const bool is_none = coefficients.*tensor.member == Matrix3d::Zero();
            EXPECT_EQ(is_none, name == tensor.title) << name << ", " << tensor.title;
        }
    }
    EXPECT_THROW(MotionParameters(body, {"transports"}), Error);
}

TEST(MotionParameters, RotateWithTheBody) {
    const Body body = ellipsoid_of(uneven);
    const Matrix3d rotation = some_turn();
    const MotionParameters parameters(body);
    const VectorXd numbers = numbers_within_bounds(parameters, 3);
    const DynamicCoefficients coefficients = parameters.coefficients(numbers);
    const DynamicCoefficients of_rotated = MotionParameters(rotated(body, rotation)).coefficients(numbers);
    for (const TensorOfMotion& tensor : tensors_of_motion) {
        const Matrix3d expected = rotation * (coefficients.*tensor.member) * rotation.transpose();
        EXPECT_LE((of_rotated.*tensor.member - expected).norm(), 1e-9 * expected.norm()) << tensor.name;
    }
    EXPECT_NEAR(of_rotated.half_length, coefficients.half_length, 1e-12);
}

TEST(MotionParameters, GrowWithTheBodyAsTheirUnitsSay) {
    const MotionParameters small(ellipsoid_of(uneven));
    const VectorXd numbers = numbers_within_bounds(small, 4);
    const DynamicCoefficients of_small = small.coefficients(numbers);
    const DynamicCoefficients of_large = MotionParameters(ellipsoid_of(10.0 * uneven)).coefficients(numbers);
    for (const TensorOfMotion& tensor : tensors_of_motion) {
        const double unit = std::pow(10.0, tensor.unit[2] - '0');  // m^2 to m^5
        EXPECT_LE((of_large.*tensor.member - unit * of_small.*tensor.member).norm(),
                  1e-6 * (of_large.*tensor.member).norm())
            << tensor.name;
    }
}

TEST(MotionParameters, GiveTheErrorOfEachEntryAlongPrincipalAxes) {
    const MotionParameters parameters(ellipsoid_of(uneven));
    const VectorXd numbers = numbers_within_bounds(parameters, 5);
    const VectorXd errors = VectorXd::LinSpaced(numbers.size(), 0.01, 0.2);
    const DynamicCoefficients standard_errors = parameters.standard_errors(errors);
    const DynamicCoefficients coefficients = parameters.coefficients(numbers);
    const DynamicCoefficients moved = parameters.coefficients(numbers + errors);
    for (const TensorOfMotion& tensor : tensors_of_motion) {
        const Matrix3d change = moved.*tensor.member - coefficients.*tensor.member;
        EXPECT_LE((standard_errors.*tensor.member - change).norm(), 1e-9 * change.norm()) << tensor.name;
    }
    EXPECT_EQ(standard_errors.rotational_transport, 0.0);
    EXPECT_EQ(standard_errors.settling_length, 0.0);
    EXPECT_EQ(standard_errors.drag_in_spin, Matrix3d::Zero());
    EXPECT_EQ(standard_errors.drag_in_motion, Matrix3d::Zero());
    EXPECT_NEAR(standard_errors.unsteady_factor, errors[errors.size() - 1], 1e-15);
}

// For a rotated body every entry depends on several numbers: the spread of entries under numbers that are
// drawn.
TEST(MotionParameters, GiveTheErrorOfEachEntryAcrossPrincipalAxes) {
    const MotionParameters parameters(rotated(ellipsoid_of(uneven), some_turn()));
    const VectorXd numbers = parameters.expected();
    const VectorXd errors = VectorXd::LinSpaced(numbers.size(), 0.01, 0.2);
    const Matrix3d mean = parameters.coefficients(numbers).transport;
    Matrix3d squares = Matrix3d::Zero();
    std::mt19937_64 generator(7);
    std::normal_distribution<double> normal;
    constexpr int draws = 4000;
    for (int i = 0; i < draws; ++i) {
        const VectorXd draw = VectorXd::NullaryExpr(numbers.size(), [&] { return normal(generator); });
        squares +=
            (parameters.coefficients(numbers + draw.cwiseProduct(errors)).transport - mean).cwiseAbs2();
    }
    const Matrix3d spread = (squares / draws).cwiseSqrt();
    const Matrix3d stated = parameters.standard_errors(errors).transport;
    // The spread of so many draws is itself known to 1.1 %.
    EXPECT_LT((stated - spread).cwiseAbs().maxCoeff(), 0.05 * spread.maxCoeff());
}

}  // namespace
}  // namespace samara
