#pragma once

#include <string>

#include "samara/internal/plot/strip.hpp"
#include "samara/motion/measures.hpp"

namespace samara {

/// gnuplot commands for the right part of the picture: descent speed, inclination and angular velocity over
/// the time of the fall, a tenth of its length before and a quarter after it.
struct SeriesPanel {
    std::string data;   ///< data blocks, to stand before the plots
    std::string plots;  ///< the three plots, within a multiplot
};

/// `left`: where it may begin (pixels).
SeriesPanel series_panel(const Motion& motion, const BodyMotion& body, int run, int copy, const Strip& strip,
                         const Measures& measures, double left);

}  // namespace samara
