#pragma once

#include <filesystem>

#include "samara/core/body/body.hpp"

namespace samara {

/// What a picture of polars shows.
struct PolarPlot {
    int arcs = 0;                  ///< planes of principal axes whose values differ
    int solved = 0;                ///< cases of the shown Reynolds number that lie on them
    double shown_angle = 0.0;      ///< degrees
    double reynolds_number = 0.0;  ///< U L / nu
};

/// Draws a body's tables against the direction of motion in the planes of its principal axes: drag, lift,
/// moment and k with their standard errors, and the solved cases that lie in the planes. At the Reynolds
/// number of most cases. The body must have tables. Throws Error as draw_picture does.
PolarPlot plot_polars(const std::filesystem::path& file, const Body& body);

}  // namespace samara
