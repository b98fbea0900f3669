#include "converter/tables/student.hpp"

#include <cmath>
#include <numbers>

namespace samara {
namespace {

/// The probability that |t| stays below a bound: M. Abramowitz and I. Stegun, Handbook of Mathematical
/// Functions, 26.7.3 and 26.7.4.
double probability_within(double bound, int degrees) {
    const double angle = std::atan(bound / std::sqrt(static_cast<double>(degrees)));
    const double cosine = std::cos(angle);
    const bool odd = degrees % 2 != 0;
    double term = odd ? cosine : 1.0;
    double sum = degrees == 1 ? 0.0 : term;
    for (int i = odd ? 3 : 2; i <= degrees - 2; i += 2) {
        term *= cosine * cosine * (i - 1.0) / i;
        sum += term;
    }
    sum *= std::sin(angle);
    return odd ? 2.0 / std::numbers::pi * (angle + sum) : sum;
}

}  // namespace

double student_widening(int degrees) {
    if (degrees < 1) return 1.0;
    const double probability = std::erf(std::numbers::sqrt2);
    double low = 2.0;
    double high = 16.0;
    while (high - low > 1e-12) {
        const double middle = 0.5 * (low + high);
        (probability_within(middle, degrees) < probability ? low : high) = middle;
    }
    return 0.25 * (low + high);
}

}  // namespace samara
