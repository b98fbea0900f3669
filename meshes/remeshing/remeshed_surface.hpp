#pragma once

#include <functional>

#include "meshes/mesh_options.hpp"
#include "meshes/remeshing/mesh_size_field.hpp"
#include "meshes/remeshing/smooth_shape.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// The shape of a surface in triangles of the wanted sizes: long sides are split, vertices at the end of
/// short ones drawn together, sides flipped to be Delaunay, and vertices moved to the middle of their
/// neighbours and back onto the smooth shape or along its crease, in turns. Creases and corners of `start`
/// (turns of more than `crease_angle`, radians) stay. Botsch and Kobbelt, A Remeshing Approach to
/// Multiresolution Modeling, SGP 2004, section 4, with sizes from a field. The sizes are options.size times
/// the field, or what it takes for about options.triangles triangles. `start` is sound and of order 1; so,
/// unless the sizes are too coarse for the shape, is the result. `progress`: called with the share of the
/// work done, 0 to 1.
Surface remeshed(const Surface& start, const SmoothShape& shape, const MeshSizeField& field,
                 const MeshOptions& options, double crease_angle,
                 const std::function<void(double)>& progress = {});

}  // namespace samara
