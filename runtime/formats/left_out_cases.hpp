#pragma once

#include <string>
#include <vector>

#include "samara/core/body/load_tables.hpp"

namespace samara {

/// A case that was planned but could not be solved: its direction is filled from the others.
struct LeftOutCase {
    std::string name;    ///< of the case's folder
    std::string reason;  ///< one line
};

/// The text that LoadTables::left_out holds of these cases: a JSON list of their names and reasons; of none
/// an empty text.
std::string left_out_text(const std::vector<LeftOutCase>& cases);

/// The cases that could not be solved. Throws Error where LoadTables::left_out is no such list.
std::vector<LeftOutCase> left_out_cases(const LoadTables& tables);

}  // namespace samara
