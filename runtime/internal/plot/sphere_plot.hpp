#pragma once

#include <filesystem>

#include "samara/core/body/body.hpp"

namespace samara {

/// What a map over the sphere of directions shows.
struct SpherePlot {
    int cases = 0;                 ///< solved directions that are marked
    double reynolds_number = 0.0;  ///< U L / nu
    double planned = 1.0;          ///< share of the sphere that the bake was planned for
};

/// Draws a body's tables over all directions of motion, in Hammer's equal-area projection with the shortest
/// principal axis at the poles and the longest in the middle: drag, moment, k, and the force's standard error
/// over the force; with the solved directions as they were solved. At the Reynolds number of most cases. The
/// body must have tables. Throws Error as draw_picture does.
SpherePlot plot_sphere(const std::filesystem::path& file, const Body& body);

}  // namespace samara
