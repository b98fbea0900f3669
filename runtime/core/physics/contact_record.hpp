#pragma once

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// The contacts of a body with ground, obstacles and other bodies while it was watched: at every point, in
/// every step. A body at rest takes no steps and records no more.
struct ContactRecord {
    Vector3d impulse = Vector3d::Zero();  ///< N s, world axes: the sum of all contact impulses on the body
    double strongest = 0.0;  ///< N s: the strongest impulse at one point in one step; 0: no contact
    Vector3d point = Vector3d::Zero();   ///< m, world: the point of the strongest impulse
    Vector3d normal = Vector3d::Zero();  ///< world axes: outwards from the touched surface there
    double time = 0.0;                   ///< s: the end of the step of the strongest impulse
    int obstacle = -1;  ///< the number of the obstacle touched there; -1: level ground, or a body
    int body = -1;      ///< the number of the body touched there; -1: none

    /// Adds the contacts of a later time.
    void add(const ContactRecord& later) noexcept {
        const Vector3d sum = impulse + later.impulse;
        if (later.strongest > strongest) *this = later;
        impulse = sum;
    }
};

}  // namespace samara
