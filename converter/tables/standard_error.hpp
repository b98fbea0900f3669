#pragma once

#include <vector>

namespace samara {

/// The arithmetic mean; 0 for an empty series.
double mean(const std::vector<double>& series);

/// The standard error of the mean of a correlated series: in quadrature
///  - that of batch means: the series is cut into about sqrt(n) batches, whose means are taken as independent
///    (C. Geyer, Practical Markov chain Monte Carlo, Statistical Science 7, 1992);
///  - half the difference between the means of its two halves: a drift that has not ended is an error, too.
/// A series without drift is so given about 1.3 times its standard error. 0 for fewer than two values.
double standard_error(const std::vector<double>& series);

/// By how much the mean of a solver's last iterations is off from that of a solver that went on:
/// standard_error(), and in quadrature the series' own standard deviation, by sqrt(100/n) of it where the
/// series has more than 100 values. What iterations swing and drift by lasts about as long as such a series
/// does, so that its batches do not tell it. 0 for fewer than two values.
double tail_error(const std::vector<double>& series);

/// By what a standard deviation that was estimated from `degrees` independent values is multiplied so that
/// twice it holds as many new values as two known standard deviations would: t/2, t the quantile of Student's
/// distribution with that many degrees of freedom at the probability that lies within two standard deviations
/// (95.45 %, two-sided). 7.0 for one, 2.3 for two, 1.14 for ten, towards 1 for many; 1 for none.
double student_widening(int degrees);

}  // namespace samara
