#include "samara/core/base/turn.hpp"

namespace samara {

Quaterniond turn_between(const Vector3d& from, const Vector3d& to) {
    return Quaterniond::FromTwoVectors(from, to);
}

}  // namespace samara
