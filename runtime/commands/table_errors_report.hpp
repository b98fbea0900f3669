#pragma once

#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "samara/commands/shared/body_notes.hpp"
#include "samara/core/body/load_tables.hpp"
#include "samara/scene/table_errors_on_path.hpp"

namespace samara {

/// "tail, symmetry, interpolation": the sources that the tables' standard errors hold; "tail and symmetry"
/// for tables from before sources were written.
std::string error_sources_in_words(const LoadTables& tables);

/// Lines of at most 100 characters about the tables' errors as a flight met them, each with its line feed;
/// empty where the flight used no tables.
std::string table_errors_as_text(const std::optional<LoadTables>& tables, const TableErrorsOnPath& errors);

/// The same as JSON: `force` and `turbulent_kinetic_energy` (means over the flight, relative; null where the
/// flight did not use them), `sources`, `left_out`; null where the flight used no tables.
nlohmann::json table_errors_as_json(const std::optional<LoadTables>& tables, const TableErrorsOnPath& errors);

/// Notes each mean error above 30 %, and a flight that left what its bake was planned for.
void note_table_errors(BodyNotes& notes, const std::string& body, const TableErrorsOnPath& errors);

}  // namespace samara
