#pragma once

#include <vector>

#include "converter/cases/case_reduction.hpp"
#include "converter/tables/reynolds_fit.hpp"

namespace samara {

/// Further Reynolds numbers may be solved on a coarser mesh than the main one, where the main one was solved
/// in the same directions too (purpose "mesh"). What the finer mesh changes there is then added to them: to
/// force and moment the difference, to k and epsilon the ratio. So a table holds one mesh's figures, and its
/// change with the Reynolds number is that of one mesh.
///
/// `main`: the Reynolds number of the densest directions; `finest`: its fit on the last mesh, in the axes of
/// the cases' directions. A table case without such a partner stays as it is, as does a laminar one beside a
/// turbulent main one, for k and epsilon.
void transfer_to_main_mesh(std::vector<SolvedCase>& cases, double main, const ReynoldsFit& finest);

}  // namespace samara
