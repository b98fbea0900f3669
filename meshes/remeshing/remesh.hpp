#pragma once

#include <functional>
#include <string>

#include "meshes/mesh_options.hpp"
#include "samara/core/body/body.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// A surface that was made of a shape, and how far it is from it.
struct MeshedShape {
    Surface surface;
    ShapeError error;
};

/// Covers the welded and sound surface of triangles with new ones, sized as in mesh_geometry: where there are
/// many more than needed they are reduced first (reduced), then remeshed (remeshed) on the smooth shape that
/// the given triangles stand for (SmoothShape). Faces that meet at more than 40 degrees are creased. The
/// result is held against the given triangles (miss_of): where it misses them, the next is tried of creases
/// at 10 degrees, flat triangles (where the order is automatic), and, where options allow as many as are
/// needed, more of them, and at last the reduced ones themselves. The smooth shape may have up to 3 % more
/// volume than the facets, which the error says. `surface` and the result are in metres: options.scale is not
/// used. Throws Error, which proposes a remedy, where no surface is sound, or its volume differs by more than
/// 15 %. `progress`: called with the share of the work done, 0 to 1.
MeshedShape remesh(const Surface& surface, const MeshOptions& options, const std::string& label,
                   const std::function<void(double)>& progress = {});

}  // namespace samara
