#include "meshes/remeshing/remesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "internal/base/labelled.hpp"
#include "internal/body/creases.hpp"
#include "internal/body/curved_surface.hpp"
#include "internal/body/surface_edges.hpp"
#include "internal/body/welded_surface.hpp"
#include "meshes/checks/sound_surface.hpp"
#include "meshes/checks/triangle_tree.hpp"
#include "meshes/checks/volume_moments.hpp"
#include "meshes/remeshing/edge_middle.hpp"
#include "meshes/remeshing/evened_surface.hpp"
#include "meshes/remeshing/mesh_size_field.hpp"
#include "meshes/remeshing/reduced_surface.hpp"
#include "meshes/remeshing/smooth_shape.hpp"
#include "samara/base/error.hpp"

namespace samara {
namespace {

// What a reduced surface may lose, before the new vertices are drawn back onto the shape.
constexpr double most_volume_lost = 0.01;
constexpr double most_distance = 0.01;  // over the body's extent

// The relative change of the volume: coarse chords lose some of a curved body, a lost crease or part more.
double volume_change(const Surface& before, const Surface& after) {
    const double volume = volume_moments(before).volume;
    return std::abs(volume_moments(after).volume - volume) / volume;
}

// The greatest distance of the vertices, or of some 20,000 of them, from the other surface.
double distance_between(const Surface& original, const Surface& other) {
    constexpr std::size_t most_points = 20000;
    const TriangleTree tree(other.vertices, other.corners);
    double squared = 0.0;
    const std::size_t step = 1 + original.vertices.size() / most_points;
    for (std::size_t i = 0; i < original.vertices.size(); i += step) {
        squared = std::max(squared, tree.nearest(original.vertices[i]).squared_distance);
    }
    return std::sqrt(squared);
}

std::size_t wanted_triangles(const Surface& surface, const MeshOptions& options) {
    if (options.sizing == MeshOptions::Sizing::triangles) return static_cast<std::size_t>(options.triangles);
    // Twice the equilateral ones of that size, since curved places and edges get smaller ones.
    const double count = 2.0 * surface_area(surface) / (std::sqrt(3.0) / 4.0 * options.size * options.size);
    return static_cast<std::size_t>(std::min(count, 1e9));
}

bool is_sound(const Surface& surface) {
    try {
        require_sound_surface(surface);
        return true;
    } catch (const Error&) {
        return false;
    }
}

// The surface that meshing starts from: reduced as far as the shape stays.
Surface base_of(const Surface& flat, const MeshOptions& options,
                const std::function<void(double)>& progress) {
    const double extent = bounding_box(flat).diagonal().norm();
    for (std::size_t count = 4000 + 2 * wanted_triangles(flat, options); count < flat.triangle_count();
         count *= 2) {
        Surface base = reduced(flat, count, progress);
        if (volume_change(flat, base) < most_volume_lost &&
            distance_between(flat, base) < most_distance * extent && is_sound(base)) {
            return base;
        }
    }
    return flat;
}

// The surface of order 1 with edge nodes on the shape, where its order asks for them. A triangle that would
// turn over keeps straight edges.
Surface with_nodes_on(const SmoothShape& shape, const Surface& surface, int order) {
    if (order == 1) return surface;
    constexpr double most_bent = 0.3;  // over the edge's length
    Surface result = with_straight_edge_nodes(surface);
    const std::vector<EdgeUse> uses = edge_uses(surface);
    for (const auto& edge : edges_of(uses)) {
        const EdgeUse& use = edge.front();
        const auto triangle = static_cast<std::size_t>(use.triangle);
        const Vector3d first = area_vector(surface, triangle);
        const Vector3d second = area_vector(surface, static_cast<std::size_t>(edge.back().triangle));
        const auto vertex = [&](std::int32_t index) -> const Vector3d& {
            return surface.vertices[static_cast<std::size_t>(index)];
        };
        const auto across = [&](const EdgeUse& one) -> const Vector3d& {
            return vertex(surface.corners[static_cast<std::size_t>(one.triangle)]
                                         [static_cast<std::size_t>(one.side + 2) % 3]);
        };
        const double length = (vertex(use.high) - vertex(use.low)).norm();
        const std::int32_t index = result.edge_nodes[triangle][static_cast<std::size_t>(use.side)];
        Vector3d& node = result.vertices[static_cast<std::size_t>(index)];
        std::optional<Vector3d> moved;
        if (first.dot(second) < std::cos(shape.crease_angle()) * first.norm() * second.norm()) {
            moved = shape.on_crease(node, most_bent * length);
        }
        const auto lifted = [&](const Vector3d& point) { return shape.on_surface(point, first + second); };
        if (!moved) {
            moved = middle_on_surface({vertex(use.low), vertex(use.high)},
                                      {across(edge.front()), across(edge.back())}, lifted);
        }
        if (!moved) moved = lifted(node);
        if (moved && (*moved - node).norm() < most_bent * length) node = *moved;
    }
    straighten_overturned(result);
    return order == automatic_order && has_straight_edges(result) ? surface : result;
}

void require_sound_result(const Surface& surface, const std::string& label) {
    try {
        require_sound_surface(surface);
    } catch (const Error& fault) {
        // The remedies for a file's own faults do not help here.
        const std::string text = fault.what();
        throw Error(fmt::format("{}: {} after remeshing; use more triangles, or --keep", label,
                                text.substr(0, text.rfind("; "))));
    }
}

}  // namespace

Surface remesh(const Surface& surface, const MeshOptions& options, const std::string& label,
               const std::function<void(double)>& progress) {
    constexpr double share_of_reduction = 0.7;
    // Attempts that are made anew do not take the work back.
    double told = 0.0;
    const auto tell = [&](double share) {
        told = std::max(told, share);
        if (progress) progress(told);
    };
    const Surface flat =
        surface.order() == 1 ? surface : labelled(label, [&] { return welded(flattened(surface, 2)); });
    const Surface base = base_of(flat, options, [&](double share) { tell(share_of_reduction * share); });
    const MeshSizeField field(base);
    // Thin bodies with shallow folds need these as edges; on coarse curved ones that would keep every facet.
    constexpr std::array<double, 2> cutting_angles = {sharp_angle, sharp_angle / 4.0};
    // These changes of the volume are in docs/shapes.md: below the one no further attempt is made, above the
    // other it is no longer the shape.
    constexpr double good_change = 0.03;
    constexpr double most_change = 0.15;
    std::optional<Surface> best;
    std::optional<Error> fault;
    double smallest_change = std::numeric_limits<double>::infinity();
    for (const double angle : cutting_angles) {
        try {
            const SmoothShape shape(flat, angle);
            const Surface flat_result = evened(base, shape, field, options, angle, [&](double share) {
                tell(share_of_reduction + (1.0 - share_of_reduction) * share);
            });
            Surface result = with_nodes_on(shape, flat_result, options.order);
            require_sound_result(result, label);
            const double change = volume_change(flat, result);
            // Cut at every shallow fold, a coarse mesh may need many times the triangles that were asked for.
            const bool too_many = options.sizing == MeshOptions::Sizing::triangles && best &&
                                  static_cast<double>(result.triangle_count()) > 1.5 * options.triangles;
            if (change < smallest_change && !too_many) {
                smallest_change = change;
                best = std::move(result);
            }
        } catch (const Error& reason) {
            if (!fault) fault = reason;
        }
        if (smallest_change < good_change) break;
    }
    if (smallest_change > good_change) {
        // Long triangles along a needle or around a rim show the shape where even ones cannot.
        const SmoothShape shape(flat, sharp_angle);
        Surface result = with_nodes_on(shape, reduced(flat, wanted_triangles(flat, options)), options.order);
        const double change = volume_change(flat, result);
        if (change < smallest_change && is_sound(result)) {
            smallest_change = change;
            best = std::move(result);
        }
    }
    if (!best) throw *fault;
    if (smallest_change > most_change) {
        throw Error(fmt::format("{}: remeshing changed the volume by {:.0f} %; use more triangles, or --keep",
                                label, 100.0 * smallest_change));
    }
    return *best;
}

}  // namespace samara
