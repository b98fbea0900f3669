#include "samara/kirchhoff/surfaces/refinement.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "samara/core/surface/curved_surface.hpp"
#include "samara/core/surface/surface_edges.hpp"

namespace samara {
namespace {

using Place = Eigen::Vector2d;  // corner coordinates (u, v) on a triangle

const std::array<Place, 3> corner_places = {Place(0.0, 0.0), Place(1.0, 0.0), Place(0.0, 1.0)};

/// The new vertices of one edge.
struct EdgeCut {
    double part = 0.5;         ///< share of the edge from its lower vertex to the cut
    std::int32_t cut = -1;     ///< where the edge is cut
    std::int32_t at_low = -1;  ///< vertex midway between the lower vertex and the cut
    std::int32_t at_high = -1;
};

/// An edge cut as one triangle's side sees it.
struct SideCut {
    double part;
    std::int32_t cut;
    std::int32_t at_start;
    std::int32_t at_end;
};

class Refinement {
  public:
    explicit Refinement(const CreasedSurface& given) : given_(given) {
        const Surface& surface = given.surface;
        new_index_.assign(surface.vertices.size(), -1);
        for (const auto& triangle : surface.corners) {
            for (const std::int32_t vertex : triangle) keep(static_cast<std::size_t>(vertex));
        }
        cut_edges();
        for (std::size_t t = 0; t < surface.triangle_count(); ++t) cut_triangle(t);
    }

    CreasedSurface take() { return std::move(result_); }

  private:
    void keep(std::size_t vertex) {
        if (new_index_[vertex] >= 0) return;
        new_index_[vertex] = add(given_.surface.vertices[vertex]);
    }

    std::int32_t add(const Vector3d& point) {
        result_.surface.vertices.push_back(point);
        return static_cast<std::int32_t>(result_.surface.vertices.size()) - 1;
    }

    void cut_edges() {
        const Surface& surface = given_.surface;
        const std::vector<bool> on_crease = vertices_on_creases(surface, given_.creases);
        side_edge_.resize(surface.triangle_count());
        const std::vector<EdgeUse> uses = edge_uses(surface);
        for (const auto& edge : edges_of(uses)) {
            const EdgeUse& use = edge.front();
            const auto triangle = static_cast<std::size_t>(use.triangle);
            const auto side = static_cast<std::size_t>(use.side);
            const bool low = on_crease[static_cast<std::size_t>(use.low)];
            const bool high = on_crease[static_cast<std::size_t>(use.high)];
            EdgeCut cut;
            if (low != high) cut.part = low ? cut_towards_creases : 1.0 - cut_towards_creases;
            const Place& from = corner_places[use.forward ? side : (side + 1) % 3];
            const Place& to = corner_places[use.forward ? (side + 1) % 3 : side];
            const auto at = [&](double part) { return add(point(triangle, from + part * (to - from))); };
            cut.cut = at(cut.part);
            cut.at_low = at(0.5 * cut.part);
            cut.at_high = at(0.5 * (1.0 + cut.part));
            for (const EdgeUse& user : edge) {
                side_edge_[static_cast<std::size_t>(user.triangle)][static_cast<std::size_t>(user.side)] =
                    static_cast<std::int32_t>(cuts_.size());
            }
            cuts_.push_back(cut);
        }
    }

    [[nodiscard]] Vector3d point(std::size_t triangle, const Place& place) const {
        return point_of_triangle(given_.surface, triangle, place.x(), place.y());
    }

    [[nodiscard]] SideCut side_cut(std::size_t triangle, std::size_t side) const {
        const auto& corners = given_.surface.corners[triangle];
        const EdgeCut& cut = cuts_[static_cast<std::size_t>(side_edge_[triangle][side])];
        if (corners[side] < corners[(side + 1) % 3]) return {cut.part, cut.cut, cut.at_low, cut.at_high};
        return {1.0 - cut.part, cut.cut, cut.at_high, cut.at_low};
    }

    void cut_triangle(std::size_t t) {
        std::array<std::int32_t, 3> corner{};
        std::array<SideCut, 3> side{};
        std::array<Place, 3> place;
        for (std::size_t i = 0; i < 3; ++i) {
            corner[i] = new_index_[static_cast<std::size_t>(given_.surface.corners[t][i])];
            side[i] = side_cut(t, i);
            place[i] = corner_places[i] + side[i].part * (corner_places[(i + 1) % 3] - corner_places[i]);
        }
        // inner[i]: between the cuts of sides i and i + 2, across corner i.
        std::array<std::int32_t, 3> inner{};
        for (std::size_t i = 0; i < 3; ++i) inner[i] = add(point(t, 0.5 * (place[i] + place[(i + 2) % 3])));
        const auto& creases = given_.creases[t];
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t last = (i + 2) % 3;
            result_.surface.corners.push_back({corner[i], side[i].cut, side[last].cut});
            result_.surface.edge_nodes.push_back({side[i].at_start, inner[i], side[last].at_end});
            result_.creases.push_back({creases[i], false, creases[last]});
        }
        result_.surface.corners.push_back({side[0].cut, side[1].cut, side[2].cut});
        result_.surface.edge_nodes.push_back({inner[1], inner[2], inner[0]});
        result_.creases.push_back({false, false, false});
    }

    const CreasedSurface& given_;
    CreasedSurface result_;
    std::vector<std::int32_t> new_index_;  // of each given vertex that is a corner
    std::vector<EdgeCut> cuts_;
    std::vector<std::array<std::int32_t, 3>> side_edge_;
};

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

    /// Returns the surface that is left; `given_index` becomes the index of each vertex in the given surface.
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

    /// Returns whether a vertex has so many triangles, as the middle of a fan has, that trying it takes long.
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

    /// Returns the neighbour that leaves the best triangles when v is drawn into it, or -1.
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

    /// Returns the worst quality of the triangles after v is drawn into the target, less the height that is
    /// lost; -1 where the surface would fold, pinch or lose a crease.
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

CreasedSurface refined(const CreasedSurface& given) {
    return Refinement(given).take();
}

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
