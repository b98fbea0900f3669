#pragma once

#include <vector>

#include "samara/motion/measures.hpp"

namespace samara {

/// One fall as series over the time since the release, which is the begin of fall_of().
struct FallSeries {
    double release = 0.0;                 ///< s, in the motion's time
    std::vector<double> times;            ///< s since the release, ascending from 0
    std::vector<Vector3d> displacements;  ///< m, world: of the centre of mass since the release
    std::vector<double> inclinations;     ///< rad
    std::vector<double> squared_spins;    ///< rad^2/s^2
    std::vector<double> upright_spins;    ///< rad/s: about the down direction
    std::vector<Vector3d> axes;           ///< the shortest axis, world
    Vector3d down = Vector3d(0.0, 0.0, -1.0);
    Measures measures;  ///< of the window (measures.hpp), whose times count from the release

    [[nodiscard]] double duration() const { return times.back(); }
};

/// The fall of one copy in one run. `window` (s since the release): what is measured; it is given the frames
/// in it. Throws Error like measure().
FallSeries fall_series(const Motion& motion, const BodyMotion& body, int run, int copy,
                       const TimeWindow& window);

/// The way at a time since the release (m, world), linear between the frames and held beyond them.
Vector3d displacement_at(const FallSeries& record, double time);

/// A stretch of a record's frames, [begin, end), the last of which is the first of the next stretch.
struct Piece {
    std::size_t begin = 0;
    std::size_t end = 0;
};

/// How a record falls into pieces that are about independent of one another.
struct Pieces {
    std::vector<Piece> pieces;   ///< all frames of the window
    std::vector<double> minima;  ///< s since the release: the swings' ends in the window
    bool by_swings = false;      ///< whether a piece is a swing; else the window in equal lengths
};

/// The pieces of the window's frames: a swing each, from one minimum of the inclination to the next, with
/// what is left at either end of the window added to its neighbour. Eight equal lengths of time for a fall
/// that is steady or autorotates without a wobble. None for a fall that swings but shows fewer than two
/// swings, and for fewer frames than pieces.
Pieces pieces_of(const FallSeries& record);

}  // namespace samara
