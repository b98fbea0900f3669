#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "samara/core/body/body.hpp"
#include "samara/internal/report/report_page.hpp"

namespace samara {

/// The parts of a report that a body file gives: the body, its polars, map, convergence and errors by source,
/// the coefficients of a turning body, the cases and where the file comes from. The body must have tables.
/// `progress` is told the share done, from 0 to 1. Throws Error where gnuplot is not installed.
std::vector<ReportPart> body_parts(const std::filesystem::path& file, const Body& body,
                                   const std::function<void(double share)>& progress);

}  // namespace samara
