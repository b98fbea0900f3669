#pragma once

#include <limits>

#include "samara/core/collision/simplex.hpp"

namespace samara {

/// The way from the nearest point of one convex body to that of another: Gilbert, Johnson and Keerthi, IEEE
/// Journal of Robotics and Automation 4(2), 1988. `first` and `second` give the point (m) of each body that
/// is farthest along a unit vector. `way` (m): from the second to the first, at first any guess; where a
/// plane across it leaves a gap above `enough` (m) it is not the nearest. False where the two overlap. Never
/// allocates.
template <typename First, typename Second>
bool nearest_way(const First& first, const Second& second, Simplex& simplex, Vector3d& way,
                 double enough = std::numeric_limits<double>::infinity()) noexcept {
    constexpr int most_rounds = 32;      // five are common, round bodies need some more
    constexpr double converged = 1e-13;  // of the squared distance
    if (way.squaredNorm() == 0.0) return false;
    double square = std::numeric_limits<double>::infinity();
    for (int round = 0; round < most_rounds; ++round) {
        const Vector3d direction = way.normalized();
        const Vector3d of_second = second(direction);
        const Vector3d point = first(-direction) - of_second;
        const double parted = way.dot(point);
        if (round > 0 && way.squaredNorm() - parted <= converged * square) return true;
        if (parted > 0.0 && parted * parted > enough * enough * way.squaredNorm()) return true;
        const Simplex before = simplex;
        simplex.add({point, of_second, 1.0});
        const bool is_outside = simplex.reduce();
        const Vector3d next = is_outside ? simplex.nearest() : Vector3d::Zero();
        const double next_square = next.squaredNorm();
        if (!(next_square > 0.0) && parted <= 0.0) return false;
        // Where a plane parts the two already, nothing but rounding finds the origin within.
        if (!(next_square > 0.0) || !(next_square < square)) {
            simplex = before;
            return true;
        }
        way = next;
        square = next_square;
    }
    return true;
}

}  // namespace samara
