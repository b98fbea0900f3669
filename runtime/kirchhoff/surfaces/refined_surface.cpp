#include "samara/kirchhoff/surfaces/refined_surface.hpp"

#include "samara/core/surface/curved_surface.hpp"
#include "samara/core/surface/surface_edges.hpp"

namespace samara {
namespace {

using Place = Eigen::Vector2d;  // corner coordinates (u, v) on a triangle

const std::array<Place, 3> corner_places = {Place(0.0, 0.0), Place(1.0, 0.0), Place(0.0, 1.0)};

/// The new vertices of one edge.
struct EdgeCut {
    double part = 0.5;         ///< from the edge's lower vertex
    std::int32_t cut = -1;     ///< where the edge is cut
    std::int32_t at_low = -1;  ///< in the middle between the lower vertex and the cut
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

}  // namespace

CreasedSurface refined(const CreasedSurface& given) {
    return Refinement(given).take();
}

}  // namespace samara
