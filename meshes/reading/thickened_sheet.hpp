#pragma once

#include "samara/core/surface/surface.hpp"

namespace samara {

/// Returns the closed surface of a sheet of that thickness (m) whose middle is the given open surface of flat
/// triangles, in metres: each vertex is moved half the thickness along either normal, farther at folds, so
/// that the faces keep their distance, and the open edges get a rim. Faces may be oriented any way. Throws
/// Error of one line, without a file name, where the surface is closed, where an edge has three or more
/// faces, where the sheet has one side only (a Moebius strip), and where the thickness is not far less than
/// the sheet's extent.
Surface thickened(const Surface& sheet, double thickness);

}  // namespace samara
