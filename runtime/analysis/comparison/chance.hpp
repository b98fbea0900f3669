#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace samara {

/// Random divisions of two sets' members: as many as are drawn, Romano, Bootstrap and randomization tests of
/// some nonparametric hypotheses, Annals of Statistics 17, 1989.
inline constexpr int chance_draws = 999;

/// What distances chance makes between two sets of one kind, and where the distance of two stands among them.
struct Chance {
    double mean = 0.0;
    double limit = 0.0;        ///< 95 % are nearer
    double probability = 0.0;  ///< share of those that are as far apart or farther
};

/// `by_chance`: distances that chance made; one at least.
Chance chance_among(double distance, std::vector<double> by_chance);

/// A whole number below `size`, the same on every machine.
inline std::size_t drawn_below(std::mt19937_64& generator, std::size_t size) {
    return static_cast<std::size_t>(generator() % static_cast<std::uint64_t>(size));
}

}  // namespace samara
