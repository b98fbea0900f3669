#pragma once

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// What a body met of ground, obstacles and other bodies while it was watched: at every point, in every step.
/// A body at rest, which takes no steps, meets nothing more.
struct ContactRecord {
    Vector3d impulse = Vector3d::Zero();  ///< N s, world axes: the sum of all that the body was given
    double strongest = 0.0;               ///< N s: of one point in one step; 0: nothing was met
    Vector3d point = Vector3d::Zero();    ///< m, world: where that was
    Vector3d normal = Vector3d::Zero();   ///< world axes: out of what was met there
    double time = 0.0;                    ///< s: when the step ended
    int obstacle = -1;                    ///< the number of what was met there; -1: level ground, or a body
    int body = -1;                        ///< the number of the body that was met there; -1: none

    /// Adds what was met later.
    void add(const ContactRecord& later) noexcept {
        const Vector3d sum = impulse + later.impulse;
        if (later.strongest > strongest) *this = later;
        impulse = sum;
    }
};

}  // namespace samara
