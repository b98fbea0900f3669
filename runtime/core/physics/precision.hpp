#pragma once

#include <cstdint>

namespace samara {

/// The numbers that steps are computed in. Positions are of double precision in both, and so is contact.
enum class Precision : std::uint8_t { double_precision, single_precision };

}  // namespace samara
