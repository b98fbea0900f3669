#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "converter/openfoam/foam_history.hpp"
#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// The flow that a case's files set up, in its own units and axes; members are absent where the files do not
/// give plain numbers (or a $name of the same file or of one that it includes).
struct CaseSetup {
    std::optional<double> viscosity;  ///< kinematic: nu of constant/transportProperties or physicalProperties
    std::optional<Vector3d> flow;     ///< velocity far from the body, on which the patches of 0/U agree
    std::optional<double> density;    ///< rhoInf of the function object `forces` in system/controlDict
    std::vector<std::string> patches;  ///< the body's, as names or patterns: those of `forces`
};

/// Reads the set-up of the case in the folder. Values that cannot be read are absent.
CaseSetup read_case_setup(const std::filesystem::path& folder);

/// The history of one quantity of a case, and its physical limits, all in the case's units.
struct QuantityHistory {
    std::string name;  ///< for error messages
    HistoryFiles files;
    std::vector<double> times;     ///< ascending
    std::vector<Vector3d> values;  ///< one for each time; of a scalar the first component alone
    double largest = 0.0;          ///< a magnitude beyond any true value
    double noise = 0.0;            ///< a magnitude up to which values may scatter about zero
    bool is_scalar = false;        ///< and then never negative
};

/// Throws Error naming file, time and the remedy where, from the time `start` on, one of the histories lacks
/// a time that another has, or where all lack times: where a step is more than twice the usual one.
void require_whole(const std::vector<QuantityHistory>& histories, double start, const std::string& remedy);

/// Throws Error naming file, time and the remedy where a value from the time `start` on is beyond `largest`,
/// is a negative scalar, or is an outlier: farther from the median than ten times its magnitude (or `noise`)
/// plus fifty times the median distance from it. Values must be finite.
void require_plausible(const QuantityHistory& history, double start, const std::string& remedy);

}  // namespace samara
