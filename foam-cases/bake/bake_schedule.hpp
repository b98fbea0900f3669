#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "foam-cases/bake/bake_plan.hpp"

namespace samara {

/// A mesh, case or fall that the farm makes, once those that it is made from are there.
struct FarmTask {
    double seconds = 0.0;            ///< wall clock on its cores; 0 where it is made already
    std::vector<std::size_t> after;  ///< the tasks that it is made from, by their places in the list
};

/// The work of a plan in the order in which the farm begins it, and what of it an earlier bake has done.
struct FarmWork {
    std::vector<FarmTask> tasks;
    std::size_t done = 0;  ///< number of cases and falls that are solved, by the same inputs

    /// Appends the work of another plan, which waits for none of this one.
    void add(const FarmWork& other);
};

/// Returns the work of a plan of a body: estimated seconds, those of earlier cases with the same inputs left
/// out. `folder`: the folder of cases, which need not exist; `foam_cases`: that of the templates. Only reads.
/// Throws Error where a template is damaged.
FarmWork farm_work(const std::filesystem::path& folder, const Body& body, const BakePlan& plan,
                   const std::filesystem::path& foam_cases);

/// Returns the time (s) that the work takes where `slots` tasks can run at once, each begun as soon as a slot
/// is free and what it is made from is there, in the order of the list (R. L. Graham's list scheduling, Bell
/// Syst. Tech. J. 45, 1966: at most 2 - 1/slots times the shortest).
double seconds_with(const FarmWork& work, std::size_t slots);

/// Returns the time (s) of the longest chain of tasks of which each waits for the one before: no number of
/// cores does it faster.
double longest_chain(const FarmWork& work);

}  // namespace samara
