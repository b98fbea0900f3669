#pragma once

#include <string>

#include "samara/internal/plot/strip.hpp"
#include "samara/motion/motion.hpp"

namespace samara {

/// gnuplot commands for the left part of the picture: the strip from the front and from the side, to one
/// scale.
struct StripPanel {
    std::string data;    ///< data blocks, to stand before the plots
    std::string plots;   ///< the two plots, within a multiplot
    double right = 0.0;  ///< pixels: where its last text ends
};

StripPanel strip_panel(const Motion& motion, const BodyMotion& body, int run, int copy, const Strip& strip);

/// The share (0 to 1) of the strip's time that has passed at a frame: for time_color().
double share_of(const Motion& motion, const Strip& strip, int frame);

}  // namespace samara
