#pragma once

#include <filesystem>

#include "samara/core/body/body.hpp"

namespace samara {

/// What a picture of convergence shows.
struct ConvergencePlot {
    int directions = 0;  ///< that were solved on more than one mesh
    int meshes = 0;      ///< on which the directions of the main Reynolds number were solved
    int sources = 0;     ///< of errors that the tables hold
};

/// Draws how far a body's tables can be trusted: drag and k of each direction over the meshes that it was
/// solved on, the tables' standard errors by source, and the drag along the principal axes over the Reynolds
/// numbers. The body must have tables. Throws Error as draw_picture does.
ConvergencePlot plot_convergence(const std::filesystem::path& file, const Body& body);

}  // namespace samara
