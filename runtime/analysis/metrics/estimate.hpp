#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

namespace samara {

/// A value with its uncertainty, both in the value's unit.
struct Estimate {
    double value = 0.0;
    std::optional<double> error;      ///< standard error; nothing where the record is too short to tell
    std::optional<double> deviation;  ///< standard deviation between falls, where there are several
};

/// The number of standard errors from which on a difference is called certain.
inline constexpr double certain_errors = 2.0;

/// Returns the standard error of a statistic of a record in `pieces` pieces, from its values with one stretch
/// of `left_out` neighbouring pieces left out at a time: the jackknife with overlapping blocks, Kuensch, The
/// jackknife and the bootstrap for general stationary observations, Annals of Statistics 17, 1989, with the
/// scatter about the mean made unbiased for independent pieces. For a mean of equal pieces and one left out
/// it is the standard error of the mean.
double jackknife_error(const std::vector<double>& values, std::size_t pieces, std::size_t left_out);

/// The kind of mean that combines the values of independent falls.
enum class Mean {
    arithmetic,
    root_mean_square,
};

/// Returns the mean of one metric over independent falls. For one fall it is its own estimate; for several
/// the error comes from their scatter, whatever errors they have themselves. Nothing where there is none.
std::optional<Estimate> mean_of(const std::vector<Estimate>& falls, Mean mean = Mean::arithmetic);

/// Number of random divisions of two sets' members for a permutation test: Romano, Bootstrap and
/// randomization tests of some nonparametric hypotheses, Annals of Statistics 17, 1989.
inline constexpr int chance_draws = 999;

/// Distances that chance gives between two sets of one distribution, and the rank of an observed distance
/// among them.
struct Chance {
    double mean = 0.0;
    double limit = 0.0;        ///< 95 % of the distances by chance are below it
    double probability = 0.0;  ///< share of the distances by chance that are as large or larger
};

/// Returns the rank of `distance` among `by_chance`, the distances that chance gave, at least one.
Chance chance_among(double distance, std::vector<double> by_chance);

/// Draws a whole number below `size`, the same on every machine.
inline std::size_t drawn_below(std::mt19937_64& generator, std::size_t size) {
    return static_cast<std::size_t>(generator() % static_cast<std::uint64_t>(size));
}

}  // namespace samara
