#pragma once

#include <nlohmann/json_fwd.hpp>

#include "foam-cases/bake/bake.hpp"
#include "samara/commands/shared/body_notes.hpp"

namespace samara {

/// Return the JSON output of `samara bake` for one body: with --dry-run, and after baking.
nlohmann::json bake_as_json(const BakeRequest& request, const BakePreparation& preparation);
nlohmann::json bake_as_json(const BakeRequest& request, const BakeResult& result);

/// Print the plan and the result of a bake as text on standard output.
void print_preparation(const BakeRequest& request, const BakePreparation& preparation, int jobs);
void print_result(const BakeRequest& request, const BakeResult& result);

/// Prints on standard output what the bodies of a scene cost together; `bodies`: bake_as_json() of each, with
/// --dry-run; `work`: of all of them.
void print_total(const nlohmann::json& bodies, const FarmWork& work, int jobs);

/// Prints in one line on standard error what will be solved, what it costs, and the errors to expect.
void note_cost(const BakeRequest& request, const BakePreparation& preparation, int jobs);

/// Adds notes where a quantity seems to be in another unit, and where a Reynolds number is below
/// laminar_reynolds_number or in the drag crisis.
void note_warnings(BodyNotes& notes, const BakeRequest& request, const BakePreparation& preparation);

/// Prints the cases that were left out in one line on standard error.
void warn_of_left_out_cases(const BakeRequest& request, const BakeResult& result);

/// Prints notes about falls whose momenta do not balance their loads, with the remedy.
void warn_of_unbalanced_falls(const BakeRequest& request, const BakeResult& result);

}  // namespace samara
