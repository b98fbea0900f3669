#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "samara/core/collision/free_flight.hpp"
#include "samara/core/collision/hull_pair.hpp"
#include "samara/core/collision/obstacle_contact.hpp"
#include "samara/core/contact/joint_impulses.hpp"
#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/physics/contact_record.hpp"

namespace samara {

/// A body among others that it may touch. Velocities are (omega, v) of the centre of mass, in world axes and
/// relative to the ground.
struct IslandBody {
    const TouchingBody* body;  ///< its hull and inertia, at its size
    const std::vector<HullFace>* faces;
    int number;                       ///< its number in the simulation, for records of contacts
    BodyPlace begin;                  ///< before the step
    Vector6d begin_velocity;          ///< likewise
    BodyPlace end;                    ///< after it; at first without contact
    Vector6d end_velocity;            ///< likewise
    bool touched = false;             ///< whether it touched anything, so that its end has changed
    bool rests = false;               ///< whether it is at rest at the end
    ContactRecord* record = nullptr;  ///< receives its contacts; null: not asked for
};

/// The surroundings that bodies of the island may touch.
struct IslandGround {
    std::optional<double> height;            ///< m: of level ground
    const ObstacleSet* obstacles = nullptr;  ///< null: none
    double time = 0.0;                       ///< s: when the step begins
    Vector3d flow = Vector3d::Zero();        ///< m/s: of the fluid, relative to the ground
};

/// The distance that two touching bodies keep, relative to the smaller bounding radius: it keeps the plane
/// between them well defined. Chosen, far below what a picture shows.
inline constexpr double skin = 1e-3;
/// The least share of the skin that must remain.
inline constexpr double closest = 0.05;

/// Returns an upper bound of the speed (m/s) of the points of a body within a radius (m) of its centre of
/// mass. `velocity`: (omega, v).
inline double speed_of_points(const Vector6d& velocity, double radius) {
    return velocity.tail<3>().norm() + radius * velocity.head<3>().norm();
}

/// Returns a matrix of (omega, v), such as an inertia, rotated from body axes to the world's.
inline Matrix6d in_world(const Matrix6d& of_body, const Quaterniond& orientation) {
    Matrix6d to_world = Matrix6d::Zero();
    to_world.topLeftCorner<3, 3>() = to_world.bottomRightCorner<3, 3>() = orientation.toRotationMatrix();
    return to_world * of_body * to_world.transpose();
}

/// Steps bodies that may touch each other. Keeps its memory from step to step.
///
/// The step is cut into substeps, in which no body rotates by more than a quarter of a radian, passes another
/// by more than half its radius or would fall from a standstill by more than a two-hundredth of it. Where two
/// fast bodies from afar collide, the substep ends, and their impulses act there and then: so do the first
/// collisions of a step, the fewer the more bodies there are. In each substep the bodies get their share of
/// the change in their steps alone, and joint impulses (joint_impulses.hpp), at the points where they may
/// touch within the substep, allow each gap to close and no more; with the resulting velocities the bodies
/// move freely (free_flight.hpp). This is Moreau's stepping: whatever the step, contact takes energy and
/// gives none. The impulses on two bodies act at one place of the world, so that momentum and angular
/// momentum are conserved. Where two would pass through each other at other points, the points where they
/// first touch on their paths are added, and the impulses solved for again. Bodies that rotation still brings
/// too close are separated, and where that does not keep two from passing through each other the substep is
/// halved, or both stop on their paths; the energy that they gain by it is taken from their motion, as far as
/// they have any.
///
/// The work of a step is limited for each body: to several times that of heaps, and to little where even the
/// most substeps are too few to follow the motion, as beside a vortex that throws bodies about by many of
/// their sizes. Once it is spent, bodies that may touch stay where they are for the rest of the step.
class IslandStep {
  public:
    using Pair = std::pair<std::size_t, std::size_t>;

    /// Takes one step of `time_step` (s). `pairs`: of bodies of the island that may touch within it, the
    /// lower number first.
    void take(std::span<IslandBody> island_bodies, std::span<const Pair> pairs, const IslandGround& ground,
              double time_step);

  private:
    struct Mover {
        BodyPlace before, place;             ///< when the substep began, and now
        BodyPlace alone;                     ///< after the substep, without contact
        Vector6d velocity_before, velocity;  ///< when the substep began, and now
        Vector6d own_velocity;               ///< when the substep began, without contact: omega in body axes
        /// 1/s: its rate of change by the step alone, constant in body axes so that spin keeps its energy
        Vector6d gain;
        Vector6d free_change;  ///< of it the change without loads in the substep: world axes as it began
        Vector3d load;         ///< N: the load on it
        double energy_before, energy;  ///< J: when the substep began, and after the impulses
        ContactRecord record;          ///< of the step
        Vector3d shift;                ///< m: its displacement by separation
        bool pressed;   ///< whether an impulse or a separation acted on it, in this substep or before
        bool overlaps;  ///< whether it overlaps another when the step ends: it is still to be separated
        int held;       ///< 1: it stopped on its path, 2: it stayed where the substep began; 0: neither
        CollisionHull hull_before;       ///< when the substep began
        mutable CollisionHull hull_now;  ///< at its place, where `hull_of` is `path`
        std::size_t path = 0;  ///< the number of its path in the substep: another one after each change
        mutable std::size_t hull_of = 0;
    };
    /// A share of two bodies' paths in a substep (free_share()), and the work of finding it.
    struct FreeShare {
        std::size_t first_path = 0, second_path = 0;  ///< of the bodies; 0: not known
        double share = 0.0;
        std::size_t work = 0;
    };
    /// Two bodies that may touch in a substep.
    struct Near {
        std::size_t first, second;
        Vector3d normal;
        double gap;
        double apart;                  ///< m: the gap that they keep
        bool waits;                    ///< whether they collide where their paths do, not before
        mutable FreeShare known = {};  ///< of their paths now; of overlapping bodies the paths alone

        /// Returns whether there was a gap when the substep began. Bodies that overlapped then are separated.
        [[nodiscard]] bool began_separated() const { return gap > 0.0; }
        /// Returns the least gap (m) that must remain.
        [[nodiscard]] double least() const;
    };

    void find_overlaps();
    void keep_angular_momentum(const Near& near, const Vector3d& first_shift, const Vector3d& second_shift);
    [[nodiscard]] double substeps_wanted(std::span<const Pair> pairs, double time_step) const;
    bool take_substeps(std::span<const Pair> pairs, const IslandGround& ground, double time_step,
                       int substeps);
    [[nodiscard]] bool rotated_far(double time_step) const;
    [[nodiscard]] bool is_spent() const;
    void start(double time_step);
    void begin_substep(double time_step);
    void try_substep(std::span<const Pair> pairs, const IslandGround& ground, double time, double substep,
                     bool ends_step, bool may_stop);
    void separate_all(const IslandGround& ground, double time, double substep);
    void restore();
    [[nodiscard]] bool all_are_free() const;
    void find_pairs(std::span<const Pair> pairs, double time_step, bool may_stop);
    [[nodiscard]] double share_free_of_hits() const;
    void find_ground(const IslandGround& ground, double time, double time_step);
    void solve_impulses(double time_step, std::size_t known);
    void move(double time_step, bool ends_step);
    bool find_passages(double time_step);
    void separate_pairs(double time_step, bool& moved);
    void separate_from_ground(const IslandGround& ground, double time, double time_step, bool& moved);
    void hold_back();
    void limit_energy(std::size_t i, double most);
    void balance_energy();
    void record_contacts(double time);
    void settle(double time_step);
    [[nodiscard]] PlacedMotion free_motion(std::size_t i, Vector6d velocity, double time) const;
    [[nodiscard]] Vector6d free_velocity_change(std::size_t i, const Vector6d& velocity, double time) const;
    [[nodiscard]] static Vector6d loaded_velocity(const Mover& mover, double time);
    [[nodiscard]] CollisionHull hull(std::size_t i, const BodyPlace& place) const;
    [[nodiscard]] CollisionHull hull_at(std::size_t i, double share) const;
    void change_path(Mover& mover) { mover.path = ++paths_; }
    [[nodiscard]] bool passes_by(const Near& near) const;
    [[nodiscard]] bool separated_before(const Near& near, const Vector3d& normal, double gap) const;
    [[nodiscard]] double free_share(const Near& near) const;
    [[nodiscard]] double found_free_share(const Near& near) const;
    [[nodiscard]] double travel_of(std::size_t i) const;
    [[nodiscard]] BodyPlace place_at(std::size_t i, double share) const;
    void add_points(const Near& near, const HullContact& record, double share, double time_step);
    [[nodiscard]] double energy_of(std::size_t i, const BodyPlace& place, const Vector6d& velocity) const;

    std::span<IslandBody> island_bodies_;
    Vector3d flow_ = Vector3d::Zero();
    std::vector<Mover> movers_;
    std::vector<ContactBody> bodies_;
    std::vector<ContactBetween> points_;
    std::vector<Near> near_;
    ContactSolver impulses_;
    mutable std::size_t work_ = 0;  ///< spent in the step: pairs of hulls checked, points with impulses
    std::size_t most_work_ = 0;
    std::size_t paths_ = 0;  ///< of all bodies so far
};

}  // namespace samara
