#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// A body among others that may touch, in world axes about its centre of mass.
struct JointBody {
    Vector6d velocity;         ///< (omega, v), relative to the ground (rad/s, m/s)
    Matrix6d inverse_inertia;  ///< K^-1
    double radius;             ///< m: of the sphere that holds it
};

/// A point at which two bodies, or a body and the ground or an obstacle, may touch within a step.
struct JointPoint {
    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    std::size_t first;                             ///< number of the body
    std::size_t second = none;                     ///< that of the other; none: ground or obstacle
    Vector3d first_arm;                            ///< m, from the first's centre of mass
    Vector3d second_arm = Vector3d::Zero();        ///< m, from the second's
    Vector3d normal;                               ///< of length one: from the second to the first
    double allowed_speed;                          ///< m/s, from zero on: at which the two may come closer
    double friction;                               ///< Coulomb's coefficient
    Vector3d surface_velocity = Vector3d::Zero();  ///< m/s: of ground or obstacle
    Vector3d surface_turning = Vector3d::Zero();   ///< rad/s
    int obstacle = -1;                             ///< the number of the one that is met; -1: level ground
    Vector3d impulse = Vector3d::Zero();           ///< N s: what the first was given
};

/// Inelastic impulses with Coulomb friction and rolling resistance on bodies that touch each other, ground
/// and obstacles, all found together. Keeps its memory from call to call.
class JointImpulses {
  public:
    /// Changes the bodies' velocities so that no point comes closer than is allowed, and notes the impulses.
    /// They never add energy but the work of obstacles that move: else the sum of w K w / 2 does not grow.
    ///
    /// Projected Gauss-Seidel, forwards and backwards, hastened by nonsmooth nonlinear conjugate gradients:
    /// Silcowitz-Hansen, Niebe and Erleben, A nonsmooth nonlinear conjugate gradient method for interactive
    /// contact force problems, The Visual Computer 26 (2010).
    /// `known`: how many of the points were there in the call before, with bodies of the same inertia: what
    /// was found for them is where this one starts from.
    void solve(std::span<JointBody> bodies, std::span<JointPoint> points, std::size_t known = 0);

  private:
    using Block = Eigen::Matrix<double, 6, 3>;
    /// Impulses along three axes, and within a length that the normal impulse bounds.
    struct Row {
        Matrix3d axes;                 ///< two tangents and the normal, as rows
        Block first_push, first_turn;  ///< what of them each body's velocity gets
        Block second_push, second_turn;
        Matrix3d push_mobility, turn_mobility;
        Matrix3d turn_inverse;
        Eigen::Matrix2d slip_inverse;
        Vector3d meant, meant_turn;  ///< the rates along the axes that are brought about
        Vector6d size;               ///< push along the axes, then turn
        Vector6d before, way;        ///< of the sweep, and of the conjugate gradients
        double rising;               ///< m/s: of the surface, along the normal
        double lever;                ///< m
    };

    void prepare(std::span<JointBody> bodies, std::span<const JointPoint> points, std::size_t known);
    static void give(std::span<JointBody> bodies, const JointPoint& point, const Row& row,
                     const Vector6d& size) noexcept;
    void sweep(std::span<JointBody> bodies, std::span<const JointPoint> points, bool backwards) noexcept;
    void relax(std::span<JointBody> bodies, const JointPoint& point, Row& row) noexcept;
    void hasten(std::span<JointBody> bodies, std::span<const JointPoint> points) noexcept;
    [[nodiscard]] bool has_converged() const noexcept;
    void keep_passive(std::span<JointBody> bodies, std::span<JointPoint> points);

    std::vector<Row> rows_;
    std::vector<Vector6d> start_;    ///< the bodies' velocities before
    std::vector<Vector6d> impulse_;  ///< that each body is given
    double slope_ = 0.0;             ///< of the conjugate gradients: squares of the last sweep's changes
};

}  // namespace samara
