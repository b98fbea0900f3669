#include "samara/core/simulation/broadphase.hpp"

#include <algorithm>
#include <numbers>

#include "samara/core/base/parallel_for.hpp"
#include "samara/core/contact/ground_contact.hpp"

namespace samara {
namespace {

// The factor on a body's predicted displacement in a step, by its velocity and gravity; where a body moved
// farther the step is repeated.
constexpr double surplus = 1.25;
constexpr int most_guesses = 16;
// Relative to the radius: a body that moves farther in a step is past all others within it, and touches none.
// Otherwise all would be near it.
constexpr double farthest_reach = 1e6;

bool sees_turbulence(const BodyState& state) {
    return !state.sampled_turbulence.velocity.isZero(0.0) ||
           !state.sampled_turbulence.angular_velocity.isZero(0.0);
}

/// Returns (omega, v) in world axes, relative to a ground with a velocity.
Vector6d world_velocity(const BodyState& state, const Vector3d& ground_velocity) {
    Vector6d velocity;
    velocity << state.orientation * state.velocity.head<3>(),
        state.orientation * state.velocity.tail<3>() - ground_velocity;
    return velocity;
}

}  // namespace

void KnownGaps::clear() {
    ++step_;
    used_ = 0;
}

std::pair<KnownGaps::Gap&, bool> KnownGaps::place_of(std::size_t a, std::size_t b) {
    if (2 * used_ >= entries_.size()) grow();
    const std::uint64_t key = static_cast<std::uint64_t>(a) << 32U | b;
    Entry& entry = entry_of(key);
    const bool is_known = entry.step == step_;
    if (!is_known) {
        entry = {step_, key, {}};
        ++used_;
    }
    return {entry.gap, is_known};
}

KnownGaps::Entry& KnownGaps::entry_of(std::uint64_t key) {
    const std::size_t mask = entries_.size() - 1;
    constexpr std::uint64_t golden = 0x9e3779b97f4a7c15;  // Knuth, The Art of Computer Programming 3, 6.4
    std::size_t place = (key * golden >> 32U) & mask;
    while (entries_[place].step == step_ && entries_[place].key != key) place = (place + 1) & mask;
    return entries_[place];
}

void KnownGaps::grow() {
    std::vector<Entry> before(std::max<std::size_t>(64, 2 * entries_.size()));
    before.swap(entries_);
    for (const Entry& entry : before) {
        if (entry.step == step_) entry_of(entry.key) = entry;
    }
}

Broadphase::Broadphase(double step, int runs, int threads)
    : step_(step), threads_(threads), runs_(static_cast<std::size_t>(runs)) {}

void Broadphase::take_step(const std::vector<std::unique_ptr<BodyGroup>>& all,
                           const Surroundings& surroundings, std::uint64_t number) {
    groups_.clear();
    for (const auto& group : all) {
        if (group->grid_start() <= number) groups_.push_back(group.get());
    }
    const Ground ground =
        ground_in_flow(surroundings, step_time(0.0, step_, number), step_time(0.0, step_, number + 1));
    const auto for_each_run = [&](const auto& work) {
        parallel_for(runs_.size(), 1, threads_, [&](std::size_t begin, std::size_t end) {
            for (std::size_t run = begin; run < end; ++run) work(run);
        });
    };
    for_each_run([&](std::size_t run) { gather(runs_[run], run, number, ground); });
    reports_.resize(groups_.size());
    for (int guess = 0; guess < most_guesses; ++guess) {
        for_each_run([&](std::size_t run) {
            if (!runs_[run].is_guessed) find_islands(runs_[run]);
        });
        for (Run& run : runs_) {
            for (const Member& member : run.members) {
                const bool in_island = member.island != ContactBetween::none;
                BodyState state = member.own;
                state.at_rest = state.at_rest && !in_island;
                Batch& batch = member.group->batch();
                batch.keep_own_state(member.index, state);
                batch.leave_contact(member.index, in_island);
                if (ContactRecord* record = batch.record(member.index)) *record = member.record;
            }
        }
        for (std::size_t i = 0; i < groups_.size(); ++i) reports_[i] = groups_[i]->take_steps(1);
        bool again = false;
        for (Run& run : runs_) {
            run.is_guessed = !went_farther(run, ground);
            again = again || !run.is_guessed;
        }
        if (!again) break;
    }
    for_each_run([&](std::size_t run) { find_islands_and_step(runs_[run], surroundings, ground); });
    for (std::size_t i = 0; i < groups_.size(); ++i) groups_[i]->keep_steps(reports_[i], 1);
}

void Broadphase::gather(Run& run, std::size_t number, std::uint64_t step, const Ground& ground) const {
    run.members.clear();
    run.is_guessed = false;
    run.gaps.clear();
    for (BodyGroup* group : groups_) {
        Batch& batch = group->batch();
        const Surroundings& surroundings = group->surroundings();
        const kernel::RestJudgement judgement = judgement_of_rest(group->body(), surroundings, step_);
        const double fall = 1.5 * step_ * step_ * surroundings.gravity.norm();
        for (std::size_t i = number * group->copies(); i < (number + 1) * group->copies(); ++i) {
            if (!group->is_there(i)) continue;
            Member member;
            member.group = group;
            member.index = i;
            member.own = batch.own_state(i);
            member.before = batch.state(i);
            member.place = ground.in_world_before(member.before);
            member.velocity = world_velocity(member.before, ground.velocity - ground.gain);
            if (const ContactRecord* record = batch.record(i)) member.record = *record;
            member.radius = batch.touching(i).contact_points.bounding_radius;
            const double speed =
                member.velocity.tail<3>().norm() + member.radius * member.velocity.head<3>().norm();
            member.reach = surplus * step_ * speed + fall + 2.0 * skin * member.radius;
            member.is_awake = !member.own.at_rest ||
                              !judgement.skips(step - group->grid_start(), !sees_turbulence(member.own));
            run.members.push_back(member);
        }
    }
}

void Broadphase::find_near(Run& run) {
    run.order.clear();
    run.near.clear();
    const auto reach_of = [&](std::size_t i) { return run.members[i].radius + run.members[i].reach; };
    for (std::size_t i = 0; i < run.members.size(); ++i) {
        if (!(run.members[i].reach <= farthest_reach * run.members[i].radius)) continue;
        run.order.emplace_back(run.members[i].place.position.x() - reach_of(i), i);
    }
    std::sort(run.order.begin(), run.order.end());
    for (auto first = run.order.begin(); first != run.order.end(); ++first) {
        const Member& a = run.members[first->second];
        const double end = a.place.position.x() + reach_of(first->second);
        for (auto second = first + 1; second != run.order.end() && second->first <= end; ++second) {
            const Member& b = run.members[second->second];
            const double most = reach_of(first->second) + reach_of(second->second);
            if ((a.place.position - b.place.position).squaredNorm() > most * most) continue;
            run.near.push_back(std::minmax(first->second, second->second));
        }
    }
    std::sort(run.near.begin(), run.near.end());
}

bool Broadphase::may_touch(Run& run, std::size_t a, std::size_t b) {
    const Member& first = run.members[a];
    const Member& second = run.members[b];
    const double reach = first.reach + second.reach;  // it only grows
    const auto [known, is_known] = run.gaps.place_of(a, b);
    if (is_known && (known.is_near || known.reach >= reach)) return known.is_near;
    const auto hull = [&](const Member& member) {
        return CollisionHull{
            {&member.group->batch().touching(member.index).contact_points,
             member.place.orientation.toRotationMatrix(), member.place.position - first.place.position},
            &member.group->faces()};
    };
    known = {reach, come_within(hull(first), hull(second), reach)};
    return known.is_near;
}

void Broadphase::find_islands(Run& run) {
    std::vector<Member>& members = run.members;
    run.pairs.clear();
    for (std::size_t i = 0; i < members.size(); ++i) members[i].island = i;
    const auto root = [&](std::size_t i) {
        while (members[i].island != i) i = members[i].island = members[members[i].island].island;
        return i;
    };
    bool grows = std::any_of(members.begin(), members.end(), [](const Member& m) { return m.is_awake; });
    while (grows) {
        grows = false;
        find_near(run);
        run.pairs.clear();
        for (const auto& [a, b] : run.near) {
            Member& first = members[a];
            Member& second = members[b];
            if (!first.is_awake && !second.is_awake) continue;
            if (!may_touch(run, a, b)) continue;
            run.pairs.emplace_back(a, b);
            const std::size_t root_a = root(a);
            const std::size_t root_b = root(b);
            members[std::max(root_a, root_b)].island = std::min(root_a, root_b);
            grows = grows || !first.is_awake || !second.is_awake;
            first.is_awake = second.is_awake = true;
        }
        // A body that is struck may come as far as the one that strikes.
        for (std::size_t i = 0; i < members.size(); ++i) {
            Member& lead = members[root(i)];
            lead.reach = std::max(lead.reach, members[i].reach);
        }
        for (std::size_t i = 0; i < members.size(); ++i) {
            const double reach = members[root(i)].reach;
            grows = grows || members[i].reach < reach;
            members[i].reach = reach;
        }
    }
    std::vector<std::size_t>& counts = run.numbers;
    counts.assign(members.size(), 0);
    for (std::size_t i = 0; i < members.size(); ++i) ++counts[root(i)];
    for (std::size_t i = 0; i < members.size(); ++i) {
        // root() must still find the members behind it, so single bodies are marked below.
        members[i].island = root(i);
    }
    for (Member& member : members) {
        if (counts[member.island] == 1) member.island = ContactBetween::none;
    }
}

bool Broadphase::went_farther(Run& run, const Ground& ground) const {
    bool farther = false;
    for (Member& member : run.members) {
        const BodyState after = member.group->batch().state(member.index);
        const double rotation =
            std::max(member.velocity.head<3>().norm(), after.velocity.head<3>().norm()) * step_;
        const double displacement = (ground.in_world(after).position - member.place.position).norm() +
                                    member.radius * std::min(rotation, std::numbers::pi);
        if (!(displacement > member.reach)) continue;
        member.reach = surplus * displacement;
        farther = true;
    }
    return farther;
}

void Broadphase::find_islands_and_step(Run& run, const Surroundings& surroundings,
                                       const Ground& ground) const {
    for (std::size_t lead = 0; lead < run.members.size(); ++lead) {
        if (run.members[lead].island != lead) continue;
        run.numbers.clear();
        for (std::size_t i = lead; i < run.members.size(); ++i) {
            if (run.members[i].island == lead) run.numbers.push_back(i);
        }
        collide_island(run, surroundings, ground);
    }
}

void Broadphase::collide_island(Run& run, const Surroundings& surroundings, const Ground& ground) const {
    run.island_bodies.clear();
    for (const std::size_t i : run.numbers) {
        const Member& member = run.members[i];
        Batch& batch = member.group->batch();
        const BodyState after = batch.state(member.index);
        run.island_bodies.push_back({.body = &batch.touching(member.index),
                                     .faces = &member.group->faces(),
                                     .number = static_cast<int>(member.group->first() + member.index),
                                     .begin = member.place,
                                     .begin_velocity = member.velocity,
                                     .end = ground.in_world(after),
                                     .end_velocity = world_velocity(after, ground.velocity),
                                     .record = batch.record(member.index)});
    }
    run.island_pairs.clear();
    const auto place_of_number = [&](std::size_t i) {
        return static_cast<std::size_t>(std::lower_bound(run.numbers.begin(), run.numbers.end(), i) -
                                        run.numbers.begin());
    };
    for (const auto& [a, b] : run.pairs) {
        if (run.members[a].island == run.members[run.numbers.front()].island) {
            run.island_pairs.emplace_back(place_of_number(a), place_of_number(b));
        }
    }
    run.step.take(run.island_bodies, run.island_pairs,
                  {.height = surroundings.ground,
                   .obstacles = surroundings.obstacles.get(),
                   .time = ground.time - step_,
                   .flow = -ground.velocity},
                  step_);
    for (std::size_t k = 0; k < run.numbers.size(); ++k) {
        const IslandBody& island_body = run.island_bodies[k];
        if (!island_body.touched) continue;
        const Member& member = run.members[run.numbers[k]];
        Batch& batch = member.group->batch();
        BodyState state = batch.state(member.index);
        const bool has_stayed = island_body.rests && island_body.end.position == member.place.position;
        if (has_stayed) {
            state.position = member.before.position;
            state.orientation = member.before.orientation;
            keep_on_ground(ground, state);
        } else {
            const Quaterniond to_body = island_body.end.orientation.conjugate();
            state.position = island_body.end.position + ground.origin;
            state.orientation = island_body.end.orientation;
            state.velocity << to_body * island_body.end_velocity.head<3>(),
                to_body * (island_body.end_velocity.tail<3>() + ground.velocity);
            state.at_rest = island_body.rests;
        }
        batch.set_state(member.index, state);
        if (has_stayed && state.position == member.before.position) {
            // Converting the units of another size would round the place.
            BodyState own = batch.own_state(member.index);
            own.position = member.own.position;
            batch.keep_own_state(member.index, own);
        }
    }
}

}  // namespace samara
