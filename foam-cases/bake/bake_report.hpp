#pragma once

#include <nlohmann/json_fwd.hpp>

#include "foam-cases/bake/bake.hpp"
#include "samara/commands/shared/body_notes.hpp"

namespace samara {

/// What samara bake prints as JSON of one body with --dry-run, and after baking it.
nlohmann::json bake_as_json(const BakeRequest& request, const BakePreparation& preparation);
nlohmann::json bake_as_json(const BakeRequest& request, const BakeResult& result);

/// The same for people, on standard output.
void print_preparation(const BakeRequest& request, const BakePreparation& preparation, int jobs);
void print_result(const BakeRequest& request, const BakeResult& result);

/// Notes where a figure looks as if it were in another unit, and where the Reynolds number is below
/// laminar_reynolds_number.
void note_warnings(BodyNotes& notes, const BakeRequest& request, const BakePreparation& preparation);

/// One line on standard error that names the cases that were left out.
void warn_of_left_out_cases(const BakeRequest& request, const BakeResult& result);

/// Notes the falls whose momenta do not balance their loads, and the remedy.
void warn_of_unbalanced_falls(const BakeRequest& request, const BakeResult& result);

}  // namespace samara
