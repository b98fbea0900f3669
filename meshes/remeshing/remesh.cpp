#include "meshes/remeshing/remesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "meshes/checks/shape_error.hpp"
#include "meshes/checks/sound_surface.hpp"
#include "meshes/remeshing/mesh_size_field.hpp"
#include "meshes/remeshing/smooth_shape.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/surface/creases.hpp"
#include "samara/core/surface/curved_surface.hpp"
#include "samara/core/surface/surface_edges.hpp"
#include "samara/core/surface/welded_surface.hpp"

namespace samara {
namespace {

// The smooth shape through coarse facets may have this much more volume; a larger estimate is not trusted.
constexpr double most_faceting = 0.03;
// Where the number of triangles is given, a mesh that changes the volume by more is rejected.
constexpr double most_change = 0.15;
// Triangles whose normals differ by more (radians) lie on each other, unless those of the shape do too.
constexpr double fold = 2.9;

std::size_t wanted_triangles(const Surface& surface, const MeshOptions& options) {
    if (options.sizing == MeshOptions::Sizing::triangles) return static_cast<std::size_t>(options.triangles);
    // Twice the number of equilateral triangles of that size, since curved places and edges get smaller ones.
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

// Returns the surface that meshing starts from: reduced in steps as long as it keeps the shape.
Surface base_of(const Surface& flat, const MeshOptions& options,
                const std::function<void(double)>& progress) {
    constexpr double most_missed = 0.5;
    constexpr std::size_t step = 4;
    const std::size_t wanted = 4000 + 2 * wanted_triangles(flat, options);
    const auto whole = static_cast<double>(flat.triangle_count());
    Surface base = flat;
    Surface last_sound = flat;
    while (base.triangle_count() > wanted) {
        const std::size_t count = std::max(wanted, base.triangle_count() / step);
        const double from = 1.0 - static_cast<double>(base.triangle_count()) / whole;
        const double to = 1.0 - static_cast<double>(count) / whole;
        Surface next = reduced(base, count, [&](double share) { progress(from + share * (to - from)); });
        if (next.triangle_count() >= base.triangle_count() || miss_of(shape_error(flat, next)) > most_missed)
            break;
        base = std::move(next);
        if (is_sound(base)) last_sound = base;
    }
    return last_sound;
}

// Adds edge nodes on the shape to a surface of order 1, where the order asks for them. Where a triangle is
// overturned, its nodes are put over the middles of their edges; where that does not help, its edges stay
// straight.
Surface with_nodes_on(const SmoothShape& shape, const Surface& surface, int order) {
    if (order == 1) return surface;
    constexpr double most_bent = 0.3;  // relative to the edge's length
    Surface result = with_straight_edge_nodes(surface);
    const std::vector<EdgeUse> uses = edge_uses(surface);
    const auto edges = edges_of(uses);
    const auto vertex = [&](std::int32_t index) -> const Vector3d& {
        return surface.vertices[static_cast<std::size_t>(index)];
    };
    const auto across = [&](const EdgeUse& one) -> const Vector3d& {
        return vertex(surface.corners[static_cast<std::size_t>(one.triangle)]
                                     [static_cast<std::size_t>(one.side + 2) % 3]);
    };
    const auto place_node = [&](std::span<const EdgeUse> edge, bool by_normals) {
        const EdgeUse& use = edge.front();
        const auto triangle = static_cast<std::size_t>(use.triangle);
        const Vector3d first = area_vector(surface, triangle);
        const Vector3d second = area_vector(surface, static_cast<std::size_t>(edge.back().triangle));
        const double length = (vertex(use.high) - vertex(use.low)).norm();
        const Vector3d middle = 0.5 * (vertex(use.low) + vertex(use.high));
        std::optional<Vector3d> moved;
        if (first.dot(second) < std::cos(shape.crease_angle()) * first.norm() * second.norm()) {
            moved = shape.on_crease(middle, most_bent * length);
        }
        const auto lifted = [&](const Vector3d& point) { return shape.on_surface(point, first + second); };
        if (!moved && by_normals) {
            moved = middle_on_surface({vertex(use.low), vertex(use.high)},
                                      {across(edge.front()), across(edge.back())}, lifted);
        }
        if (!moved) moved = lifted(middle);
        const bool is_near = moved && (*moved - middle).norm() < most_bent * length;
        const std::int32_t index = result.edge_nodes[triangle][static_cast<std::size_t>(use.side)];
        result.vertices[static_cast<std::size_t>(index)] = is_near ? *moved : middle;
    };
    for (const auto& edge : edges) place_node(edge, true);
    std::vector<bool> overturned(surface.triangle_count(), false);
    for (const std::int32_t t : overturned_triangles(result)) overturned[static_cast<std::size_t>(t)] = true;
    for (const auto& edge : edges) {
        const bool any = std::any_of(edge.begin(), edge.end(), [&](const EdgeUse& use) {
            return overturned[static_cast<std::size_t>(use.triangle)];
        });
        if (any) place_node(edge, false);
    }
    straighten_overturned(result);
    return order == automatic_order && has_straight_edges(result) ? surface : result;
}

// Returns the largest angle (radians) between the normals of two flat triangles at an edge.
double sharpest_angle(const Surface& surface) {
    double sharpest = 0.0;
    const std::vector<EdgeUse> uses = edge_uses(surface);
    for (const auto& edge : edges_of(uses)) {
        const Vector3d one = area_vector(surface, static_cast<std::size_t>(edge.front().triangle));
        const Vector3d two = area_vector(surface, static_cast<std::size_t>(edge.back().triangle));
        sharpest = std::max(sharpest, std::atan2(one.cross(two).norm(), one.dot(two)));
    }
    return sharpest;
}

// Collects attempts to mesh one shape and keeps the best.
class Attempts {
  public:
    Attempts(const Surface& flat, const Smoothing& smoothing, const std::string& label)
        : flat_(flat), smoothing_(smoothing), label_(label), sharpest_angle_(1.01 * sharpest_angle(flat)) {}

    // Whether the surface is sound and keeps the shape; the surface that misses it least is stored.
    bool holds(Surface result) {
        try {
            require_sound_surface(result);
        } catch (const Error& reason) {
            if (error_.empty()) error_ = reason.what();
            return false;
        }
        if (sharpest_angle(result) > std::max(fold, sharpest_angle_)) {
            if (error_.empty()) error_ = "the surface folds onto itself; ";
            return false;
        }
        ShapeError error = shape_error(flat_, result);
        error.faceting = smoothing_.between;
        const double meant = smoothing_.between < most_faceting ? smoothing_.volume : 0.0;
        const double miss = miss_of(error, meant);
        if (miss < smallest_miss_) {
            smallest_miss_ = miss;
            best_ = MeshedShape{std::move(result), error};
        }
        return miss <= 1.0;
    }

    [[nodiscard]] bool any() const { return best_.has_value(); }
    [[nodiscard]] bool any_holds() const { return smallest_miss_ <= 1.0; }
    [[nodiscard]] const MeshedShape& best() const { return *best_; }

    // Returns the error for a shape without a sound mesh. The remedy that the check proposes is dropped,
    // since it is for errors of the file.
    [[nodiscard]] Error unsound(const char* remedy) const {
        return Error(
            fmt::format("{}: {} after remeshing; {}", label_, error_.substr(0, error_.rfind("; ")), remedy));
    }

  private:
    const Surface& flat_;
    Smoothing smoothing_;
    const std::string& label_;
    double sharpest_angle_;
    std::optional<MeshedShape> best_;
    std::string error_;
    double smallest_miss_ = std::numeric_limits<double>::infinity();
};

}  // namespace

MeshedShape remesh(const Surface& surface, const MeshOptions& options, const std::string& label,
                   const std::function<void(double)>& progress) {
    constexpr double share_of_reduction = 0.7;
    // Repeated attempts do not lower the progress.
    double reported = 0.0;
    const auto tell = [&](double share) {
        reported = std::max(reported, share);
        if (progress) progress(reported);
    };
    const Surface flat =
        surface.order() == 1 ? surface : labelled(label, [&] { return welded(flattened(surface, 2)); });
    const Surface base = base_of(flat, options, [&](double share) { tell(share_of_reduction * share); });
    const MeshSizeField field(base);
    Attempts attempts(flat, smoothing_of(flat), label);
    // The second angle is for thin bodies with shallow folds; on coarse curved ones it would keep every
    // facet.
    constexpr std::array<double, 2> crease_angles = {sharp_angle, sharp_angle / 4.0};
    const bool may_be_flat = options.order == automatic_order;
    const auto attempt = [&](int finer) {
        MeshOptions sizes = options;
        sizes.triangles *= finer;
        sizes.size /= std::sqrt(finer);
        std::vector<Surface> flat_results;
        for (const double angle : crease_angles) {
            const SmoothShape shape(flat, angle);
            Surface flat_result = remeshed(base, shape, field, sizes, angle, [&](double share) {
                tell(share_of_reduction + (1.0 - share_of_reduction) * share);
            });
            if (attempts.holds(with_nodes_on(shape, flat_result, options.order))) return true;
            if (may_be_flat) flat_results.push_back(std::move(flat_result));
        }
        // Long triangles along a needle or around a rim resolve the shape where even ones cannot.
        const SmoothShape shape(flat, sharp_angle);
        Surface long_ones = reduced(flat, wanted_triangles(flat, sizes));
        if (attempts.holds(with_nodes_on(shape, long_ones, options.order))) return true;
        if (may_be_flat) flat_results.push_back(std::move(long_ones));
        return std::any_of(flat_results.begin(), flat_results.end(),
                           [&](Surface& result) { return attempts.holds(std::move(result)); });
    };
    constexpr std::array<int, 3> finer = {1, 2, 4};
    for (const int factor : finer) {
        if (attempt(factor) || !options.as_many_as_needed) break;
    }
    if (!attempts.any_holds() && options.as_many_as_needed && may_be_flat) attempts.holds(base);
    const char* remedy = options.order == 2 ? "leave out --order 2, use more triangles, or --keep"
                                            : "use more triangles, or --keep";
    if (!attempts.any()) throw attempts.unsound(remedy);
    const ShapeError& error = attempts.best().error;
    if (std::abs(error.volume) > most_change || (options.as_many_as_needed && !attempts.any_holds())) {
        throw Error(fmt::format(
            "{}: remeshing changed the volume by {:.2g} %, and moved the surface by {:.2g} % of its "
            "size; {}",
            label, 100.0 * error.volume, 100.0 * error.distance, remedy));
    }
    return attempts.best();
}

}  // namespace samara
