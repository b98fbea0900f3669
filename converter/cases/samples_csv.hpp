#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "converter/cases/case_reduction.hpp"

namespace samara {

/// Returns a CSV table of solved cases, one row each after a row of names: name, purpose, mesh, closure,
/// direction (unit vector), Reynolds number, force and moment coefficients (relative to A = pi L^2/4 and L),
/// k/U^2, epsilon L/U^3, and the standard errors of these by the tail of the iterations. Vectors are in body
/// axes; the columns of `axes` are the cases' axes in body axes. Numbers are written so that reading restores
/// them exactly.
std::string samples_csv(const std::vector<SolvedCase>& cases, const Matrix3d& axes);

/// Reads the cases of a table that samples_csv() wrote, in body axes. Throws Error with file and line where a
/// row has another number of columns, or a word for a number.
std::vector<SolvedCase> read_samples_csv(const std::filesystem::path& file);

}  // namespace samara
