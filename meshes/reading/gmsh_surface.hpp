#pragma once

#include <string>
#include <vector>

#include "samara/core/surface/surface.hpp"

namespace samara {

/// The surface elements of the model in the current GmshSession: of the surfaces with the given tags, or of
/// all where none are given. Quadrangles are cut in two. Throws Error, named with `label`, for other elements
/// than triangles of order 1 or 2 and quadrangles of order 1.
Surface surface_of_model(const std::string& label, const std::vector<int>& surface_tags = {});

/// surface_of_model of a mesh of order 1, with a node in the middle of each edge: the point of the geometry,
/// curve or surface, that is nearest to the middle of the straight edge. Faster than gmsh's own, which takes
/// 10 s for 1280 triangles on a NURBS ellipsoid.
Surface curved_surface_of_model(const std::string& label, const std::vector<int>& surface_tags);

}  // namespace samara
