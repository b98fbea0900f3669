#include "samara/internal/plot/silhouette.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace samara {
namespace {

constexpr double dark_share = 0.42;
constexpr double bright_share = 0.45;

/// The colour under light from 0 (dark side) to 1 (facing the light).
Color lit(const Color& color, double light) {
    const Color dark = dark_share * color;
    const Color bright = color + bright_share * (1.0 - color);
    return dark + light * (bright - dark);
}

/// The triangle with its corners moved outwards from its middle by `distance`.
std::array<Vector2d, 3> grown(const std::array<Vector2d, 3>& corners, double distance) {
    const Vector2d middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    std::array<Vector2d, 3> result = corners;
    for (Vector2d& corner : result) corner += distance * (corner - middle).stableNormalized();
    return result;
}

struct Facing {
    std::array<std::uint32_t, 3> vertices{};
    std::array<Vector2d, 3> corners;
    double depth = 0.0;
    double light = 0.0;
};

std::vector<Facing> facing_triangles(const ShadedMesh& mesh, const ShapePose& pose, const View& view) {
    const Matrix3d rotation = pose.orientation.toRotationMatrix();
    const Vector3d to_light = (-0.5 * view.right + 0.7 * Vector3d::UnitZ() + 0.6 * view.viewer).normalized();
    std::vector<Facing> facing;
    for (const auto& triangle : mesh.triangles) {
        std::array<Vector3d, 3> places;
        Vector3d normal = Vector3d::Zero();
        for (std::size_t i = 0; i < 3; ++i) {
            places[i] = pose.position + rotation * mesh.positions[triangle[i]];
            normal += rotation * mesh.normals[triangle[i]];
        }
        if ((places[1] - places[0]).cross(places[2] - places[0]).dot(view.viewer) <= 0.0) continue;
        Facing one;
        one.vertices = triangle;
        for (std::size_t i = 0; i < 3; ++i) one.corners[i] = view.project(places[i]);
        one.depth = (places[0] + places[1] + places[2]).dot(view.viewer);
        one.light = 0.5 + 0.5 * normal.normalized().dot(to_light);
        facing.push_back(one);
    }
    std::stable_sort(facing.begin(), facing.end(),
                     [](const Facing& a, const Facing& b) { return a.depth < b.depth; });
    return facing;
}

/// Strips of the given width along the outer side of the edges that only one of the triangles has: the
/// outline, and creases, which the triangles painted after it hide.
std::vector<PaintedTriangle> painted_rim(const std::vector<Facing>& facing, double width,
                                         std::uint32_t color) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const Facing& one : facing) {
        for (std::size_t i = 0; i < 3; ++i) edges.emplace(one.vertices[i], one.vertices[(i + 1) % 3]);
    }
    std::vector<PaintedTriangle> rim;
    for (const Facing& one : facing) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t next = (i + 1) % 3;
            if (edges.contains({one.vertices[next], one.vertices[i]})) continue;
            const Vector2d along = width * (one.corners[next] - one.corners[i]).stableNormalized();
            const Vector2d outwards(along.y(), -along.x());
            const Vector2d a = one.corners[i] - 0.5 * along;
            const Vector2d b = one.corners[next] + 0.5 * along;
            rim.push_back({{a - outwards, b - outwards, b + outwards}, color});
            rim.push_back({{a - outwards, b + outwards, a + outwards}, color});
        }
    }
    return rim;
}

Surface merged_over_grid(const Surface& flat, double cell) {
    std::map<std::array<std::int64_t, 3>, std::int32_t> places;
    std::vector<std::int32_t> merged;
    std::vector<double> counts;
    Surface result;
    for (const Vector3d& vertex : flat.vertices) {
        std::array<std::int64_t, 3> key{};
        for (std::size_t i = 0; i < 3; ++i) {
            key[i] = std::llround(vertex[static_cast<Eigen::Index>(i)] / cell);
        }
        const auto [place, is_new] =
            places.try_emplace(key, static_cast<std::int32_t>(result.vertices.size()));
        if (is_new) {
            result.vertices.push_back(Vector3d::Zero());
            counts.push_back(0.0);
        }
        const auto index = static_cast<std::size_t>(place->second);
        result.vertices[index] += vertex;
        counts[index] += 1.0;
        merged.push_back(place->second);
    }
    for (std::size_t i = 0; i < counts.size(); ++i) result.vertices[i] /= counts[i];
    for (const auto& corners : flat.corners) {
        std::array<std::int32_t, 3> triangle{};
        for (std::size_t i = 0; i < 3; ++i) triangle[i] = merged[static_cast<std::size_t>(corners[i])];
        if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0]) {
            result.corners.push_back(triangle);
        }
    }
    return result;
}

}  // namespace

View front_view() {
    return {Vector3d::UnitX(), -Vector3d::UnitY()};
}

View side_view() {
    return {Vector3d::UnitY(), Vector3d::UnitX()};
}

std::uint32_t packed(const Color& color) {
    std::uint32_t result = 0;
    for (const double part : color) {
        result = result << 8U | static_cast<std::uint32_t>(std::lround(255.0 * std::clamp(part, 0.0, 1.0)));
    }
    return result;
}

Color time_color(double share) {
    static const std::array<Color, 9> viridis = {
        Color(0.267, 0.005, 0.329), Color(0.278, 0.176, 0.483), Color(0.231, 0.319, 0.545),
        Color(0.172, 0.449, 0.558), Color(0.128, 0.567, 0.551), Color(0.153, 0.679, 0.507),
        Color(0.361, 0.786, 0.388), Color(0.668, 0.862, 0.196), Color(0.993, 0.906, 0.144)};
    constexpr double used_share = 0.85;
    const double place = std::clamp(share, 0.0, 1.0) * used_share * static_cast<double>(viridis.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const double rest = place - static_cast<double>(below);
    return (1.0 - rest) * viridis[below] + rest * viridis[below + 1];
}

std::vector<PaintedTriangle> painted_silhouette(const ShadedMesh& mesh, const ShapePose& pose,
                                                const View& view, const Color& color, double rim,
                                                double overlap) {
    const std::vector<Facing> facing = facing_triangles(mesh, pose, view);
    std::vector<PaintedTriangle> painted = painted_rim(facing, rim, packed(0.6 * dark_share * color));
    painted.reserve(painted.size() + facing.size());
    for (const Facing& one : facing) {
        painted.push_back({grown(one.corners, overlap), packed(lit(color, one.light))});
    }
    return painted;
}

ShadedMesh subdivided(const ShadedMesh& mesh) {
    ShadedMesh finer;
    finer.positions = mesh.positions;
    finer.normals = mesh.normals;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [place, is_new] =
            middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(finer.positions.size()));
        if (is_new) {
            finer.positions.push_back(0.5 * (mesh.positions[a] + mesh.positions[b]));
            finer.normals.push_back((mesh.normals[a] + mesh.normals[b]).stableNormalized());
        }
        return place->second;
    };
    for (const auto& [a, b, c] : mesh.triangles) {
        const std::uint32_t ab = middle(a, b);
        const std::uint32_t bc = middle(b, c);
        const std::uint32_t ca = middle(c, a);
        finer.triangles.insert(finer.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    return finer;
}

Surface simplified_surface(const Surface& surface, std::size_t triangles) {
    Surface flat = flattened_surface(surface);
    if (flat.triangle_count() <= triangles) return flat;
    Vector3d lowest = flat.vertices.front();
    Vector3d highest = lowest;
    for (const Vector3d& vertex : flat.vertices) {
        lowest = lowest.cwiseMin(vertex);
        highest = highest.cwiseMax(vertex);
    }
    const double extent = (highest - lowest).maxCoeff();
    double cells = 128.0;
    while (cells > 2.0) {
        Surface merged = merged_over_grid(flat, extent / cells);
        if (merged.triangle_count() <= triangles && merged.triangle_count() > 0) return merged;
        cells /= 1.25;
    }
    return flat;
}

}  // namespace samara
