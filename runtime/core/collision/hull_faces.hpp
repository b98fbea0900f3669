#pragma once

#include <vector>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/body/contact_points.hpp"

namespace samara {

/// A flat face of a hull.
struct HullFace {
    Vector3d normal;                   ///< body axes, outwards, of length one
    std::vector<std::size_t> outline;  ///< numbers of corners, anticlockwise from outside
};

/// The faces of the corners' convex hull: of a body without three corners none. They are the same for every
/// size of a body. What lies within a hundred-thousandth of the bounding radius of a face's plane is of the
/// face.
std::vector<HullFace> hull_faces(const ContactPoints& points);

}  // namespace samara
