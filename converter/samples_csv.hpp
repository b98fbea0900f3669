#pragma once

#include <string>
#include <vector>

#include "converter/case_reduction.hpp"

namespace samara {

/// A table of solved cases, one row each after a row of names: name, purpose, mesh, closure, direction (unit
/// vector), Reynolds number, force and moment coefficients (on A = pi L^2/4 and L), k/U^2, epsilon L/U^3, and
/// the standard errors of these by the tail of the iterations. Vectors are in body axes; the columns of
/// `axes` are the cases' axes in body axes. Numbers have the digits that give them back exactly.
std::string samples_csv(const std::vector<SolvedCase>& cases, const Matrix3d& axes);

}  // namespace samara
