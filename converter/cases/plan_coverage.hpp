#pragma once

#include "converter/cases/case_folder_reduction.hpp"
#include "converter/cases/case_plan.hpp"
#include "samara/core/body/body.hpp"

namespace samara {

/// That of which the plan has most cases on the last mesh and the one before it (purposes `table` and
/// `mesh`), the lowest of equals, whatever became of them. Throws Error where no case is for the table.
double main_reynolds_number(const CasePlan& plan);

/// Throws Error where the plan's cases cannot make tables that are worth it. The main Reynolds number must
/// plan at least the required_directions of a map with one subdivision, unless the plan covers a scene alone,
/// and at most one in five of its directions may be left out.
void require_enough_directions(const CasePlan& plan, const Symmetry& symmetry,
                               const FolderReduction& reduction);

}  // namespace samara
