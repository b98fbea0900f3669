#pragma once

#include <filesystem>
#include <string>

#include "samara/analysis/comparison/comparison.hpp"

namespace samara {

/// Draws a comparison by gnuplot, 2000 x 1300 pixels: .svg where the file's name ends so, else PNG. On the
/// left both paths from the front (x, z) and from the side (y, z), laid on their release points; on the right
/// the inclination over time, both spectra of the swings (swing_spectrum()), and both distributions of the
/// inclination with their largest distance. Of several falls one is drawn strong and up to 19 faint. `motion`
/// and `reference`: the names that stand in the title. Throws Error like draw_picture().
void plot_comparison(const std::filesystem::path& file, const Comparison& comparison,
                     const std::string& motion, const std::string& reference);

}  // namespace samara
