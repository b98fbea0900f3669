#include "samara/analysis/metrics/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "samara/motion/inclination.hpp"

namespace samara {
namespace {

double sum_of_squared_deviations(const std::vector<double>& values) {
    double mean = 0.0;
    for (const double value : values) mean += value / static_cast<double>(values.size());
    double sum = 0.0;
    for (const double value : values) sum += (value - mean) * (value - mean);
    return sum;
}

}  // namespace

double jackknife_error(const std::vector<double>& values, std::size_t pieces, std::size_t left_out) {
    const double mean_square = sum_of_squared_deviations(values) / static_cast<double>(values.size());
    return std::sqrt(mean_square * static_cast<double>(pieces - left_out) / static_cast<double>(left_out));
}

std::optional<Estimate> mean_of(const std::vector<Estimate>& falls, Mean mean) {
    if (falls.empty()) return std::nullopt;
    if (falls.size() == 1) return falls.front();
    const auto count = static_cast<double>(falls.size());
    const double power = mean == Mean::arithmetic ? 1.0 : 2.0;
    double sum = 0.0;
    std::vector<double> values;
    for (const Estimate& fall : falls) {
        values.push_back(fall.value);
        sum += std::pow(fall.value, power);
    }
    Estimate all;
    all.value = std::pow(sum / count, 1.0 / power);
    all.deviation = std::sqrt(sum_of_squared_deviations(values) / (count - 1.0));
    all.error = *all.deviation / std::sqrt(count);
    return all;
}

Chance chance_among(double distance, std::vector<double> by_chance) {
    std::sort(by_chance.begin(), by_chance.end());
    const auto count = static_cast<double>(by_chance.size());
    const auto as_far =
        by_chance.end() - std::lower_bound(by_chance.begin(), by_chance.end(), distance * (1.0 - 1e-12));
    return {std::accumulate(by_chance.begin(), by_chance.end(), 0.0) / count,
            percentile_of_sorted(by_chance, 95.0), (1.0 + static_cast<double>(as_far)) / (1.0 + count)};
}

}  // namespace samara
