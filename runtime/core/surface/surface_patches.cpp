#include "samara/core/surface/surface_patches.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {
namespace {

using Corners = std::array<Vector3d, 3>;

double area_of(const Corners& corners) {
    return 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm();
}

/// A part of the surface with its first moments.
struct Piece {
    std::vector<PatchFace> faces;
    double area = 0.0;
    Vector3d center = Vector3d::Zero();
    double spread = 0.0;                  ///< the largest second moment of area about the centre (m^4)
    Vector3d widest = Vector3d::UnitX();  ///< the direction of that largest moment
};

Piece piece_of(std::vector<PatchFace> faces) {
    Piece piece{std::move(faces)};
    for (const auto& [corners, triangle] : piece.faces) {
        const double area = area_of(corners);
        piece.area += area;
        piece.center += area / 3.0 * (corners[0] + corners[1] + corners[2]);
    }
    if (!(piece.area > 0.0)) return piece;
    piece.center /= piece.area;
    Matrix3d spread = Matrix3d::Zero();
    for (const auto& [corners, triangle] : piece.faces) {
        // The middles of the edges integrate a quadratic function exactly.
        for (std::size_t i = 0; i < 3; ++i) {
            const Vector3d arm = 0.5 * (corners[i] + corners[(i + 1) % 3]) - piece.center;
            spread += area_of(corners) / 3.0 * arm * arm.transpose();
        }
    }
    const PrincipalValues principal = principal_values(spread);
    piece.spread = principal.values[2];
    piece.widest = principal.directions.col(2);
    return piece;
}

/// Adds to `kept` the part of a triangle above, or below, a plane over which its corners have these heights.
/// A part in the plane counts as above.
void clip(const PatchFace& face, const std::array<double, 3>& heights, bool above,
          std::vector<PatchFace>& kept) {
    const Corners& corners = face.corners;
    std::vector<Vector3d> polygon;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t next = (i + 1) % 3;
        if ((heights[i] >= 0.0) == above) polygon.push_back(corners[i]);
        if ((heights[i] >= 0.0) == (heights[next] >= 0.0)) continue;
        const double along = heights[i] / (heights[i] - heights[next]);
        polygon.push_back(corners[i] + along * (corners[next] - corners[i]));
    }
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        kept.push_back({{polygon[0], polygon[i - 1], polygon[i]}, face.triangle});
    }
}

/// Returns the two halves of a piece, cut through its centre across its widest direction.
std::pair<Piece, Piece> halves_of(const Piece& piece) {
    std::vector<PatchFace> above;
    std::vector<PatchFace> below;
    for (const PatchFace& face : piece.faces) {
        std::array<double, 3> heights{};
        for (std::size_t i = 0; i < 3; ++i) heights[i] = piece.widest.dot(face.corners[i] - piece.center);
        clip(face, heights, true, above);
        clip(face, heights, false, below);
    }
    return {piece_of(std::move(above)), piece_of(std::move(below))};
}

}  // namespace

std::vector<SurfacePatch> surface_patches(const Surface& surface, int count) {
    assert(count >= 1 && count <= most_surface_patches);
    std::vector<PatchFace> faces;
    for (std::size_t triangle = 0; triangle < surface.triangle_count(); ++triangle) {
        PatchFace face{{}, triangle};
        for (std::size_t i = 0; i < 3; ++i) {
            face.corners[i] = surface.vertices[static_cast<std::size_t>(surface.corners[triangle][i])];
        }
        faces.push_back(face);
    }
    std::vector<Piece> pieces;
    pieces.push_back(piece_of(std::move(faces)));
    while (pieces.size() < static_cast<std::size_t>(count)) {
        const auto widest = std::ranges::max_element(pieces, {}, &Piece::spread);
        auto [above, below] = halves_of(*widest);
        *widest = std::move(above);
        pieces.push_back(std::move(below));
    }
    double area = 0.0;
    Vector3d center = Vector3d::Zero();
    for (const Piece& piece : pieces) {
        area += piece.area;
        center += piece.area * piece.center;
    }
    center /= area;
    std::vector<SurfacePatch> patches;
    patches.reserve(pieces.size());
    for (Piece& piece : pieces) {
        patches.push_back({piece.center - center, piece.area / area, std::move(piece.faces)});
    }
    return patches;
}

}  // namespace samara
