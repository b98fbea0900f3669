#pragma once

#include <filesystem>

#include "samara/motion/motion.hpp"

namespace samara {

/// What a landing map showed.
struct LandingPlot {
    int samples = 0;                   ///< copies x runs
    int landed = 0;                    ///< of them, on the ground
    Vector3d mean = Vector3d::Zero();  ///< m: the mean of the places drawn
    double spread = 0.0;               ///< m: rms horizontal distance from it
    double median = 0.0;               ///< m: half of the places are within it of the mean
};

/// Draws by gnuplot where the copies of a body come down in all runs, in the size and formats of
/// plot_motion(): seen from above (x, y, to one scale), with the paths of 200 of them at most, the mean and
/// the circle of the rms distance; beside it the distribution of the distance from the mean, with that of a
/// normal distribution of the same spread, and of the times of landing. With a ground the places are those of
/// the centre of mass when it first touches, of those that do; else, or where none lands, the places at the
/// last frame, and the distribution of the ways descended. Throws Error as plot_motion() does, and where
/// there are fewer than two places.
LandingPlot plot_landing(const std::filesystem::path& file, const Motion& motion, const BodyMotion& body);

}  // namespace samara
