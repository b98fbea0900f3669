#pragma once

namespace samara {

/// C_k of the paper's eq. 7; Pope, Phys. Fluids 26 (1983).
inline constexpr double kolmogorov_constant = 2.1;

}  // namespace samara
