#include "samara/analysis/comparison/landing_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include <Eigen/Core>

namespace samara {
namespace {

constexpr std::size_t most_places = 200;

double scatter_of(const std::vector<Passage>& falls, std::optional<std::size_t> left_out = {}) {
    const double count = static_cast<double>(falls.size()) - (left_out ? 1.0 : 0.0);
    Vector3d sum = Vector3d::Zero();
    double squares = 0.0;
    for (std::size_t i = 0; i < falls.size(); ++i) {
        if (i == left_out) continue;
        sum += falls[i].place;
        squares += falls[i].place.squaredNorm();
    }
    return std::sqrt(std::max(0.0, (squares - sum.squaredNorm() / count) / (count - 1.0)));
}

Landings landings_of(const std::vector<Passage>& falls) {
    Landings landings;
    std::vector<Estimate> times;
    std::vector<double> without_one;
    for (std::size_t i = 0; i < falls.size(); ++i) {
        times.push_back({falls[i].time, {}, {}});
        landings.mean += falls[i].place / static_cast<double>(falls.size());
        without_one.push_back(scatter_of(falls, i));
    }
    landings.time = mean_of(times).value_or(Estimate{});
    landings.scatter = {scatter_of(falls), jackknife_error(without_one, falls.size(), 1), {}};
    return landings;
}

// The energy distance of those of the first `first` of the order and the rest.
double energy_distance(const Eigen::MatrixXd& distances, const std::vector<Eigen::Index>& order,
                       std::size_t first) {
    double between = 0.0;
    double within_first = 0.0;
    double within_rest = 0.0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        for (std::size_t j = i + 1; j < order.size(); ++j) {
            double& sum = j < first ? within_first : i < first ? between : within_rest;
            sum += distances(order[i], order[j]);
        }
    }
    const auto a = static_cast<double>(first);
    const auto b = static_cast<double>(order.size() - first);
    return 2.0 * between / (a * b) - 2.0 * within_first / (a * a) - 2.0 * within_rest / (b * b);
}

}  // namespace

LandingComparison compare_landings(double depth, const std::vector<Passage>& motion,
                                   const std::vector<Passage>& reference) {
    LandingComparison result{depth, landings_of(motion), landings_of(reference), 0.0, {}};
    std::vector<Vector3d> places;
    const std::size_t first = std::min(motion.size(), most_places);
    const std::size_t rest = std::min(reference.size(), most_places);
    for (std::size_t i = 0; i < first; ++i) places.push_back(motion[i].place);
    for (std::size_t i = 0; i < rest; ++i) places.push_back(reference[i].place);
    const auto count = static_cast<Eigen::Index>(places.size());
    Eigen::MatrixXd distances(count, count);
    std::vector<Eigen::Index> order;
    for (Eigen::Index i = 0; i < count; ++i) {
        order.push_back(i);
        for (Eigen::Index j = 0; j < count; ++j) {
            distances(i, j) =
                (places[static_cast<std::size_t>(i)] - places[static_cast<std::size_t>(j)]).norm();
        }
    }
    result.distance = energy_distance(distances, order, first);
    std::mt19937_64 generator(1);
    std::vector<double> by_chance;
    for (int draw = 0; draw < chance_draws; ++draw) {
        for (std::size_t i = 0; i < first; ++i) {
            std::swap(order[i], order[i + drawn_below(generator, order.size() - i)]);
        }
        by_chance.push_back(energy_distance(distances, order, first));
    }
    result.chance = chance_among(result.distance, std::move(by_chance));
    return result;
}

}  // namespace samara
