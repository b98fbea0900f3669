#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "converter/cases/case_reduction.hpp"
#include "converter/tables/model_errors.hpp"
#include "converter/tables/reynolds_fit.hpp"

namespace samara {

/// The cases of one Reynolds number and purpose, with their errors and fit, in map axes.
struct ReynoldsTable {
    double reynolds_number = 0.0;
    std::vector<DirectionSample> samples;
    std::vector<LoadEntryError> tail;
    std::vector<LoadEntryError> asymmetry;
    std::unique_ptr<ReynoldsFit> fit;
    std::vector<LoadEntry> nodes;  ///< row by row; set by fill_tables(), like their scale
    LoadScale scale;
};

/// The tables by ascending Reynolds number, and the fit to which the main one's is relative.
struct FittedTables {
    std::vector<ReynoldsTable> tables;
    std::unique_ptr<ReynoldsFit> mesh_before;  ///< at the main Reynolds number on the mesh before the last
};

/// Removes the components that the symmetry forbids from the cases, corrects further Reynolds numbers for the
/// change by the last mesh, and fits the table cases of each: at the main Reynolds number relative to the
/// mesh before where that has more directions. The trend by the surface loads, where given, is used for
/// bodies of finite symmetry only. Throws Error where there is no table case at the main Reynolds number, or
/// where a Reynolds number mixes laminar and turbulent ones.
FittedTables fitted_tables(const Symmetry& symmetry, std::vector<SolvedCase>& cases,
                           double main_reynolds_number, const std::optional<SurfaceLoads>& surface);

/// Corrects cases at further Reynolds numbers that were solved on a coarser mesh, on which the main Reynolds
/// number was solved in the same directions too (purpose "mesh"): the change by the finer mesh there is
/// applied to them, for force and moment the difference, for k and epsilon the ratio. So a table holds the
/// values of one mesh, and its change with the Reynolds number is that of one mesh.
///
/// `main`: the Reynolds number of the densest directions; `finest`: its fit on the last mesh, in the axes of
/// the cases' directions. A table case without such a partner is not changed, nor are k and epsilon of a
/// laminar case with a turbulent main one.
void transfer_to_main_mesh(std::vector<SolvedCase>& cases, double main, const ReynoldsFit& finest);

}  // namespace samara
