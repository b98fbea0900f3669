#include "samara/kirchhoff/surfaces/coarsened_surface.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace samara {
namespace {

using Triangle = std::array<std::int32_t, 3>;

constexpr double most_height = 0.5;    // of a removed vertex over the new triangles, in its shortest edges
constexpr double least_cosine = 0.5;   // between a triangle's normals before and after
constexpr double least_quality = 0.1;  // 1: equilateral; or what the triangles had before

/// Triangles about each vertex, kept up to date while vertices are drawn into their neighbours.
class Coarsening {
  public:
    explicit Coarsening(const Surface& surface)
        : vertices_(surface.vertices), triangles_(surface.corners), around_(surface.vertices.size()) {
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            for (const std::int32_t corner : triangles_[t]) around_[index(corner)].push_back(t);
        }
        left_ = triangles_.size();
    }

    [[nodiscard]] std::size_t triangle_count() const { return left_; }

    /// Removes one layer of vertices; false where none could go.
    bool remove_layer() {
        std::vector<bool> locked(vertices_.size(), false);
        bool any = false;
        for (std::size_t v = 0; v < vertices_.size(); ++v) {
            if (locked[v] || around_[v].empty()) continue;
            const std::int32_t target = best_neighbour(v);
            if (target < 0) continue;
            for (const std::int32_t neighbour : neighbours(v)) locked[index(neighbour)] = true;
            draw_into(v, target);
            any = true;
        }
        return any;
    }

    /// The surface that is left; `given_index` becomes the index of each vertex in the given surface.
    [[nodiscard]] Surface result(std::vector<std::size_t>& given_index) const {
        Surface surface;
        given_index.clear();
        std::vector<std::int32_t> new_index(vertices_.size(), -1);
        for (std::size_t v = 0; v < vertices_.size(); ++v) {
            if (around_[v].empty()) continue;
            new_index[v] = static_cast<std::int32_t>(surface.vertices.size());
            surface.vertices.push_back(vertices_[v]);
            given_index.push_back(v);
        }
        for (const Triangle& triangle : triangles_) {
            if (triangle[0] < 0) continue;
            surface.corners.push_back({new_index[index(triangle[0])], new_index[index(triangle[1])],
                                       new_index[index(triangle[2])]});
        }
        return surface;
    }

  private:
    static std::size_t index(std::int32_t value) { return static_cast<std::size_t>(value); }

    /// Whether so many triangles meet, as in the middle of a fan, that trying it takes long.
    [[nodiscard]] bool is_hub(std::size_t v) const { return around_[v].size() > 32; }

    [[nodiscard]] std::set<std::int32_t> neighbours(std::size_t v) const {
        std::set<std::int32_t> result;
        for (const std::size_t t : around_[v]) result.insert(triangles_[t].begin(), triangles_[t].end());
        result.erase(static_cast<std::int32_t>(v));
        return result;
    }

    [[nodiscard]] bool has_corner(std::size_t t, std::int32_t corner) const {
        return std::find(triangles_[t].begin(), triangles_[t].end(), corner) != triangles_[t].end();
    }

    [[nodiscard]] Vector3d area_of(const Triangle& triangle) const {
        const Vector3d& a = vertices_[index(triangle[0])];
        return 0.5 * (vertices_[index(triangle[1])] - a).cross(vertices_[index(triangle[2])] - a);
    }

    [[nodiscard]] double quality_of(const Triangle& triangle) const {
        double squares = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
            squares +=
                (vertices_[index(triangle[i])] - vertices_[index(triangle[(i + 1) % 3])]).squaredNorm();
        }
        return 4.0 * std::sqrt(3.0) * area_of(triangle).norm() / squares;
    }

    /// The neighbour that leaves the best triangles when v is drawn into it, or -1.
    [[nodiscard]] std::int32_t best_neighbour(std::size_t v) const {
        if (is_hub(v)) return -1;
        double worst_before = 1.0;
        for (const std::size_t t : around_[v])
            worst_before = std::min(worst_before, quality_of(triangles_[t]));
        const std::set<std::int32_t> ring = neighbours(v);
        if (ring.size() != around_[v].size()) return -1;
        double best = std::min(least_quality, 0.5 * worst_before);
        std::int32_t choice = -1;
        for (const std::int32_t candidate : ring) {
            if (is_hub(index(candidate))) continue;
            const double quality = quality_after(v, candidate, ring);
            if (quality > best) {
                best = quality;
                choice = candidate;
            }
        }
        return choice;
    }

    /// The worst quality of the triangles after v is drawn into the target, less the height that is lost; -1
    /// where the surface would fold, pinch or lose a crease.
    [[nodiscard]] double quality_after(std::size_t v, std::int32_t target,
                                       const std::set<std::int32_t>& ring) const {
        const std::set<std::int32_t> target_ring = neighbours(index(target));
        const auto shared = std::count_if(ring.begin(), ring.end(),
                                          [&](std::int32_t other) { return target_ring.contains(other); });
        if (shared != 2 || target_ring.size() <= 3) return -1.0;
        const Vector3d step = vertices_[index(target)] - vertices_[v];
        double shortest = step.norm();
        for (const std::int32_t other : ring) {
            shortest = std::min(shortest, (vertices_[index(other)] - vertices_[v]).norm());
        }
        double quality = 1.0;
        double height = 0.0;
        for (const std::size_t t : around_[v]) {
            if (has_corner(t, target)) continue;
            Triangle moved = triangles_[t];
            std::replace(moved.begin(), moved.end(), static_cast<std::int32_t>(v), target);
            const Vector3d normal = area_of(moved).normalized();
            if (!(normal.dot(area_of(triangles_[t]).normalized()) > least_cosine)) return -1.0;
            height = std::max(height, std::abs(normal.dot(step)) / shortest);
            quality = std::min(quality, quality_of(moved));
        }
        return height > most_height ? -1.0 : quality * (1.0 - height);
    }

    void draw_into(std::size_t v, std::int32_t target) {
        for (const std::size_t t : around_[v]) {
            if (has_corner(t, target)) {
                for (const std::int32_t corner : triangles_[t]) {
                    if (index(corner) != v) std::erase(around_[index(corner)], t);
                }
                triangles_[t] = {-1, -1, -1};
                --left_;
            } else {
                std::replace(triangles_[t].begin(), triangles_[t].end(), static_cast<std::int32_t>(v),
                             target);
                around_[index(target)].push_back(t);
            }
        }
        around_[v].clear();
    }

    std::vector<Vector3d> vertices_;
    std::vector<Triangle> triangles_;
    std::vector<std::vector<std::size_t>> around_;
    std::size_t left_ = 0;
};

}  // namespace

CreasedSurface coarsened(const CreasedSurface& given, std::size_t most_triangles) {
    Coarsening coarsening(given.surface);
    while (coarsening.triangle_count() > most_triangles && coarsening.remove_layer()) {
    }
    CreasedSurface result;
    std::vector<std::size_t> given_index;
    result.surface = coarsening.result(given_index);
    result.creases = find_creases(result.surface);
    const std::vector<bool> on_crease = vertices_on_creases(given.surface, given.creases);
    for (std::size_t t = 0; t < result.creases.size(); ++t) {
        for (std::size_t side = 0; side < 3; ++side) {
            for (const std::size_t end : {side, (side + 1) % 3}) {
                const auto vertex = static_cast<std::size_t>(result.surface.corners[t][end]);
                if (!on_crease[given_index[vertex]]) result.creases[t][side] = false;
            }
        }
    }
    return result;
}

}  // namespace samara
