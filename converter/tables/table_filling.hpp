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
/// `mesh`) has more directions than the table, the main one is its fit plus that of the change by the last
/// mesh (docs/explanation/steady-loads.md#from-cases-to-tables). For a body of finite symmetry it may be
/// relative to the surface loads, where these are given (SurfaceTrend).
///
/// In `cases` the loads that the symmetry forbids are removed from every case, and the table cases' errors
/// are widened by them (keep_symmetric_part).
///
/// The error of an entry has five sources, in quadrature, for k and epsilon as errors s of their roots, from
/// which that of k is (2 sqrt(k) + s) s:
///  - tail: the iterations had not ended (tail_error);
///  - symmetry: forbidden loads (keep_symmetric_part);
///  - mesh and closure: model_errors; that of closures is in the errors of loads, and for k and epsilon in
///    error_sources alone;
///  - interpolation: the mean square over the centres of the cells around the node, since a table is used
///  between its nodes, of the interpolation between samples (ReynoldsFit::interpolation_error) and of its
///  difference from the bilinear lookup; and the interpolation between Reynolds numbers
///  (reynolds_interpolation_variance).
/// Sources that the cases do not show are absent from error_sources: mesh and closure without such
/// cases, symmetry where it forbids nothing.
///
/// Returns the standard errors by the interpolation alone, entry by entry, which more directions and Reynolds
/// numbers would lower.
///
/// Throws Error where there is no table case at the main Reynolds number, or where a Reynolds number mixes
/// laminar and turbulent ones.
std::vector<LoadEntryError> fill_tables(LoadTables& tables, const Symmetry& symmetry,
                                        std::vector<SolvedCase>& cases, double main_reynolds_number,
                                        const std::optional<SurfaceLoads>& surface = {});

/// Estimates the mean square error of interpolating a table between its Reynolds numbers, linearly in log Re:
/// each inner Reynolds number is left out and predicted from its two neighbours. That error is of intervals
/// twice as long, so that for a smooth change a quarter of it remains in the middle of the table's intervals.
/// The components of a vector have equal errors, those of k and epsilon are of their roots; zero where
/// there are fewer than three Reynolds numbers, or where the flow is laminar.
///
/// `nodes`: the entries of each of the ascending `reynolds_numbers` in the same directions.
LoadEntryError reynolds_interpolation_variance(const std::vector<double>& reynolds_numbers,
                                               const std::vector<std::vector<LoadEntry>>& nodes);

}  // namespace samara
