#pragma once

#include <optional>
#include <vector>

#include "samara/analysis/metrics/estimate.hpp"
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
    Measures measures;  ///< measures of the window (measures.hpp), whose times count from the release

    [[nodiscard]] double duration() const { return times.back(); }
};

/// Returns the fall of one copy in one run as series. `window` (s since the release): the frames that are
/// measured. Throws Error like measure().
FallSeries fall_series(const Motion& motion, const BodyMotion& body, int run, int copy,
                       const TimeWindow& window);

/// Returns the displacement (m, world) at a time (s) since the release, linear between the frames and held
/// beyond them.
Vector3d displacement_at(const FallSeries& record, double time);

/// A stretch of a record's frames, [begin, end), the last of which is the first of the next stretch.
struct Piece {
    std::size_t begin = 0;
    std::size_t end = 0;
};

/// The division of a record into pieces that are nearly independent of one another.
struct Pieces {
    std::vector<Piece> pieces;   ///< all frames of the window
    std::vector<double> minima;  ///< s since the release: the swings' ends in the window
    bool by_swings = false;      ///< whether a piece is a swing; else the window in equal lengths
};

/// Returns the pieces of the window's frames: a swing each, from one minimum of the inclination to the next,
/// with the rest at either end of the window added to its neighbour. Eight equal lengths of time for a fall
/// that is steady or autorotates without a wobble. None for a fall that swings but shows fewer than two
/// swings, and for fewer frames than pieces.
Pieces pieces_of(const FallSeries& record);

/// Time and place at which a fall first reaches a depth below its release.
struct Passage {
    double time = 0.0;                  ///< s since the release
    Vector3d place = Vector3d::Zero();  ///< m, world: horizontal, from the release
};

/// Returns one passage for each depth (m, ascending, above 0) that the fall reaches, linear between the
/// frames.
std::vector<Passage> passages_of(const FallSeries& record, const std::vector<double>& depths);

/// A turning point, minimum or maximum, of the inclination.
struct TurningPoint {
    Estimate time;         ///< s since the release; the error is that of reading it from frames
    Estimate inclination;  ///< rad; the error is that of reading it from frames
};

/// The first swing of a fall: its inclination's first minimum and first maximum after the release. They count
/// by the prominence of the minima of Measures, judged on the whole fall.
struct FirstSwing {
    std::optional<TurningPoint> minimum;
    std::optional<TurningPoint> maximum;
};

/// Returns the first swing of a fall.
FirstSwing first_swing(const FallSeries& record);

/// Returns the end of the first swing (s since the release), the later of its turning points; nothing where
/// one of them is missing.
std::optional<double> end_of(const FirstSwing& swing);

/// Returns the root mean square distance (m) between two falls until `end` (s since the release), in world
/// axes from their release points, over the frames of the second.
double path_distance(const FallSeries& fall, const FallSeries& reference, double end);

}  // namespace samara
