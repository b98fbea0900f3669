#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include <Eigen/Geometry>

#include "meshes/checks/triangle_fans.hpp"
#include "meshes/remeshing/mesh_size_field.hpp"
#include "meshes/remeshing/remesh.hpp"
#include "meshes/remeshing/smooth_shape.hpp"
#include "samara/core/base/numbers.hpp"
#include "samara/core/surface/surface_edges.hpp"

namespace samara {
namespace {

// Beyond 4/3 and below 4/5 of the wanted length, a split or a collapse brings sides nearer to it
// (Botsch & Kobbelt, A Remeshing Approach to Multiresolution Modeling, 2004). The other numbers are chosen.
constexpr double longest = 4.0 / 3.0;   // relative to the wanted length: longer sides are split
constexpr double shortest = 4.0 / 5.0;  // shorter ones are collapsed
constexpr double least_cosine = 0.3;    // between a triangle's normals before and after a change
constexpr double least_quality = 0.15;  // 1: equilateral
constexpr double good_count = 0.03;     // relative: nearer to the wanted count needs no further round
constexpr double coarsest = 1.2;  // relative to the size that would give the wanted number without edges
constexpr int least_rounds = 8;
constexpr int most_rounds = 24;
constexpr int most_passes = 12;

class Remeshing {
  public:
    Remeshing(const Surface& start, const SmoothShape& shape, const MeshSizeField& field, double size,
              double crease_angle)
        : fans_(start.vertices, start.corners),
          shape_(shape),
          field_(field),
          size_(size),
          crease_cosine_(std::cos(crease_angle)) {
        measure_sizes();
        refresh();
    }

    // Scales the wanted size, up to `most`: triangles along edges and rims count too, and must not use up the
    // number for the rest.
    void scale_size(double factor, double most) { size_ = std::min(size_ * factor, most); }
    [[nodiscard]] std::size_t triangle_count() const { return fans_.triangles.size(); }

    // Splits long sides, one for each triangle at most; returns whether there were any.
    bool split_long_sides() {
        std::vector<std::pair<double, std::size_t>> order;
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            if (edges_[e].ratio > longest) order.emplace_back(-edges_[e].ratio, e);
        }
        std::sort(order.begin(), order.end());
        std::vector<bool> split(fans_.triangles.size(), false);
        for (const auto& [ratio, e] : order) {
            const Edge& edge = edges_[e];
            if (split[as_index(edge.triangles[0])] || split[as_index(edge.triangles[1])]) continue;
            const auto middle = static_cast<std::int32_t>(fans_.vertices.size());
            fans_.vertices.push_back(middle_for_split(edge));
            sizes_.push_back(0.5 * (sizes_[as_index(edge.a)] + sizes_[as_index(edge.b)]));
            for (std::size_t i = 0; i < 2; ++i) {
                TriangleFans::Triangle& one = fans_.triangles[as_index(edge.triangles[i])];
                TriangleFans::Triangle two = one;
                one[as_index(edge.sides[i] + 1) % 3] = middle;
                two[as_index(edge.sides[i])] = middle;
                fans_.triangles.push_back(two);
                split[as_index(edge.triangles[i])] = true;
            }
        }
        refresh();
        return !order.empty();
    }

    // Collapses short sides that are no neighbours; returns whether there were any.
    bool collapse_short_edges() {
        const std::size_t before = triangle_count();
        std::vector<std::pair<double, std::size_t>> order;
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            if (edges_[e].ratio < shortest) order.emplace_back(edges_[e].ratio, e);
        }
        std::sort(order.begin(), order.end());
        for (const auto& [ratio, e] : order) {
            const Edge& edge = edges_[e];
            if (fans_.is_locked(edge.a) || fans_.is_locked(edge.b)) continue;
            if (can_collapse(edge, edge.a, edge.b)) {
                fans_.collapse_into(as_index(edge.a), edge.b);
            } else if (can_collapse(edge, edge.b, edge.a)) {
                fans_.collapse_into(as_index(edge.b), edge.a);
            }
        }
        refresh();
        return triangle_count() < before;
    }

    void flip_sides() {
        for (const Edge& edge : edges_) {
            if (edge.crease || is_locked(edge) || !should_flip(edge)) continue;
            const auto [c, d] = opposite(edge);
            fans_.triangles[as_index(edge.triangles[0])] = flipped(edge, 0, d);
            fans_.triangles[as_index(edge.triangles[1])] = flipped(edge, 1, c);
            lock_around(edge);
        }
        refresh();
    }

    void relax() {
        for (std::size_t v = 0; v < fans_.vertices.size(); ++v) {
            if (fans_.begin_around(v) == fans_.end_around(v)) continue;
            const std::optional<Vector3d> place = relaxed(v);
            if (!place || !may_move(v, *place)) continue;
            fans_.vertices[v] = *place;
        }
        measure_sizes();
        refresh();
    }

    [[nodiscard]] Surface result() const {
        Surface surface;
        std::vector<std::int32_t> new_index(fans_.vertices.size(), -1);
        for (const TriangleFans::Triangle& triangle : fans_.triangles) {
            auto& corners = surface.corners.emplace_back();
            for (std::size_t i = 0; i < 3; ++i) {
                std::int32_t& index = new_index[as_index(triangle[i])];
                if (index < 0) {
                    index = static_cast<std::int32_t>(surface.vertices.size());
                    surface.vertices.push_back(fans_.vertex(triangle[i]));
                }
                corners[i] = index;
            }
        }
        return surface;
    }

  private:
    struct Edge {
        std::int32_t a = 0;
        std::int32_t b = 0;
        std::array<std::int32_t, 2> triangles{};
        std::array<std::int32_t, 2> sides{};
        bool crease = false;
        double ratio = 1.0;  // length relative to the wanted one
    };
    struct CreaseEnds {
        int count = 0;  // 0: smooth; 2: on a crease; else a corner
        std::array<std::int32_t, 2> others{};
    };

    void measure_sizes() {
        constexpr double moved = 0.05;  // relative to the wanted length: within it the size hardly changes
        const std::size_t known = measured_at_.size();
        sizes_.resize(fans_.vertices.size());
        measured_at_.resize(fans_.vertices.size());
        for (std::size_t v = 0; v < sizes_.size(); ++v) {
            const Vector3d& place = fans_.vertices[v];
            if (v < known && (place - measured_at_[v]).norm() < moved * size_ * sizes_[v]) continue;
            sizes_[v] = field_(place);
            measured_at_[v] = place;
        }
    }

    void refresh() {
        fans_.gather();
        Surface surface;
        surface.corners = fans_.triangles;
        const std::vector<EdgeUse> uses = edge_uses(surface);
        edges_.clear();
        creases_.assign(fans_.vertices.size(), {});
        for (const auto& uses_of_edge : edges_of(uses)) {
            const EdgeUse& one = uses_of_edge.front();
            const EdgeUse& two = uses_of_edge.back();
            Edge edge{one.low, one.high, {one.triangle, two.triangle}, {one.side, two.side}, false, 1.0};
            const Vector3d first = fans_.area_vector_of(fans_.triangles[as_index(one.triangle)]);
            const Vector3d second = fans_.area_vector_of(fans_.triangles[as_index(two.triangle)]);
            const Vector3d along = fans_.vertex(one.high) - fans_.vertex(one.low);
            // The normals of slivers of a reduced surface may differ as much where the shape is smooth.
            edge.crease = first.dot(second) < crease_cosine_ * first.norm() * second.norm() &&
                          shape_.is_near_crease(fans_.vertex(one.low) + 0.5 * along, 0.3 * along.norm());
            edge.ratio =
                along.norm() / (0.5 * size_ * (sizes_[as_index(one.low)] + sizes_[as_index(one.high)]));
            if (edge.crease) {
                add_crease(edge.a, edge.b);
                add_crease(edge.b, edge.a);
            }
            edges_.push_back(edge);
        }
    }

    void add_crease(std::int32_t from, std::int32_t to) {
        CreaseEnds& ends = creases_[as_index(from)];
        if (ends.count < 2) ends.others[as_index(ends.count)] = to;
        ++ends.count;
    }

    // Returns the middle of the edge, moved onto the shape.
    [[nodiscard]] Vector3d middle_of(const Edge& edge) const {
        constexpr double most_bent = 0.3;  // relative to the edge's length
        const Vector3d along = fans_.vertex(edge.b) - fans_.vertex(edge.a);
        const Vector3d middle = fans_.vertex(edge.a) + 0.5 * along;
        std::optional<Vector3d> place;
        if (edge.crease) place = shape_.on_crease(middle, most_bent * along.norm());
        if (!place) {
            Vector3d normal = Vector3d::Zero();
            for (const std::int32_t t : edge.triangles) {
                normal += fans_.area_vector_of(fans_.triangles[as_index(t)]);
            }
            place = shape_.on_surface(middle, normal);
        }
        return place && (*place - middle).norm() < most_bent * along.norm() ? *place : middle;
    }

    // Returns the middle on the shape, or that of the straight edge where half a triangle would be
    // overturned.
    [[nodiscard]] Vector3d middle_for_split(const Edge& edge) const {
        const Vector3d middle = middle_of(edge);
        for (std::size_t i = 0; i < 2; ++i) {
            const TriangleFans::Triangle& triangle = fans_.triangles[as_index(edge.triangles[i])];
            const Vector3d before = fans_.area_vector_of(triangle);
            const Vector3d& start = fans_.vertex(triangle[as_index(edge.sides[i])]);
            const Vector3d& end = fans_.vertex(triangle[as_index(edge.sides[i] + 1) % 3]);
            const Vector3d& across = fans_.vertex(triangle[as_index(edge.sides[i] + 2) % 3]);
            for (const Vector3d& after : {Vector3d((middle - start).cross(across - start)),
                                          Vector3d((end - middle).cross(across - middle))}) {
                if (!(before.dot(after) > least_cosine * before.norm() * after.norm())) {
                    return 0.5 * (fans_.vertex(edge.a) + fans_.vertex(edge.b));
                }
            }
        }
        return middle;
    }

    // Whether the vertex lies on a crease that continues through it.
    [[nodiscard]] bool is_along_crease(std::size_t v) const {
        const CreaseEnds& ends = creases_[v];
        if (ends.count != 2) return false;
        const Vector3d before = fans_.vertices[v] - fans_.vertex(ends.others[0]);
        const Vector3d after = fans_.vertex(ends.others[1]) - fans_.vertices[v];
        return before.dot(after) > crease_cosine_ * before.norm() * after.norm();
    }

    [[nodiscard]] bool can_collapse(const Edge& edge, std::int32_t v, std::int32_t target) {
        const std::size_t from = as_index(v);
        if (fans_.is_hub(from)) return false;
        if (creases_[from].count > 0 && (!edge.crease || !is_along_crease(from))) return false;
        fans_.gather_ring(from, ring_);
        fans_.gather_ring(as_index(target), other_);
        if (!fans_.keeps_topology(ring_, other_)) return false;
        for (const std::int32_t vertex : ring_) {
            if (vertex == target) continue;
            const double length = (fans_.vertex(vertex) - fans_.vertex(target)).norm();
            const double wanted = 0.5 * size_ * (sizes_[as_index(vertex)] + sizes_[as_index(target)]);
            if (length > longest * wanted) return false;
        }
        // The triangles of a thin rim may become longer slivers.
        const double of_worst = edge.crease ? 0.25 : 1.0;
        return fans_.keeps_shape(from, target, least_cosine,
                                 std::min(least_quality, of_worst * fans_.worst_quality(from)));
    }

    [[nodiscard]] std::pair<std::int32_t, std::int32_t> opposite(const Edge& edge) const {
        const auto corner = [&](std::size_t i) {
            return fans_.triangles[as_index(edge.triangles[i])][as_index(edge.sides[i] + 2) % 3];
        };
        return {corner(0), corner(1)};
    }

    // Returns triangle i of the edge with an end of the edge replaced by the other triangle's tip.
    [[nodiscard]] TriangleFans::Triangle flipped(const Edge& edge, std::size_t i, std::int32_t tip) const {
        TriangleFans::Triangle triangle = fans_.triangles[as_index(edge.triangles[i])];
        triangle[as_index(edge.sides[i] + 1) % 3] = tip;
        return triangle;
    }

    [[nodiscard]] bool should_flip(const Edge& edge) {
        const auto [c, d] = opposite(edge);
        const auto angle_at = [&](std::int32_t tip) {
            const Vector3d one = fans_.vertex(edge.a) - fans_.vertex(tip);
            const Vector3d two = fans_.vertex(edge.b) - fans_.vertex(tip);
            return std::atan2(one.cross(two).norm(), one.dot(two));
        };
        if (angle_at(c) + angle_at(d) < std::numbers::pi + 0.01) return false;
        fans_.gather_ring(as_index(c), ring_);
        if (std::find(ring_.begin(), ring_.end(), d) != ring_.end()) return false;
        for (const std::int32_t end : {edge.a, edge.b}) {
            if (fans_.end_around(as_index(end)) - fans_.begin_around(as_index(end)) <= 3) return false;
        }
        const Vector3d one = fans_.area_vector_of(flipped(edge, 0, d));
        const Vector3d two = fans_.area_vector_of(flipped(edge, 1, c));
        for (const std::int32_t t : edge.triangles) {
            const Vector3d before = fans_.area_vector_of(fans_.triangles[as_index(t)]);
            for (const Vector3d& after : {one, two}) {
                if (!(before.dot(after) > least_cosine * before.norm() * after.norm())) return false;
            }
        }
        return true;
    }

    [[nodiscard]] std::optional<Vector3d> relaxed(std::size_t v) const {
        constexpr double share = 0.7;
        const Vector3d& here = fans_.vertices[v];
        if (creases_[v].count > 0) {
            if (!is_along_crease(v)) return std::nullopt;
            const Vector3d& one = fans_.vertex(creases_[v].others[0]);
            const Vector3d& two = fans_.vertex(creases_[v].others[1]);
            const Vector3d place = here + share * (0.5 * (one + two) - here);
            if (auto found = shape_.on_crease(place, 0.25 * (two - one).norm())) return found;
        }
        Vector3d middle = Vector3d::Zero();
        Vector3d normal = Vector3d::Zero();
        double weight = 0.0;
        for (const std::uint32_t* t = fans_.begin_around(v); t != fans_.end_around(v); ++t) {
            const TriangleFans::Triangle& triangle = fans_.triangles[*t];
            const Vector3d area = fans_.area_vector_of(triangle);
            double size = 0.0;
            Vector3d centroid = Vector3d::Zero();
            for (const std::int32_t corner : triangle) {
                size += sizes_[as_index(corner)] / 3.0;
                centroid += fans_.vertex(corner) / 3.0;
            }
            // Weights by the density whose centroidal Voronoi cells have the wanted sizes.
            const double mass = area.norm() / (size * size * size * size);
            middle += mass * centroid;
            normal += area;
            weight += mass;
        }
        const bool smooth = creases_[v].count == 0;
        return shape_.on_surface(smooth ? Vector3d(here + share * (middle / weight - here)) : here, normal);
    }

    [[nodiscard]] bool may_move(std::size_t v, const Vector3d& place) {
        const Vector3d old = fans_.vertices[v];
        for (const std::uint32_t* t = fans_.begin_around(v); t != fans_.end_around(v); ++t) {
            const TriangleFans::Triangle& triangle = fans_.triangles[*t];
            const Vector3d before = fans_.area_vector_of(triangle);
            fans_.vertices[v] = place;
            const Vector3d after = fans_.area_vector_of(triangle);
            fans_.vertices[v] = old;
            if (!(before.dot(after) > least_cosine * before.norm() * after.norm())) return false;
            if (after.norm() < 0.1 * before.norm()) return false;
        }
        return true;
    }

    [[nodiscard]] bool is_locked(const Edge& edge) const {
        const auto [c, d] = opposite(edge);
        return fans_.is_locked(edge.a) || fans_.is_locked(edge.b) || fans_.is_locked(c) || fans_.is_locked(d);
    }
    // Vertices added since the last gather have no lock yet.
    void lock_around(const Edge& edge) {
        for (const std::int32_t t : edge.triangles) {
            for (const std::int32_t corner : fans_.triangles[as_index(t)]) {
                if (as_index(corner) < creases_.size()) fans_.lock(corner);
            }
        }
        fans_.lock(edge.a);
        fans_.lock(edge.b);
    }

    TriangleFans fans_;
    const SmoothShape& shape_;
    const MeshSizeField& field_;
    double size_;
    double crease_cosine_;
    std::vector<double> sizes_;  // relative size at each vertex
    std::vector<Vector3d> measured_at_;
    std::vector<Edge> edges_;
    std::vector<CreaseEnds> creases_;
    std::vector<std::int32_t> ring_;
    std::vector<std::int32_t> other_;
};

}  // namespace

Surface remeshed(const Surface& start, const SmoothShape& shape, const MeshSizeField& field,
                 const MeshOptions& options, double crease_angle,
                 const std::function<void(double)>& progress) {
    const bool by_count = options.sizing == MeshOptions::Sizing::triangles;
    const double size =
        by_count ? std::sqrt(1.1 * field.triangle_count(1.0) / options.triangles) : options.size;
    const double most_size =
        options.as_many_as_needed ? coarsest * size : std::numeric_limits<double>::infinity();
    Remeshing remeshing(start, shape, field, size, crease_angle);
    for (int round = 0; round < most_rounds; ++round) {
        const double ratio = static_cast<double>(remeshing.triangle_count()) / options.triangles;
        const bool good = !by_count || std::abs(ratio - 1.0) < good_count;
        if (round >= least_rounds && good) break;
        if (by_count && round >= 2) remeshing.scale_size(std::pow(ratio, round < 8 ? 0.5 : 0.25), most_size);
        for (int pass = 0; pass < most_passes && remeshing.split_long_sides(); ++pass) {
        }
        for (int pass = 0; pass < most_passes && remeshing.collapse_short_edges(); ++pass) {
        }
        remeshing.flip_sides();
        remeshing.relax();
        if (progress) progress((round + 1.0) / most_rounds);
    }
    remeshing.flip_sides();
    return remeshing.result();
}

}  // namespace samara
