#pragma once

#include "samara/core/body/body.hpp"

namespace samara {

/// The body's lengths along its principal axes (m), shortest first.
Vector3d principal_extents(const Body& body);

}  // namespace samara
