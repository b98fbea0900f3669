#pragma once

#include "samara/core/surface/surface.hpp"

namespace samara {

/// Checks that the welded surface is a body's: as require_bounding_surface (core/surface/surface_check.hpp)
/// does, and that no faces cross or lie on each other. Throws Error of one line, without a file name. Takes n
/// log n time.
void require_sound_surface(const Surface& surface);

}  // namespace samara
