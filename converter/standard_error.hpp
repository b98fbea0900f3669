#pragma once

#include <vector>

namespace samara {

/// The arithmetic mean; 0 for an empty series.
double mean(const std::vector<double>& series);

/// The standard error of the mean of a correlated series, by batch means: the series is cut into about
/// sqrt(n) batches, whose means are taken as independent (C. Geyer, Practical Markov chain Monte Carlo,
/// Statistical Science 7, 1992). A series that still drifts has halves that differ more than that: then half
/// their difference, which is the same estimate with two batches, is returned. 0 for fewer than two values.
double standard_error(const std::vector<double>& series);

}  // namespace samara
