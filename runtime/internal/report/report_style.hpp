#pragma once

namespace samara {

/// The style sheet of a report's page.
extern const char* const report_style;

}  // namespace samara
