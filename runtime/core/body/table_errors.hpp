#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace samara {

/// The sources of the standard errors of load tables (docs/explanation/steady-loads.md).
enum class ErrorSource { tail, symmetry, mesh, closure, interpolation };
constexpr std::size_t error_source_count = 5;

/// Returns "tail", "symmetry", "mesh", "closure" or "interpolation".
const char* name_of(ErrorSource source);

/// Returns the source of this name, or nothing where there is none.
std::optional<ErrorSource> error_source(std::string_view name);

/// The part of one source in the standard errors of the tables: the root mean square over all entries,
/// relative to that of the quantity itself. All components of a vector count together.
struct ErrorShare {
    ErrorSource source;               ///< what causes it
    double force;                     ///< relative, as a root mean square
    double moment;                    ///< likewise
    double turbulent_kinetic_energy;  ///< likewise
    double dissipation_rate;          ///< likewise
};

/// Returns the errors of all sources for one quantity together, in quadrature; 0 where there are none.
inline double total_error(const std::vector<ErrorShare>& sources, double ErrorShare::*quantity) {
    double squares = 0.0;
    for (const ErrorShare& share : sources) squares += share.*quantity * (share.*quantity);
    return std::sqrt(squares);
}

}  // namespace samara
