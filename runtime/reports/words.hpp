#pragma once

#include <string>

#include <fmt/format.h>

namespace samara {

/// A share as "0.12 %", "17 %" or "120 %".
inline std::string per_cent(double share) {
    return share < 0.995 ? fmt::format("{:.2g} %", 100.0 * share) : fmt::format("{:.0f} %", 100.0 * share);
}

/// A number of four digits or so, without an exponent from 1e-3 to 1e9.
inline std::string in_plain_digits(double number) {
    return number >= 1000.0 && number < 1e9 ? fmt::format("{:.0f}", number) : fmt::format("{:.4g}", number);
}

}  // namespace samara
