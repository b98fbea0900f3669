#pragma once

#include <cstddef>
#include <memory>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/physics/emitter.hpp"

namespace samara {

/// The start of the copies of a body.
struct Release {
    Vector3d position = Vector3d::Zero();               ///< of the shape file's origin (m, world)
    Quaterniond orientation = Quaterniond::Identity();  ///< shape axes to world
    Vector3d velocity = Vector3d::Zero();               ///< of the centre of mass (m/s, world)
    Vector3d angular_velocity = Vector3d::Zero();       ///< rad/s, world
    double start = 0.0;                                 ///< s: held in place until then
    int count = 1;                                      ///< the number of copies
    /// m: copies start within +- this of `position`, each axis uniform
    Vector3d spread_position = Vector3d::Zero();
    double spread_angle = 0.0;  ///< rad: copies are rotated by up to this about a random axis
    /// The least size of the copies relative to the shape's lengths. Sizes, all at one density, lie between
    /// this and largest_size, their logarithms uniform; those of a single copy are equal.
    double smallest_size = 1.0;
    double largest_size = 1.0;  ///< the greatest size of the copies relative to the shape's lengths
    double spread_start = 0.0;  ///< s: copies start up to this after `start`, uniform, as a step begins
    /// The mesh where copies start instead of `position`, in its axes and with its motion; null where there
    /// is none.
    std::shared_ptr<const Emitter> emitter = nullptr;
    int first_copy = 0;  ///< number of the first of the copies that are simulated
    int simulated = 0;   ///< the number of copies from there on that are simulated; 0: all

    /// Returns the number of copies that are simulated.
    [[nodiscard]] std::size_t copies() const noexcept {
        return static_cast<std::size_t>(simulated > 0 ? simulated : count);
    }

    /// Returns whether a spread of the copies' starts is given. A single copy must have none.
    [[nodiscard]] bool spreads() const noexcept {
        return !spread_position.isZero(0.0) || spread_angle > 0.0 || spread_start > 0.0 ||
               smallest_size != largest_size;
    }
    /// Returns whether any copy has another size than the shape's.
    [[nodiscard]] bool spreads_size() const noexcept {
        return (count > 1 || smallest_size == largest_size) && (smallest_size != 1.0 || largest_size != 1.0);
    }
};

}  // namespace samara
