#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// The entries of the dictionary FoamFile at the top of an OpenFOAM file that are needed to read it.
struct FoamHeader {
    std::string format = "ascii";  ///< or "binary"
    std::string class_name;        ///< "volScalarField", ...
    std::string object;            ///< the name of what the file holds
    int label_bytes = 4;           ///< size of whole numbers in a binary file
    int scalar_bytes = 8;          ///< size of numbers in a binary file
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

// All files are read in ASCII and in binary of this machine's byte order, with labels of 32 or 64 and scalars
// of 32 or 64 bits, compressed by gzip or not, with the headers of OpenFOAM v1912 to v2312 and 8 to 11.
// Errors name the file and the line.

/// Reads the internalField of a volScalarField (or volScalarField::Internal) in the units of the file; what
/// follows it is not read. Throws Error where the file is no such field.
FoamField<double> read_scalar_field(const std::filesystem::path& file);

/// Reads the internalField of a volVectorField like read_scalar_field().
FoamField<Vector3d> read_vector_field(const std::filesystem::path& file);

/// Reads the cells of the zone `name` of a cellZones file. Throws Error where the file is damaged or has no
/// such zone.
std::vector<std::int64_t> read_cell_zone(const std::filesystem::path& file, const std::string& name);

/// Reads a labelList: the file owner or neighbour of a mesh.
std::vector<std::int64_t> read_labels(const std::filesystem::path& file);

/// Reads the file points of a mesh.
std::vector<Vector3d> read_points(const std::filesystem::path& file);

/// The faces of a mesh: face i has the points points[starts[i]] to points[starts[i + 1] - 1].
struct FoamFaces {
    std::vector<std::int64_t> starts;  ///< one more than there are faces
    std::vector<std::int64_t> points;

    [[nodiscard]] std::size_t size() const { return starts.size() - 1; }
};

/// Reads the file faces of a mesh (faceList or faceCompactList).
FoamFaces read_faces(const std::filesystem::path& file);

/// Throws Error naming file and line where a file that OpenFOAM reads as a field, a mesh or a state holds
/// more than data: a directive (#calc, #codeStream, #include, ...), an expansion ($...), a library or code to
/// load, or a type of list or class that no solver writes there. Files written by a solver hold none of
/// these, and nothing else in such a file makes OpenFOAM run or read anything. A file that ends early passes:
/// its reader reports it.
void require_foam_data(const std::filesystem::path& file);

}  // namespace samara
