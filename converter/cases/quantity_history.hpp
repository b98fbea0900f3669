#pragma once

#include <string>
#include <vector>

#include "converter/openfoam/foam_history.hpp"
#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// One quantity of a case at its iterations, and what physics allows of it, all in the case's units.
struct QuantityHistory {
    std::string name;  ///< as faults call it
    HistoryFiles files;
    std::vector<double> times;     ///< ascending
    std::vector<Vector3d> values;  ///< one for each time; of a scalar the first component alone
    double largest = 0.0;          ///< beyond any true value's size
    double noise = 0.0;            ///< a size up to which values may scatter about zero
    bool is_scalar = false;        ///< and then never negative
};

/// Throws Error naming file, time and the remedy where, from the time `start` on, one of the histories lacks
/// a time that another has, or where all lack times: where a step is more than twice the usual one.
void require_whole(const std::vector<QuantityHistory>& histories, double start, const std::string& remedy);

/// Throws Error naming file, time and the remedy where a value from the time `start` on is beyond `largest`,
/// is a negative scalar, or stands apart from the others: off their median by more than ten times its size
/// (or that of `noise`) and fifty times their median distance from it. Values must be finite.
void require_plausible(const QuantityHistory& history, double start, const std::string& remedy);

}  // namespace samara
