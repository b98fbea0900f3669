#include "samara/kirchhoff/panels/triangle_rules.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace samara {
namespace {

double integral(const TriangleRule& rule, int power_p, int power_q) {
    double sum = 0.0;
    for (std::size_t i = 0; i < rule.weight.size(); ++i) {
        sum += rule.weight[i] * std::pow(rule.p[i], power_p) * std::pow(rule.q[i], power_q);
    }
    return sum;
}

double exact_integral(int power_p, int power_q) {
    return std::tgamma(power_p + 1.0) * std::tgamma(power_q + 1.0) / std::tgamma(power_p + power_q + 3.0);
}

TEST(TriangleRules, AreExactForPolynomialsOfTheirDegree) {
    for (int degree = 1; degree <= 20; ++degree) {
        const TriangleRule rule = triangle_rule(degree);
        EXPECT_EQ(rule.degree, degree);
        for (int sum = 0; sum <= degree; ++sum) {
            for (int power = 0; power <= sum; ++power) {
                const double exact = exact_integral(power, sum - power);
                EXPECT_NEAR(integral(rule, power, sum - power), exact, 2e-13 * exact) << degree;
            }
        }
    }
}

TEST(TriangleRules, AreNotExactForOneDegreeMore) {
    for (const int degree : {2, 4, 6, 8}) {
        double error = 0.0;
        for (int power = 0; power <= degree + 1; ++power) {
            const double exact = exact_integral(power, degree + 1 - power);
            error = std::max(
                error, std::abs(integral(triangle_rule(degree), power, degree + 1 - power) / exact - 1.0));
        }
        EXPECT_GT(error, 1e-6) << degree;
    }
}

TEST(TriangleRules, FillVectorRegistersWithPointsOfNoWeight) {
    const TriangleRule rule = triangle_rule(6);
    EXPECT_EQ(rule.points, 12U);
    ASSERT_EQ(rule.weight.size(), 16U);
    for (std::size_t i = 12; i < 16; ++i) EXPECT_EQ(rule.weight[i], 0.0);
}

TEST(TriangleRules, CornerRuleIntegratesOneOverTheDistance) {
    // The integral of 1/r over the unit triangle from its right angle: sqrt(2) asinh(1).
    const TriangleRule rule = corner_rule(3, 12);
    double sum = 0.0;
    for (std::size_t i = 0; i < rule.points; ++i) sum += rule.weight[i] / std::hypot(rule.p[i], rule.q[i]);
    EXPECT_NEAR(sum, std::sqrt(2.0) * std::asinh(1.0), 1e-9);
}

}  // namespace
}  // namespace samara
