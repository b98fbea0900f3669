#include "samara/analysis/comparison/distribution_distance.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

namespace samara {
namespace {

constexpr std::size_t fewest_pieces = 3;
constexpr std::size_t enough_falls = 10;

void add(Histogram& sum, const Histogram& one, double factor = 1.0) {
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += factor * one[i];
}

double distance_of(const Histogram& a, const Histogram& b) {
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

Histogram sum_of(const std::vector<Histogram>& pieces) {
    Histogram sum{};
    for (const Histogram& piece : pieces) add(sum, piece);
    return sum;
}

Histogram sum_of(const PieceHistograms& falls) {
    Histogram sum{};
    for (const auto& pieces : falls) add(sum, sum_of(pieces));
    return sum;
}

std::vector<const Histogram*> all_pieces(const PieceHistograms& falls) {
    std::vector<const Histogram*> all;
    for (const auto& pieces : falls) {
        for (const Histogram& piece : pieces) all.push_back(&piece);
    }
    return all;
}

std::vector<double> distances_between_falls(const PieceHistograms& falls) {
    const Histogram all = sum_of(falls);
    std::vector<double> distances;
    for (const auto& pieces : falls) {
        const Histogram one = sum_of(pieces);
        Histogram others = all;
        add(others, one, -1.0);
        distances.push_back(distance_of(one, others));
    }
    return distances;
}

std::vector<double> distances_of_draws(const PieceHistograms& motion, const PieceHistograms& reference) {
    std::vector<const Histogram*> pool = all_pieces(motion);
    const std::vector<const Histogram*> more = all_pieces(reference);
    const std::size_t drawn = std::min(pool.size(), more.size());
    if (drawn < fewest_pieces) return {};
    pool.insert(pool.end(), more.begin(), more.end());
    Histogram all = sum_of(motion);
    add(all, sum_of(reference));
    std::mt19937_64 generator(1);
    std::vector<double> distances;
    for (int draw = 0; draw < chance_draws; ++draw) {
        Histogram one{};
        for (std::size_t i = 0; i < drawn; ++i) {
            std::swap(pool[i], pool[i + drawn_below(generator, pool.size() - i)]);
            add(one, *pool[i]);
        }
        Histogram other = all;
        add(other, one, -1.0);
        distances.push_back(distance_of(one, other));
    }
    return distances;
}

}  // namespace

DistributionDistance distribution_distance(const PieceHistograms& motion, const PieceHistograms& reference) {
    DistributionDistance result;
    result.distance = distance_of(sum_of(motion), sum_of(reference));
    const PieceHistograms& fewer = motion.size() < reference.size() ? motion : reference;
    const PieceHistograms& more = motion.size() < reference.size() ? reference : motion;
    result.by_falls = fewer.size() == 1 && more.size() >= enough_falls;
    std::vector<double> distances =
        result.by_falls ? distances_between_falls(more) : distances_of_draws(motion, reference);
    if (distances.empty()) return result;
    result.chance = chance_among(result.distance, std::move(distances));
    return result;
}

}  // namespace samara
