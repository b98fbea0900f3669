#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "samara/core/contact/contact_impulses.hpp"

namespace samara {

/// A body among others that may touch, in world axes about its centre of mass.
struct ContactBody {
    Vector6d velocity;         ///< (omega, v), relative to the ground (rad/s, m/s)
    Matrix6d inverse_inertia;  ///< K^-1
    double radius;             ///< m: of the sphere that holds it
};

/// A point at which two bodies, or a body and the ground or an obstacle, may touch within a step.
struct ContactBetween {
    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    std::size_t first;                             ///< number of the body
    std::size_t second = none;                     ///< that of the other; none: ground or obstacle
    Vector3d first_arm;                            ///< m, from the first's centre of mass
    Vector3d second_arm = Vector3d::Zero();        ///< m, from the second's
    Vector3d normal;                               ///< of length one: from the second to the first
    double allowed_speed;                          ///< m/s, not negative: the closing speed that is allowed
    double friction;                               ///< Coulomb's coefficient
    Vector3d surface_velocity = Vector3d::Zero();  ///< m/s: of ground or obstacle
    Vector3d surface_angular_velocity = Vector3d::Zero();  ///< rad/s
    int obstacle = -1;                    ///< the number of the touched obstacle; -1: level ground
    Vector3d impulse = Vector3d::Zero();  ///< N s: on the first
};

/// Solves for the impulses of after_impulses() on bodies that touch each other, ground and obstacles, all
/// together. Keeps its memory from call to call.
class ContactSolver {
  public:
    /// Changes the bodies' velocities so that no point closes faster than is allowed, and records the
    /// impulses. They never add energy but the work of moving obstacles: the sum of w K w / 2 does not grow
    /// otherwise.
    ///
    /// Projected Gauss-Seidel, forwards and backwards, sped up by nonsmooth nonlinear conjugate gradients:
    /// Silcowitz-Hansen, Niebe and Erleben, A nonsmooth nonlinear conjugate gradient method for interactive
    /// contact force problems, The Visual Computer 26 (2010). `known`: the number of points that the call
    /// before had too, with bodies of the same inertia; their impulses are the initial guess.
    void solve(std::span<ContactBody> bodies, std::span<ContactBetween> points, std::size_t known = 0);

  private:
    struct Row : ContactImpulses {
        Vector6d before, direction;  ///< of the sweep, and of the conjugate gradients
    };

    void prepare(std::span<ContactBody> bodies, std::span<const ContactBetween> points, std::size_t known);
    void sweep(std::span<ContactBody> bodies, std::span<const ContactBetween> points,
               bool backwards) noexcept;
    void accelerate(std::span<ContactBody> bodies, std::span<const ContactBetween> points) noexcept;
    [[nodiscard]] bool has_converged(std::span<const ContactBody> bodies) const noexcept;
    void keep_passive(std::span<ContactBody> bodies, std::span<ContactBetween> points);

    std::vector<Row> rows_;
    std::vector<Vector6d> start_;    ///< the bodies' velocities before
    std::vector<Vector6d> before_;   ///< those before the sweep
    std::vector<Vector6d> impulse_;  ///< on each body
    double slope_ = 0.0;             ///< of the conjugate gradients: squares of the last sweep's changes
};

}  // namespace samara
