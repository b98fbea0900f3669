#pragma once

#include <array>
#include <initializer_list>
#include <utility>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// A point of the difference of two convex bodies, and the second's part in it.
struct Difference {
    Vector3d point;
    Vector3d on_second;
    double share = 0.0;
};

/// Up to four of them, and the point nearest to the origin: Ericson, Real-Time Collision Detection (2005),
/// 5.1. Never allocates.
struct Simplex {
    std::array<Difference, 4> corners;
    int size = 0;

    [[nodiscard]] Vector3d nearest() const;
    /// What of the second body the nearest point is made of.
    [[nodiscard]] Vector3d on_second() const;
    void add(const Difference& corner) { corners[static_cast<std::size_t>(size++)] = corner; }
    /// Keeps the corners that the nearest point lies between. False where the origin lies within.
    bool reduce();

  private:
    [[nodiscard]] const Difference& at(int i) const { return corners[static_cast<std::size_t>(i)]; }
    [[nodiscard]] const Vector3d& point(int i) const { return at(i).point; }
    void keep(std::initializer_list<std::pair<int, double>> kept);
    void reduce_segment();
    void reduce_triangle();
    bool reduce_tetrahedron();
};

}  // namespace samara
