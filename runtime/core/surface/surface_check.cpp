#include "samara/core/surface/surface_check.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/base/numbers.hpp"
#include "samara/core/surface/curved_surface.hpp"
#include "samara/core/surface/surface_edges.hpp"
#include "samara/core/surface/welded_surface.hpp"

namespace samara {
namespace {

// The height, relative to its longest side, below which a face has no area to rely on: its normal is unknown.
constexpr double flattest_face = 1e-7;

std::string count_of(std::size_t count, const char* one, const char* many) {
    return count == 1 ? fmt::format("1 {}", one) : fmt::format("{} {}", count, many);
}

void require_area(const Surface& surface) {
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        const double longest = longest_edge(surface, t);
        const double height = longest > 0.0 ? 2.0 * area_vector(surface, t).norm() / longest : 0.0;
        if (height <= flattest_face * longest) {
            throw Error(fmt::format("face {} at {} has no area; merge its corners or delete it", t + 1,
                                    place(triangle_centroid(surface, t))));
        }
    }
}

void require_each_face_once(const Surface& surface) {
    std::vector<std::pair<std::array<std::int32_t, 3>, std::size_t>> faces;
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        faces.emplace_back(surface.corners[t], t);
        std::sort(faces.back().first.begin(), faces.back().first.end());
    }
    std::sort(faces.begin(), faces.end());
    for (std::size_t i = 1; i < faces.size(); ++i) {
        if (faces[i].first != faces[i - 1].first) continue;
        throw Error(fmt::format("faces {} and {} at {} are the same; delete one of them",
                                faces[i - 1].second + 1, faces[i].second + 1,
                                place(triangle_centroid(surface, faces[i].second))));
    }
}

// Throws where a face belongs to no closed surface: one on its own, or one that hangs on an edge of a
// complete surface.
void require_no_stray_face(const Surface& surface, const std::vector<std::span<const EdgeUse>>& edges) {
    std::vector<int> open_sides(surface.triangle_count(), 0);
    std::vector<int> crowded_sides(surface.triangle_count(), 0);
    for (const auto& edge : edges) {
        for (const EdgeUse& use : edge) {
            if (edge.size() == 1) ++open_sides[as_index(use.triangle)];
            if (edge.size() > 2) ++crowded_sides[as_index(use.triangle)];
        }
    }
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        const bool alone = open_sides[t] == 3 && surface.triangle_count() > 1;
        const bool hanging = open_sides[t] > 0 && open_sides[t] + crowded_sides[t] == 3;
        if (alone || hanging) {
            throw Error(fmt::format("face {} at {} is not part of the surface: {}; delete it", t + 1,
                                    place(triangle_centroid(surface, t)),
                                    alone ? "it shares no edge with another face"
                                          : "it shares an edge that already has two faces"));
        }
    }
}

void require_two_faces_at_most(const Surface& surface, const std::span<const EdgeUse>& edge) {
    if (edge.size() <= 2) return;
    throw Error(fmt::format(
        "{} faces share the edge from {} to {}; an edge must have two: delete inner faces, or join the parts "
        "into one solid",
        edge.size(), place(vertex(surface, edge.front().low)), place(vertex(surface, edge.front().high))));
}

void require_two_faces_at_each_edge(const Surface& surface,
                                    const std::vector<std::span<const EdgeUse>>& edges) {
    std::size_t open = 0;
    const EdgeUse* first_open = nullptr;
    for (const auto& edge : edges) {
        require_two_faces_at_most(surface, edge);
        if (edge.size() == 1 && open++ == 0) first_open = &edge.front();
    }
    if (open > 0) {
        throw Error(fmt::format(
            "is not closed: {}, the first from {} to {}; fill the hole (in Blender: Mesh > Clean Up > Fill "
            "Holes), or give a sheet a thickness ('samara mesh --thickness', or thickness in a scene)",
            count_of(open, "edge has a face on one side only", "edges have a face on one side only"),
            place(vertex(surface, first_open->low)), place(vertex(surface, first_open->high))));
    }
}

// At a sound vertex one walk from face to face over the edges visits all of its faces.
void require_one_fan_at_each_vertex(const Surface& surface) {
    const auto others = neighbours(surface);
    std::vector<std::int32_t> faces_at(surface.vertices.size(), 0);
    for (const auto& corners : surface.corners) {
        for (const std::int32_t index : corners) ++faces_at[as_index(index)];
    }
    std::vector<char> walked(surface.vertices.size(), 0);
    for (std::size_t start = 0; start < surface.triangle_count(); ++start) {
        for (const std::int32_t centre : surface.corners[start]) {
            if (walked[as_index(centre)] != 0) continue;
            walked[as_index(centre)] = 1;
            std::int32_t count = 0;
            auto current = static_cast<std::int32_t>(start);
            std::int32_t previous = -1;
            do {
                // The two sides at the centre: leave by the one that was not entered by.
                const auto& corners = surface.corners[as_index(current)];
                const auto at = static_cast<std::size_t>(std::find(corners.begin(), corners.end(), centre) -
                                                         corners.begin());
                const std::int32_t one = others[as_index(current)][at];
                const std::int32_t two = others[as_index(current)][(at + 2) % 3];
                const std::int32_t next = one == previous ? two : one;
                previous = current;
                current = next;
                ++count;
            } while (current != static_cast<std::int32_t>(start) && count <= faces_at[as_index(centre)]);
            if (count < faces_at[as_index(centre)]) {
                throw Error(fmt::format(
                    "separate parts of the surface touch at the corner {}; split that corner or move it",
                    place(vertex(surface, centre))));
            }
        }
    }
}

void require_shared_edge_nodes(const Surface& surface, const std::vector<std::span<const EdgeUse>>& edges) {
    if (surface.order() != 2) return;
    const auto node = [&](const EdgeUse& use) {
        return surface.edge_nodes[as_index(use.triangle)][as_index(use.side)];
    };
    for (const auto& edge : edges) {
        if (node(edge[0]) != node(edge[1])) {
            throw Error(fmt::format(
                "there is a gap between the curved faces {} and {} at {}; export the file again",
                edge[0].triangle + 1, edge[1].triangle + 1, place(vertex(surface, node(edge[0])))));
        }
    }
}

void require_curved_faces_to_stay_flat_enough(const Surface& surface) {
    const std::vector<std::int32_t> overturned = overturned_triangles(surface);
    if (overturned.empty()) return;
    const std::int32_t first = overturned.front();
    throw Error(fmt::format("the curved face {} at {} folds over; use more triangles, or order 1", first + 1,
                            place(triangle_centroid(surface, as_index(first)))));
}

void require_faces_to_agree(const Surface& surface, const std::vector<Component>& pieces) {
    std::vector<std::int32_t> reversed;
    for (const Component& piece : pieces) {
        if (2 * piece.against.size() <= piece.triangles.size()) {
            reversed.insert(reversed.end(), piece.against.begin(), piece.against.end());
            continue;
        }
        std::vector<std::int32_t> all = piece.triangles;
        std::vector<std::int32_t> others = piece.against;
        std::sort(all.begin(), all.end());
        std::sort(others.begin(), others.end());
        std::set_difference(all.begin(), all.end(), others.begin(), others.end(),
                            std::back_inserter(reversed));
    }
    if (reversed.empty()) return;
    const std::int32_t first = *std::min_element(reversed.begin(), reversed.end());
    throw Error(
        fmt::format("{} of {} faces {} oriented against the others, the first is face {} at {}; make the "
                    "normals consistent",
                    reversed.size(), surface.triangle_count(), reversed.size() == 1 ? "is" : "are", first + 1,
                    place(triangle_centroid(surface, as_index(first)))));
}

std::string place_of(const Surface& surface, const Component& piece) {
    return place(triangle_centroid(surface, as_index(piece.triangles.front())));
}

void require_matter_inside(const Surface& surface, const std::vector<Component>& pieces) {
    const std::vector<int> depths = nesting_depths(surface, pieces);
    const double size = bounding_box(surface).diagonal().norm();
    std::vector<double> volumes;
    std::size_t outer = 0;
    std::size_t inside_out = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        volumes.push_back(enclosed_volume(surface, pieces[i]));
        if (std::abs(volumes[i]) <= 1e-12 * size * size * size) {
            throw Error(fmt::format("the faces around {} enclose no volume; give the sheet a thickness",
                                    place_of(surface, pieces[i])));
        }
        if (depths[i] > 0) continue;
        ++outer;
        if (volumes[i] < 0.0) ++inside_out;
    }
    if (inside_out == outer) {
        throw Error(
            fmt::format("the surface is inside out: its faces point inwards (volume {:.4g}); flip the "
                        "normals in the modelling program, or of a body with 'samara mesh --flip'",
                        *std::min_element(volumes.begin(), volumes.end())));
    }
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const std::string faces = count_of(pieces[i].triangles.size(), "face", "faces");
        const std::string where = place_of(surface, pieces[i]);
        if (depths[i] > 0 && volumes[i] < 0.0) {
            throw Error(
                fmt::format("the {} around {} enclose a cavity, which the fluid does not reach; delete them, "
                            "and give the body's mass, center_of_mass and inertia in the scene",
                            faces, where));
        }
        if (depths[i] > 0) {
            throw Error(fmt::format("the {} around {} lie inside another part; delete them", faces, where));
        }
        if (volumes[i] < 0.0) {
            throw Error(
                fmt::format("the part of {} around {} is inside out, the others are not; flip its normals",
                            faces, where));
        }
    }
}

}  // namespace

std::string place(const Vector3d& point) {
    return fmt::format("({:.4g}, {:.4g}, {:.4g})", point.x() + 0.0, point.y() + 0.0, point.z() + 0.0);
}

void require_bounding_surface(const Surface& surface) {
    require_area(surface);
    require_each_face_once(surface);
    const std::vector<EdgeUse> uses = edge_uses(surface);
    const auto edges = edges_of(uses);
    require_no_stray_face(surface, edges);
    require_two_faces_at_each_edge(surface, edges);
    require_one_fan_at_each_vertex(surface);
    require_shared_edge_nodes(surface, edges);
    require_curved_faces_to_stay_flat_enough(surface);
    const std::vector<Component> pieces = components(surface);
    require_faces_to_agree(surface, pieces);
    require_matter_inside(surface, pieces);
}

void require_solid_surface(const Surface& surface) {
    const std::vector<EdgeUse> uses = edge_uses(surface);
    const auto edges = edges_of(uses);
    const bool ends =
        std::any_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.size() == 1; });
    if (!ends) return require_bounding_surface(surface);
    require_area(surface);
    require_each_face_once(surface);
    for (const auto& edge : edges) require_two_faces_at_most(surface, edge);
    require_faces_to_agree(surface, components(surface));
}

}  // namespace samara
