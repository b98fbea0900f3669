#pragma once

#include <optional>
#include <vector>

#include "converter/cases/case_reduction.hpp"
#include "converter/tables/reynolds_fit.hpp"

namespace samara {

/// The magnitude of loads and turbulence at one Reynolds number, to which their model errors are relative.
struct LoadScale {
    ErrorMetrics rms;  ///< root mean squares over the directions; of turbulence in_fit_units()

    /// Returns the scales of an entry in_fit_units(): of force sqrt(|F|^2 + (rms F / 2)^2), the others
    /// likewise. The error grows with the value, with a lower limit where the value vanishes, by the symmetry
    /// or in a direction that is itself uncertain.
    [[nodiscard]] ErrorMetrics at(const LoadEntry& entry) const;
};

/// Standard errors for all directions, relative to their LoadScale; of turbulence in_fit_units().
using RelativeErrors = ErrorMetrics;

/// Estimates the model errors by comparing the cases of one purpose with the table's that were solved in the
/// same direction and at the same Reynolds number, on the same mesh (closures) or with the same closure
/// (meshes). All `cases` already passed through keep_symmetric_part. `scales`: for each of
/// `reynolds_numbers`. Returns nothing where no case has that purpose, or none has its table case.
///
/// Mesh: the whole difference between the two meshes is taken as one standard error of the finer one. With
/// half the cells along each edge, Richardson's extrapolation gives that for a method of first order, a third
/// of it for one of second; around bluff bodies neither order is reached uniformly, and P. Roache's grid
/// convergence index for two meshes (Annual Review of Fluid Mechanics 29, 1997) applies the safety factor 3
/// to second order.
///
/// Closure: none of the closures is known to be the right one. They are taken as a sample of all possible
/// closures: the table's standard error is the sample's standard deviation over the closures, which for two
/// is their difference over the square root of 2.
///
/// Both are root mean squares over the directions and the components that the symmetry allows there; that of
/// the closures is widened for the small number of directions (student_widening), that of the meshes is not,
/// since the whole difference is conservative already. Where the symmetry allows no moment in any direction,
/// the force's relative error is used for the moment.
std::optional<RelativeErrors> model_errors(CasePurpose purpose, const Symmetry& symmetry,
                                           const std::vector<SolvedCase>& cases,
                                           const std::vector<double>& reynolds_numbers,
                                           const std::vector<LoadScale>& scales);

}  // namespace samara
