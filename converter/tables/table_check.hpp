#pragma once

#include <string>
#include <vector>

#include "converter/cases/case_reduction.hpp"
#include "samara/core/body/load_tables.hpp"

namespace samara {

/// The comparison of a table with one case that it was not made from (body axes).
struct CheckedCase {
    std::string name;
    Vector3d direction;
    double reynolds_number;
    LoadEntry value;        ///< of the case
    LoadEntry difference;   ///< table less case
    LoadEntryError stated;  ///< the table's standard error there
};

/// The errors of one quantity over all cases.
struct QuantityCheck {
    double error = 0.0;   ///< force, moment: rms difference over rms value; k, epsilon: rms of ln(table/case)
    double stated = 0.0;  ///< stated standard errors, averaged like `error`
    double within_two = 0.0;  ///< share of differences (of components) within two standard errors
};

/// The comparison of a table with solved cases.
struct TableCheck {
    std::vector<CheckedCase> cases;
    QuantityCheck force;
    QuantityCheck moment;
    QuantityCheck turbulent_kinetic_energy;
    QuantityCheck dissipation_rate;
    double within_two = 0.0;  ///< over all quantities and components
};

/// Compares tables with cases of purpose "table" (body axes) at other directions and Reynolds numbers. Throws
/// Error where there is no such case.
TableCheck check_tables(const LoadTables& tables, const std::vector<SolvedCase>& cases);

}  // namespace samara
