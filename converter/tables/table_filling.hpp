#pragma once

#include <optional>
#include <vector>

#include "converter/cases/case_reduction.hpp"
#include "samara/core/body/body.hpp"
#include "samara/core/body/load_tables.hpp"

namespace samara {

/// Fills the tables (Reynolds numbers, entries, errors, error sources) over all directions from the solved
/// table cases, with `subdivisions` and `axes` of the tables as they stand. The main Reynolds number has
/// most directions; the others may have any of its directions (ReynoldsFit). Where the mesh before (purpose
/// `mesh`) has more directions than the table, the main one is its fit plus that of what the last mesh
/// changes (docs/theory.md, "Two meshes"). Of a body of finite symmetry it may stand beside the loads of its
/// surface, where these are given (SurfaceTrend).
///
/// In `cases` the loads that the symmetry forbids are taken from every case, and the table cases' errors are
/// widened by them (keep_symmetric_part).
///
/// The error of an entry has five sources, in quadrature, for k and epsilon as errors of their logarithms,
/// from which k's is k (exp(s) - 1):
///  - tail: of the iterations;
///  - symmetry: keep_symmetric_part;
///  - mesh and closure: model_errors;
///  - interpolation: since a table is used between its nodes, the mean square over the centres of the cells
///    around the node, of the interpolation between samples (ReynoldsFit::interpolation_error) and of the
///    difference that the bilinear lookup makes to it; and that between Reynolds numbers
///    (reynolds_interpolation_variance).
/// Sources of which the cases say nothing are absent from error_sources: mesh and closure without such
/// cases, symmetry where it forbids nothing.
///
/// Returns the standard errors of the interpolation alone, entry by entry: what more directions and Reynolds
/// numbers would lower.
///
/// Throws Error where there is no table case at the main Reynolds number, or where a Reynolds number mixes
/// laminar and turbulent ones.
std::vector<LoadEntryError> fill_tables(LoadTables& tables, const Symmetry& symmetry,
                                        std::vector<SolvedCase>& cases, double main_reynolds_number,
                                        const std::optional<SurfaceLoads>& surface = {});

/// The mean square error of looking a table up between its Reynolds numbers, linear in log Re: each inner
/// Reynolds number is left out and predicted from its two neighbours. That error belongs to intervals twice
/// as long, and to their middle, so that for a smooth change a quarter of it is left in the middle of the
/// table's own. One figure for each kind of quantity (the components of a vector alike), k and epsilon by
/// their logarithms; nothing (zero) where there are fewer than three Reynolds numbers, or where they are
/// laminar.
///
/// `nodes`: the entries of each of the ascending `reynolds_numbers` in the same directions.
LoadEntryError reynolds_interpolation_variance(const std::vector<double>& reynolds_numbers,
                                               const std::vector<std::vector<LoadEntry>>& nodes);

}  // namespace samara
