#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Core>

#include "samara/core/collision/hull_separation.hpp"

namespace samara {

/// The corners of a hull that lie lowest along a normal, within a tolerance: one, an edge, or the outline of
/// a face. Never allocates.
class LowestSide {
  public:
    /// `tolerance`: m, above the lowest corner.
    LowestSide(const PlacedHull& hull, const Vector3d& normal, double tolerance) noexcept;

    /// The part of the way from a to b, from share `from` to share `to`, that lies under it along the normal;
    /// false where none does.
    bool covers(const Vector3d& a, const Vector3d& b, double& from, double& to) const noexcept;

    /// Its height (m, along the normal) over a place under it.
    [[nodiscard]] double height(const Vector3d& place) const noexcept;

  private:
    [[nodiscard]] Eigen::Vector2d flat(const Vector3d& place) const noexcept {
        return {first_.dot(place), second_.dot(place)};
    }
    void turn_around() noexcept;
    void fit_plane() noexcept;

    Vector3d first_, second_;                     // axes in the plane
    std::array<Vector3d, most_corners> outline_;  // both coordinates in the plane, and the height
    std::size_t count_ = 0;
    Vector3d slope_ = Vector3d::Zero();  // height is slope x (first, second, 1)
};

}  // namespace samara
