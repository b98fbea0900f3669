#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "meshes/checks/triangle_fans.hpp"
#include "meshes/remeshing/mesh_size_field.hpp"
#include "meshes/remeshing/remesh.hpp"
#include "samara/core/base/numbers.hpp"
#include "samara/core/base/parallel_for.hpp"
#include "samara/core/surface/creases.hpp"

namespace samara {
namespace {

using Triangle = TriangleFans::Triangle;

constexpr double least_collapse_cosine = 0.5;  // between a triangle's normals before and after
constexpr double least_collapse_quality =
    0.15;  // 1: equilateral; or half the least quality before, where that is smaller
// The squared length of a collapse counts with this weight, so that flat places stay resolved with
// well-shaped triangles.
constexpr double weight_of_length = 1e-6;
// One layer removes this share of the vertices, those of the least cost first.
constexpr double share_of_layer = 0.25;
constexpr std::size_t vertices_of_a_piece = 4096;

// The weighted sum over planes of the squared distance of a point.
struct Quadric {
    Matrix3d square = Matrix3d::Zero();
    Vector3d linear = Vector3d::Zero();
    double constant = 0.0;
    double weight = 0.0;

    void add_plane(const Vector3d& normal, const Vector3d& point, double area) {
        const double offset = normal.dot(point);
        square += area * normal * normal.transpose();
        linear -= area * offset * normal;
        constant += area * offset * offset;
        weight += area;
    }
    void add(const Quadric& other) {
        square += other.square;
        linear += other.linear;
        constant += other.constant;
        weight += other.weight;
    }
    // Returns the mean square distance.
    [[nodiscard]] double mean(const Vector3d& point) const {
        return std::max(0.0, (point.dot(square * point) + 2.0 * linear.dot(point) + constant) / weight);
    }
};

class Reduction {
  public:
    explicit Reduction(const Surface& surface) : fans_(surface.vertices, surface.corners) {
        // Coordinates are relative to a vertex and to the body's size, since squares of large numbers would
        // cancel.
        const Vector3d origin = fans_.vertices.front();
        Eigen::AlignedBox3d box;
        for (const Vector3d& vertex : fans_.vertices) box.extend(vertex);
        const double unit = box.diagonal().norm();
        for (Vector3d& vertex : fans_.vertices) vertex = (vertex - origin) / unit;
        quadrics_.resize(fans_.vertices.size());
        for (const Triangle& triangle : fans_.triangles) {
            const Vector3d normal = fans_.area_vector_of(triangle);
            const double area = normal.norm();
            for (const std::int32_t corner : triangle) {
                quadrics_[as_index(corner)].add_plane(normal / area, fans_.vertex(corner), area);
            }
        }
        fans_.gather();
    }

    [[nodiscard]] const std::vector<Triangle>& triangles() const { return fans_.triangles; }

    // Removes one layer of vertices, so that at least `wanted` triangles are left; returns false where none
    // could be removed.
    bool remove_layer(std::size_t wanted) {
        choose_targets();
        std::vector<std::uint32_t> order;
        for (std::size_t v = 0; v < choices_.size(); ++v) {
            if (choices_[v].target >= 0) order.push_back(static_cast<std::uint32_t>(v));
        }
        std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
            return std::pair(choices_[a].cost, a) < std::pair(choices_[b].cost, b);
        });
        const std::size_t before = fans_.triangles.size();
        const auto in_layer =
            1 + static_cast<std::size_t>(share_of_layer * static_cast<double>(before) / 2.0);
        order.resize(std::min(order.size(), in_layer));
        std::size_t left = before;
        for (const std::uint32_t v : order) {
            if (left <= wanted) break;
            const std::int32_t target = choices_[v].target;
            if (fans_.is_locked(static_cast<std::int32_t>(v)) || fans_.is_locked(target)) continue;
            fans_.collapse_into(v, target);
            quadrics_[as_index(target)].add(quadrics_[v]);
            left -= 2;
        }
        fans_.gather();
        return left < before;
    }

  private:
    struct Choice {
        std::int32_t target = -1;
        double cost = std::numeric_limits<double>::infinity();
    };
    using Ring = std::vector<std::int32_t>;

    // The sharp edges at a vertex.
    struct Sharpness {
        int edges = 0;
        std::array<std::int32_t, 2> ends{};  // far ends of the first two
    };

    [[nodiscard]] Sharpness sharpness_at(std::size_t v) const {
        Sharpness sharpness;
        const std::uint32_t* const begin = fans_.begin_around(v);
        const std::uint32_t* const end = fans_.end_around(v);
        const Vector3d first = fans_.area_vector_of(fans_.triangles[*begin]);
        const double least = std::cos(0.5 * sharp_angle);
        const bool smooth = std::all_of(begin + 1, end, [&](std::uint32_t t) {
            const Vector3d other = fans_.area_vector_of(fans_.triangles[t]);
            return first.dot(other) > least * first.norm() * other.norm();
        });
        if (smooth) return sharpness;
        for (const std::uint32_t* t = begin; t != end; ++t) {
            // The edge from v to the next corner, which the other triangle has in the opposite direction.
            const Triangle& triangle = fans_.triangles[*t];
            const auto next_of = [&](const Triangle& corners, std::size_t step) {
                const auto at = std::find(corners.begin(), corners.end(), static_cast<std::int32_t>(v));
                return corners[(static_cast<std::size_t>(at - corners.begin()) + step) % 3];
            };
            const std::int32_t far_end = next_of(triangle, 1);
            const std::uint32_t* other = std::find_if(begin, end, [&](std::uint32_t candidate) {
                return next_of(fans_.triangles[candidate], 2) == far_end;
            });
            const Vector3d one = fans_.area_vector_of(triangle);
            const Vector3d two = fans_.area_vector_of(fans_.triangles[*other]);
            if (one.dot(two) >= std::cos(sharp_angle) * one.norm() * two.norm()) continue;
            if (sharpness.edges < 2) sharpness.ends[static_cast<std::size_t>(sharpness.edges)] = far_end;
            ++sharpness.edges;
        }
        return sharpness;
    }

    void choose_targets() {
        choices_.assign(fans_.vertices.size(), {});
        parallel_for(choices_.size(), vertices_of_a_piece, 0, [&](std::size_t begin, std::size_t end) {
            Ring ring;
            Ring other;
            for (std::size_t v = begin; v < end; ++v) choose_target(v, ring, other);
        });
    }

    // Chooses the neighbour into which v is collapsed at the least cost.
    void choose_target(std::size_t v, Ring& ring, Ring& other) {
        fans_.gather_ring(v, ring);
        if (ring.empty() || fans_.is_hub(v)) return;
        const Sharpness sharpness = sharpness_at(v);
        if (sharpness.edges != 0 && sharpness.edges != 2) return;
        const double least = std::min(least_collapse_quality, 0.5 * fans_.worst_quality(v));
        for (const std::int32_t target : ring) {
            // Along the edge only: across the thin rim of a plate the cost would be low.
            if (sharpness.edges == 2 && target != sharpness.ends[0] && target != sharpness.ends[1]) continue;
            const Vector3d& place = fans_.vertex(target);
            const double cost =
                quadrics_[v].mean(place) + weight_of_length * (place - fans_.vertices[v]).squaredNorm();
            if (cost >= choices_[v].cost || !fans_.keeps_shape(v, target, least_collapse_cosine, least))
                continue;
            fans_.gather_ring(as_index(target), other);
            if (fans_.keeps_topology(ring, other)) choices_[v] = {target, cost};
        }
    }

    TriangleFans fans_;
    std::vector<Quadric> quadrics_;
    std::vector<Choice> choices_;
};

}  // namespace

Surface reduced(const Surface& surface, std::size_t wanted, const std::function<void(double)>& progress) {
    if (surface.triangle_count() <= wanted) return surface;
    Reduction reduction(surface);
    const double whole = static_cast<double>(surface.triangle_count() - wanted);
    while (reduction.triangles().size() > wanted && reduction.remove_layer(wanted)) {
        if (progress) {
            progress(static_cast<double>(surface.triangle_count() - reduction.triangles().size()) / whole);
        }
    }
    Surface result;
    std::vector<std::int32_t> new_index(surface.vertices.size(), -1);
    for (const Triangle& triangle : reduction.triangles()) {
        Triangle& corners = result.corners.emplace_back();
        for (std::size_t i = 0; i < 3; ++i) {
            std::int32_t& index = new_index[as_index(triangle[i])];
            if (index < 0) {
                index = static_cast<std::int32_t>(result.vertices.size());
                result.vertices.push_back(surface.vertices[as_index(triangle[i])]);
            }
            corners[i] = index;
        }
    }
    return result;
}

}  // namespace samara
