#include "samara/kirchhoff/surface_checks.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "samara/base/error.hpp"
#include "samara/body/surface_edges.hpp"

namespace samara {
namespace {

using Triangle = std::array<std::int32_t, 3>;

std::size_t count_repeated(const Surface& surface) {
    std::vector<Triangle> triangles = surface.corners;
    for (Triangle& triangle : triangles) std::sort(triangle.begin(), triangle.end());
    std::sort(triangles.begin(), triangles.end());
    const auto last = std::unique(triangles.begin(), triangles.end());
    return static_cast<std::size_t>(triangles.end() - last);
}

// Of a triangle, over its longest edge's square: a thinner one is a line.
constexpr double least_area = 1e-10;

std::string in_words(const Vector3d& point) {
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", point.x(), point.y(), point.z());
}

}  // namespace

Surface with_merged_vertices(const Surface& surface) {
    Surface result;
    std::map<std::array<double, 3>, std::int32_t> places;
    std::vector<std::int32_t> merged_index(surface.vertices.size(), -1);
    const auto merged = [&](std::int32_t vertex) {
        std::int32_t& index = merged_index[static_cast<std::size_t>(vertex)];
        if (index >= 0) return index;
        const Vector3d& place = surface.vertices[static_cast<std::size_t>(vertex)];
        const auto next = static_cast<std::int32_t>(result.vertices.size());
        const auto [known, is_new] = places.try_emplace({place.x(), place.y(), place.z()}, next);
        if (is_new) result.vertices.push_back(place);
        return index = known->second;
    };
    for (const Triangle& triangle : surface.corners) {
        result.corners.push_back({merged(triangle[0]), merged(triangle[1]), merged(triangle[2])});
    }
    for (const Triangle& nodes : surface.edge_nodes) {
        result.edge_nodes.push_back({merged(nodes[0]), merged(nodes[1]), merged(nodes[2])});
    }
    return result;
}

std::string edge_fault(const Surface& surface) {
    if (const std::size_t repeated = count_repeated(surface); repeated > 0) {
        return fmt::format("{} triangle{} there twice", repeated, repeated == 1 ? " is" : "s are");
    }
    std::size_t open = 0;
    std::size_t flipped = 0;
    std::size_t shared = 0;
    const std::vector<EdgeUse> uses = edge_uses(surface);
    for (const auto& edge : edges_of(uses)) {
        if (edge.size() == 1) ++open;
        if (edge.size() == 2 && edge[0].forward == edge[1].forward) ++flipped;
        const auto forward =
            std::count_if(edge.begin(), edge.end(), [](const EdgeUse& u) { return u.forward; });
        if (edge.size() > 2 && 2 * forward != static_cast<std::ptrdiff_t>(edge.size())) ++shared;
    }
    if (flipped > 0) return fmt::format("{} edges have triangles that face opposite ways", flipped);
    if (open > 0) return fmt::format("it has a hole: {} edges belong to one triangle alone", open);
    if (shared > 0) return fmt::format("{} edges are shared by an odd number of triangles", shared);
    return {};
}

std::string component_fault(const Surface& surface) {
    const std::vector<Component> pieces = components(surface);
    const std::vector<int> depths = nesting_depths(surface, pieces);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Vector3d place =
            triangle_centroid(surface, static_cast<std::size_t>(pieces[i].triangles.front()));
        if (depths[i] > 0) {
            return fmt::format(
                "the closed part at {} lies inside another: a cavity, whose walls no outer fluid touches; "
                "remove "
                "the inner part and give mass, center_of_mass and inertia in the scene",
                in_words(place));
        }
        if (!(enclosed_volume(surface, pieces[i]) > 0.0)) {
            return fmt::format(
                "the {} turned inside out (its volume is negative); mesh the shape again with 'samara mesh'",
                pieces.size() == 1 ? std::string("surface is")
                                   : fmt::format("closed part at {} is", in_words(place)));
        }
    }
    return {};
}

Surface sound_surface(const Surface& surface) {
    for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
        if (surface.vertices[v].allFinite()) continue;
        throw Error(fmt::format("vertex {} is not finite; mesh the shape again with 'samara mesh'", v));
    }
    Surface merged = with_merged_vertices(surface);
    if (merged.triangle_count() < 4) throw Error("the surface has fewer than four triangles; it is no body");
    for (std::size_t t = 0; t < merged.triangle_count(); ++t) {
        const double longest = longest_edge(merged, t);
        if (area_vector(merged, t).norm() > least_area * longest * longest) continue;
        throw Error(fmt::format("triangle {} has no area; mesh the shape again with 'samara mesh'", t));
    }
    if (const std::string fault = edge_fault(merged); !fault.empty()) {
        throw Error(fmt::format(
            "the surface is not closed and outward: {}; mesh the shape again with 'samara mesh'", fault));
    }
    if (const std::string fault = component_fault(merged); !fault.empty()) throw Error(fault);
    return merged;
}

}  // namespace samara
