#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "samara/export/shaded_mesh.hpp"
#include "samara/export/shape_pose.hpp"

namespace samara {

using Eigen::Vector2d;

/// A parallel view of the world with z up, from the front or from the side.
struct View {
    Vector3d right = Vector3d::UnitX();    ///< the world direction that points right in the picture
    Vector3d viewer = -Vector3d::UnitY();  ///< the world direction towards the viewer, right x up

    /// A place in the world (m) in the picture: right, up.
    [[nodiscard]] Vector2d project(const Vector3d& place) const { return {place.dot(right), place.z()}; }
};

/// x to the right: seen from -y.
View front_view();

/// y to the right: seen from +x.
View side_view();

/// A colour by its parts from 0 to 1.
using Color = Eigen::Array3d;

/// The colour as 0xRRGGBB; parts outside 0 to 1 are held at the ends.
std::uint32_t packed(const Color& color);

/// The colour of a share from 0 to 1 of the time shown: the map viridis (van der Walt and Smith 2015) without
/// its pale end, which is lost on white.
Color time_color(double share);

/// A filled triangle of the picture, in metres.
struct PaintedTriangle {
    std::array<Vector2d, 3> corners;
    std::uint32_t color = 0;
};

/// The body at a pose, to be painted in this order: a dark rim, `rim` (m) wide, then the triangles that face
/// the viewer, from back to front, in shades of `color` as lit from the upper left. Triangles overlap their
/// neighbours by `overlap` (m), so that no seams show.
std::vector<PaintedTriangle> painted_silhouette(const ShadedMesh& mesh, const ShapePose& pose,
                                                const View& view, const Color& color, double rim,
                                                double overlap);

/// The mesh with each triangle cut into four, and the normals between: smoother shades on the same shape.
ShadedMesh subdivided(const ShadedMesh& mesh);

/// A surface of the same form with about `triangles` triangles or fewer: vertices are merged over the cells
/// of a grid. For pictures only. The surface as it is, flattened, where it has no more.
Surface simplified_surface(const Surface& surface, std::size_t triangles);

}  // namespace samara
