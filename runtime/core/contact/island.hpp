#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "samara/core/collision/free_flight.hpp"
#include "samara/core/collision/hull_pair.hpp"
#include "samara/core/collision/obstacle_contact.hpp"
#include "samara/core/contact/contact_impulses.hpp"
#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/physics/contact_record.hpp"

namespace samara {

/// A body among others that it may touch. Velocities are (omega, v) of the centre of mass, in world axes and
/// relative to the ground.
struct IslandBody {
    const TouchingBody* body;  ///< what it touches with, at its size
    const std::vector<HullFace>* faces;
    int number;               ///< of the flight: what records of contacts call it
    BodyPlace begin;          ///< before the step
    Vector6d begin_velocity;  ///< the same
    BodyPlace end;            ///< after it; at first as if nothing were in its way
    Vector6d end_velocity;    ///< the same
    bool touched = false;     ///< whether anything was, so that the end is another than it was at first
    bool rests = false;       ///< whether it lies still at the end
    ContactRecord* record = nullptr;  ///< gets what it met; null: not asked for
};

/// What bodies of the island may touch besides each other.
struct IslandGround {
    std::optional<double> height;            ///< m: of level ground
    const ObstacleSet* obstacles = nullptr;  ///< null: none
    double time = 0.0;                       ///< s: when the step begins
    Vector3d flow = Vector3d::Zero();        ///< m/s: of the fluid, relative to the ground
};

/// How far (m) two bodies that touch stay apart, over the smaller bounding radius: what keeps the plane
/// between them well defined. Chosen, far below what a picture shows.
inline constexpr double skin = 1e-3;
/// What must be left of it at the least.
inline constexpr double closest = 0.05;

/// No point of a body within a radius (m) of its centre of mass is faster (m/s). `velocity`: (omega, v).
inline double speed_of_points(const Vector6d& velocity, double radius) {
    return velocity.tail<3>().norm() + radius * velocity.head<3>().norm();
}

/// A matrix of (omega, v), such as an inertia, from body axes to the world's.
inline Matrix6d in_world(const Matrix6d& of_body, const Quaterniond& orientation) {
    Matrix6d to_world = Matrix6d::Zero();
    to_world.topLeftCorner<3, 3>() = to_world.bottomRightCorner<3, 3>() = orientation.toRotationMatrix();
    return to_world * of_body * to_world.transpose();
}

/// Steps bodies that may touch each other. Keeps its memory from step to step.
///
/// The step is cut into parts, in which no body turns by more than a quarter of a radian, passes another by
/// more than half its radius or would fall from a standstill by more than a two-hundredth of it. Where two
/// that come fast from afar hit, the part ends, and they are struck there and then: so are the first of a
/// step, the fewer the more bodies there are. In each part the bodies get their share of what the step does
/// to them alone, and joint impulses (contact_impulses.hpp), at the points where they may meet within the
/// part, allow each gap to close and no more; with the velocities that these leave the bodies fly freely
/// (free_flight.hpp). So much is Moreau's stepping: whatever the step, contact takes energy and gives none.
/// Two are pushed at one place of the world, so that they keep their momentum and angular momentum. Where two
/// come through each other at other points, those where they first touch on their way are added, and the
/// impulses found anew. What turning still brings too close is moved apart, and where that does not keep two
/// from passing through each other the part is halved, or both stop on their way; what they win by it is paid
/// for in kinetic energy.
///
/// A step does so much work for each body and no more: several times what heaps take, and little where even
/// the most parts are too few to follow the motion, as beside a vortex that throws bodies about by many of
/// their sizes. Where it is spent, those that may meet stay for the rest of the step where they have come to.
class IslandStep {
  public:
    using Pair = std::pair<std::size_t, std::size_t>;

    /// `pairs`: of bodies of the island that may touch within the step of `time_step` (s), the lower number
    /// first.
    void take(std::span<IslandBody> island_bodies, std::span<const Pair> pairs, const IslandGround& ground,
              double time_step);

  private:
    struct Mover {
        BodyPlace before, place;             ///< when the part began, and now
        BodyPlace alone;                     ///< where it would be after the part if nothing were in its way
        Vector6d velocity_before, velocity;  ///< when the part began, and now
        Vector6d own_velocity;  ///< when the part began, if nothing had met it: omega in body axes
        Vector6d gain;          ///< of it a second, so that spin keeps its energy
        Vector6d by_itself;     ///< of this what comes without loads in the part: world axes as it began
        Vector3d load;          ///< N: what pulls it
        double energy_before, energy;  ///< J: when the part began, and after the impulses
        ContactRecord record;          ///< in the step
        Vector3d shift;                ///< m: by which it was moved apart
        bool pressed;                  ///< whether anything pushed it, in this part or before
        bool overlaps;                 ///< another, when the step ended: it is still to come out
        int held;  ///< 1: it stopped on its way, 2: it stayed where the part began; 0: neither
    };
    /// Two that may meet in a part.
    struct Near {
        std::size_t first, second;
        Vector3d normal;
        double gap;
        double apart;  ///< m: the gap that they keep
        bool waits;    ///< whether they are to meet where they do, not before

        /// Whether there was a gap when the part began: what overlapped, since it started so, is to come out.
        [[nodiscard]] bool began_separated() const { return gap > 0.0; }
        /// The gap (m) that must be left.
        [[nodiscard]] double least() const;
    };

    void find_overlaps();
    void keep_angular_momentum(const Near& near, const Vector3d& first_shift, const Vector3d& second_shift);
    [[nodiscard]] double parts_wanted(std::span<const Pair> pairs, double time_step) const;
    bool take_parts(std::span<const Pair> pairs, const IslandGround& ground, double time_step, int parts);
    [[nodiscard]] bool turned_far(double time_step) const;
    [[nodiscard]] bool is_spent() const;
    void start(double time_step);
    void begin_part(double time_step);
    void try_part(std::span<const Pair> pairs, const IslandGround& ground, double time, double part,
                  bool ends_step, bool may_stop);
    void part_all(const IslandGround& ground, double time, double part);
    void take_back();
    [[nodiscard]] bool all_come_through() const;
    void find_pairs(std::span<const Pair> pairs, double time_step, bool may_stop);
    [[nodiscard]] double free_of_hits() const;
    void find_ground(const IslandGround& ground, double time, double time_step);
    void push(double time_step, std::size_t known);
    void move(double time_step, bool ends_step);
    bool find_passages(double time_step);
    void part_pairs(double time_step, int round, bool& moved);
    void part_from_ground(const IslandGround& ground, double time, double time_step, bool& moved);
    void hold_back();
    void slow(std::size_t i, double most);
    void pay();
    void note(double time);
    void settle(double time_step);
    [[nodiscard]] PlacedMotion flown(std::size_t i, Vector6d velocity, double time) const;
    [[nodiscard]] Vector6d changed_by_itself(std::size_t i, const Vector6d& velocity, double time) const;
    [[nodiscard]] static Vector6d fed(const Mover& mover, double time);
    [[nodiscard]] CollisionHull hull(std::size_t i, const BodyPlace& place) const;
    [[nodiscard]] bool passes_by(const Near& near) const;
    [[nodiscard]] bool separated_before(const Near& near, const Vector3d& normal, double gap) const;
    [[nodiscard]] double free_share(const Near& near) const;
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
    mutable std::size_t work_ = 0;  ///< done in the step: pairs of hulls looked at, points pushed at
    std::size_t most_work_ = 0;
};

}  // namespace samara
