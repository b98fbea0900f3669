#include "samara/core/surface/welded_surface.hpp"

#include <algorithm>
#include <limits>
#include <unordered_map>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/base/numbers.hpp"
#include "samara/core/surface/surface_check.hpp"

namespace samara {
namespace {

// The bounds of a body's size, whatever the unit of its file. Within them the integrals of second moments, of
// degree five in the size, stay far from overflow and underflow.
constexpr double largest_coordinate = 1e12;
constexpr double smallest_extent = 1e-12;

// Vertices by the cell of a grid, to find those nearby.
class VertexGrid {
  public:
    VertexGrid(const Vector3d& lowest, double tolerance) : lowest_(lowest), tolerance_(tolerance) {}

    // Returns the index of a kept vertex within the tolerance of the point, or of a new one.
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

    // Cells some times wider than the tolerance: most look-ups then visit a single cell.
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

// Far from the origin the numbers of a file, most often of 32 bits, are too coarse for a small body.
void require_numbers_that_tell_it_apart(const Surface& surface, const Eigen::AlignedBox3d& box) {
    constexpr double coarsest = 1e-4;  // relative to the extent
    const double extent = box.diagonal().norm();
    const double farthest =
        std::max(box.min().lpNorm<Eigen::Infinity>(), box.max().lpNorm<Eigen::Infinity>());
    if (farthest * std::numeric_limits<float>::epsilon() <= coarsest * extent) return;
    const bool single =
        std::all_of(surface.vertices.begin(), surface.vertices.end(),
                    [](const Vector3d& point) { return point == point.cast<float>().cast<double>(); });
    const double apart =
        farthest * (single ? std::numeric_limits<float>::epsilon() : std::numeric_limits<double>::epsilon());
    if (apart <= coarsest * extent) return;
    throw Error(
        fmt::format("lies {:.3g} from the origin, where coordinates{} have a resolution of {:.2g}, {:.2g} of "
                    "its size; move it to the origin before you export it",
                    farthest, single ? " of 32 bits" : "", apart, apart / extent));
}

}  // namespace

void require_usable_numbers(const Surface& surface) {
    if (surface.corners.empty()) {
        throw Error("holds no triangles; export the surface as triangles");
    }
    const auto require = [&](std::size_t t, std::int32_t index) {
        if (index < 0 || as_index(index) >= surface.vertices.size()) {
            throw Error(fmt::format("face {} refers to vertex {} of {}; export the file again", t + 1,
                                    static_cast<std::int64_t>(index) + 1, surface.vertices.size()));
        }
        if (!vertex(surface, index).allFinite()) {
            throw Error(fmt::format("face {} has a corner at {}, which is not finite; export the file again",
                                    t + 1, place(vertex(surface, index))));
        }
        if (vertex(surface, index).lpNorm<Eigen::Infinity>() > largest_coordinate) {
            throw Error(fmt::format(
                "face {} has a corner at {}, farther than {:g} from the origin; export the file again", t + 1,
                place(vertex(surface, index)), largest_coordinate));
        }
    };
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        for (const std::int32_t index : surface.corners[t]) require(t, index);
        if (surface.order() == 2) {
            for (const std::int32_t index : surface.edge_nodes[t]) require(t, index);
        }
    }
}

Eigen::AlignedBox3d bounding_box(const Surface& surface) {
    Eigen::AlignedBox3d box;
    for (const auto& corners : surface.corners) {
        for (const std::int32_t index : corners) box.extend(surface.vertices[as_index(index)]);
    }
    return box;
}

Surface welded(const Surface& surface, double part) {
    require_usable_numbers(surface);
    const Eigen::AlignedBox3d box = bounding_box(surface);
    const double extent = box.diagonal().norm();
    if (extent < smallest_extent) {
        throw Error(fmt::format("all of its points lie within {:g} of each other; export the file again",
                                smallest_extent));
    }
    require_numbers_that_tell_it_apart(surface, box);
    const double tolerance = part * extent;
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

}  // namespace samara
