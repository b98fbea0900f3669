#include "samara/core/contact/body_impulses.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Cholesky>

#include "samara/core/contact/contact_impulses.hpp"

namespace samara {
namespace {

// Chosen by trial, not derived, so that the tests GroundContact, GroundRest, Settling and Encounters pass: no
// energy is gained, nothing sinks, and bodies rest to the last bit.
constexpr int most_sweeps = 100;
constexpr int most_attempts = 12;   // to find which points stick
constexpr double converged = 1e-5;  // change of an impulse in a sweep, relative to the largest
constexpr double furthest = 10.0;   // extrapolation from a sweep, relative to its change
constexpr double sinking = 1e-7;    // speed of penetration that is tolerated, relative to the body's
// stiffness of the springs at sticking points, relative to the body's inertia there
constexpr double stiffness = 1e3;

/// A near point that no impulse acts on yet.
struct Candidate {
    const NearPoint* near;
    double allowed_speed;  ///< m/s, against the normal, relative to the ground
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

    /// Removes and returns the candidate that penetrates fastest, if any does by more than `tolerance` (m/s).
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
        take(fastest, taken);
        return true;
    }

    /// Removes and returns the candidate at a point that an impulse was found at, if it is near.
    bool take(const FoundImpulse& found, Candidate& taken) noexcept {
        for (std::size_t i = 0; i < count_; ++i) {
            const NearPoint& near = *candidates_[i].near;
            if (near.obstacle != found.obstacle || near.point != found.point) continue;
            take(i, taken);
            return true;
        }
        return false;
    }

  private:
    void take(std::size_t i, Candidate& taken) noexcept {
        taken = candidates_[i];
        candidates_[i] = candidates_[--count_];
    }

    /// The component of a velocity along a normal.
    struct Sinking {
        Sinking(const Vector3d& normal, const Vector6d& velocity)
            : linear(normal.dot(velocity.tail<3>())), angular(normal.cross(velocity.head<3>())) {}
        [[nodiscard]] double speed_of(const Vector3d& point) const { return linear + angular.dot(point); }
        double linear;
        Vector3d angular;
    };

    Vector3d up_;  // body axes
    std::array<Candidate, most_near_points> candidates_;
    std::size_t count_ = 0;
};

/// The impulses at a contact point of a single body.
struct Contact : ContactImpulses {
    using Rows = Eigen::Matrix<double, 3, 6>;

    const NearPoint* near;
    Rows along, about;  ///< J: maps a velocity to rates along and about the axes
    Held holds;
    Vector6d step;     ///< a change of the size
    Vector6d before;   ///< the size before a sweep
    Vector6d swept;    ///< the change in the last sweep that was extrapolated from
    Vector6d reached;  ///< the size after it

    /// Visits the impulses that are solved for together: each one's place in the size, its row of J, its
    /// mobility and its rate.
    template <typename Function>
    void for_each_held(const Function& function) const {
        for (int i = holds.slip ? 0 : 2; i < 3; ++i) {
            function(i, along.row(i), push_mobility(i, i), target[i]);
        }
        for (int i = 0; holds.spin && i < 3; ++i) {
            function(3 + i, about.row(i), spin_mobility(i, i), target_spin[i]);
        }
    }
    /// Holds those by springs at their target rates.
    void brace(const Vector6d& velocity, Matrix6d& stiff, Vector6d& pull) {
        step.setZero();
        for_each_held([&](int i, const auto& row, double mobility, double rate) {
            const double spring = stiffness / mobility;
            step[i] = -spring * (row.dot(velocity) - rate);
            stiff += row.transpose() * (spring * row);
            pull += row.transpose() * step[i];
        });
    }
    /// Adds the impulses of the springs, once the velocity has changed.
    void follow(const Vector6d& change) {
        for_each_held([&](int i, const auto& row, double mobility, double) {
            step[i] -= stiffness / mobility * row.dot(change);
        });
    }
};

/// Returns the share, up to 1, of a step that keeps a size within its bound, which changes with it.
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

/// The velocity of a single body, relative to the ground, while impulses act on it.
class ImpulseSolver {
  public:
    /// `surfaces_move`: whether the touched surfaces have their velocity, or stand still.
    ImpulseSolver(const TouchingBody& body, const Matrix3d& to_world, bool surfaces_move,
                  const Vector6d& velocity) noexcept
        : body_(body),
          to_world_(to_world),
          surfaces_move_(surfaces_move),
          tolerance_(sinking * (velocity.tail<3>().norm() +
                                body.contact_points.bounding_radius * velocity.head<3>().norm())),
          velocity_(velocity) {}

    /// Begins with impulses that were found at the same points before.
    void begin(const FoundImpulses& found, Candidates& candidates) noexcept {
        for (const FoundImpulse& one : found) {
            Candidate candidate;
            if (!candidates.take(one, candidate)) continue;
            add(candidate);
            add_impulse(contacts_[count_ - 1], one.size);
        }
    }

    void solve(Candidates& candidates) noexcept {
        for (int sweep = 0; sweep < most_sweeps; ++sweep) {
            Candidate next;
            if (count_ < most_contacts && candidates.take_fastest(velocity_, tolerance_, next)) {
                add(next);
                sweeps_of_all_ = 0;
            } else if (has_converged() && (sweep > 0 || count_ == 0)) {
                return;
            }
            change_ = largest_ = 0.0;
            for (std::size_t i = 0; i < count_; ++i) {
                Contact& contact = contacts_[i];
                contact.before = contact.size;
                const Vector3d rotation = velocity_.head<3>();
                const Vector3d slide = velocity_.tail<3>() + rotation.cross(contact.near->point);
                Vector6d change;
                contact.holds = contact.relax(slide, rotation, change);
                if (contact.holds.touches) push(contact, change);
                record_change(contact);
            }
            stick();
            if (!has_converged() && sweep + 1 < most_sweeps) extrapolate();
        }
    }

    [[nodiscard]] const Vector6d& velocity() const { return velocity_; }

    /// Returns the impulses times `share`.
    [[nodiscard]] ContactRecord record(double share) const noexcept {
        ContactRecord all;
        for (std::size_t i = 0; i < count_; ++i) {
            const Contact& contact = contacts_[i];
            const Vector3d impulse = share * contact.push();
            all.add({.impulse = impulse,
                     .strongest = impulse.norm(),
                     .point = contact.near->point,
                     .normal = contact.near->normal,
                     .obstacle = contact.near->obstacle});
        }
        return all;
    }

    /// Returns the impulses of the points that press.
    [[nodiscard]] FoundImpulses found() const noexcept {
        FoundImpulses all;
        for (std::size_t i = 0; i < count_; ++i) {
            const Contact& contact = contacts_[i];
            if (contact.size[2] > 0.0) all.add({contact.near->point, contact.near->obstacle, contact.size});
        }
        return all;
    }

    /// Returns the work (J) of the moving surfaces.
    [[nodiscard]] double work() const noexcept {
        double sum = 0.0;
        for (std::size_t i = 0; surfaces_move_ && i < count_; ++i) sum += contacts_[i].work();
        return sum;
    }

  private:
    void add(const Candidate& candidate) noexcept {
        const NearPoint& near = *candidate.near;
        const bool moves = surfaces_move_ && !near.on_ground();
        Contact& contact = contacts_[count_++];
        contact.near = &near;
        contact.swept.setZero();
        contact.reached.setZero();
        contact.begin(near.on_ground() ? to_world_ : axes_about(near.normal),
                      moves ? near.surface_velocity : Vector3d::Zero(),
                      moves ? near.surface_angular_velocity : Vector3d::Zero(), near.friction,
                      body_.contact_points.bounding_radius);
        contact.target.z() = -candidate.allowed_speed;
        contact.along << -contact.axes * skew(near.point), contact.axes;
        contact.about << contact.axes, Matrix3d::Zero();
        contact.first.push = body_.inverse_inertia * contact.along.transpose();
        contact.first.spin = body_.inverse_inertia * contact.about.transpose();
        contact.push_mobility = contact.along * contact.first.push;
        contact.spin_by_push = contact.about * contact.first.push;
        contact.spin_mobility = contact.about * contact.first.spin;
        contact.invert();
    }

    /// Solves for all pressing and sticking points together, as if by springs so stiff that they yield next
    /// to nothing. Where one would pull or leave friction's bounds it goes to that bound, is released, and
    /// the solution continues. Sweeps alone take hundreds where points are close together.
    void stick() noexcept {
        for (int attempt = 0; attempt < most_attempts; ++attempt) {
            Matrix6d stiff = body_.inertia;
            Vector6d pull = Vector6d::Zero();
            for_each_pressing([&](Contact& contact) { contact.brace(velocity_, stiff, pull); });
            const Vector6d change = Eigen::LLT<Matrix6d>(stiff).solve(pull);
            double share = 1.0;
            Contact* lets_go = nullptr;
            bool Held::*which = nullptr;
            const auto limit = [&](double most, Contact& contact, bool Held::*what) {
                if (most >= share) return;
                share = most;
                lets_go = &contact;
                which = what;
            };
            for_each_pressing([&](Contact& contact) {
                contact.follow(change);
                const Vector6d& size = contact.size;
                const Vector6d& step = contact.step;
                const auto limit_to = [&](const auto& part, const auto& its_step, double bound,
                                          bool Held::*what) {
                    if (!(contact.holds.*what)) return;
                    limit(share_within(part, its_step, bound * size[2], bound * step[2]), contact, what);
                };
                limit_to(size.head<2>(), step.head<2>(), contact.friction, &Held::slip);
                limit_to(size.tail<3>(), step.tail<3>(), contact.lever, &Held::spin);
                if (step[2] < 0.0) limit(-size[2] / step[2], contact, nullptr);
            });
            for_each_pressing([&](Contact& contact) { contact.size += share * contact.step; });
            velocity_ += share * change;
            if (lets_go == nullptr) return;
            if (which != nullptr) {
                lets_go->holds.*which = false;
                continue;
            }
            add_impulse(*lets_go, -lets_go->size);
        }
    }

    /// Goes on to where the impulses would not change any more if sweeps were linear, as the last two tell:
    /// sweeps alone leave two thirds of the error where points slide. Anderson, Iterative procedures for
    /// nonlinear integral equations, Journal of the ACM 12(4), 1965, with one sweep before.
    void extrapolate() noexcept {
        double product = 0.0;
        double square = 0.0;
        for (std::size_t i = 0; i < count_; ++i) {
            Contact& contact = contacts_[i];
            Vector6d weight;
            weight << contact.push_mobility.diagonal(), contact.spin_mobility.diagonal();
            const Vector6d swept = contact.size - contact.before;
            const Vector6d less = swept - contact.swept;
            product += weight.dot(less.cwiseProduct(swept));
            square += weight.dot(less.cwiseAbs2());
            contact.swept = swept;
        }
        const bool is_known = sweeps_of_all_++ > 0 && square > 0.0;
        const double more = is_known ? std::clamp(-product / square, -furthest, furthest) : 0.0;
        for (std::size_t i = 0; i < count_; ++i) {
            Contact& contact = contacts_[i];
            Vector6d step = more * (contact.size - contact.reached);
            step[2] = std::max(step[2], -contact.size[2]);
            contact.reached = contact.size;
            add_impulse(contact, step);
        }
    }

    void add_impulse(Contact& contact, const Vector6d& step) noexcept {
        contact.size += step;
        push(contact, step);
    }
    void push(const Contact& contact, const Vector6d& step) noexcept {
        velocity_ += contact.first.push * step.head<3>() + contact.first.spin * step.tail<3>();
    }

    template <typename Function>
    void for_each_pressing(const Function& function) noexcept {
        for (std::size_t i = 0; i < count_; ++i) {
            if (contacts_[i].size[2] > 0.0) function(contacts_[i]);
        }
    }

    /// Records the change of impulses in a sweep.
    void record_change(const Contact& contact) noexcept {
        const Vector6d change = contact.size - contact.before;
        const auto add = [&](double by, double to, double mobility) {
            change_ = std::max(change_, by * mobility);
            largest_ = std::max(largest_, to * mobility);
        };
        add(change[2] * change[2], contact.size[2] * contact.size[2], contact.push_mobility(2, 2));
        add(change.head<2>().squaredNorm(), contact.size.head<2>().squaredNorm(),
            contact.push_mobility(0, 0) + contact.push_mobility(1, 1));
        add(change.tail<3>().squaredNorm(), contact.size.tail<3>().squaredNorm(),
            contact.spin_mobility.trace());
    }
    [[nodiscard]] bool has_converged() const noexcept { return change_ <= converged * converged * largest_; }

    const TouchingBody& body_;
    const Matrix3d& to_world_;
    bool surfaces_move_;
    double tolerance_;  ///< m/s: of penetration
    std::array<Contact, most_contacts> contacts_;
    std::size_t count_ = 0;
    int sweeps_of_all_ = 0;  ///< since the last point was added
    Vector6d velocity_;
    double change_ = 0.0;   ///< J: twice the energy of the largest change of an impulse in a sweep
    double largest_ = 0.0;  ///< J: likewise of the largest impulse
};

}  // namespace

Vector6d after_impulses(const TouchingBody& body, const ContactSet& near, const Approach& approach,
                        const Vector6d& velocity, FoundImpulses* found, ContactRecord* record) noexcept {
    Candidates candidates(near, approach);
    ImpulseSolver solver(body, near.to_world(), !approach.drift, velocity);
    if (found != nullptr) solver.begin(*found, candidates);
    solver.solve(candidates);
    if (found != nullptr) *found = solver.found();
    const Vector6d change = solver.velocity() - velocity;
    const Vector6d momentum = body.inertia * change;
    const double share = passive_share(velocity.dot(momentum) - solver.work(), change.dot(momentum));
    if (record != nullptr) *record = solver.record(share);
    return velocity + (share == 1.0 ? change : Vector6d(share * change));
}

}  // namespace samara
