#pragma once

namespace samara {

/// Reads a number at the start of [first, last) as std::from_chars does, and returns where it ends; `first`
/// where there is none. One too large for a double is infinite, one too small (OpenFOAM writes 1e-320 in
/// decaying fields) zero.
const char* read_foam_number(const char* first, const char* last, double& value);

}  // namespace samara
