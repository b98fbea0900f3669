#pragma once

#include <optional>
#include <vector>

#include "converter/cases/case_reduction.hpp"
#include "converter/tables/reynolds_fit.hpp"

namespace samara {

/// How large the loads of one Reynolds number are: what their model errors are a fraction of.
struct LoadScale {
    double force = 0.0;  ///< root mean squares over the directions
    double moment = 0.0;

    /// The scale in one direction: sqrt(|F|^2 + (rms F / 2)^2), for the moment alike. An error that grows
    /// with the load, with a floor where the load vanishes: there it vanishes by the symmetry, or in a
    /// direction that is itself uncertain.
    [[nodiscard]] double of_force(const Vector3d& force) const;
    [[nodiscard]] double of_moment(const Vector3d& moment) const;
};

/// One standard error for all directions, of which a load's is a fraction of its LoadScale; for k and epsilon
/// that of their logarithms.
using RelativeErrors = ErrorMetrics;

/// The cases of one purpose against the table's: which were solved in the same direction and at the same
/// Reynolds number, on the same mesh (closures) or with the same closure (meshes). All `cases` already passed
/// through keep_symmetric_part. `scales`: for each of `reynolds_numbers`. Nothing where no case is of that
/// purpose, or none has its table case.
///
/// Mesh: the whole difference between the two meshes is taken as one standard error of the finer one's. With
/// half the cells along each edge, Richardson's extrapolation gives that for a method of first order, a third
/// of it for one of second; around bluff bodies neither is reached evenly, and P. Roache's grid convergence
/// index for two meshes (Annual Review of Fluid Mechanics 29, 1997) guards the second order by the factor 3.
///
/// Closure: none of the closures is known to be the right one. They are taken as draws from all one might
/// have chosen: the table's standard error is the sample's standard deviation over the closures, which for
/// two is their difference over the square root of 2.
///
/// Both are root mean squares over the directions and the components that the symmetry allows there; the
/// closures' is widened for the small number of directions (student_widening), the meshes' is not: to take
/// the whole difference is a guard already. Where it allows no moment in any of the directions, the force's
/// fraction stands for the moment's.
std::optional<RelativeErrors> model_errors(CasePurpose purpose, const Symmetry& symmetry,
                                           const std::vector<SolvedCase>& cases,
                                           const std::vector<double>& reynolds_numbers,
                                           const std::vector<LoadScale>& scales);

}  // namespace samara
