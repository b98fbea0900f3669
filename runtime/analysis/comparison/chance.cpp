#include "samara/analysis/comparison/chance.hpp"

#include <algorithm>
#include <numeric>

#include "samara/motion/inclination.hpp"

namespace samara {

Chance chance_among(double distance, std::vector<double> by_chance) {
    std::sort(by_chance.begin(), by_chance.end());
    const auto count = static_cast<double>(by_chance.size());
    const auto as_far =
        by_chance.end() - std::lower_bound(by_chance.begin(), by_chance.end(), distance * (1.0 - 1e-12));
    return {std::accumulate(by_chance.begin(), by_chance.end(), 0.0) / count,
            percentile_of_sorted(by_chance, 95.0), (1.0 + static_cast<double>(as_far)) / (1.0 + count)};
}

}  // namespace samara
