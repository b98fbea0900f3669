#include "samara/kirchhoff/panels.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "samara/base/error.hpp"

namespace samara {
namespace {

Panel make_panel(const std::vector<Vector3d>& vertices, const std::array<std::int32_t, 3>& corners) {
    const auto corner = [&](std::size_t i) { return vertices[static_cast<std::size_t>(corners[i])]; };
    Panel panel;
    panel.corners = corners;
    panel.centroid = (corner(0) + corner(1) + corner(2)) / 3.0;
    const Vector3d twice_area = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    panel.area = 0.5 * twice_area.norm();
    panel.normal = twice_area.normalized();
    panel.radius = 0.0;
    panel.second_moment.setZero();
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector3d arm = corner(i) - panel.centroid;
        panel.radius = std::max(panel.radius, arm.norm());
        panel.second_moment += arm * arm.transpose() / 12.0;
    }
    return panel;
}

/// The midpoints of straight edges, each made once.
class Midpoints {
  public:
    explicit Midpoints(std::vector<Vector3d>& vertices) : vertices_(vertices) {}

    std::int32_t between(std::int32_t a, std::int32_t b) {
        const auto [place, is_new] =
            known_.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(vertices_.size()));
        if (is_new) {
            const Vector3d middle =
                0.5 * (vertices_[static_cast<std::size_t>(a)] + vertices_[static_cast<std::size_t>(b)]);
            vertices_.push_back(middle);
        }
        return place->second;
    }

  private:
    std::vector<Vector3d>& vertices_;
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> known_;
};

}  // namespace

Panels make_panels(const Surface& surface, const Vector3d& reference_point, double length) {
    Panels result;
    result.length = length;
    result.vertices.reserve(surface.vertices.size());
    for (const Vector3d& vertex : surface.vertices) {
        result.vertices.push_back((vertex - reference_point) / length);
    }
    result.panels.reserve(surface.triangle_count());
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        const Panel panel = make_panel(result.vertices, surface.corners[t]);
        // Also false where a coordinate is not a number.
        if (!(panel.area > 1e-12 * panel.radius * panel.radius)) {
            throw Error(fmt::format(
                "triangle {} has no area or is not finite; mesh the shape again with 'samara mesh'", t));
        }
        result.panels.push_back(panel);
    }
    return result;
}

Surface subdivided(const Surface& surface) {
    Surface fine;
    fine.vertices = surface.vertices;
    Midpoints midpoints(fine.vertices);
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        const auto& [a, b, c] = surface.corners[t];
        const std::array<std::int32_t, 3> middle =
            surface.order() == 2
                ? surface.edge_nodes[t]
                : std::array{midpoints.between(a, b), midpoints.between(b, c), midpoints.between(c, a)};
        const auto& [ab, bc, ca] = middle;
        fine.corners.push_back({a, ab, ca});
        fine.corners.push_back({ab, b, bc});
        fine.corners.push_back({ca, bc, c});
        fine.corners.push_back({ab, bc, ca});
    }
    return fine;
}

}  // namespace samara
