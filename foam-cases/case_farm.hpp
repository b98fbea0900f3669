#pragma once

#include <filesystem>

#include "foam-cases/bake_plan.hpp"

namespace samara {

/// Throws Error naming every program that solving needs and that is not on PATH, with the Debian packages
/// that bring them.
void require_solvers();

/// How many of the planned cases are solved.
std::size_t count_solved(const std::filesystem::path& folder, const BakePlan& plan);

/// Solves the cases of a folder written by write_case_folder that are not solved yet, `jobs` at once, with
/// Snakemake; a case that fails leaves the others running. Progress goes to standard error. Throws Error
/// where the mesh or a case failed (naming the first, its log, and how many), where the user interrupted it,
/// and where another program is at work in the folder. Solved cases stay: the next call goes on from there.
void solve_cases(const std::filesystem::path& folder, const BakePlan& plan, int jobs,
                 const std::filesystem::path& templates);

}  // namespace samara
