#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "samara/core/body/body.hpp"
#include "samara/reports/bake_verdict.hpp"
#include "samara/reports/report_blocks.hpp"

namespace samara {

/// The part of a report that the folder of a body's cases adds.
struct CasesReport {
    std::vector<ReportPart> parts;
    std::vector<Finding> findings;
    std::vector<std::string> missing;  ///< parts that are missing, a line each, with the reason
};

/// Reads a folder of cases for the report of its body; `progress` is called with the share done.
using CasesReader = std::function<CasesReport(const std::filesystem::path& folder, const Body& body,
                                              const std::function<void(double share)>& progress)>;

/// Runs the command samara report: argv[0] is its name. `read_cases` comes from the baking tools; without it
/// the report is of the body file alone, and says so where there are cases. Returns the exit status.
int run_report(int argc, const char* const* argv, const CasesReader& read_cases);

}  // namespace samara
