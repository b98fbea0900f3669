#include "foam-cases/bake/direction_choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Cholesky>

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

/// A quantity that walks at random over the sphere, known in some directions: the square of its change has
/// the mean of the chord, and its mean value is uncertain by the change between opposite ends (covariance 2 -
/// r). What is left of its variance is the mean squared error of the best weighted sum of the known values.
class RandomWalk {
  public:
    /// Constructs the walk at the images of the candidates under a finite symmetry and in the weighted
    /// directions, known nowhere.
    RandomWalk(const Symmetry& symmetry, const std::vector<Vector3d>& candidates,
               const std::vector<WeightedDirection>& weights)
        : weights_(static_cast<Eigen::Index>(weights.size())) {
        std::vector<Vector3d> places;
        for (const Vector3d& candidate : candidates) {
            const auto first = static_cast<std::ptrdiff_t>(places.size());
            for (const Matrix3d& element : elements_in_map_axes(symmetry)) {
                const Vector3d image = element * candidate;
                const auto same = [&](const Vector3d& other) {
                    return (other - image).norm() < direction_tolerance(symmetry);
                };
                if (std::none_of(places.begin() + first, places.end(), same)) {
                    places.push_back(image);
                }
            }
            blocks_.push_back({first, std::ssize(places) - first});
        }
        for (std::size_t i = 0; i < weights.size(); ++i) {
            weights_[static_cast<Eigen::Index>(i)] = weights[i].weight;
            places.push_back(weights[i].direction);
        }
        const auto count = static_cast<Eigen::Index>(places.size());
        covariance_.resize(count, count);
        for (Eigen::Index i = 0; i < count; ++i) {
            for (Eigen::Index j = 0; j < count; ++j) {
                covariance_(i, j) =
                    2.0 - (places[static_cast<std::size_t>(i)] - places[static_cast<std::size_t>(j)]).norm();
            }
        }
    }

    /// Makes the walk known at the images of a candidate that it was not known at.
    void know(std::size_t candidate) {
        const auto [first, count] = blocks_[candidate];
        const Eigen::MatrixXd columns = covariance_.middleCols(first, count);
        const Eigen::MatrixXd block = columns.middleRows(first, count);
        covariance_ -= columns * block.ldlt().solve(columns.transpose());
    }

    /// Returns the weighted mean of the variance that is left.
    [[nodiscard]] double mean_square() const {
        return weights_.dot(covariance_.diagonal().tail(weights_.size()));
    }

    /// Returns by how much know() would lower mean_square().
    [[nodiscard]] double gain(std::size_t candidate) const {
        const auto [first, count] = blocks_[candidate];
        const Eigen::MatrixXd columns =
            covariance_.block(covariance_.rows() - weights_.size(), first, weights_.size(), count);
        const Eigen::MatrixXd block = covariance_.block(first, first, count, count);
        const Eigen::MatrixXd solved = block.ldlt().solve(columns.transpose());
        return weights_.dot(columns.cwiseProduct(solved.transpose()).rowwise().sum());
    }

  private:
    /// The rows of a candidate's images.
    struct Block {
        Eigen::Index first;
        Eigen::Index count;
    };

    Eigen::MatrixXd covariance_;  ///< given the known values; rows of the images, then of the weights
    Eigen::VectorXd weights_;
    std::vector<Block> blocks_;  ///< of each candidate
};

/// Returns the candidate outside of `chosen` for which `gain` is largest: the first of equals, between which
/// rounding must not decide; none where all are chosen.
template <typename Gain>
std::optional<std::size_t> best_candidate(std::size_t count, const std::vector<std::size_t>& chosen,
                                          const Gain& gain) {
    std::optional<std::size_t> best;
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t index = 0; index < count; ++index) {
        if (std::ranges::find(chosen, index) != chosen.end()) continue;
        const double here = gain(index);
        if (best && here <= most + 1e-9 * std::abs(most)) continue;
        most = here;
        best = index;
    }
    return best;
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

std::vector<std::size_t> ends_of_axes(const Symmetry& symmetry, const std::vector<Vector3d>& candidates) {
    std::vector<std::size_t> found;
    for (const Vector3d& end : required_directions(symmetry, 1)) {
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            if ((candidates[i] - end).norm() < direction_tolerance(symmetry)) found.push_back(i);
        }
    }
    return found;
}

double mean_squared_spread(const Symmetry& symmetry, const std::vector<Vector3d>& candidates,
                           const std::vector<std::size_t>& chosen,
                           const std::vector<WeightedDirection>& weights) {
    if (symmetry.type == Symmetry::Type::finite) {
        RandomWalk walk(symmetry, candidates, weights);
        for (const std::size_t index : chosen) walk.know(index);
        return walk.mean_square();
    }
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
    std::optional<RandomWalk> walk;
    if (symmetry.type == Symmetry::Type::finite) {
        walk.emplace(symmetry, candidates, weights);
        for (const std::size_t index : chosen) walk->know(index);
    }
    const auto gain = [&](std::size_t index) {
        if (walk) return walk->gain(index);
        all.push_back(index);
        const double left = mean_squared_spread(symmetry, candidates, all, weights);
        all.pop_back();
        return -left;
    };
    while (all.size() < chosen.size() + count) {
        const auto best = best_candidate(candidates.size(), all, gain);
        if (!best) break;
        if (walk) walk->know(*best);
        all.push_back(*best);
    }
    return {all.begin() + static_cast<std::ptrdiff_t>(chosen.size()), all.end()};
}

}  // namespace samara
