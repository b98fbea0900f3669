#include "samara/core/simulation/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "samara/core/base/numbers.hpp"
#include "samara/core/base/parallel_for.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/simulation/body_group.hpp"
#include "samara/core/simulation/broadphase.hpp"
#include "samara/core/simulation/simulation_surroundings.hpp"

namespace samara {
namespace {

/// All of an obstacle but for its keys that shapes the motion, exactly.
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

/// Keys by which an obstacle goes on from where it is at `now`, and is when the last step has ended, to those
/// given.
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
    std::uint64_t wind_seed;                 ///< for good: set_seed() is of the noise
    std::shared_ptr<ObstacleSet> obstacles;  ///< null: none. The kinds see what becomes of them
    Surroundings surroundings;
    std::vector<std::unique_ptr<BodyGroup>> groups;
    std::size_t size = 0;
    double time = 0.0;
    bool has_begun = false;
    bool watches_contacts = false;
    Broadphase broadphase;  ///< where bodies meet
    std::string stopped;    ///< why; empty: it has not
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

Simulation::Simulation(const SimulationSettings& settings) : parts_(std::make_unique<Parts>()) {
    if (!(settings.step > 0.0 && std::isfinite(settings.step)) || settings.runs < 1) {
        reject(SimulationError::Reason::invalid_argument,
               "a flight needs a step above zero and one run at least");
    }
    parts_->settings = settings;
    parts_->broadphase = Broadphase(settings.step, settings.runs, settings.threads);
    parts_->wind_seed = settings.seed;
    parts_->settings.wind = settings.wind.seeded(parts_->wind_seed);
    if (!settings.obstacles.empty()) parts_->obstacles = std::make_shared<ObstacleSet>(settings.obstacles);
    parts_->settings.obstacles.clear();
    renew_surroundings();
}

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

std::size_t Simulation::add(const LoadedBody& body, const BodyPhysics& physics, const Release& release,
                            const std::string& given_name) {
    if (release.start < parts_->time) {
        reject(SimulationError::Reason::invalid_argument,
               fmt::format("start is {} s, but the simulation is at {} s; let the bodies start then or later",
                           release.start, parts_->time));
    }
    const std::string name = given_name.empty() ? body.body->name : given_name;
    for (const auto& other : parts_->groups) {
        if (other->name() != name) continue;
        reject(SimulationError::Reason::invalid_argument,
               fmt::format("the name '{}' is taken by another kind; give this one another", name));
    }
    const std::size_t first = parts_->size;
    parts_->groups.push_back(std::make_unique<BodyGroup>(parts_->settings, parts_->surroundings, body,
                                                         physics, release, name, first));
    parts_->groups.back()->watch_contacts(parts_->watches_contacts);
    parts_->size += parts_->groups.back()->size();
    return first;
}

std::size_t Simulation::add_obstacle(Obstacle obstacle) {
    if (!parts_->groups.empty()) {
        reject(SimulationError::Reason::invalid_argument, "obstacles must be added before the bodies");
    }
    auto& set = parts_->obstacles;
    if (set != nullptr) {
        for (const ObstacleFaces& other : set->obstacles()) {
            if (other.obstacle().name != obstacle.name) continue;
            reject(SimulationError::Reason::invalid_argument,
                   fmt::format("the name '{}' is taken by another obstacle; give this one another",
                               obstacle.name));
        }
        set->add(std::move(obstacle));
    } else {
        set = std::make_shared<ObstacleSet>(std::vector{std::move(obstacle)});
    }
    renew_surroundings();
    return set->obstacles().size() - 1;
}

std::size_t Simulation::obstacle_count() const noexcept {
    return parts_->obstacles == nullptr ? 0 : parts_->obstacles->obstacles().size();
}

void Simulation::set_obstacle_keys(std::size_t index, const std::vector<ObstacleKey>& keys) {
    ObstacleSet& set = *parts_->obstacles;
    const Obstacle& obstacle = set.obstacles()[index].obstacle();
    if (!parts_->has_begun) {
        set.set_keys(index, keys);
        return;
    }
    double stepped = parts_->time;
    for (const auto& group : parts_->groups) {
        if (group->steps() > 0) stepped = std::max(stepped, group->reached());
    }
    const bool stood = !obstacle.moves();
    set.set_keys(index, keys_from(obstacle, parts_->time, stepped, parts_->settings.step, keys));
    if (stood && !obstacle.moves()) return;
    for (const auto& group : parts_->groups) group->set_surroundings(parts_->surroundings);
}

void Simulation::set_ground(std::optional<double> ground) {
    parts_->settings.ground = ground;
    renew_surroundings();
}

const std::optional<double>& Simulation::ground() const noexcept {
    return parts_->settings.ground;
}

void Simulation::set_wind(const Wind& wind) {
    parts_->settings.wind = wind.seeded(parts_->wind_seed);
    renew_surroundings();
}

const Wind& Simulation::wind() const noexcept {
    return parts_->settings.wind;
}

void Simulation::renew_surroundings() {
    parts_->surroundings = surroundings_of(parts_->settings);
    parts_->surroundings.obstacles = parts_->obstacles;
    for (const auto& group : parts_->groups) group->set_surroundings(parts_->surroundings);
}

std::size_t Simulation::size() const noexcept {
    return parts_->size;
}

double Simulation::time() const noexcept {
    return parts_->time;
}

const std::vector<std::unique_ptr<BodyGroup>>& Simulation::groups() const noexcept {
    return parts_->groups;
}

std::uint64_t Simulation::steps() const noexcept {
    std::uint64_t steps = 0;
    for (const auto& group : parts_->groups) steps += group->steps();
    return steps;
}

StepReport Simulation::report() const {
    StepReport report;
    for (const auto& group : parts_->groups) report.add(group->report());
    return report;
}

void Simulation::require_running() const {
    if (!parts_->stopped.empty()) reject(SimulationError::Reason::out_of_range, parts_->stopped);
}

void Simulation::require_time(double time) const {
    require_running();
    if (!std::isfinite(time))
        reject(SimulationError::Reason::invalid_argument, "time is not a finite number");
    if (time < parts_->time) {
        reject(
            SimulationError::Reason::time_passed,
            fmt::format("the simulation is at {} s and cannot go back to {} s; restore a state from before",
                        parts_->time, time));
    }
    if (time / parts_->settings.step > most_steps_off) {
        reject(
            SimulationError::Reason::invalid_argument,
            fmt::format("time {} s is more than {:.0e} steps off; is a unit wrong?", time, most_steps_off));
    }
}

void Simulation::advance_to(double time) {
    require_time(time);
    if (time == parts_->time && parts_->has_begun) return;
    parts_->has_begun = true;
    try {
        if (parts_->settings.bodies_collide) {
            fly_together(time);
        } else {
            for (const auto& group : parts_->groups) group->advance_to(time, time - parts_->time);
        }
    } catch (const SimulationError& lost) {
        parts_->stopped = lost.what();
        throw;
    }
    parts_->time = time;
}

void Simulation::fly_together(double time) {
    auto& groups = parts_->groups;
    const double step = parts_->settings.step;
    for (const auto& group : groups) group->begin_call(time, time - parts_->time);
    const std::uint64_t needed = steps_reaching(time, step);
    for (std::uint64_t now = steps_reaching(parts_->time, step); now < needed; ++now) {
        if (now + 1 == needed) {
            for (const auto& group : groups) {
                if (group->grid_start() <= now) group->note_poses();
            }
        }
        parts_->broadphase.take_step(groups, parts_->surroundings, now);
    }
    for (const auto& group : groups) group->require_finite();
}

void Simulation::wake_all() {
    if (!parts_->settings.bodies_collide) return;
    for (const auto& group : parts_->groups) {
        for (std::size_t i = 0; i < group->size(); ++i) group->wake(i);
    }
}

BodyGroup& Simulation::kind_of(std::size_t index) const {
    const auto next = std::upper_bound(parts_->groups.begin(), parts_->groups.end(), index,
                                       [](std::size_t i, const auto& group) { return i < group->first(); });
    return **std::prev(next);
}

Pose Simulation::pose(std::size_t index) const {
    const BodyGroup& group = kind_of(index);
    return group.pose(index - group.first(), parts_->time);
}

void Simulation::poses(std::size_t first, std::size_t count, Pose* poses) const {
    parallel_for(count, poses_a_piece, parts_->settings.threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) poses[i] = pose(first + i);
    });
}

void Simulation::set_pose(std::size_t index, const Pose& pose) {
    BodyGroup& group = kind_of(index);
    group.set_pose(index - group.first(), pose, parts_->time);
    wake_all();
}

void Simulation::add_wrench(std::size_t index, const Wrench& wrench) {
    BodyGroup& group = kind_of(index);
    group.add_wrench(index - group.first(), wrench);
}

void Simulation::add_impulse(std::size_t index, const Wrench& impulse) {
    BodyGroup& group = kind_of(index);
    group.add_impulse(index - group.first(), impulse, parts_->time);
    wake_all();
}

void Simulation::remove(std::size_t index) {
    BodyGroup& group = kind_of(index);
    group.remove(index - group.first(), parts_->time);
    wake_all();
}

bool Simulation::is_removed(std::size_t index) const {
    const BodyGroup& group = kind_of(index);
    return group.is_removed(index - group.first());
}

bool Simulation::is_at_rest(std::size_t index) const {
    const BodyGroup& group = kind_of(index);
    return group.is_at_rest(index - group.first());
}

void Simulation::watch_contacts(bool watch) {
    parts_->watches_contacts = watch;
    for (const auto& group : parts_->groups) group->watch_contacts(watch);
}

ContactRecord Simulation::take_contacts(std::size_t index) {
    if (!parts_->watches_contacts) {
        reject(SimulationError::Reason::invalid_argument,
               "contacts are not noted; call watch_contacts before they happen");
    }
    BodyGroup& group = kind_of(index);
    return group.take_contacts(index - group.first());
}

FluidLoad Simulation::fluid_load(std::size_t index) const {
    const BodyGroup& group = kind_of(index);
    return group.fluid_load(index - group.first(), parts_->time);
}

double Simulation::size_of(std::size_t index) const {
    const BodyGroup& group = kind_of(index);
    return group.size_of(index - group.first());
}

double Simulation::mass(std::size_t index) const {
    const double size = size_of(index);
    return size * size * size * kind_of(index).body().mass;
}

Matrix3d Simulation::inertia(std::size_t index) const {
    const double size = size_of(index);
    return (size * size * size) * (size * size) * kind_of(index).body().own_inertia;
}

Vector3d Simulation::center_of_mass(std::size_t index) const {
    const BodyGroup& group = kind_of(index);
    return size_of(index) * group.body().center_of_mass;
}

void Simulation::set_seed(std::uint64_t seed, std::uint32_t first_run) {
    parts_->settings.seed = seed;
    parts_->settings.first_run = first_run;
    for (const auto& group : parts_->groups) group->set_seed(seed, first_run);
}

std::string Simulation::fingerprint() const {
    const SimulationSettings& all = parts_->settings;
    std::string text = fmt::format("{} {} {} {} {} {} ground {} step {} runs {}\n", all.fluid.density,
                                   all.fluid.viscosity, fmt::join(all.fluid.current.reshaped(), " "),
                                   fmt::join(all.fluid.gust.amplitude.reshaped(), " "), all.fluid.gust.period,
                                   fmt::join(all.gravity.reshaped(), " "),
                                   all.ground ? fmt::format("{}", *all.ground) : "none", all.step, all.runs);
    for (std::size_t i = 0; i < obstacle_count(); ++i) {
        text += description_of(parts_->obstacles->obstacles()[i].obstacle());
    }
    text += description_of(all.wind);
    if (all.bodies_collide) text += "bodies meet\n";
    for (const auto& group : parts_->groups) text += group->description();
    return text;
}

std::size_t Simulation::fixed_state_size() const {
    std::size_t size = sizeof(parts_->time) + sizeof(std::uint8_t) + sizeof(parts_->settings.seed) +
                       sizeof(parts_->settings.first_run);
    for (const auto& group : parts_->groups) size += group->state_size();
    return size;
}

std::size_t Simulation::state_size() const {
    std::size_t size = seal_size() + fixed_state_size();
    for (std::size_t i = 0; i < obstacle_count(); ++i) {
        size += keys_size(parts_->obstacles->obstacles()[i].obstacle().keys.size());
    }
    return size;
}

std::string Simulation::state() const {
    require_running();
    StateWriter writer;
    writer.write(parts_->time);
    writer.write(static_cast<std::uint8_t>(parts_->has_begun));
    writer.write(parts_->settings.seed);
    writer.write(parts_->settings.first_run);
    for (const auto& group : parts_->groups) group->write(writer);
    for (std::size_t i = 0; i < obstacle_count(); ++i) {
        writer.write(parts_->obstacles->obstacles()[i].obstacle().keys);
    }
    return sealed_state(writer.bytes(), fingerprint());
}

void Simulation::set_state(std::string_view bytes) {
    const std::string_view payload = opened_state(bytes, fingerprint(), fixed_state_size());
    // Sealed by another hand it may hold anything: all of it is looked at before any of it is kept.
    if (!read_state(payload, false)) {
        reject(SimulationError::Reason::foreign_state, "the state holds numbers that no simulation has");
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
    bool sound = time >= 0.0 && time / parts_->settings.step <= most_steps_off;
    for (const auto& group : parts_->groups) sound = sound && group->read(reader, time, keep);
    std::vector<ObstacleKey> keys;
    for (std::size_t i = 0; i < obstacle_count(); ++i) {
        sound = sound && reader.read(keys) && is_sound(keys);
        if (keep) parts_->obstacles->set_keys(i, keys);
    }
    sound = sound && reader.at_end();
    if (!keep) return sound;
    parts_->time = time;
    parts_->has_begun = has_begun != 0;
    parts_->stopped.clear();
    set_seed(seed, first_run);
    return sound;
}

}  // namespace samara
