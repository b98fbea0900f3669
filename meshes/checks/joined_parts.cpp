#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Surface_mesh.h>
#include <Eigen/Geometry>
#include <fmt/format.h>

#include "meshes/checks/sound_surface.hpp"
#include "meshes/checks/triangle_tree.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/base/numbers.hpp"
#include "samara/core/surface/mended_surface.hpp"
#include "samara/core/surface/surface_check.hpp"
#include "samara/core/surface/surface_edges.hpp"
#include "samara/core/surface/welded_surface.hpp"

namespace samara {
namespace {

using Triangle = std::array<std::int32_t, 3>;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactMesh = CGAL::Surface_mesh<Exact::Point_3>;
using Quick = CGAL::Exact_predicates_inexact_constructions_kernel;

constexpr double push = 2.0;  // in units of the welding tolerance: farther than what counts as touching

// Union-find structure (disjoint sets): two numbers are of one set where their `root` is the same.
class DisjointSets {
  public:
    explicit DisjointSets(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    }
    std::size_t root(std::size_t item) {
        while (parent_[item] != item) item = parent_[item] = parent_[parent_[item]];
        return item;
    }
    void unite(std::size_t a, std::size_t b) {
        parent_[std::max(root(a), root(b))] = std::min(root(a), root(b));
    }

  private:
    std::vector<std::size_t> parent_;
};

// Pairs of faces that share an edge within one part. At edges of more than two faces those that stand next to
// each other in the file are paired, since it holds one part after the other. Nothing where an edge does not
// have as many faces in one direction as in the other.
std::optional<std::vector<std::pair<EdgeUse, EdgeUse>>> mates(const Surface& surface) {
    const std::vector<EdgeUse> uses = edge_uses(surface);
    std::vector<std::pair<EdgeUse, EdgeUse>> pairs;
    for (const auto& edge : edges_of(uses)) {
        std::vector<EdgeUse> forward;
        std::vector<EdgeUse> backward;
        for (const EdgeUse& use : edge) (use.forward ? forward : backward).push_back(use);
        if (forward.size() != backward.size()) return std::nullopt;
        for (std::size_t i = 0; i < forward.size(); ++i) pairs.emplace_back(forward[i], backward[i]);
    }
    return pairs;
}

// Returns the closed parts, each with its own vertices; none where the surface is not closed.
std::vector<Surface> parts_of(const Surface& surface) {
    const auto pairs = mates(surface);
    if (!pairs) return {};
    DisjointSets faces(surface.triangle_count());
    DisjointSets corners(3 * surface.triangle_count());
    const auto corner = [](const EdgeUse& use, int next) {
        return 3 * as_index(use.triangle) + as_index((use.side + next) % 3);
    };
    for (const auto& [one, two] : *pairs) {
        faces.unite(as_index(one.triangle), as_index(two.triangle));
        corners.unite(corner(one, 0), corner(two, 1));
        corners.unite(corner(one, 1), corner(two, 0));
    }
    std::vector<Surface> parts;
    std::vector<std::int32_t> part_of(surface.triangle_count(), -1);
    std::vector<std::int32_t> vertex_of(3 * surface.triangle_count(), -1);
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        std::int32_t& part = part_of[faces.root(t)];
        if (part < 0) {
            part = static_cast<std::int32_t>(parts.size());
            parts.emplace_back();
        }
        Surface& its = parts[as_index(part)];
        Triangle triangle{};
        for (std::size_t k = 0; k < 3; ++k) {
            std::int32_t& vertex = vertex_of[corners.root(3 * t + k)];
            if (vertex < 0) {
                vertex = static_cast<std::int32_t>(its.vertices.size());
                its.vertices.push_back(surface.vertices[as_index(surface.corners[t][k])]);
            }
            triangle[k] = vertex;
        }
        its.corners.push_back(triangle);
    }
    return parts;
}

void append(Surface& surface, const Surface& more) {
    const auto first = static_cast<std::int32_t>(surface.vertices.size());
    surface.vertices.insert(surface.vertices.end(), more.vertices.begin(), more.vertices.end());
    for (const auto& [a, b, c] : more.corners) surface.corners.push_back({a + first, b + first, c + first});
}

Eigen::AlignedBox3d grown(Eigen::AlignedBox3d box, double margin) {
    box.min().array() -= margin;
    box.max().array() += margin;
    return box;
}

// Closed parts, and which of them touch each other.
class Parts {
  public:
    Parts(std::vector<Surface> parts, double tolerance)
        : parts_(std::move(parts)), tolerance_(tolerance), trees_(parts_.size()), groups_(parts_.size()) {
        std::vector<std::size_t> order(parts_.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        for (const Surface& part : parts_) boxes_.push_back(grown(bounding_box(part), tolerance));
        std::sort(order.begin(), order.end(),
                  [&](std::size_t a, std::size_t b) { return boxes_[a].min().x() < boxes_[b].min().x(); });
        for (std::size_t i = 0; i < order.size(); ++i) {
            for (std::size_t j = i + 1; j < order.size(); ++j) {
                if (boxes_[order[j]].min().x() > boxes_[order[i]].max().x()) break;
                const auto [one, two] = std::minmax(order[i], order[j]);
                if (boxes_[one].intersects(boxes_[two]) && touch(one, two)) touching_.emplace_back(one, two);
            }
        }
        for (const auto& [one, two] : touching_) groups_.unite(one, two);
    }

    // Returns the numbers of the parts that are connected by contacts, each list in ascending order.
    std::vector<std::vector<std::size_t>> groups() {
        std::map<std::size_t, std::vector<std::size_t>> by_root;
        for (std::size_t i = 0; i < parts_.size(); ++i) by_root[groups_.root(i)].push_back(i);
        std::vector<std::vector<std::size_t>> lists;
        for (auto& [root, list] : by_root) lists.push_back(std::move(list));
        return lists;
    }

    // Moves the sides of each part that lie on an earlier one, back to back, into that by twice the
    // tolerance.
    void push_together() {
        std::vector<std::map<std::int32_t, std::vector<Vector3d>>> facings(parts_.size());
        for (const auto& [one, two] : touching_) {
            visit_near(one, two, [&, &one = one, &two = two](std::size_t t, std::size_t u) {
                const auto base = corners_of(one, t);
                const auto side = corners_of(two, u);
                const Vector3d normal = (base[1] - base[0]).cross(base[2] - base[0]).normalized();
                const bool back_to_back = (side[1] - side[0]).cross(side[2] - side[0]).dot(normal) < 0.0;
                if (!back_to_back || !flush_patch(base, side, tolerance_)) return true;
                for (const std::int32_t vertex : parts_[two].corners[u]) {
                    auto& known = facings[two][vertex];
                    const bool is_new = std::none_of(known.begin(), known.end(), [&](const Vector3d& other) {
                        return other.dot(normal) > 0.99;
                    });
                    if (is_new) known.push_back(normal);
                }
                return true;
            });
        }
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            for (const auto& [vertex, normals] : facings[i]) {
                for (const Vector3d& normal : normals) {
                    parts_[i].vertices[as_index(vertex)] -= push * tolerance_ * normal;
                }
            }
        }
    }

    [[nodiscard]] bool any_touch() const { return !touching_.empty(); }
    [[nodiscard]] double tolerance() const { return tolerance_; }
    [[nodiscard]] const Surface& operator[](std::size_t part) const { return parts_[part]; }

    // Names two parts of the group that touch, with their boxes.
    [[nodiscard]] std::string names_of_two(const std::vector<std::size_t>& group) const {
        const auto pair = std::find_if(touching_.begin(), touching_.end(), [&](const auto& two) {
            return std::find(group.begin(), group.end(), two.first) != group.end();
        });
        const auto name = [&](std::size_t part) {
            const Eigen::AlignedBox3d box = bounding_box(parts_[part]);
            return fmt::format("part {} (from {} to {})", part + 1, place(box.min()), place(box.max()));
        };
        return name(pair->first) + " and " + name(pair->second);
    }

  private:
    const TriangleTree& tree(std::size_t part) {
        if (!trees_[part]) trees_[part].emplace(parts_[part].vertices, parts_[part].corners);
        return *trees_[part];
    }

    [[nodiscard]] std::array<Vector3d, 3> corners_of(std::size_t part, std::size_t t) const {
        const auto& [a, b, c] = parts_[part].corners[t];
        const auto& vertices = parts_[part].vertices;
        return {vertices[as_index(a)], vertices[as_index(b)], vertices[as_index(c)]};
    }

    // Calls visit(t, u) with the triangles of two parts whose boxes lie within the tolerance of each other,
    // until it returns false.
    template <typename Visit>
    void visit_near(std::size_t one, std::size_t two, const Visit& visit) {
        const TriangleTree& its = tree(two);
        const TriangleTree& mine = tree(one);
        bool goes_on = true;
        mine.visit_overlaps(boxes_[two], [&](std::size_t t) {
            its.visit_overlaps(grown(mine.box_of(t), tolerance_), [&](std::size_t u) {
                goes_on = visit(t, u);
                return goes_on;
            });
            return goes_on;
        });
    }

    bool touch(std::size_t one, std::size_t two) {
        const auto as_triangle = [&](std::size_t part, std::size_t t) {
            const auto corners = corners_of(part, t);
            const auto point = [](const Vector3d& p) { return Quick::Point_3(p.x(), p.y(), p.z()); };
            return Quick::Triangle_3(point(corners[0]), point(corners[1]), point(corners[2]));
        };
        bool found = false;
        visit_near(one, two, [&](std::size_t t, std::size_t u) {
            found =
                CGAL::squared_distance(as_triangle(one, t), as_triangle(two, u)) <= tolerance_ * tolerance_;
            return !found;
        });
        return found;
    }

    std::vector<Surface> parts_;
    double tolerance_;
    std::vector<std::optional<TriangleTree>> trees_;
    std::vector<Eigen::AlignedBox3d> boxes_;
    std::vector<std::pair<std::size_t, std::size_t>> touching_;
    DisjointSets groups_;
};

ExactMesh exact(const Surface& surface) {
    ExactMesh mesh;
    std::vector<ExactMesh::Vertex_index> vertices;
    for (const Vector3d& v : surface.vertices) vertices.push_back(mesh.add_vertex({v.x(), v.y(), v.z()}));
    for (const auto& [a, b, c] : surface.corners) {
        mesh.add_face(vertices[as_index(a)], vertices[as_index(b)], vertices[as_index(c)]);
    }
    return mesh;
}

Surface rounded(const ExactMesh& mesh) {
    Surface surface;
    std::vector<std::int32_t> index(mesh.num_vertices() + mesh.number_of_removed_vertices(), -1);
    for (const auto vertex : mesh.vertices()) {
        index[vertex.idx()] = static_cast<std::int32_t>(surface.vertices.size());
        const Exact::Point_3& p = mesh.point(vertex);
        surface.vertices.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
    }
    for (const auto face : mesh.faces()) {
        Triangle corners{};
        std::size_t k = 0;
        for (const auto vertex : CGAL::vertices_around_face(mesh.halfedge(face), mesh)) {
            corners[k++] = index[vertex.idx()];
        }
        surface.corners.push_back(corners);
    }
    return surface;
}

// Returns the union of the parts, joined from the smallest on, so that the time grows little faster than the
// number of triangles; nothing where it is no surface with two faces at each edge.
std::optional<Surface> united(const Parts& parts, const std::vector<std::size_t>& group) {
    using Sized = std::pair<std::size_t, std::size_t>;
    std::vector<ExactMesh> meshes;
    std::priority_queue<Sized, std::vector<Sized>, std::greater<>> waiting;
    for (const std::size_t part : group) {
        waiting.emplace(parts[part].triangle_count(), meshes.size());
        meshes.push_back(exact(parts[part]));
    }
    namespace processing = CGAL::Polygon_mesh_processing;
    while (waiting.size() > 1) {
        const std::size_t one = waiting.top().second;
        waiting.pop();
        const std::size_t two = waiting.top().second;
        waiting.pop();
        ExactMesh both;
        const auto strictly = CGAL::parameters::throw_on_self_intersection(true);
        try {
            if (!processing::corefine_and_compute_union(meshes[one], meshes[two], both, strictly))
                return std::nullopt;
        } catch (const std::exception&) {  // a part intersects itself
            return std::nullopt;
        }
        meshes[one].clear();
        meshes[two] = std::move(both);
        waiting.emplace(meshes[two].number_of_faces(), two);
    }
    return rounded(meshes[waiting.top().second]);
}

// The union of parts, or the reason why it is not the surface of a body.
struct Union {
    Surface surface;
    bool is_sound = false;
    std::string error;  // empty where it is no surface at all, or its faces cross or touch
};

// Joins a group of parts; vertices within `part` of the diagonal are welded.
Union soundly_united(const Parts& parts, const std::vector<std::size_t>& group, double part) {
    Union whole;
    const std::optional<Surface> exact_union = united(parts, group);
    if (!exact_union) return whole;
    try {
        whole.surface = mended(*exact_union, part);
        require_bounding_surface(whole.surface);
    } catch (const Error& error) {
        whole.error = error.what();
        return whole;
    }
    try {
        require_sound_surface(whole.surface);
        // Parts that were just separated may still touch in an edge or a point.
        whole.is_sound = !Parts(parts_of(whole.surface), parts.tolerance()).any_touch();
    } catch (const Error&) {
        // The message would name faces of the union, which are not those of the file.
    }
    return whole;
}

}  // namespace

Surface with_parts_joined(const Surface& surface) {
    if (surface.order() == 2) return surface;
    std::vector<Surface> separate = parts_of(surface);
    if (separate.size() < 2) return surface;
    const double tolerance = welding_tolerance * bounding_box(surface).diagonal().norm();
    Parts parts(std::move(separate), tolerance);
    std::optional<Parts> pushed;
    Surface result;
    bool any = false;
    for (const std::vector<std::size_t>& group : parts.groups()) {
        const bool outwards = std::all_of(group.begin(), group.end(), [&](std::size_t part) {
            return enclosed_volume(parts[part], components(parts[part]).front()) > 0.0;
        });
        if (group.size() == 1 || !outwards) {
            for (const std::size_t part : group) append(result, parts[part]);
            continue;
        }
        Union whole = soundly_united(parts, group, welding_tolerance);
        const std::string error = whole.error;
        if (!whole.is_sound) {
            if (!pushed) pushed.emplace(parts).push_together();
            whole = soundly_united(*pushed, group, 2.0 * push * welding_tolerance);
        }
        if (!whole.is_sound) {
            const std::string names = parts.names_of_two(group);
            if (!error.empty()) throw Error(fmt::format("{} touch or overlap: {}", names, error));
            labelled(names + " touch or overlap", [&] { require_bounding_surface(surface); });
            throw Error(
                fmt::format("{} touch or overlap in a way that samara cannot join, such as in a single edge "
                            "or point; join them into one solid (in Blender: the Boolean modifier, Union), "
                            "or move them apart by more than {:.2g}",
                            names, tolerance));
        }
        append(result, whole.surface);
        any = true;
    }
    return any ? mended(result) : surface;
}

}  // namespace samara
