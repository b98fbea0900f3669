#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "samara/core/collision/contact_set.hpp"
#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/physics/contact_record.hpp"

namespace samara {

/// The approach of a body to what it may touch.
struct Approach {
    double margin = 0.0;     ///< m: points with a larger gap are ignored
    double touching = 0.0;   ///< m: gaps up to this count as none
    double time_step = 0.0;  ///< s: the time in which a point may close the rest of its gap, and no more
    /// An additional velocity (omega, v) in body axes, relative to the ground. Where there is one, moving
    /// obstacles move under it, and impulses change a displacement over which they stand still.
    std::optional<Vector6d> drift = {};
};

/// Returns a velocity (omega, v; body axes, relative to the ground) after inelastic impulses with Coulomb
/// friction and rolling resistance. They act where a near point would otherwise penetrate, found one after
/// the other, at `most_contacts` points at most, and never add energy but the work of moving obstacles: w K w
/// / 2 does not grow otherwise. `record` (null: not asked for) receives the impulses, in body axes and from
/// the centre of mass, without a time. Never throws or allocates.
///
/// Projected Gauss-Seidel on the impulses: Erleben, Velocity-based shock propagation for multibody dynamics
/// animation, ACM Transactions on Graphics 26(2), 2007, section 3; the inertia here is K, the fluid's
/// included. As one body has six velocities only, all sticking points are solved for together after each
/// sweep.
Vector6d after_impulses(const TouchingBody& body, const ContactSet& near, const Approach& approach,
                        const Vector6d& velocity, ContactRecord* record = nullptr) noexcept;

/// The lever of the load at a contact point, relative to the bounding radius: it stops a ball that rolls and
/// a body that rocks or spins. Chosen, not measured: 0.1 mm for a body of 2 cm
/// (docs/explanation/integrator.md#ground).
inline constexpr double rolling_resistance = 0.005;
inline constexpr std::size_t most_contacts = 16;

/// The impulses at one contact point: forces along two tangents and the normal, and moments against rolling
/// and spinning about the same axes. One body receives them, and what it touches the opposite.
struct ContactImpulses {
    using Response = Eigen::Matrix<double, 6, 3>;
    /// The velocity (omega, v) that unit impulses along and about the axes give a body.
    struct Side {
        Response push, spin;
    };

    Matrix3d axes;  ///< two tangents and the normal, as rows
    Side first, second;
    Matrix3d push_mobility, spin_mobility;  ///< rates along and about the axes of unit impulses
    Eigen::Matrix2d slip_inverse;           ///< of the mobility along the tangents
    Matrix3d spin_inverse;
    Vector3d target, target_spin;  ///< target rates of the impulses
    double rising;                 ///< m/s: of the surface, along the normal
    double friction;
    double lever;   ///< m
    Vector6d size;  ///< along the axes, then about them

    /// Sets all but mobilities and responses, with impulses of zero: for a surface with a velocity (m/s) and
    /// an angular velocity (rad/s), between bodies the smaller of which is held by a sphere of a radius (m).
    void begin(const Matrix3d& along, const Vector3d& surface_velocity,
               const Vector3d& surface_angular_velocity, double friction_coefficient, double radius) noexcept;
    /// Computes the inverse mobilities. Call it once the mobilities are set.
    void invert() noexcept;
    /// Returns the impulse (N s) on the first body.
    [[nodiscard]] Vector3d push() const noexcept { return axes.transpose() * size.head<3>(); }
    /// Returns the work (J) of the surface.
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
        Matrix3d spin_by_push;       ///< rates about the axes of unit impulses along them
        Vector6d before, direction;  ///< of the sweep, and of the conjugate gradients
    };

    void prepare(std::span<ContactBody> bodies, std::span<const ContactBetween> points, std::size_t known);
    void sweep(std::span<ContactBody> bodies, std::span<const ContactBetween> points,
               bool backwards) noexcept;
    static void relax(std::span<ContactBody> bodies, const ContactBetween& point, Row& row) noexcept;
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
