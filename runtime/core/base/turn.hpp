#pragma once

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// The least turn that takes the direction of `from` to that of `to`, about any axis across them where they
/// are opposite. Here because Eigen's takes seconds to compile wherever it is used.
Quaterniond turn_between(const Vector3d& from, const Vector3d& to);

}  // namespace samara
