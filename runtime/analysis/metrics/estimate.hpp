#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace samara {

/// A figure with what is known of its uncertainty, in the figure's unit.
struct Estimate {
    double value = 0.0;
    std::optional<double> error;      ///< standard error; nothing where the record is too short to tell
    std::optional<double> deviation;  ///< standard deviation between falls, where there are several
};

/// The standard error of a figure of a record in `pieces` pieces, from its values with one stretch of
/// `left_out` neighbouring pieces left out at a time, each stretch in turn: the jackknife with overlapping
/// blocks, Kuensch, The jackknife and the bootstrap for general stationary observations, Annals of Statistics
/// 17, 1989, with the scatter about the mean made unbiased for independent pieces. For a mean of equal pieces
/// and one left out it is the standard error of the mean.
double jackknife_error(const std::vector<double>& values, std::size_t pieces, std::size_t left_out);

/// How the values of independent falls make one figure.
enum class Mean {
    arithmetic,
    root_mean_square,
};

/// The mean of one figure over falls that are independent of one another. One fall: its own estimate.
/// Several: the error of the mean by their scatter, whatever errors they have themselves. Nothing where there
/// is none.
std::optional<Estimate> mean_of(const std::vector<Estimate>& falls, Mean mean = Mean::arithmetic);

}  // namespace samara
