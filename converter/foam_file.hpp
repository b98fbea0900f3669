#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "samara/base/linear_algebra.hpp"

namespace samara {

/// The dictionary FoamFile at the top of every OpenFOAM file, as far as reading it needs it.
struct FoamHeader {
    std::string format;      ///< "ascii" or "binary"
    std::string class_name;  ///< "volScalarField", ...
    std::string object;      ///< the name of what the file holds
    int label_bytes = 4;     ///< of a binary file's whole numbers
    int scalar_bytes = 8;    ///< of a binary file's numbers
};

/// The values of a field inside the mesh: one for each cell, or one for all.
template <typename Value>
struct FoamField {
    bool uniform = false;
    std::vector<Value> values;  ///< one value where uniform

    [[nodiscard]] const Value& operator[](std::size_t cell) const { return values[uniform ? 0 : cell]; }
    /// Whether the field has a value at the cell.
    [[nodiscard]] bool covers(std::size_t cell) const { return uniform || cell < values.size(); }
};

/// The internalField of a volScalarField (or volScalarField::Internal) in the units of the file. ASCII, or
/// binary of this machine's byte order. Throws Error with file and line where the file is not such a field,
/// or is compressed (the message names the tool that unpacks it).
FoamField<double> read_scalar_field(const std::filesystem::path& file);

/// The same for a volVectorField.
FoamField<Vector3d> read_vector_field(const std::filesystem::path& file);

/// The cells of the zone `name` of a cellZones file. Throws Error as above, and where it has no such zone.
std::vector<std::int64_t> read_cell_zone(const std::filesystem::path& file, const std::string& name);

}  // namespace samara
