#pragma once

#include <vector>

#include "samara/analysis/metrics/fall_series.hpp"

namespace samara {

/// Where and when a fall first is so deep below its release.
struct Passage {
    double time = 0.0;                  ///< s since the release
    Vector3d place = Vector3d::Zero();  ///< m, world: horizontal, from the release
};

/// One for each depth (m, ascending, above 0), linear between the frames; the rest where the fall does not
/// come so deep.
std::vector<Passage> passages_of(const FallSeries& record, const std::vector<double>& depths);

}  // namespace samara
