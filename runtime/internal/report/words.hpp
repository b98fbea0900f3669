#pragma once

#include <string>

#include <fmt/format.h>

namespace samara {

/// A share as "0.12 %", "17 %" or "120 %".
inline std::string per_cent(double share) {
    return share < 0.995 ? fmt::format("{:.2g} %", 100.0 * share) : fmt::format("{:.0f} %", 100.0 * share);
}

}  // namespace samara
