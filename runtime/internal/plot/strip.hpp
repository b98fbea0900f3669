#pragma once

#include <vector>

#include "samara/motion/motion.hpp"

namespace samara {

/// Which frames of a copy's fall a strip of silhouettes shows.
struct Strip {
    int first = 0;            ///< first frame of the path that is drawn
    int last = 0;             ///< last frame of it
    std::vector<int> frames;  ///< the silhouettes: at even times from `first` on
};

/// The strip of one copy in one run.
///
/// It shows the fall (fall_of() of measures.hpp), and of a long one the last stretch that spans no more than
/// 24 times the body's largest extent, so that the silhouettes can be made out. The silhouettes follow one
/// another at the smallest even interval at which nine in ten neighbours do not overlap in either view, front
/// and side, but at no more than twice the interval at which nine in ten do not overlap in one of the views,
/// and there are at most 40. One silhouette alone where the body does not leave its place.
Strip choose_strip(const Motion& motion, const BodyMotion& body, int run, int copy);

}  // namespace samara
