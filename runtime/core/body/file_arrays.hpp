#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/files/hdf5_reader.hpp"
#include "samara/core/files/hdf5_writer.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// Returns the row-major values of a matrix or vector, for Hdf5Writer.
template <typename Derived>
std::vector<double> row_major(const Eigen::MatrixBase<Derived>& matrix) {
    std::vector<double> values;
    values.reserve(static_cast<std::size_t>(matrix.size()));
    for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
        for (Eigen::Index column = 0; column < matrix.cols(); ++column) values.push_back(matrix(row, column));
    }
    return values;
}

/// Returns the matrix of fixed size with these row-major values.
template <typename Matrix>
Matrix from_row_major(const std::vector<double>& values) {
    Matrix matrix;
    std::size_t next = 0;
    for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
        for (Eigen::Index column = 0; column < matrix.cols(); ++column)
            matrix(row, column) = values.at(next++);
    }
    return matrix;
}

/// Returns the components of the vectors one after another: the values of a dataset of shape (n, 3).
std::vector<double> flattened(const std::vector<Vector3d>& vectors);

/// Returns the vectors whose components, one after another, are the values.
std::vector<Vector3d> unflattened(const std::vector<double>& values);

/// Writes a surface as the datasets vertices (n, 3), corners (triangles, 3) and, for order 2, edge_nodes
/// (triangles, 3) of the group, in body files and motion files.
void write_surface(Hdf5Writer& file, const std::string& group, const Surface& surface,
                   const char* units = "m", const char* axes = "shape axes");

/// Reads a surface that write_surface() wrote. Throws Error where a value is not finite, an index points
/// outside the vertices, or the lengths do not fit.
Surface read_surface(const Hdf5Reader& file, const std::string& group);

}  // namespace samara
