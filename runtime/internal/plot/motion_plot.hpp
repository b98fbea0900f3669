#pragma once

#include <filesystem>
#include <string>

#include "samara/motion/measures.hpp"

namespace samara {

/// gnuplot commands for the title of a picture of one copy in one run: its name, regime and figures.
std::string picture_title(const Motion& motion, const BodyMotion& body, int run, int copy,
                          const Measures& measures);

/// What a picture of a motion showed.
struct MotionPlot {
    int silhouettes = 0;
    TimeWindow strip;   ///< s, the stretch of the path that is drawn
    Measures measures;  ///< of the copy, in its default window
};

/// Draws one copy of a body in one run by gnuplot, 2000 x 1300 pixels: .svg where the file's name ends so,
/// else PNG. On the left the body's silhouettes along its path (choose_strip()) to scale, from the front (x,
/// z) and from the side (y, z), coloured by time; on the right descent speed, inclination and angular
/// velocity over time, a tenth of the fall's length before it and a quarter after it at most, with the
/// measures of the default window, shaded. Without gravity the down direction is -z. Throws Error where
/// gnuplot is not installed or fails, and where the file cannot be written. `body` belongs to `motion`; run
/// and copy must exist.
MotionPlot plot_motion(const std::filesystem::path& file, const Motion& motion, const BodyMotion& body,
                       int run = 0, int copy = 0);

}  // namespace samara
