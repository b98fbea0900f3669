#pragma once

#include <vector>

namespace samara {

/// Returns the arithmetic mean; 0 for an empty series.
double mean(const std::vector<double>& series);

/// Returns the standard error of the mean of a correlated series: in quadrature
///  - that of batch means: the series is cut into about sqrt(n) batches, whose means are taken as independent
///    (C. Geyer, Practical Markov chain Monte Carlo, Statistical Science 7, 1992);
///  - half the difference between the means of its two halves: a remaining drift is an error, too. For a
///  series without drift this is about 1.3 times its standard error. 0 for fewer than two values.
double standard_error(const std::vector<double>& series);

/// Estimates the error of the mean of a solver's last iterations relative to that of a solver that had
/// continued: standard_error(), and in quadrature the series' standard deviation, times sqrt(100/n) where the
/// series has n > 100 values. Oscillations and drifts of iterations last about as long as such a series, so
/// that its batches do not show them. 0 for fewer than two values.
double tail_error(const std::vector<double>& series);

/// Returns the factor for a standard deviation estimated from `degrees` independent values by which twice it
/// includes as many new values as two known standard deviations would: t/2, t the quantile of Student's
/// distribution with that many degrees of freedom at the probability that lies within two standard deviations
/// (95.45 %, two-sided). 7.0 for one, 2.3 for two, 1.14 for ten, towards 1 for many; 1 for none.
double student_widening(int degrees);

}  // namespace samara
