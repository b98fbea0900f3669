#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/export/shape_pose.hpp"

namespace samara {

/// What the copies of a motion are called and how they are coloured in a file for another program.
struct CopyStyle {
    int first = 0;  ///< number of the motion's first copy, where those before it were left out
    /// Red, green and blue (0 to 1, linear) of the bodies without a display mesh: copy k has colour k modulo
    /// their number. Empty: the format's own.
    std::vector<Vector3d> colors;

    /// Returns the name of a copy, counted from the motion's first.
    [[nodiscard]] std::string name(const BodyMotion& body, int copy) const {
        return copy_name(body, first + copy);
    }
    /// Returns whether the copies of a body are coloured.
    [[nodiscard]] bool colors_copies_of(const BodyMotion& body) const {
        return !colors.empty() && body.display == nullptr;
    }
    /// Returns the colour of a copy, counted from the motion's first; there must be colours.
    [[nodiscard]] const Vector3d& color(int copy) const {
        return colors[static_cast<std::size_t>(first + copy) % colors.size()];
    }
};

}  // namespace samara
