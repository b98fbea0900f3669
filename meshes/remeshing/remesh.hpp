#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

#include "samara/core/body/body.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

class MeshSizeField;
class SmoothShape;

/// The value of MeshOptions::order by which the shape decides: 2 where it has curved faces, 1 where all are
/// flat.
inline constexpr int automatic_order = 0;

/// How a shape is meshed: the options of `samara mesh`.
struct MeshOptions {
    enum class Sizing {
        triangles,  ///< about `triangles` triangles
        size,       ///< triangles with sides of about `size` where the body is flat, smaller where it curves
        keep,       ///< the file's own triangles; for geometry gmsh's mesh with the sizes that the file sets
    };
    Sizing sizing = Sizing::triangles;
    int triangles = 1280;
    double size = 0.0;              ///< m, after scaling
    bool as_many_as_needed = true;  ///< more or smaller triangles where these do not hold the shape
    int order = automatic_order;    ///< 1: flat; 2: curved triangles with nodes in the middle of their edges
    double scale = 1.0;             ///< metres for one unit of the file
    double thickness = 0.0;         ///< m: makes an open sheet of triangles a solid; 0: the shape is one
    bool flip = false;              ///< reverse the orientation of every face of a file of triangles
    double time_limit = 300.0;      ///< CPU seconds that gmsh may take for the file
};

/// A surface that was meshed from a shape, and its error.
struct MeshedShape {
    Surface surface;
    ShapeError error;
};

/// Replaces the triangles of a welded and sound surface by new ones, sized as in mesh_geometry: where there
/// are many more than needed they are reduced first (reduced), then remeshed (remeshed) on the smooth shape
/// that the given triangles approximate (SmoothShape), with creases where normals differ by more than 40
/// degrees. The result is compared with the given triangles (miss_of). Where it misses them, further attempts
/// follow: creases at 10 degrees, flat triangles (where the order is automatic), and, where the options allow
/// as many triangles as are needed, more of them, and at last the reduced ones themselves. The smooth shape
/// may have up to 3 % more volume than the facets; the error tells it. `surface` and the result are in
/// metres: options.scale is not used. Throws Error, which proposes a remedy, where no surface is sound or its
/// volume differs by more than 15 %. `progress`: called with the share of the work done, 0 to 1.
MeshedShape remesh(const Surface& surface, const MeshOptions& options, const std::string& label,
                   const std::function<void(double)>& progress = {});

/// Reduces a sound surface of order 1 to about `wanted` triangles, whose vertices are some of the given ones:
/// vertices are collapsed into neighbours where that moves the surface least, until no more than `wanted`
/// triangles are left or no vertex can be removed. Vertices on sharp edges (40 degrees) are moved along these
/// only, and those where several such edges join stay. No normal changes by more than 60 degrees, and the
/// surface keeps its topology. The error measure is the mean square distance from the planes of all the
/// triangles that a vertex has taken over (Garland and Heckbert, Surface Simplification Using Quadric Error
/// Metrics, SIGGRAPH 1997), applied in layers of vertices that are no neighbours, so that a million triangles
/// take seconds.
///
/// meshoptimizer 0.18 is faster, but folds some triangles onto each other and makes others without area in
/// flat places. `progress` is called with the share of the work done, 0 to 1. The result does not depend on
/// the number of threads.
Surface reduced(const Surface& surface, std::size_t wanted, const std::function<void(double)>& progress = {});

/// Remeshes a surface with triangles of the wanted sizes: long sides are split, short ones collapsed, sides
/// flipped to be Delaunay, and vertices moved to the middle of their neighbours and back onto the smooth
/// shape or along its crease, repeatedly. Creases and corners of `start` (normals that differ by more than
/// `crease_angle`, radians) stay. Botsch and Kobbelt, A Remeshing Approach to Multiresolution Modeling, SGP
/// 2004, section 4, with sizes from a field. The sizes are options.size times the field, or scaled for about
/// options.triangles triangles. `start` is sound and of order 1; so is the result, unless the sizes are too
/// coarse for the shape. `progress`: called with the share of the work done, 0 to 1.
Surface remeshed(const Surface& start, const SmoothShape& shape, const MeshSizeField& field,
                 const MeshOptions& options, double crease_angle,
                 const std::function<void(double)>& progress = {});

/// Meshes the body in a file of exact geometry (.geo, .step, .stp, .brep): the surface of its volumes, or all
/// of its surfaces where it has no volume. Faces that two volumes share are left out. A wanted number of
/// triangles is reached within about 5 %, unless the geometry's own edges and corners need more. The result
/// is in metres, welded, checked (require_sound_surface) and oriented outwards; the nodes of order 2 lie on
/// the geometry. The mesh is compared with a finer one of order 2: where it misses the shape (miss_of) and
/// the options allow it, up to 16 times the triangles are tried; a mesh that still misses it is an Error. The
/// unit that STEP files state is applied. Throws Error. `progress`: called with the share of the work done, 0
/// to 1.
MeshedShape mesh_geometry(const std::filesystem::path& file, const MeshOptions& options,
                          const std::function<void(double)>& progress = {});

}  // namespace samara
