#include "samara/motion/distribution_distance.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>

namespace samara {
namespace {

constexpr int draws = 999;
constexpr std::size_t fewest_pieces = 3;

void add(InclinationHistogram& sum, const InclinationHistogram& one, double factor = 1.0) {
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += factor * one[i];
}

double distance_of(const InclinationHistogram& a, const InclinationHistogram& b) {
    const double all_a = std::accumulate(a.begin(), a.end(), 0.0);
    const double all_b = std::accumulate(b.begin(), b.end(), 0.0);
    double below_a = 0.0;
    double below_b = 0.0;
    double distance = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        below_a += a[i] / all_a;
        below_b += b[i] / all_b;
        distance = std::max(distance, std::abs(below_a - below_b));
    }
    return distance;
}

/// A whole number below `size`, the same on every machine.
std::size_t drawn_below(std::mt19937_64& generator, std::size_t size) {
    return static_cast<std::size_t>(generator() % static_cast<std::uint64_t>(size));
}

}  // namespace

DistributionDistance distribution_distance(const std::vector<InclinationHistogram>& motion,
                                           const std::vector<InclinationHistogram>& reference) {
    InclinationHistogram sum_motion{};
    InclinationHistogram sum_reference{};
    for (const InclinationHistogram& piece : motion) add(sum_motion, piece);
    for (const InclinationHistogram& piece : reference) add(sum_reference, piece);
    DistributionDistance result;
    result.distance = distance_of(sum_motion, sum_reference);
    if (std::min(motion.size(), reference.size()) < fewest_pieces) return result;

    std::vector<const InclinationHistogram*> pool;
    for (const InclinationHistogram& piece : motion) pool.push_back(&piece);
    for (const InclinationHistogram& piece : reference) pool.push_back(&piece);
    InclinationHistogram all = sum_motion;
    add(all, sum_reference);
    const std::size_t drawn = std::min(motion.size(), reference.size());
    std::mt19937_64 generator(1);
    std::vector<double> distances;
    for (int draw = 0; draw < draws; ++draw) {
        InclinationHistogram one{};
        for (std::size_t i = 0; i < drawn; ++i) {
            std::swap(pool[i], pool[i + drawn_below(generator, pool.size() - i)]);
            add(one, *pool[i]);
        }
        InclinationHistogram other = all;
        add(other, one, -1.0);
        distances.push_back(distance_of(one, other));
    }
    std::sort(distances.begin(), distances.end());
    result.by_chance = std::accumulate(distances.begin(), distances.end(), 0.0) / draws;
    result.chance_limit = distances[static_cast<std::size_t>(0.95 * draws)];
    const auto as_far = distances.end() -
                        std::lower_bound(distances.begin(), distances.end(), result.distance * (1.0 - 1e-12));
    result.probability = (1.0 + static_cast<double>(as_far)) / (1.0 + draws);
    return result;
}

}  // namespace samara
