#pragma once

#include <optional>
#include <vector>

#include "samara/motion/motion.hpp"

namespace samara {

/// The largest allowed distance of a pose between two kept keys from the motion's own.
struct KeyTolerance {
    double position = 0.0;  ///< m
    double angle =
        0.0;  ///< rad: rotation that moves the body's farthest point from the shape's origin by `position`
};

/// Returns the tolerance of a body whose points may be off by `position` (m); where none is given, 1/500 of
/// the body's radius, the distance from its centre of mass to its farthest point.
KeyTolerance key_tolerance(const BodyMotion& body, const std::optional<double>& position);

/// Returns the tolerance of an obstacle, by the rule for a body of its size.
KeyTolerance key_tolerance(const Obstacle& obstacle, const std::optional<double>& position);

/// Values of a body at its frames, and the rounded values that a file would hold at each of them.
template <typename Value>
struct KeyedFrames {
    const std::vector<double>& times;      ///< s, ascending
    const std::vector<Value>& values;      ///< at these times
    const std::vector<double>& key_times;  ///< s
    const std::vector<Value>& keys;        ///< quaternions: of unit length, signs continuous
};

/// Returns the frames to keep as keys so that linear interpolation between the keys is within `tolerance` (m)
/// of the value at every frame: the first, the last, and those at which a stretch between two kept ones is
/// split, again and again at its worst frame, until it is within the tolerance (Ramer, Douglas, Peucker).
/// Ascending. With the tolerance 0 all are kept.
std::vector<std::size_t> kept_keys(const KeyedFrames<Vector3d>& frames, double tolerance);

/// Returns the frames to keep of orientations as kept_keys() does of positions, with a tolerance in rad,
/// whether a reader interpolates along the arc (as glTF and USD ask) or by components (as Blender does).
std::vector<std::size_t> kept_keys(const KeyedFrames<Quaterniond>& frames, double tolerance);

}  // namespace samara
