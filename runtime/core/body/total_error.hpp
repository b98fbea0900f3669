#pragma once

#include <cmath>
#include <vector>

#include "samara/core/body/table_errors.hpp"

namespace samara {

/// The sources' errors of one quantity together, in quadrature: 0 where there are none.
inline double total_error(const std::vector<ErrorShare>& sources, double ErrorShare::*quantity) {
    double squares = 0.0;
    for (const ErrorShare& share : sources) squares += share.*quantity * (share.*quantity);
    return std::sqrt(squares);
}

}  // namespace samara
