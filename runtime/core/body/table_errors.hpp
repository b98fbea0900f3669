#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace samara {

/// Where the standard errors of load tables come from (docs/theory.md, errors of the tables).
enum class ErrorSource { tail, symmetry, mesh, closure, interpolation };
constexpr std::size_t error_source_count = 5;

/// "tail", "symmetry", "mesh", "closure" or "interpolation".
const char* name_of(ErrorSource source);

/// The source of this name, if there is one.
std::optional<ErrorSource> error_source(std::string_view name);

/// What one source adds to the standard errors of the tables: the root mean square over all entries, over
/// that of the quantity itself. Vectors count by all their components together.
struct ErrorShare {
    ErrorSource source;               ///< what causes it
    double force;                     ///< relative, as a root mean square
    double moment;                    ///< likewise
    double turbulent_kinetic_energy;  ///< likewise
    double dissipation_rate;          ///< likewise
};

/// A case that was planned but could not be solved: its direction is filled from the others.
struct LeftOutCase {
    std::string name;    ///< of the case's folder
    std::string reason;  ///< one line
};

}  // namespace samara
