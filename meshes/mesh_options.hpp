#pragma once

namespace samara {

/// The order of a surface is left to the shape: 2 where it has curved faces, 1 where all are flat.
inline constexpr int automatic_order = 0;

/// How a shape becomes a surface: the options of `samara mesh`.
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
    bool flip = false;              ///< turn every face of a file of triangles round
    double time_limit = 300.0;      ///< s: the most computing that gmsh may do on the file
};

}  // namespace samara
