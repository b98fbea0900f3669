#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "samara/core/collision/contact_set.hpp"
#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/physics/contact_record.hpp"

namespace samara {

/// How a body comes to what it may touch.
struct Approach {
    double margin = 0.0;     ///< m: points with a larger gap are left out
    double touching = 0.0;   ///< m: gaps up to this count as none
    double time_step = 0.0;  ///< s: in which a point may close what is left of its gap, and no more
    /// A velocity that it has besides, (omega, v) in body axes, relative to the ground. Where there is one,
    /// obstacles that move do so under it, and what impulses change is a way over which they stand still.
    std::optional<Vector6d> drift = {};
};

/// What inelastic impulses with Coulomb friction and rolling resistance make of a velocity (omega, v; body
/// axes, relative to the ground). They act where a near point would else go through what it may meet, found
/// one after the other, on `most_contacts` points at most, and never add energy but the work of obstacles
/// that move: else w K w / 2 does not grow. `met` (null: not asked for) becomes what they are, in body axes
/// and from the centre of mass, without a time. Never throws or allocates.
///
/// Projected Gauss-Seidel on the impulses: Erleben, Velocity-based shock propagation for multibody dynamics
/// animation, ACM Transactions on Graphics 26(2), 2007, section 3; the inertia here is K, the fluid's
/// included. As one body has six velocities only, what sticks is solved for at once after each sweep.
Vector6d after_impulses(const TouchingBody& body, const ContactSet& near, const Approach& approach,
                        const Vector6d& velocity, ContactRecord* record = nullptr) noexcept;

/// How far the load of a contact point stands off it, over the bounding radius: what stops a ball that rolls
/// and a body that rocks or spins. Chosen, not measured: 0.1 mm for a body of 2 cm (docs/theory.md#ground).
inline constexpr double rolling_resistance = 0.005;
inline constexpr std::size_t most_contacts = 16;

/// The impulses at one contact point, along two tangents and the normal, and what resists being rolled over
/// or spun there, about the same axes: one body is given them, and what it touches the opposite.
struct ContactImpulses {
    using Response = Eigen::Matrix<double, 6, 3>;
    /// The velocity (omega, v) that a body gets of impulses of one along and about the axes.
    struct Side {
        Response push, turn;
    };

    Matrix3d axes;  ///< two tangents and the normal, as rows
    Side first, second;
    Matrix3d push_mobility, turn_mobility;  ///< rates along and about the axes of impulses of one
    Eigen::Matrix2d slip_inverse;           ///< of the mobility along the tangents
    Matrix3d turn_inverse;
    Vector3d meant, meant_turn;  ///< rates that the impulses bring about
    double rising;               ///< m/s: of the surface, along the normal
    double friction;
    double lever;   ///< m
    Vector6d size;  ///< along the axes, then about them

    /// Sets all but mobilities and responses, with impulses of none: a surface with a velocity (m/s) and an
    /// angular velocity (rad/s), between bodies the smaller of which is held by a sphere of a radius (m).
    void begin(const Matrix3d& along, const Vector3d& surface_velocity,
               const Vector3d& surface_angular_velocity, double friction_coefficient, double radius) noexcept;
    /// What the mobilities are worth inverted: to be called once they are set.
    void invert() noexcept;
    /// What the first body is given (N s).
    [[nodiscard]] Vector3d push() const noexcept { return axes.transpose() * size.head<3>(); }
    /// The work (J) of the surface.
    [[nodiscard]] double work() const noexcept;
};

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
    double allowed_speed;                          ///< m/s, from zero on: at which the two may come closer
    double friction;                               ///< Coulomb's coefficient
    Vector3d surface_velocity = Vector3d::Zero();  ///< m/s: of ground or obstacle
    Vector3d surface_angular_velocity = Vector3d::Zero();  ///< rad/s
    int obstacle = -1;                    ///< the number of the one that is met; -1: level ground
    Vector3d impulse = Vector3d::Zero();  ///< N s: what the first was given
};

/// The impulses of after_impulses() on bodies that touch each other, ground and obstacles, all found
/// together. Keeps its memory from call to call.
class ContactSolver {
  public:
    /// Changes the bodies' velocities so that no point comes closer than is allowed, and notes the impulses.
    /// They never add energy but the work of obstacles that move: else the sum of w K w / 2 does not grow.
    ///
    /// Projected Gauss-Seidel, forwards and backwards, sped up by nonsmooth nonlinear conjugate gradients:
    /// Silcowitz-Hansen, Niebe and Erleben, A nonsmooth nonlinear conjugate gradient method for interactive
    /// contact force problems, The Visual Computer 26 (2010).
    /// `known`: how many of the points were there in the call before, with bodies of the same inertia: what
    /// was found for them is where this one starts from.
    void solve(std::span<ContactBody> bodies, std::span<ContactBetween> points, std::size_t known = 0);

  private:
    struct Row : ContactImpulses {
        Vector6d before, direction;  ///< of the sweep, and of the conjugate gradients
    };

    void prepare(std::span<ContactBody> bodies, std::span<const ContactBetween> points, std::size_t known);
    void sweep(std::span<ContactBody> bodies, std::span<const ContactBetween> points,
               bool backwards) noexcept;
    void accelerate(std::span<ContactBody> bodies, std::span<const ContactBetween> points) noexcept;
    [[nodiscard]] bool has_converged() const noexcept;
    void keep_passive(std::span<ContactBody> bodies, std::span<ContactBetween> points);

    std::vector<Row> rows_;
    std::vector<Vector6d> start_;    ///< the bodies' velocities before
    std::vector<Vector6d> impulse_;  ///< that each body is given
    double slope_ = 0.0;             ///< of the conjugate gradients: squares of the last sweep's changes
};

}  // namespace samara
