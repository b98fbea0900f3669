#include "converter/tables/standard_error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace samara {
namespace {

double mean_of(const double* first, std::size_t count) {
    return std::accumulate(first, first + count, 0.0) / static_cast<double>(count);
}

/// Returns the standard error by `batches` equal batches; excess values at the start are dropped.
double batch_error(const std::vector<double>& series, std::size_t batches) {
    const std::size_t length = series.size() / batches;
    const double* const start = series.data() + (series.size() - batches * length);
    std::vector<double> means;
    for (std::size_t batch = 0; batch < batches; ++batch) {
        means.push_back(mean_of(start + batch * length, length));
    }
    const double center = mean(means);
    double squares = 0.0;
    for (const double value : means) squares += (value - center) * (value - center);
    const auto count = static_cast<double>(batches);
    return std::sqrt(squares / (count * (count - 1.0)));
}

// In iterations; chosen by ellipsoids that were solved to twice the length, tested on spheres and plates
// (docs/explanation/bake.md).
constexpr double memory_of_iterations = 100.0;

}  // namespace

double mean(const std::vector<double>& series) {
    return series.empty() ? 0.0 : mean_of(series.data(), series.size());
}

double standard_error(const std::vector<double>& series) {
    if (series.size() < 2) return 0.0;
    const auto batches = static_cast<std::size_t>(std::sqrt(static_cast<double>(series.size())));
    // The error by two batches is half the difference of their means.
    return std::hypot(batch_error(series, std::max<std::size_t>(batches, 2)), batch_error(series, 2));
}

double tail_error(const std::vector<double>& series) {
    if (series.size() < 2) return 0.0;
    const double center = mean(series);
    double squares = 0.0;
    for (const double value : series) squares += (value - center) * (value - center);
    const auto count = static_cast<double>(series.size());
    const double share = std::min(1.0, memory_of_iterations / count);
    return std::hypot(standard_error(series), std::sqrt(share * squares / count));
}

namespace {

/// Returns the probability that |t| of Student's distribution stays below a bound: M. Abramowitz and I.
/// Stegun, Handbook of Mathematical Functions, 26.7.3 and 26.7.4.
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
