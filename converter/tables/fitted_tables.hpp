#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "converter/cases/case_reduction.hpp"
#include "converter/falls/model_errors.hpp"
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

}  // namespace samara
