#include "samara/core/simulation/simulation.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "samara/core/base/numbers.hpp"
#include "samara/core/base/parallel_for.hpp"
#include "samara/core/dynamics/body_size.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/physics/broken_rule.hpp"
#include "samara/core/simulation/body_group.hpp"
#include "samara/core/simulation/broadphase.hpp"
#include "samara/core/simulation/world_pose.hpp"

namespace samara {
namespace {

/// Returns a description of all of an obstacle but its keys that determines the motion, exactly.
std::string description_of(const Obstacle& obstacle) {
    std::string shape;
    for (const auto& corners : obstacle.surface.corners) {
        for (const std::int32_t corner : corners) {
            const Vector3d& vertex = obstacle.surface.vertices[as_index(corner)];
            shape += fmt::format("{} ", fmt::join(vertex.reshaped(), " "));
        }
    }
    return fmt::format("obstacle friction {} shape {}\n", obstacle.friction, content_hash(shape));
}

/// Returns keys by which an obstacle moves on from its place at `now`, and at the end of the last step, to
/// those given.
std::vector<ObstacleKey> keys_from(const Obstacle& obstacle, double now, double stepped, double step,
                                   const std::vector<ObstacleKey>& given) {
    std::vector<ObstacleKey> keys = {{place_of(obstacle, now), now}};
    if (stepped > now) keys.push_back({place_of(obstacle, stepped), stepped});
    for (const ObstacleKey& key : given) {
        if (key.time > stepped + 0.5 * step) keys.push_back(key);
    }
    if (keys.back().time <= stepped) keys.push_back({given.back(), stepped + step});
    const auto stands_as_first = [&](const ObstacleKey& key) {
        return key.position == keys.front().position &&
               key.orientation.coeffs() == keys.front().orientation.coeffs();
    };
    if (std::all_of(keys.begin(), keys.end(), stands_as_first)) keys.resize(1);
    return keys;
}

bool is_sound(const std::vector<ObstacleKey>& keys) {
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const ObstacleKey& key = keys[i];
        if (!std::isfinite(key.time) || !key.position.allFinite()) return false;
        if (!(std::abs(key.orientation.norm() - 1.0) <= 1e-6)) return false;
        if (i > 0 && !(key.time > keys[i - 1].time)) return false;
    }
    return true;
}

[[noreturn]] void reject(SimulationError::Reason reason, const std::string& why) {
    throw SimulationError(reason, why);
}

}  // namespace

struct Simulation::Parts {
    SimulationSettings settings;
    std::uint64_t wind_seed;                 ///< constant: set_seed() affects the noise alone
    std::shared_ptr<ObstacleSet> obstacles;  ///< null: none. The groups share it
    Surroundings surroundings;
    std::vector<std::unique_ptr<BodyGroup>> groups;
    std::size_t size = 0;
    double time = 0.0;
    bool has_begun = false;
    bool watches_contacts = false;
    Broadphase broadphase;  ///< for bodies that touch each other
    std::string stopped;    ///< the reason; empty while it runs
};

void StepReport::add(const StepReport& other) {
    steps += other.steps;
    implicit_steps += other.implicit_steps;
    most_substeps = std::max(most_substeps, other.most_substeps);
    steps_at_limit += other.steps_at_limit;
    highest_reynolds_number = std::max(highest_reynolds_number, other.highest_reynolds_number);
    moving += other.moving;
    below_table += other.below_table;
}

double StepReport::share_below_table() const {
    return moving == 0 ? 0.0 : static_cast<double>(below_table) / static_cast<double>(moving);
}

Simulation::Simulation(const SimulationSettings& settings) : members_(std::make_unique<Parts>()) {
    if (!(settings.step > 0.0 && std::isfinite(settings.step)) || settings.runs < 1) {
        reject(SimulationError::Reason::invalid_argument,
               "a simulation needs a step above zero and at least one run");
    }
    if (const auto broken = broken_rule(settings.precision, settings.bodies_collide)) {
        reject(SimulationError::Reason::invalid_argument, broken->member + ' ' + broken->what);
    }
    members_->settings = settings;
    members_->broadphase = Broadphase(settings.step, settings.runs, settings.threads);
    members_->wind_seed = settings.seed;
    members_->settings.wind = settings.wind.seeded(members_->wind_seed);
    if (!settings.obstacles.empty()) members_->obstacles = std::make_shared<ObstacleSet>(settings.obstacles);
    members_->settings.obstacles.clear();
    renew_surroundings();
}

Simulation Simulation::without_bodies(int threads) const {
    Simulation other;
    Parts& parts = *other.members_;
    parts.settings = members_->settings;
    parts.settings.threads = threads;
    parts.broadphase = Broadphase(parts.settings.step, parts.settings.runs, threads);
    parts.wind_seed = members_->wind_seed;
    parts.obstacles = members_->obstacles;
    parts.surroundings = members_->surroundings;
    return other;
}

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

std::size_t Simulation::add(const LoadedBody& body, const BodyPhysics& physics, const Release& release,
                            const std::string& given_name) {
    if (release.start < members_->time) {
        reject(SimulationError::Reason::invalid_argument,
               fmt::format(
                   "start is {} s, but the simulation is at {} s; start the bodies at that time or later",
                   release.start, members_->time));
    }
    const std::string name = given_name.empty() ? body.body->name : given_name;
    for (const auto& other : members_->groups) {
        if (other->name() != name) continue;
        reject(SimulationError::Reason::invalid_argument,
               fmt::format("another body group already has the name '{}'; choose another name", name));
    }
    const std::size_t first = members_->size;
    members_->groups.push_back(std::make_unique<BodyGroup>(members_->settings, members_->surroundings, body,
                                                           physics, release, name, first));
    members_->groups.back()->watch_contacts(members_->watches_contacts);
    members_->size += members_->groups.back()->size();
    return first;
}

std::size_t Simulation::add_obstacle(Obstacle obstacle) {
    auto& set = members_->obstacles;
    for (std::size_t i = 0; i < obstacle_count(); ++i) {
        const ObstacleFaces& other = set->obstacles()[i];
        if (other.is_removed() || other.obstacle().name != obstacle.name) continue;
        reject(SimulationError::Reason::invalid_argument,
               fmt::format("another obstacle already has the name '{}'; choose another name", obstacle.name));
    }
    const ObstacleSet alone({obstacle});
    for (const auto& group : members_->groups) group->require_outside(alone, members_->time);
    if (set == nullptr) {
        set = std::make_shared<ObstacleSet>(std::vector{std::move(obstacle)});
    } else {
        set->add(std::move(obstacle));
    }
    renew_surroundings();
    return set->obstacles().size() - 1;
}

void Simulation::remove_obstacle(std::size_t index) {
    members_->obstacles->remove(index);
    renew_surroundings();
}

bool Simulation::is_obstacle_removed(std::size_t index) const {
    return members_->obstacles->obstacles()[index].is_removed();
}

std::size_t Simulation::obstacle_count() const noexcept {
    return members_->obstacles == nullptr ? 0 : members_->obstacles->obstacles().size();
}

void Simulation::set_obstacle_keys(std::size_t index, const std::vector<ObstacleKey>& keys) {
    ObstacleSet& set = *members_->obstacles;
    const Obstacle& obstacle = set.obstacles()[index].obstacle();
    if (!members_->has_begun) {
        set.set_keys(index, keys);
        return;
    }
    double stepped = members_->time;
    for (const auto& group : members_->groups) {
        if (group->steps() > 0) stepped = std::max(stepped, group->reached());
    }
    const bool stood = !obstacle.moves();
    set.set_keys(index, keys_from(obstacle, members_->time, stepped, members_->settings.step, keys));
    if (stood && !obstacle.moves()) return;
    for (const auto& group : members_->groups) group->set_surroundings(members_->surroundings);
}

void Simulation::set_ground(std::optional<double> ground) {
    members_->settings.ground = ground;
    renew_surroundings();
}

const std::optional<double>& Simulation::ground() const noexcept {
    return members_->settings.ground;
}

void Simulation::set_wind(const Wind& wind) {
    members_->settings.wind = wind.seeded(members_->wind_seed);
    renew_surroundings();
}

const Wind& Simulation::wind() const noexcept {
    return members_->settings.wind;
}

void Simulation::renew_surroundings() {
    members_->surroundings = surroundings_of(members_->settings);
    members_->surroundings.obstacles = members_->obstacles;
    for (const auto& group : members_->groups) group->set_surroundings(members_->surroundings);
}

std::size_t Simulation::size() const noexcept {
    return members_->size;
}

double Simulation::time() const noexcept {
    return members_->time;
}

const std::vector<std::unique_ptr<BodyGroup>>& Simulation::groups() const noexcept {
    return members_->groups;
}

std::uint64_t Simulation::steps() const noexcept {
    std::uint64_t steps = 0;
    for (const auto& group : members_->groups) steps += group->steps();
    return steps;
}

StepReport Simulation::report() const {
    StepReport report;
    for (const auto& group : members_->groups) report.add(group->report());
    return report;
}

void Simulation::require_running() const {
    if (!members_->stopped.empty()) reject(SimulationError::Reason::out_of_range, members_->stopped);
}

void Simulation::require_time(double time) const {
    require_running();
    if (!std::isfinite(time))
        reject(SimulationError::Reason::invalid_argument, "time is not a finite number");
    if (time < members_->time) {
        reject(SimulationError::Reason::time_passed,
               fmt::format("the simulation is at {} s and cannot go back to {} s; restore an earlier state",
                           members_->time, time));
    }
    if (time / members_->settings.step > most_steps_off) {
        reject(SimulationError::Reason::invalid_argument,
               fmt::format("time {} s is more than {:.0e} steps away; check the unit", time, most_steps_off));
    }
}

void Simulation::advance_to(double time) {
    require_time(time);
    if (time == members_->time && members_->has_begun) return;
    members_->has_begun = true;
    try {
        if (members_->settings.bodies_collide) {
            advance_together(time);
        } else {
            for (const auto& group : members_->groups) group->advance_to(time, time - members_->time);
        }
    } catch (const SimulationError& lost) {
        members_->stopped = lost.what();
        throw;
    }
    members_->time = time;
}

void Simulation::advance_within(double time, double seconds) {
    using Clock = std::chrono::steady_clock;
    require_time(time);
    const double step = members_->settings.step;
    const Clock::time_point begin = Clock::now();
    Clock::time_point last = begin;
    for (const auto& group : members_->groups) group->keep_wrenches();
    for (;;) {
        const auto steps = static_cast<double>(steps_reaching(members_->time, step));
        advance_to(std::min(time, (steps + 1.0) * step));
        const Clock::time_point now = Clock::now();
        const Clock::duration after_next = now - begin + (now - last);
        if (members_->time >= time || std::chrono::duration<double>(after_next).count() > seconds) return;
        last = now;
        for (const auto& group : members_->groups) group->repeat_wrenches();
    }
}

void Simulation::advance_together(double time) {
    auto& groups = members_->groups;
    const double step = members_->settings.step;
    for (const auto& group : groups) group->begin_call(time, time - members_->time);
    const std::uint64_t needed = steps_reaching(time, step);
    for (std::uint64_t now = steps_reaching(members_->time, step); now < needed; ++now) {
        if (now + 1 == needed) {
            for (const auto& group : groups) {
                if (group->grid_start() <= now) group->record_poses();
            }
        }
        members_->broadphase.take_step(groups, members_->surroundings, now);
    }
    for (const auto& group : groups) group->require_finite();
}

void Simulation::wake_all() {
    if (!members_->settings.bodies_collide) return;
    for (const auto& group : members_->groups) {
        for (std::size_t i = 0; i < group->size(); ++i) group->wake(i);
    }
}

BodyGroup& Simulation::group_of(std::size_t index) const {
    const auto next = std::upper_bound(members_->groups.begin(), members_->groups.end(), index,
                                       [](std::size_t i, const auto& group) { return i < group->first(); });
    return **std::prev(next);
}

Pose Simulation::pose(std::size_t index) const {
    const BodyGroup& group = group_of(index);
    return group.pose(index - group.first(), members_->time);
}

void Simulation::poses(std::size_t first, std::size_t count, Pose* poses) const {
    parallel_for(count, poses_a_piece, members_->settings.threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) poses[i] = pose(first + i);
    });
}

void Simulation::set_pose(std::size_t index, const Pose& pose) {
    BodyGroup& group = group_of(index);
    group.set_pose(index - group.first(), pose, members_->time);
    wake_all();
}

void Simulation::add_wrench(std::size_t index, const Wrench& wrench) {
    BodyGroup& group = group_of(index);
    group.add_wrench(index - group.first(), wrench);
}

void Simulation::add_impulse(std::size_t index, const Wrench& impulse) {
    BodyGroup& group = group_of(index);
    group.add_impulse(index - group.first(), impulse, members_->time);
    wake_all();
}

void Simulation::remove(std::size_t index) {
    BodyGroup& group = group_of(index);
    group.remove(index - group.first(), members_->time);
    wake_all();
}

bool Simulation::is_removed(std::size_t index) const {
    const BodyGroup& group = group_of(index);
    return group.is_removed(index - group.first());
}

bool Simulation::is_at_rest(std::size_t index) const {
    const BodyGroup& group = group_of(index);
    return group.is_at_rest(index - group.first());
}

void Simulation::watch_contacts(bool watch) {
    members_->watches_contacts = watch;
    for (const auto& group : members_->groups) group->watch_contacts(watch);
}

ContactRecord Simulation::take_contacts(std::size_t index) {
    if (!members_->watches_contacts) {
        reject(SimulationError::Reason::invalid_argument,
               "contacts are not recorded; call watch_contacts before they happen");
    }
    BodyGroup& group = group_of(index);
    return group.take_contacts(index - group.first());
}

FluidForces Simulation::fluid_forces(std::size_t index) const {
    const BodyGroup& group = group_of(index);
    return group.fluid_forces(index - group.first(), members_->time);
}

FluidLoad Simulation::fluid_load(std::size_t index) const {
    const BodyGroup& group = group_of(index);
    return group.fluid_load(index - group.first(), members_->time);
}

double Simulation::size_of(std::size_t index) const {
    const BodyGroup& group = group_of(index);
    return group.size_of(index - group.first());
}

double Simulation::mass(std::size_t index) const {
    const double size = size_of(index);
    const ImmersedBody& body = group_of(index).body();
    return size * size * size * own_share(body, size) * body.mass;
}

Matrix3d Simulation::inertia(std::size_t index) const {
    const double size = size_of(index);
    const ImmersedBody& body = group_of(index).body();
    return (size * size * size) * (size * size) * own_share(body, size) * body.own_inertia;
}

Vector3d Simulation::center_of_mass(std::size_t index) const {
    const BodyGroup& group = group_of(index);
    return size_of(index) * group.body().center_of_mass;
}

void Simulation::set_seed(std::uint64_t seed, std::uint32_t first_run) {
    members_->settings.seed = seed;
    members_->settings.first_run = first_run;
    for (const auto& group : members_->groups) group->set_seed(seed, first_run);
}

std::string Simulation::fingerprint() const {
    const SimulationSettings& all = members_->settings;
    std::string text = fmt::format("{} {} {} {} {} {} ground {} step {} runs {}\n", all.fluid.density,
                                   all.fluid.viscosity, fmt::join(all.fluid.current.reshaped(), " "),
                                   fmt::join(all.fluid.gust.amplitude.reshaped(), " "), all.fluid.gust.period,
                                   fmt::join(all.gravity.reshaped(), " "),
                                   all.ground ? fmt::format("{}", *all.ground) : "none", all.step, all.runs);
    for (std::size_t i = 0; i < obstacle_count(); ++i) {
        const ObstacleFaces& faces = members_->obstacles->obstacles()[i];
        text += description_of(faces.obstacle());
        if (faces.is_removed()) text += "removed\n";
    }
    text += description_of(all.wind);
    if (all.bodies_collide) text += "bodies meet\n";
    if (all.precision != Precision::double_precision) text += "single precision\n";
    for (const auto& group : members_->groups) text += group->description();
    return text;
}

std::size_t Simulation::fixed_state_size() const {
    std::size_t size = sizeof(members_->time) + sizeof(std::uint8_t) + sizeof(members_->settings.seed) +
                       sizeof(members_->settings.first_run);
    for (const auto& group : members_->groups) size += group->state_size();
    return size;
}

std::size_t Simulation::state_size() const {
    std::size_t size = seal_size() + fixed_state_size();
    for (std::size_t i = 0; i < obstacle_count(); ++i) {
        size += keys_size(members_->obstacles->obstacles()[i].obstacle().keys.size());
    }
    return size;
}

std::string Simulation::state() const {
    require_running();
    StateWriter writer;
    writer.write(members_->time);
    writer.write(static_cast<std::uint8_t>(members_->has_begun));
    writer.write(members_->settings.seed);
    writer.write(members_->settings.first_run);
    for (const auto& group : members_->groups) group->write(writer);
    for (std::size_t i = 0; i < obstacle_count(); ++i) {
        writer.write(members_->obstacles->obstacles()[i].obstacle().keys);
    }
    return sealed_state(writer.bytes(), fingerprint());
}

void Simulation::set_state(std::string_view bytes) {
    const std::string_view payload = opened_state(bytes, fingerprint(), fixed_state_size());
    // A state that others sealed may hold anything: all of it is checked before any of it is kept.
    if (!read_state(payload, false)) {
        reject(SimulationError::Reason::foreign_state, "the state holds invalid numbers; save it again");
    }
    read_state(payload, true);
}

bool Simulation::read_state(std::string_view payload, bool keep) {
    StateReader reader(payload);
    double time = 0.0;
    std::uint8_t has_begun = 0;
    std::uint64_t seed = 0;
    std::uint32_t first_run = 0;
    reader.read(time);
    reader.read(has_begun);
    reader.read(seed);
    reader.read(first_run);
    bool sound = time >= 0.0 && time / members_->settings.step <= most_steps_off;
    for (const auto& group : members_->groups) sound = sound && group->read(reader, time, keep);
    std::vector<ObstacleKey> keys;
    for (std::size_t i = 0; i < obstacle_count(); ++i) {
        sound = sound && reader.read(keys) && is_sound(keys);
        if (keep) members_->obstacles->set_keys(i, keys);
    }
    sound = sound && reader.at_end();
    if (!keep) return sound;
    members_->time = time;
    members_->has_begun = has_begun != 0;
    members_->stopped.clear();
    set_seed(seed, first_run);
    return sound;
}

}  // namespace samara
