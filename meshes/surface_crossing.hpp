#pragma once

#include <optional>

#include "samara/body/surface.hpp"

namespace samara {

/// Two flat triangles, and a point where a side of the one goes through the other.
struct Crossing {
    std::size_t first = 0;
    std::size_t second = 0;
    Vector3d point = Vector3d::Zero();
};

/// A place where the welded surface passes through itself, or nothing. Triangles that share an edge, and
/// those that only touch, do not cross. Takes n log n time.
std::optional<Crossing> find_crossing(const Surface& surface);

}  // namespace samara
