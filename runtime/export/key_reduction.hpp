#pragma once

#include <optional>
#include <vector>

#include "samara/motion/motion.hpp"

namespace samara {

/// How far a pose between two kept keys may be from the motion's own.
struct KeyTolerance {
    double position = 0.0;  ///< m
    double angle = 0.0;     ///< rad: turns the body's farthest point from the shape's origin by `position`
};

/// The tolerance that `position` (m) stands for on this body; where none is given, 1/500 of the body's
/// radius, the distance from its centre of mass to its farthest point.
KeyTolerance key_tolerance(const BodyMotion& body, const std::optional<double>& position);

/// The same for an obstacle: as for a body of its size.
KeyTolerance key_tolerance(const Obstacle& obstacle, const std::optional<double>& position);

/// The frames of a moving body, and what a file would hold at each of them: the same, rounded.
template <typename Value>
struct KeyedFrames {
    const std::vector<double>& times;      ///< s, ascending
    const std::vector<Value>& values;      ///< at these times
    const std::vector<double>& key_times;  ///< s
    const std::vector<Value>& keys;        ///< of unit length where they are quaternions, signs continuous
};

/// Which frames to keep as keys so that linear interpolation between the keys is within `tolerance` (m) of
/// the value at every frame: the first, the last, and those at which a stretch between two kept ones is
/// parted, again and again at its worst frame, until it is within the tolerance (Ramer, Douglas, Peucker).
/// Ascending. With the tolerance 0 all are kept.
std::vector<std::size_t> kept_keys(const KeyedFrames<Vector3d>& frames, double tolerance);

/// The same of orientations, with a tolerance in rad, whether a reader interpolates along the arc (as glTF
/// and USD ask) or by components (as Blender does).
std::vector<std::size_t> kept_keys(const KeyedFrames<Quaterniond>& frames, double tolerance);

}  // namespace samara
