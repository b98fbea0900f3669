#pragma once

#include <array>
#include <optional>
#include <string_view>

#include <nlohmann/json.hpp>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// Parses a JSON text. Throws Error, "is no JSON (REASON)" or error_of_json_size(), where it is none or too
/// large.
nlohmann::json parse_json(std::string_view text);

/// Parses a JSON text; returns a value whose is_discarded() holds where parse_json() would throw.
nlohmann::json parse_json_or_discard(std::string_view text);

/// Returns a vector as the list [x, y, z].
inline nlohmann::json as_json(const Vector3d& vector) {
    return {vector.x(), vector.y(), vector.z()};
}

/// Returns the value as JSON, or null where there is none.
template <typename Value>
nlohmann::json or_null(const std::optional<Value>& value) {
    return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
}

/// Returns a square matrix as a list of its rows, each a list of numbers.
template <int size>
nlohmann::json rows_as_json(const Eigen::Matrix<double, size, size>& matrix) {
    nlohmann::json rows = nlohmann::json::array();
    for (int row = 0; row < size; ++row) {
        rows.push_back(nlohmann::json::array());
        for (int column = 0; column < size; ++column) rows.back().push_back(matrix(row, column));
    }
    return rows;
}

/// Reads the vector that as_json() wrote. Throws nlohmann::json::exception for anything else.
inline Vector3d vector_of(const nlohmann::json& values) {
    const auto numbers = values.get<std::array<double, 3>>();
    return {numbers[0], numbers[1], numbers[2]};
}
/// Reads the 3x3 matrix that rows_as_json() wrote. Throws nlohmann::json::exception for anything else.
inline Matrix3d matrix_of(const nlohmann::json& rows) {
    Matrix3d matrix;
    for (std::size_t row = 0; row < 3; ++row) matrix.row(static_cast<int>(row)) = vector_of(rows.at(row));
    return matrix;
}

}  // namespace samara
