#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// Velocities of the air at the nodes of a regular grid, at even times: what a wind file holds.
struct WindGrid {
    Vector3d origin = Vector3d::Zero();            ///< m: the first node, from the file's own origin
    Vector3d spacing = Vector3d::Ones();           ///< m between nodes, along each axis
    std::array<std::size_t, 3> nodes = {1, 1, 1};  ///< along x, y, z
    std::size_t frames = 1;                        ///< times
    double interval = 1.0;                         ///< s from one time to the next; the first is 0
    std::vector<float> velocities;  ///< m/s: (((time * z + z) * y + y) * x + x) * 3 + component
    std::string source;             ///< what it was made from, one line
    std::string hash;               ///< of the content, in hexadecimal digits; empty where unknown

    /// s: the last time.
    [[nodiscard]] double duration() const { return interval * static_cast<double>(frames - 1); }
    /// How many numbers `velocities` holds.
    [[nodiscard]] std::size_t size() const { return frames * nodes[0] * nodes[1] * nodes[2] * 3; }
};

/// A grid's wind in a scene. Between nodes and times it is cubic (Keys, IEEE Trans. Acoust. Speech Signal
/// Process. 29, 1981): its gradient is continuous.
struct WindFile {
    /// What is beyond the grid: what is at its edge, or nothing, after a fall to zero within one spacing.
    enum class Outside { edge, still };
    std::shared_ptr<const WindGrid> grid;  ///< never null where there is a file
    Vector3d position = Vector3d::Zero();  ///< m, world: of the file's origin
    double start = 0.0;                    ///< s: of the first time; before it the wind is as it is then
    bool repeats = false;                  ///< begins anew one interval after the last time; else that stays
    Outside outside = Outside::edge;       ///< beyond the grid

    /// Member by member; of grids, that they are the same.
    bool operator==(const WindFile&) const = default;
};

}  // namespace samara
