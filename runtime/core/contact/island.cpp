#include "samara/core/contact/island.hpp"

#include <algorithm>
#include <cmath>

#include "samara/core/collision/contact_set.hpp"
#include "samara/core/contact/ground_contact.hpp"

namespace samara {
namespace {

// Chosen by trial, so that the tests Encounters and BroadphaseStability pass.
constexpr double most_rotation = 0.25;  // rad, in a substep
constexpr double most_passing = 0.5;    // relative displacement of two, over the smaller radius, in a substep
constexpr double most_fall = 0.005;     // fall from a standstill, relative to the radius, in a substep
constexpr int most_island_substeps = 64;
constexpr int most_substep_attempts = 6;    // to find where bodies touch within a substep
constexpr double kept_energy_share = 0.25;  // share of its kinetic energy that a body which stays keeps
// in a step, times bodies: substeps that end early, where some collide or would be held back
constexpr int most_stops = 24;
constexpr int most_tries = 6;  // of a substep
// In a step, times bodies. Heaps whose motion the substeps can follow take up to 9,000, also at a step of
// 1/24 s.
constexpr std::size_t most_work = 50000;
constexpr std::size_t most_work_of_fast = 500;  // where even the most substeps are too few
constexpr std::size_t work_of_point = 20;       // of an impulse at a point, relative to a check of two hulls
constexpr int most_separation_rounds = 60;      // in which bodies are separated
// displacement in a step, relative to the radius, that counts as none
constexpr double resting_displacement = 2e-4;
constexpr double no_motion = 2e-5;  // the same, which is undone for a body at rest
constexpr double still_in_island =
    1e-2;  // speed that counts as none, relative to the change in a step without contact
constexpr double ground_touching = 1e-5;  // gap to the ground that counts as none, relative to the radius
constexpr std::size_t most_ground_points = 12;

Vector6d rotated(const Quaterniond& rotation, const Vector6d& velocity) {
    Vector6d result;
    result << rotation * velocity.head<3>(), rotation * velocity.tail<3>();
    return result;
}

/// Visits, of points near the ground or obstacles, those with the smallest gap, and with the greatest
/// distance from those before.
template <typename Visit>
void visit_spread(const ContactSet& near, double radius, const Visit& visit) {
    std::array<double, most_near_points> distance;
    const auto count = static_cast<std::size_t>(near.end() - near.begin());
    std::size_t next = 0;
    for (std::size_t i = 0; i < count; ++i) {
        distance[i] = 1e300;
        if (near.begin()[i].gap < near.begin()[next].gap) next = i;
    }
    for (std::size_t taken = 0; taken < std::min(count, most_ground_points); ++taken) {
        const NearPoint& chosen = near.begin()[next];
        visit(chosen);
        for (std::size_t i = 0; i < count; ++i) {
            const NearPoint& other = near.begin()[i];
            distance[i] =
                std::min(distance[i], (other.point - chosen.point).squaredNorm() +
                                          radius * radius * (other.normal - chosen.normal).squaredNorm());
        }
        next = static_cast<std::size_t>(std::max_element(distance.begin(), distance.begin() + count) -
                                        distance.begin());
    }
}

}  // namespace

CollisionHull IslandStep::hull(std::size_t i, const BodyPlace& place) const {
    const IslandBody& island_body = island_bodies_[i];
    // Relative to the first body, so that little is lost to rounding far from the origin.
    return {{&island_body.body->contact_points, place.orientation.toRotationMatrix(),
             place.position - island_bodies_.front().begin.position},
            island_body.faces};
}

double IslandStep::energy_of(std::size_t i, const BodyPlace& place, const Vector6d& velocity) const {
    const Vector6d own = rotated(place.orientation.conjugate(), velocity);
    return 0.5 * own.dot(island_bodies_[i].body->inertia * own);
}

double IslandStep::substeps_wanted(std::span<const Pair> pairs, double time_step) const {
    double substeps = 1.0;
    const auto at_both = [&](std::size_t i, const auto& function) {
        return std::max(function(island_bodies_[i].begin_velocity), function(island_bodies_[i].end_velocity));
    };
    for (std::size_t i = 0; i < island_bodies_.size(); ++i) {
        const double rotation_rate = at_both(i, [](const Vector6d& u) { return u.head<3>().norm(); });
        substeps = std::max(substeps, time_step * rotation_rate / most_rotation);
        const Vector6d change = island_bodies_[i].end_velocity - island_bodies_[i].begin_velocity;
        const double radius = island_bodies_[i].body->contact_points.bounding_radius;
        substeps =
            std::max(substeps, std::sqrt(0.5 * time_step * change.tail<3>().norm() / (most_fall * radius)));
    }
    for (const auto& [a, b] : pairs) {
        const IslandBody& first = island_bodies_[a];
        const IslandBody& second = island_bodies_[b];
        const double past = std::max((first.begin_velocity - second.begin_velocity).tail<3>().norm(),
                                     (first.end_velocity - second.end_velocity).tail<3>().norm());
        const double radius =
            std::min(first.body->contact_points.bounding_radius, second.body->contact_points.bounding_radius);
        substeps = std::max(substeps, time_step * past / (most_passing * radius));
    }
    return substeps;
}

void IslandStep::start(double time_step) {
    movers_.resize(island_bodies_.size());
    bodies_.resize(island_bodies_.size());
    for (std::size_t i = 0; i < island_bodies_.size(); ++i) {
        IslandBody& island_body = island_bodies_[i];
        Mover& mover = movers_[i];
        island_body.touched = false;
        mover.record = {};
        mover.place = island_body.begin;
        mover.velocity = island_body.begin_velocity;
        const Vector6d change = island_body.end_velocity - island_body.begin_velocity;
        const Quaterniond& to_world = island_body.begin.orientation;
        mover.own_velocity << to_world.conjugate() * island_body.begin_velocity.head<3>(),
            island_body.begin_velocity.tail<3>();
        mover.gain << island_body.end.orientation.conjugate() * island_body.end_velocity.head<3>() -
                          mover.own_velocity.head<3>(),
            change.tail<3>();
        mover.gain /= time_step;
        const Vector6d momentum = island_body.body->inertia * rotated(to_world.conjugate(), change);
        mover.load = to_world * momentum.tail<3>() / time_step;
    }
}

/// Returns the place and velocity after a time (s) of a body without loads that starts from its place before
/// the substep.
PlacedMotion IslandStep::free_motion(std::size_t i, Vector6d velocity, double time) const {
    velocity.tail<3>() -= flow_;
    PlacedMotion end = free_flight(island_bodies_[i].body->inertia, {movers_[i].before, velocity}, time);
    end.place.position += time * flow_;
    end.velocity.tail<3>() += flow_;
    return end;
}

/// Returns the change of velocity in a time (s) of a body without loads, in body axes, rotated as they were
/// before the substep.
Vector6d IslandStep::free_velocity_change(std::size_t i, const Vector6d& velocity, double time) const {
    const PlacedMotion end = free_motion(i, velocity, time);
    const Quaterniond back = movers_[i].before.orientation * end.place.orientation.conjugate();
    Vector6d change = end.velocity - velocity;
    change.head<3>() = back * end.velocity.head<3>() - velocity.head<3>();
    return change;
}

/// Returns the velocity before the substep plus the change that the step of the body alone causes in a time
/// (s).
Vector6d IslandStep::loaded_velocity(const Mover& mover, double time) {
    Vector6d velocity = mover.velocity_before;
    velocity.head<3>() += mover.before.orientation * (time * mover.gain.head<3>());
    velocity.tail<3>() += time * mover.gain.tail<3>();
    return velocity;
}

void IslandStep::begin_substep(double time_step) {
    for (std::size_t i = 0; i < island_bodies_.size(); ++i) {
        Mover& mover = movers_[i];
        const TouchingBody& body = *island_bodies_[i].body;
        mover.velocity_before = mover.velocity;
        mover.before = mover.place;
        mover.hull_before = hull(i, mover.before);
        bodies_[i] = {.velocity = loaded_velocity(mover, time_step),
                      .inverse_inertia = in_world(body.inverse_inertia, mover.place.orientation),
                      .radius = body.contact_points.bounding_radius};
        mover.energy_before = energy_of(i, mover.place, mover.velocity);
        // The free change of the angular velocity is left out of the change by the step of the body alone:
        // the body may rotate otherwise by now.
        Vector6d own = mover.own_velocity;
        own.head<3>() = mover.before.orientation * own.head<3>();
        mover.free_change = free_velocity_change(i, own, time_step);
        mover.alone = free_motion(i, bodies_[i].velocity, time_step).place;
    }
}

void IslandStep::find_ground(const IslandGround& ground, double time, double time_step) {
    for (std::size_t i = 0; i < island_bodies_.size(); ++i) {
        const ContactPoints& points = island_bodies_[i].body->contact_points;
        const double radius = points.bounding_radius;
        const BodyPlace& place = movers_[i].place;
        const double margin = 2.0 * time_step *
                                  std::max(speed_of_points(movers_[i].velocity, radius),
                                           speed_of_points(bodies_[i].velocity, radius)) +
                              ground_touching * radius;
        const Matrix3d to_world = place.orientation.toRotationMatrix();
        ContactSet near(to_world);
        if (ground.height && place.position.z() - *ground.height - radius <= margin) {
            near.add_ground(points, place.position.z() - *ground.height, margin);
        }
        if (ground.obstacles != nullptr && passes_near(*ground.obstacles, points, place, place, margin)) {
            add_obstacles(*ground.obstacles, points, place,
                          rotated(place.orientation.conjugate(), bodies_[i].velocity), time, time_step,
                          margin, near);
        }
        if (near.empty()) continue;
        visit_spread(near, radius, [&](const NearPoint& point) {
            points_.push_back(
                {.first = i,
                 .first_arm = to_world * point.point,
                 .normal = to_world * point.normal,
                 .allowed_speed = std::max(0.0, point.gap - ground_touching * radius) / time_step,
                 .friction = point.friction,
                 .surface_velocity = to_world * point.surface_velocity,
                 .surface_angular_velocity = to_world * point.surface_angular_velocity,
                 .obstacle = point.obstacle});
        });
    }
}

void IslandStep::solve_impulses(double time_step, std::size_t known) {
    for (std::size_t i = 0; i < island_bodies_.size(); ++i) {
        bodies_[i].velocity = loaded_velocity(movers_[i], time_step);
        movers_[i].pressed = island_bodies_[i].touched;
    }
    impulses_.solve(bodies_, points_, known);
    for (const ContactBetween& point : points_) {
        if (point.impulse.isZero(0.0)) continue;
        movers_[point.first].pressed = true;
        if (point.second != ContactBetween::none) movers_[point.second].pressed = true;
    }
    // A body with impulses moves with the velocity after the substep, others with that halfway: bodies that
    // touch must move alike.
    for (bool spreads = true; spreads;) {
        spreads = false;
        for (const Near& near : near_) {
            Mover& a = movers_[near.first];
            Mover& b = movers_[near.second];
            const double off =
                time_step * time_step * std::max(a.gain.tail<3>().norm(), b.gain.tail<3>().norm());
            if (a.pressed == b.pressed || near.gap > 2.0 * near.apart + off) continue;
            a.pressed = b.pressed = spreads = true;
        }
    }
}

void IslandStep::move(double time_step, bool ends_step) {
    for (std::size_t i = 0; i < island_bodies_.size(); ++i) {
        Mover& mover = movers_[i];
        // Without contact: half of the loads before, half after, as in the step of a body alone.
        Vector6d later = Vector6d::Zero();
        if (!mover.pressed) later = 0.5 * (bodies_[i].velocity - mover.velocity_before - mover.free_change);
        const PlacedMotion end = free_motion(i, bodies_[i].velocity - mover.free_change - later, time_step);
        later.head<3>() = end.place.orientation * (mover.before.orientation.conjugate() * later.head<3>());
        mover.place = end.place;
        mover.velocity = end.velocity + later;
        if (ends_step && !mover.pressed) {
            mover.place = island_bodies_[i].end;
            mover.velocity = island_bodies_[i].end_velocity;
        }
        change_path(mover);
        mover.energy = energy_of(i, mover.before, bodies_[i].velocity);
        mover.shift.setZero();
        mover.held = 0;
    }
}

void IslandStep::separate_from_ground(const IslandGround& ground, double time, double time_step,
                                      bool& moved) {
    for (std::size_t i = 0; i < island_bodies_.size(); ++i) {
        Mover& mover = movers_[i];
        const ContactPoints& points = island_bodies_[i].body->contact_points;
        const BodyPlace reached = mover.place;
        if (ground.obstacles != nullptr &&
            passes_near(*ground.obstacles, points, mover.before, mover.place, 0.0)) {
            keep_out(*ground.obstacles, points, time, time + time_step, mover.before, mover.place);
        }
        if (ground.height) {
            const Vector3d down = mover.place.orientation.conjugate() * -Vector3d::UnitZ();
            const double lift = reach(points, down) - (mover.place.position.z() - *ground.height);
            if (lift > 0.0) mover.place.position.z() += lift;
        }
        const Vector3d shift = mover.place.position - reached.position;
        if (shift.isZero(0.0) && mover.place.orientation.coeffs() == reached.orientation.coeffs()) continue;
        mover.shift += shift;
        mover.pressed = true;
        change_path(mover);
        moved = moved || shift.norm() > closest * skin * bodies_[i].radius;
    }
}

/// Reduces a body's kinetic energy to at most `most` (J): by its rotation, and where that does not suffice by
/// all of its motion.
void IslandStep::limit_energy(std::size_t i, double most) {
    Mover& mover = movers_[i];
    Vector6d linear = mover.velocity;
    linear.head<3>().setZero();
    Vector6d angular = mover.velocity - linear;
    const double of_translation = energy_of(i, mover.place, linear);
    const double of_rotation = energy_of(i, mover.place, angular);
    const double of_both = energy_of(i, mover.place, mover.velocity) - of_translation - of_rotation;
    const double discriminant = of_both * of_both - 4.0 * of_rotation * (of_translation - most);
    if (mover.held == 0 && of_translation <= most && of_rotation > 0.0) {
        const double share = (std::sqrt(discriminant) - of_both) / (2.0 * of_rotation);
        mover.velocity = linear + std::min(1.0, share) * angular;
    } else {
        mover.velocity *= std::sqrt(most / (of_translation + of_both + of_rotation));
    }
}

void IslandStep::balance_energy() {
    double excess = 0.0;
    double left = 0.0;
    for (std::size_t i = 0; i < island_bodies_.size(); ++i) {
        Mover& mover = movers_[i];
        if (!mover.pressed) continue;
        island_bodies_[i].touched = true;
        double most = mover.energy;
        if (mover.held > 0) {
            // At most the work of its weight on its path.
            const double work = mover.load.dot(mover.place.position - mover.before.position);
            most = std::min(most, std::max(0.0, mover.energy_before + work));
            // Slower bodies find a free path; otherwise the same would happen in the next substep.
            if (mover.held == 2) most *= kept_energy_share;
        } else {
            most -= std::max(0.0, -mover.load.dot(mover.shift));
        }
        excess += std::max(0.0, -most);
        most = std::max(0.0, most);
        // The inertia rotates with the body, which must give no energy either.
        const double energy = energy_of(i, mover.place, mover.velocity);
        if (energy > most) limit_energy(i, most);
        left += std::min(energy, most);
    }
    // The other bodies give up the energy that some lack.
    if (excess == 0.0) return;
    const double share = std::sqrt(std::max(0.0, 1.0 - excess / std::max(left, excess)));
    for (Mover& mover : movers_) {
        if (mover.pressed) mover.velocity *= share;
    }
}

void IslandStep::record_contacts(double time) {
    for (const ContactBetween& point : points_) {
        if (point.impulse.isZero(0.0)) continue;
        const auto add = [&](std::size_t i, std::size_t other, double sign, const Vector3d& arm) {
            movers_[i].record.add(
                {.impulse = sign * point.impulse,
                 .strongest = point.impulse.norm(),
                 .point = movers_[i].place.position + arm,
                 .normal = sign * point.normal,
                 .time = time,
                 .obstacle = point.obstacle,
                 .body = other == ContactBetween::none ? -1 : island_bodies_[other].number});
        };
        add(point.first, point.second, 1.0, point.first_arm);
        if (point.second == ContactBetween::none) continue;
        add(point.second, point.first, -1.0, point.second_arm);
    }
}

void IslandStep::settle(double time_step) {
    find_overlaps();
    for (std::size_t i = 0; i < island_bodies_.size(); ++i) {
        IslandBody& island_body = island_bodies_[i];
        if (!island_body.touched) continue;
        const Vector6d change = island_body.end_velocity - island_body.begin_velocity;
        const double radius = island_body.body->contact_points.bounding_radius;
        const double begun = energy_of(i, island_body.begin, island_body.begin_velocity);
        const double left = energy_of(i, island_body.begin, movers_[i].velocity);
        island_body.rests =
            !movers_[i].overlaps && begun < resting_energy * movers_[i].load.norm() * radius &&
            left < still_in_island * still_in_island * energy_of(i, island_body.begin, change) &&
            time_step * speed_of_points(movers_[i].velocity, radius) < resting_displacement * radius;
        if (island_body.record != nullptr && movers_[i].record.strongest > 0.0)
            island_body.record->add(movers_[i].record);
        const double moved =
            (movers_[i].place.position - island_body.begin.position).norm() +
            radius * movers_[i].place.orientation.angularDistance(island_body.begin.orientation);
        island_body.end =
            island_body.rests && moved <= no_motion * radius ? island_body.begin : movers_[i].place;
        island_body.end_velocity = island_body.rests ? Vector6d::Zero() : movers_[i].velocity;
    }
}

/// Returns whether the step has spent all of its work.
bool IslandStep::is_spent() const {
    return work_ > most_work_;
}

/// Returns whether a body with impulses rotated so far in a substep that its ends say little about its path
/// between.
bool IslandStep::rotated_far(double time_step) const {
    return std::any_of(movers_.begin(), movers_.end(), [&](const Mover& mover) {
        return mover.pressed && time_step * mover.velocity.head<3>().norm() > 2.0 * most_rotation;
    });
}

/// Moves the bodies for a substep with contacts between each other, ground and obstacles.
void IslandStep::try_substep(std::span<const Pair> pairs, const IslandGround& ground, double time,
                             double substep, bool ends_step, bool may_stop) {
    begin_substep(substep);
    points_.clear();
    find_pairs(pairs, substep, may_stop);
    if (is_spent()) points_.clear();  // bodies that may touch are held back
    find_ground(ground, time, substep);
    std::size_t known = 0;
    for (int attempt = 0; attempt < most_substep_attempts; ++attempt) {
        solve_impulses(substep, known);
        known = points_.size();
        work_ += work_of_point * known;
        move(substep, ends_step);
        if (is_spent() || (may_stop && share_free_of_hits() < 1.0) || !find_passages(substep)) return;
    }
}

void IslandStep::separate_all(const IslandGround& ground, double time, double substep) {
    bool moved = true;
    for (int round = 0; round < most_separation_rounds && moved && (round == 0 || !is_spent()); ++round) {
        moved = false;
        separate_pairs(substep, moved);
        separate_from_ground(ground, time, substep, moved);
    }
}

void IslandStep::restore() {
    for (Mover& mover : movers_) {
        mover.place = mover.before;
        mover.velocity = mover.velocity_before;
    }
}

/// Takes the step in so many substeps; false where there should be more.
bool IslandStep::take_substeps(std::span<const Pair> pairs, const IslandGround& ground, double time_step,
                               int substeps) {
    start(time_step);
    double longest = time_step / substeps;
    int stops = 0;
    for (double begun = 0.0; begun < time_step;) {
        const double time = ground.time + begun;
        const double rest = time_step - begun;
        if (is_spent()) longest = rest;
        // Avoids a tiny last substep.
        double substep = rest <= longest * (1.0 + 1e-9) ? rest : longest;
        for (int tries = 1;; ++tries) {
            const bool may_stop =
                tries < most_tries && stops * static_cast<int>(movers_.size()) < most_stops && !is_spent();
            try_substep(pairs, ground, time, substep, substep == rest, may_stop);
            const double free = may_stop ? share_free_of_hits() : 1.0;
            if (free == 1.0) {
                if (2 * substeps <= most_island_substeps && !is_spent() && rotated_far(substep)) return false;
                separate_all(ground, time, substep);
                if (!may_stop || is_spent() || all_are_free()) break;
                longest = 0.5 * substep;
            }
            substep *= free < 1.0 ? free : 0.5;
            ++stops;
            restore();
        }
        record_contacts(time + substep);
        hold_back();
        balance_energy();
        for (Mover& mover : movers_) mover.own_velocity += substep * mover.gain;
        begun = substep == rest ? time_step : begun + substep;
    }
    return true;
}

void IslandStep::take(std::span<IslandBody> island_bodies, std::span<const Pair> pairs,
                      const IslandGround& ground, double time_step) {
    island_bodies_ = island_bodies;
    flow_ = ground.flow;
    const double wanted = substeps_wanted(pairs, time_step);
    work_ = 0;
    most_work_ = island_bodies.size() * (wanted > most_island_substeps ? most_work_of_fast : most_work);
    int substeps = static_cast<int>(std::ceil(std::min(wanted, static_cast<double>(most_island_substeps))));
    while (!take_substeps(pairs, ground, time_step, substeps)) substeps *= 2;
    settle(time_step);
}

}  // namespace samara
