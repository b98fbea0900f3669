#pragma once

#include <string>

namespace samara::test {

/// One line of the table in docs/studies/stability.
struct StabilityRow {
    std::string subject;  ///< the case, in words
    std::string step;     ///< the time step, in words
    std::string checked;  ///< what the metric measures
    double bound;         ///< the metric must not be above it
    double metric;
};

/// Expects the metric to be a number not above the bound, and records the line with the running test, from
/// where docs/studies/stability/stability_table.py takes it. To be called from the test's own thread.
void expect_row(const StabilityRow& row);

}  // namespace samara::test
