#pragma once

#include <cstddef>
#include <vector>

#include "samara/analysis/metrics/sampled_falls.hpp"
#include "samara/core/body/body.hpp"
#include "samara/core/body/planned_region.hpp"

namespace samara {

/// A direction of motion (map axes, the columns of symmetry.axes) and how much it counts; weights sum to one.
struct WeightedDirection {
    Vector3d direction;
    double weight;
};

/// What part of all weight lies evenly on the whole sphere: a motion strays from what was planned, and a
/// table must be sane there too.
inline constexpr double weight_of_the_unvisited = 0.05;

/// The directions that must be good for the visits' motion: nodes of a fine octahedral map, one for each set
/// that the symmetry makes alike, with the share of the squared loads met there, for a load's error moves the
/// body in proportion to the dynamic pressure. weight_of_the_unvisited of it lies evenly on all.
std::vector<WeightedDirection> direction_weights(const std::vector<FlowVisit>& visits,
                                                 const Symmetry& symmetry);

/// The directions that the visits have been in, to within the 7.5 degrees of the map, and all that the
/// symmetry makes alike; all directions of a ball.
PlannedRegion visited_region(const std::vector<FlowVisit>& visits, const Symmetry& symmetry);

/// Adds the other region of the same body to one.
void merge(PlannedRegion& region, const PlannedRegion& other);

/// The directions that a table may be solved in: those of the finest octahedral map that leaves at most
/// `most` of them after symmetry, and whose subdivisions are a power of two, at most 8.
struct Candidates {
    int subdivisions;
    std::vector<Vector3d> directions;  ///< required_directions (direction_sampling.hpp)
};
inline constexpr std::size_t most_candidates = 66;  ///< those of a body without symmetry at 4 subdivisions
Candidates candidate_directions(const Symmetry& symmetry, std::size_t most = most_candidates);

/// The weighted mean square of the interpolation's spread (DirectionFit::spread) from the chosen candidates:
/// what the expected squared error of the loads is proportional to.
double mean_squared_spread(const Symmetry& symmetry, const std::vector<Vector3d>& candidates,
                           const std::vector<std::size_t>& chosen,
                           const std::vector<WeightedDirection>& weights);

/// Chooses `count` more candidates (indices), one after the other that lowers mean_squared_spread most; the
/// first of equals, so that the choice is the same everywhere. Fewer where there are no more.
std::vector<std::size_t> choose_directions(const Symmetry& symmetry, const std::vector<Vector3d>& candidates,
                                           const std::vector<std::size_t>& chosen,
                                           const std::vector<WeightedDirection>& weights, std::size_t count);

}  // namespace samara
