#include "samara/core/contact/contact_impulses.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace samara {
namespace {

// Chosen by trial, not derived: what they must give, no energy, no sinking and rest to the last bit, is what
// the tests GroundContact, GroundRest and Settling hold them to.
constexpr int most_sweeps = 100;
constexpr int most_attempts = 12;   // to find what holds
constexpr double converged = 1e-6;  // change of an impulse in a sweep, over the largest
constexpr double settling = 1e-2;   // the same, from which on further points are looked for
constexpr double sinking = 1e-7;    // speed of a point through what it meets that is let be, over the body's
constexpr double stiffness = 1e3;   // of what holds the points that stick, over the body's inertia there

using Block = Eigen::Matrix<double, 3, 6>;

/// Impulses that act on the body together, along the rows of a block (two tangents and the normal; over the
/// ground the world's x, y, z) and within a length that the normal impulse bounds.
struct Impulses {
    Block along;                           ///< J: velocity -> rates along the rows
    Eigen::Matrix<double, 6, 3> response;  ///< K^-1 J^T
    Matrix3d mobility;                     ///< J K^-1 J^T
    Vector3d meant;  ///< rates that the impulses bring about: those of the surface, along the rows
    Vector3d size;
    Vector3d step;  ///< a change of the size
    bool holds;     ///< within the bound: what it holds is at rest

    void set(const Block& rows, const Vector3d& rates, const Matrix6d& inverse_inertia) {
        along = rows;
        meant = rates;
        response = inverse_inertia * rows.transpose();
        mobility = rows * response;
        size.setZero();
        holds = false;
    }

    /// Holds the rows from `first` on by springs at the rates that are meant.
    void brace(int first, const Vector6d& velocity, Matrix6d& stiff, Vector6d& pull) {
        step.setZero();
        for (int row = first; row < 3; ++row) {
            const double spring = stiffness / mobility(row, row);
            const double rate = along.row(row).dot(velocity) - meant[row];
            step[row] = -spring * rate;
            stiff += along.row(row).transpose() * (spring * along.row(row));
            pull += along.row(row).transpose() * step[row];
        }
    }
    /// What the springs push with, once the velocity has changed.
    void follow(int first, const Vector6d& change) {
        for (int row = first; row < 3; ++row) {
            step[row] -= stiffness / mobility(row, row) * along.row(row).dot(change);
        }
    }
};

struct Contact {
    const NearPoint* near;
    Matrix3d axes;  ///< along whose rows `push` acts
    double friction;
    double rising;  ///< m/s: of the surface, along the normal
    Impulses push;  ///< friction along x and y, the normal impulse along z
    Impulses turn;  ///< rolling resistance
};

/// The share, up to 1, of a step that keeps a size within its bound, which changes with it.
template <typename Part>
double share_within(const Part& size, const Part& step, double bound, double bound_step) {
    // |size + s step|^2 <= (bound + s bound_step)^2
    const double a = step.squaredNorm() - bound_step * bound_step;
    const double b = size.dot(step) - bound * bound_step;
    const double c = std::min(0.0, size.squaredNorm() - bound * bound);
    if (a + 2.0 * b + c <= 0.0 && bound + bound_step >= 0.0) return 1.0;
    const double root = std::sqrt(std::max(0.0, b * b - a * c));
    // The smallest root that is not negative, without cancellation.
    if (b >= 0.0) return b + root > 0.0 ? std::clamp(-c / (b + root), 0.0, 1.0) : 0.0;
    return a > 0.0 ? std::clamp((root - b) / a, 0.0, 1.0) : 1.0;
}

/// A near point that no impulse acts on yet.
struct Candidate {
    const NearPoint* near;
    double allowed_speed;  ///< against the normal, relative to the ground
};

/// The points within the margin.
class Candidates {
  public:
    Candidates(const ContactSet& near, const Approach& approach) noexcept : up_(near.to_world().row(2)) {
        for (const NearPoint& point : near) {
            if (point.gap > approach.margin) continue;
            const double left = std::max(0.0, point.gap - approach.touching) / approach.time_step;
            const double rising = point.normal.dot(point.surface_velocity);
            double allowed = left - rising;
            if (approach.drift) {
                const Vector6d& drift = *approach.drift;
                allowed = std::max(
                    0.0,
                    left + point.normal.dot(drift.tail<3>() + drift.head<3>().cross(point.point)) - rising);
            }
            candidates_[count_++] = {&point, allowed};
        }
    }

    /// Takes out the candidate that sinks fastest, if any does by more than `tolerance` (m/s).
    bool take_fastest(const Vector6d& velocity, double tolerance, Candidate& taken) noexcept {
        const Sinking over_ground(up_, velocity);
        std::size_t fastest = count_;
        double worst = -tolerance;
        for (std::size_t i = 0; i < count_; ++i) {
            const NearPoint& near = *candidates_[i].near;
            const Sinking sinking_there = near.on_ground() ? over_ground : Sinking(near.normal, velocity);
            const double speed = sinking_there.speed_of(near.point) + candidates_[i].allowed_speed;
            if (speed >= worst) continue;
            worst = speed;
            fastest = i;
        }
        if (fastest == count_) return false;
        taken = candidates_[fastest];
        candidates_[fastest] = candidates_[--count_];
        return true;
    }

  private:
    /// What a velocity is along a normal.
    struct Sinking {
        Sinking(const Vector3d& normal, const Vector6d& velocity)
            : moving(normal.dot(velocity.tail<3>())), turning(normal.cross(velocity.head<3>())) {}
        [[nodiscard]] double speed_of(const Vector3d& point) const { return moving + turning.dot(point); }
        double moving;
        Vector3d turning;
    };

    Vector3d up_;  // body axes
    std::array<Candidate, most_near_points> candidates_;
    std::size_t count_ = 0;
};

/// Two tangents and the normal, as rows in body axes.
Matrix3d axes_of(const NearPoint& near, const Matrix3d& to_world) noexcept {
    if (near.on_ground()) return to_world;
    Matrix3d axes;
    axes.row(0) = near.normal.unitOrthogonal().transpose();
    axes.row(1) = near.normal.cross(axes.row(0).transpose()).transpose();
    axes.row(2) = near.normal.transpose();
    return axes;
}

/// The velocity relative to the ground while impulses act on it.
class ImpulseSolver {
  public:
    /// `surfaces_move`: whether what bodies meet has its velocity, or stands still.
    ImpulseSolver(const TouchingBody& body, const Matrix3d& to_world, bool surfaces_move,
                  const Vector6d& velocity) noexcept
        : body_(body), to_world_(to_world), surfaces_move_(surfaces_move), velocity_(velocity) {}

    void solve(Candidates& candidates) noexcept {
        const double radius = body_.contact_points.bounding_radius;
        const double tolerance = sinking * (velocity_.tail<3>().norm() + radius * velocity_.head<3>().norm());
        for (int sweep = 0; sweep < most_sweeps; ++sweep) {
            if (change_ <= settling * largest_) {
                Candidate next;
                if (count_ < most_contacts && candidates.take_fastest(velocity_, tolerance, next)) {
                    add(next);
                } else if (change_ <= converged * largest_) {
                    return;
                }
            }
            change_ = largest_ = 0.0;
            for (std::size_t i = 0; i < count_; ++i) {
                Contact& contact = contacts_[i];
                press(contact.push);
                const double normal = contact.push.size.z();
                hold<2>(contact.push, contact.friction * normal);
                hold<3>(contact.turn, rolling_resistance * radius * normal);
            }
            stick(radius);
        }
    }

    [[nodiscard]] const Vector6d& velocity() const { return velocity_; }

    /// What the impulses are, times `share`.
    [[nodiscard]] ContactRecord record(double share) const noexcept {
        ContactRecord all;
        for (std::size_t i = 0; i < count_; ++i) {
            const Contact& contact = contacts_[i];
            const Vector3d impulse = share * (contact.axes.transpose() * contact.push.size);
            all.add({.impulse = impulse,
                     .strongest = impulse.norm(),
                     .point = contact.near->point,
                     .normal = contact.near->normal,
                     .obstacle = contact.near->obstacle});
        }
        return all;
    }

    /// The work (J) of the surfaces that move.
    [[nodiscard]] double work() const noexcept {
        double sum = 0.0;
        if (!surfaces_move_) return sum;
        for (std::size_t i = 0; i < count_; ++i) {
            const Contact& contact = contacts_[i];
            sum += contact.push.size.head<2>().dot(contact.push.meant.head<2>()) +
                   contact.push.size.z() * contact.rising + contact.turn.size.dot(contact.turn.meant);
        }
        return sum;
    }

  private:
    void add(const Candidate& candidate) noexcept {
        const NearPoint& near = *candidate.near;
        const Matrix3d axes = axes_of(near, to_world_);
        const bool moves = surfaces_move_ && !near.on_ground();
        Vector3d rates = moves ? Vector3d(axes * near.surface_velocity) : Vector3d::Zero();
        const Vector3d turning = moves ? Vector3d(axes * near.surface_turning) : Vector3d::Zero();
        Contact& contact = contacts_[count_++];
        contact.near = &near;
        contact.axes = axes;
        contact.friction = near.friction;
        contact.rising = rates.z();
        rates.z() = -candidate.allowed_speed;
        Block rows;
        rows << -axes * skew(near.point), axes;
        contact.push.set(rows, rates, body_.inverse_inertia);
        rows << axes, Matrix3d::Zero();
        contact.turn.set(rows, turning, body_.inverse_inertia);
    }

    /// Lets the point come down no faster than is allowed.
    void press(Impulses& impulses) noexcept {
        const double mobility = impulses.mobility(2, 2);
        const double speed = impulses.along.row(2).dot(velocity_) - impulses.meant.z();
        const double before = impulses.size.z();
        impulses.size.z() = std::max(0.0, before - speed / mobility);
        velocity_ += impulses.response.col(2) * (impulses.size.z() - before);
        note(std::abs(impulses.size.z() - before), impulses.size.z(), mobility);
    }

    /// Stops the first N rates where impulses within `bound` can, else slows them.
    template <int N>
    void hold(Impulses& impulses, double bound) noexcept {
        using Part = Eigen::Matrix<double, N, 1>;
        const Eigen::Matrix<double, N, N> mobility = impulses.mobility.topLeftCorner<N, N>();
        const Part rates = impulses.along.topRows<N>() * velocity_ - impulses.meant.head<N>();
        const Part before = impulses.size.head<N>();
        Part after = before - mobility.inverse() * rates;
        impulses.holds = after.norm() <= bound;
        if (!impulses.holds) {
            // A step of projected gradients: no longer than the mobility's trace allows, so it never gains.
            after = before - rates / mobility.trace();
            const double size = after.norm();
            if (size > bound) after *= bound / size;
        }
        impulses.size.head<N>() = after;
        velocity_ += impulses.response.leftCols<N>() * (after - before);
        note((after - before).norm(), after.norm(), mobility.trace());
    }

    /// Solves at once for all points that press and all that is held, as if by springs so stiff that they
    /// leave next to nothing. Where one would pull or leave friction's bounds it goes as far as
    /// that, lets go of it, and goes on. Sweeps alone take hundreds where points stand close together.
    void stick(double radius) noexcept {
        const double lever = rolling_resistance * radius;
        for (int attempt = 0; attempt < most_attempts; ++attempt) {
            Matrix6d stiff = body_.inertia;
            Vector6d pull = Vector6d::Zero();
            for_each_pressing([&](Contact& contact) {
                contact.push.brace(contact.push.holds ? 0 : 2, velocity_, stiff, pull);
                contact.turn.brace(contact.turn.holds ? 0 : 3, velocity_, stiff, pull);
            });
            const Vector6d change = Eigen::LLT<Matrix6d>(stiff).solve(pull);
            double share = 1.0;
            Contact* lets_go = nullptr;
            Impulses* which = nullptr;
            const auto limit = [&](double most, Contact& contact, Impulses* impulses) {
                if (most >= share) return;
                share = most;
                lets_go = &contact;
                which = impulses;
            };
            for_each_pressing([&](Contact& contact) {
                contact.push.follow(contact.push.holds ? 0 : 2, change);
                contact.turn.follow(contact.turn.holds ? 0 : 3, change);
                const double normal = contact.push.size.z();
                const double more = contact.push.step.z();
                if (contact.push.holds) {
                    const Eigen::Vector2d size = contact.push.size.head<2>();
                    const Eigen::Vector2d step = contact.push.step.head<2>();
                    limit(share_within(size, step, contact.friction * normal, contact.friction * more),
                          contact, &contact.push);
                }
                if (contact.turn.holds) {
                    limit(share_within(contact.turn.size, contact.turn.step, lever * normal, lever * more),
                          contact, &contact.turn);
                }
                if (more < 0.0) limit(-normal / more, contact, nullptr);
            });
            for_each_pressing([&](Contact& contact) {
                contact.turn.size += share * contact.turn.step;
                contact.push.size += share * contact.push.step;
            });
            velocity_ += share * change;
            if (lets_go == nullptr) return;
            if (which != nullptr) {
                which->holds = false;
            } else {
                release(*lets_go);
            }
        }
    }

    void release(Contact& contact) noexcept {
        velocity_ -= contact.push.response * contact.push.size + contact.turn.response * contact.turn.size;
        contact.push.size.setZero();
        contact.turn.size.setZero();
    }

    template <typename Function>
    void for_each_pressing(const Function& function) noexcept {
        for (std::size_t i = 0; i < count_; ++i) {
            if (contacts_[i].push.size.z() > 0.0) function(contacts_[i]);
        }
    }

    void note(double change, double size, double mobility) noexcept {
        change_ = std::max(change_, change * std::sqrt(mobility));
        largest_ = std::max(largest_, size * std::sqrt(mobility));
    }

    const TouchingBody& body_;
    const Matrix3d& to_world_;
    bool surfaces_move_;
    std::array<Contact, most_contacts> contacts_;
    std::size_t count_ = 0;
    Vector6d velocity_;
    double change_ = 0.0;
    double largest_ = 0.0;
};

/// The share of the change that was found which adds no energy beyond the `work` (J) of surfaces that move:
/// friction that was bounded by a normal impulse which later fell may add a little.
double passive_share(const TouchingBody& body, const Vector6d& velocity, const Vector6d& change,
                     double work) {
    const Vector6d momentum = body.inertia * change;
    const double gain = velocity.dot(momentum) - work;
    const double square = change.dot(momentum);
    if (gain + 0.5 * square <= 0.0) return 1.0;
    return std::max(0.0, -gain / square);
}

}  // namespace

Vector6d after_impulses(const TouchingBody& body, const ContactSet& near, const Approach& approach,
                        const Vector6d& velocity, ContactRecord* met) noexcept {
    Candidates candidates(near, approach);
    ImpulseSolver solver(body, near.to_world(), !approach.drift, velocity);
    solver.solve(candidates);
    const Vector6d change = solver.velocity() - velocity;
    const double share = passive_share(body, velocity, change, solver.work());
    if (met != nullptr) *met = solver.record(share);
    return velocity + (share == 1.0 ? change : Vector6d(share * change));
}

}  // namespace samara
