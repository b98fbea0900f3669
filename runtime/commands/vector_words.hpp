#pragma once

#include <optional>
#include <string>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// The vector that an option's words "x,y,z" give; nothing where they are no three finite numbers.
std::optional<Vector3d> vector_of_words(const std::string& words);

}  // namespace samara
