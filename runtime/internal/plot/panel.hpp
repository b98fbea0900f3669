#pragma once

#include <string>
#include <vector>

#include "samara/internal/plot/canvas.hpp"
#include "samara/motion/measures.hpp"

namespace samara {

/// gnuplot commands: data blocks, to stand before the plots, and plots within a multiplot.
struct PanelText {
    std::string data;
    std::string plots;
};

/// An axis of a panel: `step` between its numbers, 0 for a round one.
struct PanelAxis {
    Range range;
    std::string title;  ///< of the horizontal axis below it, where empty its numbers are left out too; of the
                        ///< vertical one the panel's heading
    double step = 0.0;
};

/// The least pixels between the tics of a panel's axes.
inline constexpr double across_least = 110.0;
inline constexpr double up_least = 60.0;

/// gnuplot commands for the frame of a panel with a gray text above its right end. The plot command follows,
/// then end_panel().
std::string begin_panel(const Box& box, const PanelAxis& across, const PanelAxis& up,
                        const std::string& right = "");

/// A gnuplot command that shades a stretch of time in a panel.
std::string shaded_window(const TimeWindow& window);

std::string end_panel();

/// From the least to the most of the values (not empty) with some air at both ends.
Range airy_range(const std::vector<double>& values);

}  // namespace samara
