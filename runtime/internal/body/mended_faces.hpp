#pragma once

#include "samara/body/surface.hpp"

namespace samara {

/// Leaves out triangles with two equal corners, pairs of triangles that lie on each other back to back and
/// close nothing, and vertices that no triangle uses. Takes n log n time where there are any, else n.
void drop_collapsed_faces(Surface& surface);

/// Cuts flat triangles with an open side in two or more where corners of other open sides lie on it, within
/// `tolerance` (m): what looks like a hole there is none. Does nothing where every side has a neighbour.
void split_at_corners_on_sides(Surface& surface, double tolerance);

/// Turns the common side of a flat triangle without area, a corner of which lies on its longest side within
/// `tolerance` (m) and whose other sides have neighbours, and its neighbour across that side: the two of them
/// then have area, and the surface is closed as before.
void flip_faces_without_area(Surface& surface, double tolerance);

}  // namespace samara
