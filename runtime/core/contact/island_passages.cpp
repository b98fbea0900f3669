// The passages and collisions of two bodies of the island within a substep.

#include <algorithm>

#include <Eigen/Cholesky>

#include "samara/core/collision/contact_set.hpp"
#include "samara/core/contact/island.hpp"

namespace samara {
namespace {

// Chosen by trial, so that the tests Encounters and BroadphaseStability pass.
// precision of the place where two touch, relative to their path, and to the skin where that is coarser
constexpr double finest_passage_share = 1e-3;
constexpr double coarsest_passage_share = 0.25;
constexpr double passage_precision = 0.05;
// displacement of two in a substep, relative to the radius, from which they collide where their paths do
constexpr double fast_travel = 0.02;
// relative to the skin: the distance to which bodies that come too close are separated
constexpr double separated_to = 0.2;
// relative to the radius: the most displacement that separates two which rotation brought together
constexpr double most_shift = 0.06;
// relative to the skin: the displacement that reduces an overlap in a substep
constexpr double most_removed_overlap = 0.5;
// 1/s, in radii: the speed at which overlapping bodies are separated
constexpr double separation_speed = 1.0;

}  // namespace

/// Finds the pairs that may touch in a substep. `may_stop`: whether fast bodies collide where their paths do.
void IslandStep::find_pairs(std::span<const Pair> pairs, double time_step, bool may_stop) {
    near_.clear();
    const auto fastest = [&](std::size_t i) {
        return std::max(speed_of_points(movers_[i].velocity, bodies_[i].radius),
                        speed_of_points(bodies_[i].velocity, bodies_[i].radius));
    };
    double fastest_of_all = 0.0;
    for (std::size_t i = 0; i < island_bodies_.size(); ++i)
        fastest_of_all = std::max(fastest_of_all, fastest(i));
    for (const auto& [a, b] : pairs) {
        const double apart = skin * std::min(bodies_[a].radius, bodies_[b].radius);
        // Impulses may stop either, or double its rotation; and a body that others strike comes as far as
        // they.
        const double reach = 2.0 * time_step * (fastest(a) + fastest(b)) + 2.0 * apart;
        const double reach_if_struck = 4.0 * time_step * fastest_of_all + 2.0 * apart;
        const double distance = (movers_[a].place.position - movers_[b].place.position).norm();
        if (distance - bodies_[a].radius - bodies_[b].radius > reach_if_struck) continue;
        const CollisionHull first = hull(a, movers_[a].place);
        const CollisionHull second = hull(b, movers_[b].place);
        const PairSeparation now = pair_separation(first, second, reach_if_struck);
        ++work_;
        if (now.gap > reach_if_struck) continue;
        const double travel = time_step * (fastest(a) + fastest(b));
        const bool waits = may_stop && now.gap > 2.0 * apart &&
                           travel > fast_travel * std::min(bodies_[a].radius, bodies_[b].radius);
        near_.push_back({a, b, now.normal, now.gap, apart, waits});
        if (waits || now.gap > reach || passes_by(near_.back())) continue;
        add_points(near_.back(), hull_contact(first, second, now, reach), 0.0, time_step);
    }
}

/// Returns a bound of how far (m) the points of a body move in the substep.
double IslandStep::travel_of(std::size_t i) const {
    const Mover& mover = movers_[i];
    const double rotation =
        2.0 * (mover.before.orientation.conjugate() * mover.place.orientation).vec().norm();
    return (mover.place.position - mover.before.position).norm() + rotation * bodies_[i].radius;
}

BodyPlace IslandStep::place_at(std::size_t i, double share) const {
    const Mover& mover = movers_[i];
    if (share == 0.0) return mover.before;
    return {mover.before.position + share * (mover.place.position - mover.before.position),
            mover.before.orientation.slerp(share, mover.place.orientation)};
}

/// Returns the hull of a body at a share of its path in the substep.
CollisionHull IslandStep::hull_at(std::size_t i, double share) const {
    const Mover& mover = movers_[i];
    if (share == 0.0) return mover.hull_before;
    if (share < 1.0) return hull(i, place_at(i, share));
    if (mover.hull_of != mover.path) {
        mover.hull_now = hull(i, place_at(i, share));
        mover.hull_of = mover.path;
    }
    return mover.hull_now;
}

/// Adds the contact points of two that touch at a share of their paths. Where they do not touch as the
/// substep begins, the part of the path by rotation beyond that by the velocities is subtracted from the gap.
void IslandStep::add_points(const Near& near, const HullContact& contact, double share, double time_step) {
    const auto arm = [&](std::size_t i, const Vector3d& point) {
        const BodyPlace there = place_at(i, share);
        const Vector3d of_centre = point + island_bodies_.front().begin.position - there.position;
        if (share == 0.0) return of_centre;
        return Vector3d(movers_[i].before.orientation * (there.orientation.conjugate() * of_centre));
    };
    const auto beyond_velocity = [&](std::size_t i, const Vector3d& of_centre) {
        const Mover& mover = movers_[i];
        const Vector3d own = mover.before.orientation.conjugate() * of_centre;
        const Vector3d travel = mover.place.orientation * own - of_centre;
        return Vector3d(travel - time_step * mover.velocity.head<3>().cross(of_centre));
    };
    for (std::size_t k = 0; k < contact.count; ++k) {
        Vector3d first_arm = arm(near.first, contact.points[k].on_first);
        Vector3d second_arm = arm(near.second, contact.points[k].on_second);
        double gap = contact.normal.dot(movers_[near.first].before.position + first_arm -
                                        movers_[near.second].before.position - second_arm);
        if (share > 0.0) {
            const double by_rotation = contact.normal.dot(beyond_velocity(near.first, first_arm) -
                                                          beyond_velocity(near.second, second_arm));
            gap += std::min(0.0, by_rotation);
        }
        // Both arms at one place of the world, so that angular momentum is conserved.
        const Vector3d across = 0.5 * (movers_[near.second].before.position + second_arm -
                                       movers_[near.first].before.position - first_arm);
        first_arm += across;
        second_arm -= across;
        points_.push_back({.first = near.first,
                           .second = near.second,
                           .first_arm = first_arm,
                           .second_arm = second_arm,
                           .normal = contact.normal,
                           .allowed_speed = std::max(0.0, gap - near.apart) / time_step,
                           .friction = ground_friction});
    }
}

/// Returns whether two that, left alone, would be beyond their plane after the substep are then separated by
/// another plane that separates them before as well.
bool IslandStep::passes_by(const Near& near) const {
    if (near.gap <= near.apart) return false;
    const CollisionHull first = hull(near.first, movers_[near.first].alone);
    const CollisionHull second = hull(near.second, movers_[near.second].alone);
    if (gap_along(first.hull, second.hull, near.normal) >= 0.0) return false;  // others may bring them there
    const auto later = plane_between(first, second, near.apart, near.normal);
    ++work_;
    return later && separated_before(near, later->normal, near.apart) && later->gap >= near.apart;
}

/// Returns whether a plane separated two by a gap when the substep began.
bool IslandStep::separated_before(const Near& near, const Vector3d& normal, double gap) const {
    return gap_along(movers_[near.first].hull_before.hull, movers_[near.second].hull_before.hull, normal) >=
           gap;
}

/// Returns the share of their paths, up to 1, that two surely complete without passing through each other: at
/// both ends of each piece of it one plane leaves them a gap. Zero where all work is spent.
double IslandStep::free_share(const Near& near) const {
    if (is_spent()) return 0.0;
    const std::size_t first_path = movers_[near.first].path;
    const std::size_t second_path = movers_[near.second].path;
    if (near.known.first_path == first_path && near.known.second_path == second_path) {
        work_ += near.known.work;  // as if it was found anew
        return near.known.share;
    }
    const std::size_t before = work_;
    const double share = found_free_share(near);
    near.known = {first_path, second_path, share, work_ - before};
    return share;
}

double IslandStep::found_free_share(const Near& near) const {
    ++work_;
    const double least = near.least();
    const auto hulls = [&](double share) {
        return std::pair(hull_at(near.first, share), hull_at(near.second, share));
    };
    auto [first, second] = hulls(0.0);
    Vector3d normal = near.normal;
    double share = 0.0;
    double piece = 1.0;
    const double finest =
        std::clamp(passage_precision * near.apart / (travel_of(near.first) + travel_of(near.second)),
                   finest_passage_share, coarsest_passage_share);
    while (share < 1.0 && piece >= finest) {
        ++work_;
        const double next_share = std::min(1.0, share + piece);
        const auto [next_first, next_second] = hulls(next_share);
        if (gap_along(next_first.hull, next_second.hull, normal) < least) {
            const auto there = plane_between(next_first, next_second, least, normal);
            const bool is_free =
                there && there->gap >= least && gap_along(first.hull, second.hull, there->normal) >= 0.0;
            if (!is_free) {
                piece *= 0.5;
                continue;
            }
            normal = there->normal;
        }
        share = next_share;
        first = next_first;
        second = next_second;
    }
    return share;
}

double IslandStep::Near::least() const {
    return std::min(closest * apart, 0.5 * gap);
}

/// Returns the least share of their paths that fast pairs surely complete before they collide; 1 where none
/// of them collide.
double IslandStep::share_free_of_hits() const {
    double free = 1.0;
    for (const Near& near : near_) {
        if (!near.waits) continue;
        const double share = free_share(near);
        if (share > 0.0) free = std::min(free, share);
    }
    return free;
}

/// Returns whether no body must be held back.
bool IslandStep::all_are_free() const {
    return std::all_of(near_.begin(), near_.end(),
                       [&](const Near& near) { return !near.began_separated() || free_share(near) >= 1.0; });
}

bool IslandStep::find_passages(double time_step) {
    bool found = false;
    for (const Near& near : near_) {
        if (!near.began_separated()) continue;
        const double share = free_share(near);
        if (share >= 1.0) continue;
        const CollisionHull first = hull_at(near.first, share);
        const CollisionHull second = hull_at(near.second, share);
        const double reach = 4.0 * near.apart;
        const PairSeparation there = pair_separation(first, second, reach);
        add_points(near, hull_contact(first, second, there, reach), share, time_step);
        found = true;
    }
    return found;
}

void IslandStep::separate_pairs(double time_step, bool& moved) {
    for (const Near& near : near_) {
        Mover& a = movers_[near.first];
        Mover& b = movers_[near.second];
        const double radius = std::min(bodies_[near.first].radius, bodies_[near.second].radius);
        const bool began_separated = near.began_separated();
        const double free = began_separated ? free_share(near) : 1.0;
        if (began_separated && free >= 1.0) continue;
        if (!began_separated) {
            if (near.known.first_path == a.path && near.known.second_path == b.path)
                continue;  // nothing moved
            near.known = {a.path, b.path, free, 0};
        }
        ++work_;
        const CollisionHull first = hull_at(near.first, free);
        const CollisionHull second = hull_at(near.second, free);
        const auto plane = plane_between(first, second, near.apart, near.normal);
        Vector3d normal = near.normal;
        if (plane) {
            normal = plane->normal;
        } else if (!began_separated) {
            normal = pair_separation(first, second, near.apart).normal;
        }
        const double gap = gap_along(hull(near.first, a.place).hull, hull(near.second, b.place).hull, normal);
        // Overlapping bodies are separated a little in each substep, and held against what presses on them.
        double separated = separated_to * near.apart;
        if (!began_separated) {
            const double removed =
                std::min(most_removed_overlap * near.apart, time_step * separation_speed * radius);
            separated = std::min(separated, near.gap + removed);
        }
        const double travel = separated - gap;
        if (travel <= 0.0 || (began_separated && travel > most_shift * radius)) continue;
        const auto yields = [&](std::size_t i) {
            return normal.dot(bodies_[i].inverse_inertia.bottomRightCorner<3, 3>() * normal);
        };
        const double share = yields(near.first) / (yields(near.first) + yields(near.second));
        a.shift += share * travel * normal;
        a.place.position += share * travel * normal;
        b.shift -= (1.0 - share) * travel * normal;
        b.place.position -= (1.0 - share) * travel * normal;
        a.pressed = b.pressed = true;
        change_path(a);
        change_path(b);
        moved = true;
        keep_angular_momentum(near, share * travel * normal, (share - 1.0) * travel * normal);
    }
}

/// Gives two that were separated the angular momentum that their displacement took, as a rotation of both as
/// one body about their place, which changes nothing between them. Nothing is done where it would add energy.
void IslandStep::keep_angular_momentum(const Near& near, const Vector3d& first_shift,
                                       const Vector3d& second_shift) {
    struct Member {
        std::size_t number;
        Vector3d shift;
        Matrix6d by_rotation = Matrix6d::Identity();  ///< maps the velocity of both as one body to its own
        double gain = 0.0;                            ///< J
    };
    Member pair[] = {{near.first, first_shift}, {near.second, second_shift}};
    const Vector3d about = movers_[near.first].place.position;
    Matrix6d inertia_of_both = Matrix6d::Zero();
    Vector6d missed = Vector6d::Zero();
    for (Member& member : pair) {
        const Mover& mover = movers_[member.number];
        const Matrix6d inertia =
            in_world(island_bodies_[member.number].body->inertia, mover.place.orientation);
        member.by_rotation.bottomLeftCorner<3, 3>() = -skew(mover.place.position - about);
        inertia_of_both += member.by_rotation.transpose() * inertia * member.by_rotation;
        missed.head<3>() -= member.shift.cross((inertia * mover.velocity).tail<3>());
    }
    const Vector6d rotation = Eigen::LLT<Matrix6d>(inertia_of_both).solve(missed);
    double gain = 0.0;
    for (Member& member : pair) {
        const Mover& mover = movers_[member.number];
        member.gain = energy_of(member.number, mover.place, mover.velocity + member.by_rotation * rotation) -
                      energy_of(member.number, mover.place, mover.velocity);
        gain += member.gain;
    }
    if (gain > 0.0) return;
    for (const Member& member : pair) {
        movers_[member.number].velocity += member.by_rotation * rotation;
        movers_[member.number].energy += member.gain;
    }
}

void IslandStep::find_overlaps() {
    for (Mover& mover : movers_) mover.overlaps = false;
    for (const Near& near : near_) {
        const CollisionHull first = hull(near.first, movers_[near.first].place);
        const CollisionHull second = hull(near.second, movers_[near.second].place);
        if (gap_along(first.hull, second.hull, near.normal) > 0.0) continue;
        if (plane_between(first, second, 0.0, near.normal)) continue;
        movers_[near.first].overlaps = movers_[near.second].overlaps = true;
    }
}

void IslandStep::hold_back() {
    bool again = true;
    while (again) {
        again = false;
        for (const Near& near : near_) {
            Mover& a = movers_[near.first];
            Mover& b = movers_[near.second];
            if (!near.began_separated() || (a.held == 2 && b.held == 2)) continue;
            const double share = free_share(near);
            if (share >= 1.0) continue;
            const BodyPlace places[] = {place_at(near.first, share), place_at(near.second, share)};
            // Both go as far as they come freely, or not at all where that is in another's path.
            for (Mover* mover : {&a, &b}) {
                mover->held = mover->held == 0 && share > 0.0 ? 1 : 2;
                mover->place = mover->held == 2 ? mover->before : places[mover == &a ? 0 : 1];
                mover->pressed = true;
                change_path(*mover);
            }
            again = true;
        }
    }
}

}  // namespace samara
