#pragma once

#include <string>

#include "samara/motion/measures.hpp"
#include "samara/plot/strip.hpp"

namespace samara {

/// gnuplot commands for the right part of the picture: descent speed, inclination and angular velocity over
/// time.
struct SeriesPanel {
    std::string data;   ///< data blocks, to stand before the plots
    std::string plots;  ///< the three plots, within a multiplot
};

/// `left`: where it may begin (pixels).
SeriesPanel series_panel(const Motion& motion, const BodyMotion& body, int run, int copy, const Strip& strip,
                         const Measures& measures, double left);

}  // namespace samara
