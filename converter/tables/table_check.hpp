#pragma once

#include <string>
#include <vector>

#include "converter/cases/case_reduction.hpp"
#include "samara/core/body/load_tables.hpp"

namespace samara {

/// A table against one case that it was not made from (body axes).
struct CheckedCase {
    std::string name;
    Vector3d direction;
    double reynolds_number;
    LoadEntry value;        ///< of the case
    LoadEntry difference;   ///< table less case
    LoadEntryError stated;  ///< the table's standard error there
};

/// One quantity over all cases.
struct QuantityCheck {
    double error = 0.0;   ///< force, moment: rms difference over rms value; k, epsilon: rms of ln(table/case)
    double stated = 0.0;  ///< the same of the stated standard errors
    double within_two = 0.0;  ///< share of differences (of components) within two standard errors
};

struct TableCheck {
    std::vector<CheckedCase> cases;
    QuantityCheck force;
    QuantityCheck moment;
    QuantityCheck turbulent_kinetic_energy;
    QuantityCheck dissipation_rate;
    double within_two = 0.0;  ///< over all quantities and components
};

/// Holds tables against cases of purpose "table" (body axes) at directions and Reynolds numbers of their own.
/// Throws Error where there is none.
TableCheck check_tables(const LoadTables& tables, const std::vector<SolvedCase>& cases);

}  // namespace samara
