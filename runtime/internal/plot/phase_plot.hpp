#pragma once

#include <filesystem>
#include <optional>

#include "samara/motion/measures.hpp"

namespace samara {

/// What a phase portrait showed.
struct PhasePlot {
    TimeWindow fall;                        ///< s, what is drawn
    double highest_rate = 0.0;              ///< rad/s, of the tilt, either way
    int lines = 0;                          ///< unbroken pieces of the curve
    std::optional<double> frames_in_swing;  ///< where the body swings; of fewer than 12 the picture says so
    Measures measures;                      ///< of the copy, in its default window
};

/// Draws the phase portrait of one copy in one run by gnuplot, in the size and formats of plot_motion(): how
/// the body leans in the plane in which it swings most (Tilt) against the rate of that, coloured by time,
/// and both over time beside it. Throws Error as plot_motion() does, and for a body without a shortest axis,
/// such as a sphere.
PhasePlot plot_phase(const std::filesystem::path& file, const Motion& motion, const BodyMotion& body,
                     int run = 0, int copy = 0);

}  // namespace samara
