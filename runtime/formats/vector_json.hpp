#pragma once

#include <array>
#include <optional>

#include <nlohmann/json.hpp>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// [x, y, z]
inline nlohmann::json as_json(const Vector3d& vector) {
    return {vector.x(), vector.y(), vector.z()};
}

/// The value, or null.
template <typename Value>
nlohmann::json or_null(const std::optional<Value>& value) {
    return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
}

/// The rows of the matrix, each a list.
template <int size>
nlohmann::json rows_as_json(const Eigen::Matrix<double, size, size>& matrix) {
    nlohmann::json rows = nlohmann::json::array();
    for (int row = 0; row < size; ++row) {
        rows.push_back(nlohmann::json::array());
        for (int column = 0; column < size; ++column) rows.back().push_back(matrix(row, column));
    }
    return rows;
}

/// The vector of as_json, and the matrix of rows_as_json. Throw nlohmann::json::exception for anything else.
inline Vector3d vector_of(const nlohmann::json& values) {
    const auto numbers = values.get<std::array<double, 3>>();
    return {numbers[0], numbers[1], numbers[2]};
}
inline Matrix3d matrix_of(const nlohmann::json& rows) {
    Matrix3d matrix;
    for (std::size_t row = 0; row < 3; ++row) matrix.row(static_cast<int>(row)) = vector_of(rows.at(row));
    return matrix;
}

}  // namespace samara
