#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "converter/cases/case_reduction.hpp"
#include "converter/tables/model_errors.hpp"
#include "converter/tables/reynolds_fit.hpp"

namespace samara {

/// The cases of one Reynolds number and purpose, and what comes of those for the table, in map axes.
struct ReynoldsTable {
    double reynolds_number = 0.0;
    std::vector<DirectionSample> samples;
    std::vector<LoadEntryError> tail;
    std::vector<LoadEntryError> asymmetry;
    std::unique_ptr<ReynoldsFit> fit;
    std::vector<LoadEntry> nodes;  ///< row by row; these and their scale are filled by fill_tables
    LoadScale scale;
};

/// The tables by ascending Reynolds number, and what the main one's fit stands beside.
struct FittedTables {
    std::vector<ReynoldsTable> tables;
    std::unique_ptr<ReynoldsFit> mesh_before;  ///< the main Reynolds number's on the mesh before the last
};

/// Takes from the cases what the symmetry forbids, adds to further Reynolds numbers what the last mesh
/// changes, and fits the table cases of each: the main one's beside the mesh before where that has more
/// directions. The trend by the surface, where it is given, stands for bodies of finite symmetry only. Throws
/// Error where there is no table case at the main Reynolds number, or where a Reynolds number mixes laminar
/// and turbulent ones.
FittedTables fitted_tables(const Symmetry& symmetry, std::vector<SolvedCase>& cases,
                           double main_reynolds_number, const std::optional<SurfaceLoads>& surface);

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
