#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "samara/internal/report/bake_verdict.hpp"

namespace samara {

/// A part of a report.
struct ReportPart {
    std::string title;  ///< unlike those of the other parts
    std::string html;   ///< what stands under it: whole elements (html.hpp)
};

/// Writes a report as one page that needs nothing else: no network, no script, light and dark, printable. The
/// verdict stands on top. Throws Error where the file cannot be written.
void write_report_page(const std::filesystem::path& file, const std::string& name, const std::string& below,
                       const BakeVerdict& verdict, const std::vector<ReportPart>& parts);

}  // namespace samara
