#pragma once

#include <filesystem>

namespace samara {

/// Throws Error naming file and line where a file that OpenFOAM reads as a field, a mesh or a state holds
/// more than data: a directive (#calc, #codeStream, #include, ...), an expansion ($...), a library or code to
/// load, or a kind of list or class that no solver writes there. What a solver wrote has none of these, and
/// nothing else in such a file makes OpenFOAM run or read anything. A file that ends early is let be: its
/// reader says so.
void require_foam_data(const std::filesystem::path& file);

}  // namespace samara
