#pragma once

#include <filesystem>
#include <vector>

#include "samara/core/body/body.hpp"
#include "samara/reports/report_blocks.hpp"

namespace samara {

/// The parts of a report that a body file gives: the body, its polars, map, convergence and errors by source,
/// the coefficients of a turning body, the cases and where the file comes from. The body must have tables.
std::vector<ReportPart> body_parts(const std::filesystem::path& file, const Body& body);

}  // namespace samara
