#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// Velocities of the air at the nodes of a regular grid, at even times: the content of a wind file.
struct WindGrid {
    Vector3d origin = Vector3d::Zero();            ///< m: the first node, from the file's own origin
    Vector3d spacing = Vector3d::Ones();           ///< m between nodes, along each axis
    std::array<std::size_t, 3> nodes = {1, 1, 1};  ///< along x, y, z
    std::size_t frames = 1;                        ///< times
    double interval = 1.0;                         ///< s from one time to the next; the first is 0
    std::vector<float> velocities;  ///< m/s: (((time * z + z) * y + y) * x + x) * 3 + component
    std::string source;             ///< what it was made from, one line
    std::string hash;               ///< of the content, in hexadecimal digits; empty where unknown

    /// Returns the last time (s).
    [[nodiscard]] double duration() const { return interval * static_cast<double>(frames - 1); }
    /// Returns the number of values that `velocities` holds.
    [[nodiscard]] std::size_t size() const { return frames * nodes[0] * nodes[1] * nodes[2] * 3; }
};

/// The wind of a grid in a scene. Between nodes and times it is cubic (Keys, IEEE Trans. Acoust. Speech
/// Signal Process. 29, 1981), so that its gradient is continuous.
struct WindFile {
    /// The wind beyond the grid: that at its edge, or none, after a decay to zero within one spacing.
    enum class Outside { edge, still };
    std::shared_ptr<const WindGrid> grid;  ///< never null where there is a file
    Vector3d position = Vector3d::Zero();  ///< m, world: of the file's origin
    double start = 0.0;    ///< s: of the first time; before it the wind is that of the first time
    bool repeats = false;  ///< starts again one interval after the last time; else the last values stay
    Outside outside = Outside::edge;  ///< beyond the grid

    /// Compares member by member; grids by identity.
    bool operator==(const WindFile&) const = default;
};

}  // namespace samara
