#include "samara/analysis/metrics/metric_catalogue.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace samara {

std::array<double, 2> wilson_interval(int count, int samples) {
    constexpr double z = 1.959963984540054;  // 97.5 % point of the normal distribution
    const double n = samples;
    const double share = count / n;
    const double denominator = 1.0 + z * z / n;
    const double middle = (share + 0.5 * z * z / n) / denominator;
    const double half = z / denominator * std::sqrt(share * (1.0 - share) / n + 0.25 * z * z / (n * n));
    return {std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

int RegimeCounts::total() const {
    return std::accumulate(counts.begin(), counts.end(), 0);
}

Regime RegimeCounts::commonest() const {
    return static_cast<Regime>(std::ranges::max_element(counts) - counts.begin());
}

double RegimeCounts::share(Regime regime) const {
    return static_cast<double>(of(regime)) / std::max(total(), 1);
}

std::array<double, 2> RegimeCounts::confidence() const {
    return wilson_interval(of(commonest()), total());
}

}  // namespace samara
