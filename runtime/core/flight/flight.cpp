#include "samara/core/flight/flight.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "samara/core/base/as_index.hpp"
#include "samara/core/base/parallel_for.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/flight/body_group.hpp"
#include "samara/core/flight/broadphase.hpp"
#include "samara/core/flight/flight_surroundings.hpp"

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

[[noreturn]] void refuse(FlightError::Kind kind, const std::string& why) {
    throw FlightError(kind, why);
}

}  // namespace

struct Flight::Parts {
    FlightSettings settings;
    std::uint64_t wind_seed;                 ///< for good: set_seed() is of the noise
    std::shared_ptr<ObstacleSet> obstacles;  ///< null: none. The kinds see what becomes of them
    Surroundings surroundings;
    std::vector<std::unique_ptr<BodyGroup>> kinds;
    std::size_t size = 0;
    double time = 0.0;
    bool has_begun = false;
    bool watches_contacts = false;
    Broadphase broadphase;  ///< where bodies meet
    std::string stopped;    ///< why; empty: it has not
};

void FlightReport::add(const FlightReport& other) {
    steps += other.steps;
    implicit_steps += other.implicit_steps;
    most_substeps = std::max(most_substeps, other.most_substeps);
    steps_at_limit += other.steps_at_limit;
    highest_reynolds_number = std::max(highest_reynolds_number, other.highest_reynolds_number);
    moving += other.moving;
    below_table += other.below_table;
}

double FlightReport::share_below_table() const {
    return moving == 0 ? 0.0 : static_cast<double>(below_table) / static_cast<double>(moving);
}

Flight::Flight(const FlightSettings& settings) : parts_(std::make_unique<Parts>()) {
    if (!(settings.step > 0.0 && std::isfinite(settings.step)) || settings.runs < 1) {
        refuse(FlightError::Kind::invalid_argument, "a flight needs a step above zero and one run at least");
    }
    parts_->settings = settings;
    parts_->broadphase = Broadphase(settings.step, settings.runs, settings.threads);
    parts_->wind_seed = settings.seed;
    parts_->settings.wind = settings.wind.seeded(parts_->wind_seed);
    if (!settings.obstacles.empty()) parts_->obstacles = std::make_shared<ObstacleSet>(settings.obstacles);
    parts_->settings.obstacles.clear();
    renew_surroundings();
}

Flight::~Flight() = default;
Flight::Flight(Flight&&) noexcept = default;
Flight& Flight::operator=(Flight&&) noexcept = default;

std::size_t Flight::add(const LoadedBody& body, const BodyPhysics& physics, const Release& release,
                        const std::string& given_name) {
    if (release.start < parts_->time) {
        refuse(FlightError::Kind::invalid_argument,
               fmt::format("start is {} s, but the simulation is at {} s; let the bodies start then or later",
                           release.start, parts_->time));
    }
    const std::string name = given_name.empty() ? body.body->name : given_name;
    for (const auto& other : parts_->kinds) {
        if (other->name() != name) continue;
        refuse(FlightError::Kind::invalid_argument,
               fmt::format("the name '{}' is taken by another kind; give this one another", name));
    }
    const std::size_t first = parts_->size;
    parts_->kinds.push_back(std::make_unique<BodyGroup>(parts_->settings, parts_->surroundings, body, physics,
                                                        release, name, first));
    parts_->kinds.back()->watch_contacts(parts_->watches_contacts);
    parts_->size += parts_->kinds.back()->size();
    return first;
}

std::size_t Flight::add_obstacle(Obstacle obstacle) {
    if (!parts_->kinds.empty()) {
        refuse(FlightError::Kind::invalid_argument, "obstacles must be added before the bodies");
    }
    auto& set = parts_->obstacles;
    if (set != nullptr) {
        for (const ObstacleFaces& other : set->obstacles()) {
            if (other.obstacle().name != obstacle.name) continue;
            refuse(FlightError::Kind::invalid_argument,
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

std::size_t Flight::obstacle_count() const noexcept {
    return parts_->obstacles == nullptr ? 0 : parts_->obstacles->obstacles().size();
}

void Flight::set_obstacle_keys(std::size_t index, const std::vector<ObstacleKey>& keys) {
    ObstacleSet& set = *parts_->obstacles;
    const Obstacle& obstacle = set.obstacles()[index].obstacle();
    if (!parts_->has_begun) {
        set.set_keys(index, keys);
        return;
    }
    double stepped = parts_->time;
    for (const auto& kind : parts_->kinds) {
        if (kind->steps() > 0) stepped = std::max(stepped, kind->reached());
    }
    const bool stood = !obstacle.moves();
    set.set_keys(index, keys_from(obstacle, parts_->time, stepped, parts_->settings.step, keys));
    if (stood && !obstacle.moves()) return;
    for (const auto& kind : parts_->kinds) kind->set_surroundings(parts_->surroundings);
}

void Flight::set_ground(std::optional<double> ground) {
    parts_->settings.ground = ground;
    renew_surroundings();
}

const std::optional<double>& Flight::ground() const noexcept {
    return parts_->settings.ground;
}

void Flight::set_wind(const Wind& wind) {
    parts_->settings.wind = wind.seeded(parts_->wind_seed);
    renew_surroundings();
}

const Wind& Flight::wind() const noexcept {
    return parts_->settings.wind;
}

void Flight::renew_surroundings() {
    parts_->surroundings = surroundings_of(parts_->settings);
    parts_->surroundings.obstacles = parts_->obstacles;
    for (const auto& kind : parts_->kinds) kind->set_surroundings(parts_->surroundings);
}

std::size_t Flight::size() const noexcept {
    return parts_->size;
}

double Flight::time() const noexcept {
    return parts_->time;
}

const std::vector<std::unique_ptr<BodyGroup>>& Flight::kinds() const noexcept {
    return parts_->kinds;
}

std::uint64_t Flight::steps() const noexcept {
    std::uint64_t steps = 0;
    for (const auto& kind : parts_->kinds) steps += kind->steps();
    return steps;
}

FlightReport Flight::report() const {
    FlightReport report;
    for (const auto& kind : parts_->kinds) report.add(kind->report());
    return report;
}

void Flight::require_running() const {
    if (!parts_->stopped.empty()) refuse(FlightError::Kind::out_of_range, parts_->stopped);
}

void Flight::require_time(double time) const {
    require_running();
    if (!std::isfinite(time)) refuse(FlightError::Kind::invalid_argument, "time is not a finite number");
    if (time < parts_->time) {
        refuse(
            FlightError::Kind::time_passed,
            fmt::format("the simulation is at {} s and cannot go back to {} s; restore a state from before",
                        parts_->time, time));
    }
    if (time / parts_->settings.step > most_steps_off) {
        refuse(
            FlightError::Kind::invalid_argument,
            fmt::format("time {} s is more than {:.0e} steps off; is a unit wrong?", time, most_steps_off));
    }
}

void Flight::advance_to(double time) {
    require_time(time);
    if (time == parts_->time && parts_->has_begun) return;
    parts_->has_begun = true;
    try {
        if (parts_->settings.bodies_meet) {
            fly_together(time);
        } else {
            for (const auto& kind : parts_->kinds) kind->advance_to(time, time - parts_->time);
        }
    } catch (const FlightError& lost) {
        parts_->stopped = lost.what();
        throw;
    }
    parts_->time = time;
}

void Flight::fly_together(double time) {
    auto& kinds = parts_->kinds;
    const double step = parts_->settings.step;
    for (const auto& kind : kinds) kind->begin_call(time, time - parts_->time);
    const std::uint64_t needed = steps_reaching(time, step);
    for (std::uint64_t now = steps_reaching(parts_->time, step); now < needed; ++now) {
        if (now + 1 == needed) {
            for (const auto& kind : kinds) {
                if (kind->grid_start() <= now) kind->note_poses();
            }
        }
        parts_->broadphase.take_step(kinds, parts_->surroundings, now);
    }
    for (const auto& kind : kinds) kind->require_finite();
}

void Flight::wake_all() {
    if (!parts_->settings.bodies_meet) return;
    for (const auto& kind : parts_->kinds) {
        for (std::size_t i = 0; i < kind->size(); ++i) kind->wake(i);
    }
}

BodyGroup& Flight::kind_of(std::size_t index) const {
    const auto next = std::upper_bound(parts_->kinds.begin(), parts_->kinds.end(), index,
                                       [](std::size_t i, const auto& kind) { return i < kind->first(); });
    return **std::prev(next);
}

Pose Flight::pose(std::size_t index) const {
    const BodyGroup& kind = kind_of(index);
    return kind.pose(index - kind.first(), parts_->time);
}

void Flight::poses(std::size_t first, std::size_t count, Pose* poses) const {
    parallel_for(count, poses_a_piece, parts_->settings.threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) poses[i] = pose(first + i);
    });
}

void Flight::set_pose(std::size_t index, const Pose& pose) {
    BodyGroup& kind = kind_of(index);
    kind.set_pose(index - kind.first(), pose, parts_->time);
    wake_all();
}

void Flight::add_wrench(std::size_t index, const Wrench& wrench) {
    BodyGroup& kind = kind_of(index);
    kind.add_wrench(index - kind.first(), wrench);
}

void Flight::add_impulse(std::size_t index, const Wrench& impulse) {
    BodyGroup& kind = kind_of(index);
    kind.add_impulse(index - kind.first(), impulse, parts_->time);
    wake_all();
}

void Flight::remove(std::size_t index) {
    BodyGroup& kind = kind_of(index);
    kind.remove(index - kind.first(), parts_->time);
    wake_all();
}

bool Flight::is_removed(std::size_t index) const {
    const BodyGroup& kind = kind_of(index);
    return kind.is_removed(index - kind.first());
}

bool Flight::is_at_rest(std::size_t index) const {
    const BodyGroup& kind = kind_of(index);
    return kind.is_at_rest(index - kind.first());
}

void Flight::watch_contacts(bool watch) {
    parts_->watches_contacts = watch;
    for (const auto& kind : parts_->kinds) kind->watch_contacts(watch);
}

ContactRecord Flight::take_contacts(std::size_t index) {
    if (!parts_->watches_contacts) {
        refuse(FlightError::Kind::invalid_argument,
               "contacts are not noted; call watch_contacts before they happen");
    }
    BodyGroup& kind = kind_of(index);
    return kind.take_contacts(index - kind.first());
}

FluidLoad Flight::fluid_load(std::size_t index) const {
    const BodyGroup& kind = kind_of(index);
    return kind.fluid_load(index - kind.first(), parts_->time);
}

double Flight::size_of(std::size_t index) const {
    const BodyGroup& kind = kind_of(index);
    return kind.size_of(index - kind.first());
}

double Flight::mass(std::size_t index) const {
    const double size = size_of(index);
    return size * size * size * kind_of(index).body().mass;
}

Matrix3d Flight::inertia(std::size_t index) const {
    const double size = size_of(index);
    return (size * size * size) * (size * size) * kind_of(index).body().own_inertia;
}

Vector3d Flight::center_of_mass(std::size_t index) const {
    const BodyGroup& kind = kind_of(index);
    return size_of(index) * kind.body().center_of_mass;
}

void Flight::set_seed(std::uint64_t seed, std::uint32_t first_run) {
    parts_->settings.seed = seed;
    parts_->settings.first_run = first_run;
    for (const auto& kind : parts_->kinds) kind->set_seed(seed, first_run);
}

std::string Flight::fingerprint() const {
    const FlightSettings& all = parts_->settings;
    std::string text = fmt::format("{} {} {} {} {} {} ground {} step {} runs {}\n", all.fluid.density,
                                   all.fluid.viscosity, fmt::join(all.fluid.current.reshaped(), " "),
                                   fmt::join(all.fluid.gust.amplitude.reshaped(), " "), all.fluid.gust.period,
                                   fmt::join(all.gravity.reshaped(), " "),
                                   all.ground ? fmt::format("{}", *all.ground) : "none", all.step, all.runs);
    for (std::size_t i = 0; i < obstacle_count(); ++i) {
        text += description_of(parts_->obstacles->obstacles()[i].obstacle());
    }
    text += description_of(all.wind);
    if (all.bodies_meet) text += "bodies meet\n";
    for (const auto& kind : parts_->kinds) text += kind->description();
    return text;
}

std::size_t Flight::fixed_state_size() const {
    std::size_t size = sizeof(parts_->time) + sizeof(std::uint8_t) + sizeof(parts_->settings.seed) +
                       sizeof(parts_->settings.first_run);
    for (const auto& kind : parts_->kinds) size += kind->state_size();
    return size;
}

std::size_t Flight::state_size() const {
    std::size_t size = seal_size() + fixed_state_size();
    for (std::size_t i = 0; i < obstacle_count(); ++i) {
        size += keys_size(parts_->obstacles->obstacles()[i].obstacle().keys.size());
    }
    return size;
}

std::string Flight::state() const {
    require_running();
    StateWriter writer;
    writer.write(parts_->time);
    writer.write(static_cast<std::uint8_t>(parts_->has_begun));
    writer.write(parts_->settings.seed);
    writer.write(parts_->settings.first_run);
    for (const auto& kind : parts_->kinds) kind->write(writer);
    for (std::size_t i = 0; i < obstacle_count(); ++i) {
        writer.write(parts_->obstacles->obstacles()[i].obstacle().keys);
    }
    return sealed_state(writer.bytes(), fingerprint());
}

void Flight::set_state(std::string_view bytes) {
    const std::string_view payload = opened_state(bytes, fingerprint(), fixed_state_size());
    // Sealed by another hand it may hold anything: all of it is looked at before any of it is kept.
    if (!read_state(payload, false)) {
        refuse(FlightError::Kind::foreign_state, "the state holds numbers that no simulation has");
    }
    read_state(payload, true);
}

bool Flight::read_state(std::string_view payload, bool keep) {
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
    for (const auto& kind : parts_->kinds) sound = sound && kind->read(reader, time, keep);
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
