#pragma once

#include <vector>

#include "converter/symmetric_loads.hpp"

namespace samara {

/// The entries of all nodes of an octahedral map for one Reynolds number, row by row, in map axes.
struct FilledMap {
    std::vector<LoadEntry> entries;
    std::vector<LoadEntryError> errors;
};

/// Fills every node of the map from samples in the required_directions of the same symmetry and subdivisions
/// (in any order), already passed through keep_symmetric_part:
///  - finite: the exact image of a sample (node_images);
///  - axial: force along the axis and across it, moment, k and epsilon interpolated over the polar angle by
///    monotone cubics that keep their parity at the axis and at the mirror (M. Steffen, A simple method for
///    monotonic interpolation in one dimension, Astronomy and Astrophysics 239, 1990); errors linearly;
///  - spherical: the drag of the one sample.
/// Throws Error naming the direction that has no sample.
FilledMap fill_map(const Symmetry& symmetry, int subdivisions, const std::vector<DirectionSample>& samples);

}  // namespace samara
