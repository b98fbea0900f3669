#include "meshes/surface_check.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <unordered_map>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "meshes/surface_crossing.hpp"
#include "samara/base/error.hpp"
#include "samara/body/curved_surface.hpp"
#include "samara/body/surface_edges.hpp"

namespace samara {
namespace {

// A face whose height is below this part of its longest side has no area to speak of: no normal can be relied
// on.
constexpr double flattest_face = 1e-7;

std::size_t as_index(std::int32_t value) {
    return static_cast<std::size_t>(value);
}

const Vector3d& vertex(const Surface& surface, std::int32_t index) {
    return surface.vertices[as_index(index)];
}

std::string count_of(std::size_t count, const char* one, const char* many) {
    return count == 1 ? fmt::format("1 {}", one) : fmt::format("{} {}", count, many);
}

void require_usable_numbers(const Surface& surface, const std::string& label) {
    if (surface.corners.empty()) {
        throw Error(fmt::format("{}: holds no triangles; export the surface as triangles", label));
    }
    const auto require = [&](std::size_t t, std::int32_t index) {
        if (index < 0 || as_index(index) >= surface.vertices.size()) {
            throw Error(fmt::format("{}: face {} names vertex {} of {}; export the file again", label, t + 1,
                                    static_cast<std::int64_t>(index) + 1, surface.vertices.size()));
        }
        if (!vertex(surface, index).allFinite()) {
            throw Error(
                fmt::format("{}: face {} has a corner at {}, which is not finite; export the file again",
                            label, t + 1, place(vertex(surface, index))));
        }
    };
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        for (const std::int32_t index : surface.corners[t]) require(t, index);
        if (surface.order() == 2) {
            for (const std::int32_t index : surface.edge_nodes[t]) require(t, index);
        }
    }
}

// Vertices by the cell of a grid, to find those nearby.
class VertexGrid {
  public:
    VertexGrid(const Vector3d& lowest, double tolerance) : lowest_(lowest), tolerance_(tolerance) {}

    // The index of a kept vertex within the tolerance of the point, or a new one.
    std::int32_t index_of(const Vector3d& point, std::vector<Vector3d>& kept) {
        const Cell low = cell_of(point - Vector3d::Constant(tolerance_));
        const Cell high = cell_of(point + Vector3d::Constant(tolerance_));
        for (std::int64_t x = low.x(); x <= high.x(); ++x) {
            for (std::int64_t y = low.y(); y <= high.y(); ++y) {
                for (std::int64_t z = low.z(); z <= high.z(); ++z) {
                    const auto found = cells_.find(key({x, y, z}));
                    if (found == cells_.end()) continue;
                    for (const std::int32_t index : found->second) {
                        if ((kept[as_index(index)] - point).norm() <= tolerance_) return index;
                    }
                }
            }
        }
        const auto index = static_cast<std::int32_t>(kept.size());
        kept.push_back(point);
        cells_[key(cell_of(point))].push_back(index);
        return index;
    }

  private:
    using Cell = Eigen::Matrix<std::int64_t, 3, 1>;

    // Cells some times wider than the tolerance: most look-ups then meet a single cell.
    [[nodiscard]] Cell cell_of(const Vector3d& point) const {
        return ((point - lowest_) / (4.0 * tolerance_)).array().floor().matrix().cast<std::int64_t>();
    }
    static std::uint64_t key(const Cell& cell) {
        constexpr std::uint64_t mask = (1U << 21U) - 1U;
        return (static_cast<std::uint64_t>(cell.x()) & mask) << 42U |
               (static_cast<std::uint64_t>(cell.y()) & mask) << 21U |
               (static_cast<std::uint64_t>(cell.z()) & mask);
    }

    Vector3d lowest_;
    double tolerance_;
    std::unordered_map<std::uint64_t, std::vector<std::int32_t>> cells_;
};

Eigen::AlignedBox3d box_of_faces(const Surface& surface) {
    Eigen::AlignedBox3d box;
    for (const auto& corners : surface.corners) {
        for (const std::int32_t index : corners) box.extend(vertex(surface, index));
    }
    return box;
}

void require_area(const Surface& surface, const std::string& label) {
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        double longest = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vector3d side =
                vertex(surface, surface.corners[t][(i + 1) % 3]) - vertex(surface, surface.corners[t][i]);
            longest = std::max(longest, side.norm());
        }
        const double height = longest > 0.0 ? 2.0 * area_vector(surface, t).norm() / longest : 0.0;
        if (height <= flattest_face * longest) {
            throw Error(fmt::format("{}: face {} at {} has no area; merge its corners or delete it", label,
                                    t + 1, place(triangle_centroid(surface, t))));
        }
    }
}

void require_each_face_once(const Surface& surface, const std::string& label) {
    std::vector<std::pair<std::array<std::int32_t, 3>, std::size_t>> faces;
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        faces.emplace_back(surface.corners[t], t);
        std::sort(faces.back().first.begin(), faces.back().first.end());
    }
    std::sort(faces.begin(), faces.end());
    for (std::size_t i = 1; i < faces.size(); ++i) {
        if (faces[i].first != faces[i - 1].first) continue;
        throw Error(fmt::format("{}: faces {} and {} at {} are the same; delete one of them", label,
                                faces[i - 1].second + 1, faces[i].second + 1,
                                place(triangle_centroid(surface, faces[i].second))));
    }
}

// A face that belongs to no closed surface: on its own, or hanging on by one edge of a surface that is
// complete.
void require_no_stray_face(const Surface& surface, const std::vector<std::span<const EdgeUse>>& edges,
                           const std::string& label) {
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
            throw Error(
                fmt::format("{}: face {} at {} is stray: {}; delete it", label, t + 1,
                            place(triangle_centroid(surface, t)),
                            alone ? "it shares no edge with another face"
                                  : "it hangs on the surface by an edge that has its two faces already"));
        }
    }
}

void require_two_faces_at_each_edge(const Surface& surface,
                                    const std::vector<std::span<const EdgeUse>>& edges,
                                    const std::string& label) {
    std::size_t open = 0;
    const EdgeUse* first_open = nullptr;
    for (const auto& edge : edges) {
        const Vector3d& from = vertex(surface, edge.front().low);
        const Vector3d& to = vertex(surface, edge.front().high);
        if (edge.size() > 2) {
            throw Error(fmt::format(
                "{}: {} faces share the edge from {} to {}; a body's surface has two at each edge: "
                "delete inner faces, or join the parts into one solid",
                label, edge.size(), place(from), place(to)));
        }
        if (edge.size() == 1 && open++ == 0) first_open = &edge.front();
    }
    if (open > 0) {
        throw Error(fmt::format(
            "{}: is not closed: {}, the first from {} to {}; fill the hole", label,
            count_of(open, "edge has a face on one side only", "edges have a face on one side only"),
            place(vertex(surface, first_open->low)), place(vertex(surface, first_open->high))));
    }
}

// At a sound vertex one walk from face to face over the edges meets all of its faces.
void require_one_fan_at_each_vertex(const Surface& surface, const std::string& label) {
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
                throw Error(
                    fmt::format("{}: separate sheets of the surface touch in the corner at {}; split that "
                                "corner or move it",
                                label, place(vertex(surface, centre))));
            }
        }
    }
}

void require_shared_edge_nodes(const Surface& surface, const std::vector<std::span<const EdgeUse>>& edges,
                               const std::string& label) {
    if (surface.order() != 2) return;
    const auto node = [&](const EdgeUse& use) {
        return surface.edge_nodes[as_index(use.triangle)][as_index(use.side)];
    };
    for (const auto& edge : edges) {
        if (node(edge[0]) != node(edge[1])) {
            throw Error(fmt::format("{}: the curved faces {} and {} gape at {}; export the file again", label,
                                    edge[0].triangle + 1, edge[1].triangle + 1,
                                    place(vertex(surface, node(edge[0])))));
        }
    }
}

void require_curved_faces_to_stay_flat_enough(const Surface& surface, const std::string& label) {
    const std::vector<std::int32_t> overturned = overturned_triangles(surface);
    if (overturned.empty()) return;
    const std::int32_t first = overturned.front();
    throw Error(fmt::format("{}: the curved face {} at {} turns over; use more triangles, or order 1", label,
                            first + 1, place(triangle_centroid(surface, as_index(first)))));
}

void require_faces_to_agree(const Surface& surface, const std::vector<Component>& pieces,
                            const std::string& label) {
    std::vector<std::int32_t> turned;
    for (const Component& piece : pieces) {
        if (2 * piece.against.size() <= piece.triangles.size()) {
            turned.insert(turned.end(), piece.against.begin(), piece.against.end());
            continue;
        }
        std::vector<std::int32_t> all = piece.triangles;
        std::vector<std::int32_t> others = piece.against;
        std::sort(all.begin(), all.end());
        std::sort(others.begin(), others.end());
        std::set_difference(all.begin(), all.end(), others.begin(), others.end(), std::back_inserter(turned));
    }
    if (turned.empty()) return;
    const std::int32_t first = *std::min_element(turned.begin(), turned.end());
    throw Error(
        fmt::format("{}: {} of {} faces {} turned against the others, the first is face {} at {}; make the "
                    "normals consistent",
                    label, turned.size(), surface.triangle_count(), turned.size() == 1 ? "is" : "are",
                    first + 1, place(triangle_centroid(surface, as_index(first)))));
}

std::string place_of(const Surface& surface, const Component& piece) {
    return place(triangle_centroid(surface, as_index(piece.triangles.front())));
}

void require_matter_inside(const Surface& surface, const std::vector<Component>& pieces,
                           const std::string& label) {
    const std::vector<int> depths = nesting_depths(surface, pieces);
    const double size = box_of_faces(surface).diagonal().norm();
    std::vector<double> volumes;
    std::size_t outer = 0;
    std::size_t inside_out = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        volumes.push_back(enclosed_volume(surface, pieces[i]));
        if (std::abs(volumes[i]) <= 1e-12 * size * size * size) {
            throw Error(fmt::format("{}: the faces around {} enclose no volume; give the sheet its thickness",
                                    label, place_of(surface, pieces[i])));
        }
        if (depths[i] > 0) continue;
        ++outer;
        if (volumes[i] < 0.0) ++inside_out;
    }
    if (inside_out == outer) {
        throw Error(
            fmt::format("{}: the surface is inside out: its faces look inwards (volume {:.4g}); turn them "
                        "round with --flip",
                        label, *std::min_element(volumes.begin(), volumes.end())));
    }
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const std::string faces = count_of(pieces[i].triangles.size(), "face", "faces");
        const std::string where = place_of(surface, pieces[i]);
        if (depths[i] > 0 && volumes[i] < 0.0) {
            throw Error(fmt::format(
                "{}: the {} around {} enclose a cavity, which no outer fluid reaches; delete them, and give "
                "the body's mass, center_of_mass and inertia in the scene",
                label, faces, where));
        }
        if (depths[i] > 0) {
            throw Error(fmt::format("{}: the {} around {} are a body within a body; delete them", label,
                                    faces, where));
        }
        if (volumes[i] < 0.0) {
            throw Error(fmt::format(
                "{}: the piece of {} around {} is inside out, the others are not; turn its normals round",
                label, faces, where));
        }
    }
}

void require_no_crossing(const Surface& surface, const std::string& label) {
    if (const auto crossing = find_crossing(surface)) {
        throw Error(
            fmt::format("{}: the surface passes through itself: faces {} and {} cross at {}; join the parts "
                        "into one solid, "
                        "or where the body is thin use more triangles",
                        label, crossing->first + 1, crossing->second + 1, place(crossing->point)));
    }
}

}  // namespace

std::string place(const Vector3d& point) {
    return fmt::format("({:.4g}, {:.4g}, {:.4g})", point.x() + 0.0, point.y() + 0.0, point.z() + 0.0);
}

Surface welded(const Surface& surface, const std::string& label) {
    require_usable_numbers(surface, label);
    const Eigen::AlignedBox3d box = box_of_faces(surface);
    const double tolerance = welding_tolerance * box.diagonal().norm();
    if (!(tolerance > 0.0))
        throw Error(fmt::format("{}: all of its points coincide; export the file again", label));
    VertexGrid grid(box.min(), tolerance);
    Surface result;
    std::vector<std::int32_t> new_index(surface.vertices.size(), -1);
    const auto weld = [&](std::int32_t index) {
        std::int32_t& kept = new_index[as_index(index)];
        if (kept < 0) kept = grid.index_of(vertex(surface, index), result.vertices);
        return kept;
    };
    for (const auto& corners : surface.corners) {
        result.corners.push_back({weld(corners[0]), weld(corners[1]), weld(corners[2])});
    }
    for (const auto& nodes : surface.edge_nodes) {
        result.edge_nodes.push_back({weld(nodes[0]), weld(nodes[1]), weld(nodes[2])});
    }
    return result;
}

void require_sound_surface(const Surface& surface, const std::string& label) {
    require_area(surface, label);
    require_each_face_once(surface, label);
    const std::vector<EdgeUse> uses = edge_uses(surface);
    const auto edges = edges_of(uses);
    require_no_stray_face(surface, edges, label);
    require_two_faces_at_each_edge(surface, edges, label);
    require_one_fan_at_each_vertex(surface, label);
    require_shared_edge_nodes(surface, edges, label);
    require_curved_faces_to_stay_flat_enough(surface, label);
    const std::vector<Component> pieces = components(surface);
    require_faces_to_agree(surface, pieces, label);
    require_matter_inside(surface, pieces, label);
    require_no_crossing(surface, label);
}

}  // namespace samara
