#include "foam-cases/bake/direction_choice.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>

#include "converter/tables/direction_fit.hpp"
#include "converter/tables/direction_sampling.hpp"
#include "samara/core/surface/octahedral_map.hpp"

namespace samara {
namespace {

constexpr int weight_subdivisions = 12;  // nodes every 7.5 degrees

/// Returns the index (row by row) of the node of the map of weights that is nearest to a direction in the
/// map's square.
std::size_t nearest_node(const Vector3d& direction) {
    const OctahedralCell cell = octahedral_cell(weight_subdivisions, direction);
    return unique_node(weight_subdivisions, cell.row + (cell.row_fraction < 0.5 ? 0 : 1),
                       cell.column + (cell.column_fraction < 0.5 ? 0 : 1));
}

/// The required directions, and for every node of the map of weights the index of the one whose image it is.
struct Wedge {
    std::vector<Vector3d> directions;
    std::vector<std::size_t> of_node;
};

Wedge finite_wedge(const Symmetry& symmetry) {
    Wedge wedge{required_directions(symmetry, weight_subdivisions), {}};
    for (const NodeImage& image : node_images(symmetry, weight_subdivisions)) {
        const auto found = std::ranges::find(wedge.directions, image.source);
        wedge.of_node.push_back(static_cast<std::size_t>(found - wedge.directions.begin()));
    }
    return wedge;
}

/// Returns the wedge of a body of revolution or a sphere: nodes belong to the nearest direction by polar
/// angle.
Wedge round_wedge(const Symmetry& symmetry) {
    Wedge wedge{required_directions(symmetry, weight_subdivisions), {}};
    const Vector3d axis = symmetry.axes.transpose() * symmetry.axis;
    const bool mirrored =
        symmetry.type == Symmetry::Type::axial && axial_arc(symmetry, weight_subdivisions).mirrored;
    const auto height = [&](const Vector3d& direction) {
        const double along = direction.dot(axis);
        return mirrored ? std::abs(along) : along;
    };
    for (int row = 0; row <= 2 * weight_subdivisions; ++row) {
        for (int column = 0; column <= 2 * weight_subdivisions; ++column) {
            const double here = height(octahedral_node(weight_subdivisions, row, column));
            const auto nearest = std::ranges::min_element(
                wedge.directions, {},
                [&](const Vector3d& direction) { return std::abs(height(direction) - here); });
            wedge.of_node.push_back(static_cast<std::size_t>(nearest - wedge.directions.begin()));
        }
    }
    return wedge;
}

Wedge wedge_of(const Symmetry& symmetry) {
    return symmetry.type == Symmetry::Type::finite ? finite_wedge(symmetry) : round_wedge(symmetry);
}

}  // namespace

std::vector<WeightedDirection> direction_weights(const std::vector<FlowVisit>& visits,
                                                 const Symmetry& symmetry) {
    const Wedge wedge = wedge_of(symmetry);
    std::vector<double> visited(wedge.directions.size(), 0.0);
    double all = 0.0;
    for (const FlowVisit& visit : visits) {
        const double weight = visit.pressure * visit.pressure;
        visited[wedge.of_node[nearest_node(symmetry.axes.transpose() * visit.direction)]] += weight;
        all += weight;
    }
    std::vector<double> even(wedge.directions.size(), 0.0);
    double nodes = 0.0;
    for (std::size_t node = 0; node < wedge.of_node.size(); ++node) {
        constexpr std::size_t side = 2 * std::size_t{weight_subdivisions} + 1;
        if (unique_node(weight_subdivisions, static_cast<int>(node / side), static_cast<int>(node % side)) !=
            node) {
            continue;
        }
        even[wedge.of_node[node]] += 1.0;
        nodes += 1.0;
    }
    const double part_visited = all > 0.0 ? 1.0 - weight_of_the_unvisited : 0.0;
    std::vector<WeightedDirection> weights;
    for (std::size_t i = 0; i < wedge.directions.size(); ++i) {
        const double of_visits = all > 0.0 ? part_visited * visited[i] / all : 0.0;
        weights.push_back({wedge.directions[i], of_visits + (1.0 - part_visited) * even[i] / nodes});
    }
    return weights;
}

PlannedRegion visited_region(const std::vector<FlowVisit>& visits, const Symmetry& symmetry) {
    PlannedRegion region;
    if (symmetry.type == Symmetry::Type::spherical) return region;
    const Wedge wedge = wedge_of(symmetry);
    std::vector<std::uint8_t> visited(wedge.directions.size(), 0);
    for (const FlowVisit& visit : visits) {
        const OctahedralCell cell =
            octahedral_cell(weight_subdivisions, symmetry.axes.transpose() * visit.direction);
        for (const auto& [down, right] : {std::pair{0, 0}, {0, 1}, {1, 0}, {1, 1}}) {
            visited[wedge.of_node[unique_node(weight_subdivisions, cell.row + down, cell.column + right)]] =
                1;
        }
    }
    region.subdivisions = weight_subdivisions;
    for (const std::size_t place : wedge.of_node) region.planned.push_back(visited[place]);
    return region;
}

void merge(PlannedRegion& region, const PlannedRegion& other) {
    for (std::size_t i = 0; i < region.planned.size(); ++i) region.planned[i] |= other.planned[i];
}

Candidates candidate_directions(const Symmetry& symmetry, std::size_t most) {
    Candidates candidates{1, required_directions(symmetry, 1)};
    for (const int subdivisions : {2, 4, 8}) {
        std::vector<Vector3d> finer = required_directions(symmetry, subdivisions);
        if (finer.size() > most) break;
        candidates = {subdivisions, std::move(finer)};
    }
    return candidates;
}

double mean_squared_spread(const Symmetry& symmetry, const std::vector<Vector3d>& candidates,
                           const std::vector<std::size_t>& chosen,
                           const std::vector<WeightedDirection>& weights) {
    std::vector<Vector3d> directions;
    directions.reserve(chosen.size());
    for (const std::size_t index : chosen) directions.push_back(candidates[index]);
    const DirectionFit fit(symmetry, directions);
    double sum = 0.0;
    for (const WeightedDirection& one : weights) {
        const double spread = fit.spread(one.direction);
        sum += one.weight * spread * spread;
    }
    return sum;
}

std::vector<std::size_t> choose_directions(const Symmetry& symmetry, const std::vector<Vector3d>& candidates,
                                           const std::vector<std::size_t>& chosen,
                                           const std::vector<WeightedDirection>& weights, std::size_t count) {
    std::vector<std::size_t> all = chosen;
    std::vector<std::size_t> more;
    while (more.size() < count) {
        std::optional<std::size_t> best;
        double lowest = std::numeric_limits<double>::infinity();
        for (std::size_t index = 0; index < candidates.size(); ++index) {
            if (std::ranges::find(all, index) != all.end()) continue;
            all.push_back(index);
            const double left = mean_squared_spread(symmetry, candidates, all, weights);
            all.pop_back();
            // Rounding must not decide between equals.
            if (left < lowest * (1.0 - 1e-9)) {
                lowest = left;
                best = index;
            }
        }
        if (!best) break;
        all.push_back(*best);
        more.push_back(*best);
    }
    return more;
}

}  // namespace samara
