#pragma once

#include <vector>

#include "samara/core/body/load_tables.hpp"

namespace samara {

/// The mean square error of looking a table up between its Reynolds numbers, linear in log Re: each inner
/// Reynolds number is left out and predicted from its two neighbours. That error belongs to intervals twice
/// as long, and to their middle, so that for a smooth change a quarter of it is left in the middle of the
/// table's own. One figure for each kind of quantity (the components of a vector alike), k and epsilon by
/// their logarithms; nothing (zero) where there are fewer than three Reynolds numbers, or where they are
/// laminar.
///
/// `nodes`: the entries of each of the ascending `reynolds_numbers` in the same directions.
LoadEntryError reynolds_interpolation_variance(const std::vector<double>& reynolds_numbers,
                                               const std::vector<std::vector<LoadEntry>>& nodes);

}  // namespace samara
