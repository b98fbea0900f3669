#pragma once

#include <cstddef>
#include <vector>

#include "samara/analysis/metrics/sampled_falls.hpp"
#include "samara/core/body/body.hpp"
#include "samara/core/body/planned_region.hpp"

namespace samara {

/// A direction of motion (map axes, the columns of symmetry.axes) with its weight; weights sum to one.
struct WeightedDirection {
    Vector3d direction;
    double weight;
};

/// The share of all weight that is spread evenly over the whole sphere, since a motion deviates from the
/// planned one, and a table must be usable there too.
inline constexpr double weight_of_the_unvisited = 0.05;

/// Returns the directions that matter for the motion of the visits: nodes of a fine octahedral map, one for
/// each set of equivalent ones, weighted by the share of the squared loads there, since a load's error moves
/// the body in proportion to the dynamic pressure. weight_of_the_unvisited is spread evenly over all.
std::vector<WeightedDirection> direction_weights(const std::vector<FlowVisit>& visits,
                                                 const Symmetry& symmetry);

/// Returns the directions of the visits, to within the 7.5 degrees of the map, and all that are equivalent by
/// the symmetry; all directions for a sphere.
PlannedRegion visited_region(const std::vector<FlowVisit>& visits, const Symmetry& symmetry);

/// Adds another region of the same body to a region.
void merge(PlannedRegion& region, const PlannedRegion& other);

/// The directions in which a table may be solved.
struct Candidates {
    int subdivisions;
    std::vector<Vector3d> directions;  ///< required_directions (direction_sampling.hpp)
};

/// The number of candidates of a body without symmetry at 4 subdivisions.
inline constexpr std::size_t most_candidates = 66;

/// Returns the directions of the finest octahedral map that has at most `most` of them after symmetry, and
/// whose subdivisions are a power of two, at most 8.
Candidates candidate_directions(const Symmetry& symmetry, std::size_t most = most_candidates);

/// Returns the candidates (indices) that are ends of the map's axes, without which a table would extrapolate.
std::vector<std::size_t> ends_of_axes(const Symmetry& symmetry, const std::vector<Vector3d>& candidates);

/// Returns the weighted mean square error of a quantity that is known in the chosen candidates alone, by a
/// measure that every further direction lowers: of a finite symmetry the error of the best weighted sum for a
/// random walk over the sphere, whose squared increments have the mean of the chord; of a body of revolution
/// the square of DirectionFit::spread.
double mean_squared_spread(const Symmetry& symmetry, const std::vector<Vector3d>& candidates,
                           const std::vector<std::size_t>& chosen,
                           const std::vector<WeightedDirection>& weights);

/// Chooses `count` more candidates (indices), each time the one that lowers mean_squared_spread() most; the
/// first of equals, so that the choice is deterministic and a longer one begins like a shorter. Returns fewer
/// where there are no more.
std::vector<std::size_t> choose_directions(const Symmetry& symmetry, const std::vector<Vector3d>& candidates,
                                           const std::vector<std::size_t>& chosen,
                                           const std::vector<WeightedDirection>& weights, std::size_t count);

}  // namespace samara
