#pragma once

#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "samara/commands/shared/body_notes.hpp"
#include "samara/core/body/load_tables.hpp"
#include "samara/scene/table_errors_on_path.hpp"

namespace samara {

/// Returns the sources that the tables' standard errors hold, "tail, symmetry, interpolation"; "tail,
/// symmetry" for tables from before sources were written.
std::string error_sources_in_words(const LoadTables& tables);

/// Returns lines of at most 100 characters about the tables' errors along a body's path, each with its line
/// feed; empty where the body used no tables.
std::string table_errors_as_text(const std::optional<LoadTables>& tables, const TableErrorsOnPath& errors);

/// Returns the tables' errors along a body's path as JSON: `force` and `turbulent_kinetic_energy` (means over
/// the poses, relative; null where the body did not use them), `sources`, `left_out`; null where the body
/// used no tables.
nlohmann::json table_errors_as_json(const std::optional<LoadTables>& tables, const TableErrorsOnPath& errors);

/// Warns of each mean error above 30 %, with a remedy that fits the quality of the tables, and of a body that
/// moved in directions that its bake was not planned for.
void note_table_errors(BodyNotes& notes, const std::string& body, const std::optional<LoadTables>& tables,
                       const TableErrorsOnPath& errors);

}  // namespace samara
