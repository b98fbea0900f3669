#pragma once

#include <nlohmann/json.hpp>

#include "samara/base/linear_algebra.hpp"

namespace samara {

/// [x, y, z]
inline nlohmann::json as_json(const Vector3d& vector) {
    return {vector.x(), vector.y(), vector.z()};
}

}  // namespace samara
