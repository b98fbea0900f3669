#include "samara/c_interface/live_simulation.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "samara/c_interface/guard.hpp"
#include "samara/c_interface/state_bytes.hpp"
#include "samara/dynamics/loads.hpp"
#include "samara/simulation/world_pose.hpp"

namespace samara {
namespace {

constexpr double most_steps = 1e10;
/// The bodies' speeds and whether they are numbers are looked at after every so many steps of the grid,
/// whatever times are asked for.
constexpr std::uint64_t steps_between_looks = 32;

/// Says what the body lacks in the words of the C interface.
void require_data(const Body& body, const SceneBody& kind) {
    if (kind.added_mass && !body.kirchhoff) {
        throw Fault(SAMARA_MISSING_DATA,
                    fmt::format("body '{}' holds no added mass; add it with 'samara kirchhoff', or set "
                                "added_mass to 0",
                                kind.name));
    }
    const bool loads = kind.loads == Loads::table;
    if ((loads || kind.turbulence == Turbulence::table) && !body.tables) {
        throw Fault(
            SAMARA_MISSING_DATA,
            fmt::format("body '{0}' holds no tables, which {1} asks for; make them with 'samara bake', or "
                        "set {1} otherwise",
                        kind.name, loads ? "loads" : "turbulence"));
    }
}

std::string text_of(const Vector3d& v) {
    return fmt::format("({} {} {})", v.x(), v.y(), v.z());
}

/// All numbers exactly, so that equal texts mean the same motion from the same state and noise.
std::string description_of(const SceneBody& kind, const ImmersedBody& body, const std::string& hash) {
    const Matrix3d inertia = body.inertia.topLeftCorner<3, 3>();
    const CoefficientLoads& coefficients = body.coefficients;
    return fmt::format(
        "{} {} {} {} {} {} {} {} {} loads {} {} {} {} {} {} turbulence {} {} {} {} models {} {} {}\n",
        kind.name, kind.count, kind.start, hash, body.mass, text_of(body.center_of_mass),
        text_of(inertia.col(0)), text_of(inertia.col(1)), text_of(inertia.col(2)),
        static_cast<int>(kind.loads), coefficients.drag_coefficient, coefficients.lift_coefficient,
        coefficients.reference_area.value_or(0.0), text_of(*coefficients.normal),
        text_of(coefficients.center_of_pressure), static_cast<int>(kind.turbulence),
        kind.turbulent_kinetic_energy, kind.dissipation_rate, static_cast<int>(kind.langevin),
        kind.added_mass, static_cast<int>(kind.dynamic), kind.table_reynolds_number.value_or(0.0));
}

/// The pose after steady motion over `duration` (s).
Pose carried(const Pose& pose, double duration) {
    Pose result = pose;
    result.position += duration * pose.velocity;
    const double angle = duration * pose.angular_velocity.norm();
    if (angle > 0.0) {
        result.orientation =
            Quaterniond(Eigen::AngleAxisd(angle, pose.angular_velocity.normalized())) * pose.orientation;
    }
    return result;
}

template <typename AnyReport, typename Visit>
void visit_report(AnyReport& report, const Visit& visit) {
    visit(report.steps);
    visit(report.substeps);
    visit(report.most_substeps);
    visit(report.highest_reynolds_number);
}

bool is_finite(const BodyState& state) {
    return state.position.allFinite() && state.velocity.allFinite() && state.orientation.coeffs().allFinite();
}

}  // namespace

LiveSimulation::LiveSimulation(const SimulationSettings& settings) : settings_(settings) {}

std::size_t LiveSimulation::add(const Body& body, PreparedBodies& prepared, const std::string& hash,
                                const SceneBody& given) {
    if (has_begun_) throw Fault(SAMARA_INVALID_ARGUMENT, "bodies cannot be added after the first advance");
    SceneBody kind = given;
    if (kind.name.empty()) kind.name = body.name;
    for (const Kind& other : kinds_) {
        if (other.given.name != kind.name) continue;
        throw Fault(SAMARA_INVALID_ARGUMENT,
                    fmt::format("the name '{}' is taken by another kind; give this one another", kind.name));
    }
    require_data(body, kind);
    const auto count = static_cast<std::size_t>(kind.count);
    auto immersed = prepared.get(body, kind, settings_.fluid);
    Batch batch(*immersed, count);
    Kind added{.given = kind,
               .description = description_of(kind, *immersed, hash),
               .body = std::move(immersed),
               .batch = std::move(batch),
               .first = size_,
               .steps = 0,
               .before = std::vector<Pose>(count),
               .before_time = std::vector<double>(count, kind.start)};
    for (std::size_t i = 0; i < count; ++i) {
        const Noise noise(settings_.seed, kind.name, settings_.run, static_cast<std::uint32_t>(i));
        const BodyState state =
            initial_state(kind, added.body->center_of_mass, settings_.surroundings, noise);
        require_above_ground(*added.body, kind.name, settings_.surroundings, kind.start, state, i, count);
        added.batch.set_state(i, state);
        added.before[i] = flow_pose(state);
    }
    key_noise(added);
    kinds_.push_back(std::move(added));
    const std::size_t first = size_;
    size_ += count;
    return first;
}

void LiveSimulation::key_noise(Kind& kind) {
    for (std::size_t i = 0; i < kind.batch.size(); ++i) {
        kind.batch.set_noise(
            i, Noise(settings_.seed, kind.given.name, settings_.run, static_cast<std::uint32_t>(i)));
    }
}

void LiveSimulation::set_seed(std::uint64_t seed, std::uint32_t run) {
    settings_.seed = seed;
    settings_.run = run;
    for (Kind& kind : kinds_) key_noise(kind);
}

double LiveSimulation::step_time(const Kind& kind) const {
    return kind.given.start + static_cast<double>(kind.steps) * settings_.step;
}

void LiveSimulation::require_running() const {
    if (!stopped_.empty()) throw Fault(SAMARA_OUT_OF_RANGE, stopped_);
}

void LiveSimulation::advance_to(double time) {
    require_running();
    if (!std::isfinite(time)) throw Fault(SAMARA_INVALID_ARGUMENT, "time is not a finite number");
    if (time < time_) {
        throw Fault(SAMARA_TIME_PASSED,
                    fmt::format("the simulation is at {} s and cannot go back to {} s; restore "
                                "a state from before",
                                time_, time));
    }
    if (time / settings_.step > most_steps) {
        throw Fault(
            SAMARA_INVALID_ARGUMENT,
            fmt::format("time {} s is more than {:.0e} steps off; is a unit wrong?", time, most_steps));
    }
    has_begun_ = true;
    for (Kind& kind : kinds_) {
        const std::uint64_t needed = steps_until(time - kind.given.start);
        if (needed <= kind.steps) continue;
        step_to(kind, needed - 1);
        for (std::size_t i = 0; i < kind.batch.size(); ++i) {
            kind.before[i] = flow_pose(kind.batch.state(i));
            kind.before_time[i] = step_time(kind);
        }
        step_to(kind, needed);
        require_finite(kind);
    }
    time_ = time;
}

std::uint64_t LiveSimulation::steps_until(double time_in_flight) const {
    const double reached = time_in_flight * (1.0 - 1e-12);
    auto steps = static_cast<std::uint64_t>(std::max(0.0, std::floor(reached / settings_.step)));
    while (static_cast<double>(steps) * settings_.step < reached) ++steps;
    return steps;
}

void LiveSimulation::step_to(Kind& kind, std::uint64_t steps) {
    while (kind.steps < steps) {
        const std::uint64_t next_look = (kind.steps / steps_between_looks + 1) * steps_between_looks;
        const std::uint64_t end = std::min(steps, next_look);
        const BatchReport done = kind.batch.advance(settings_.surroundings, kind.given.start, settings_.step,
                                                    kind.steps, end - kind.steps, settings_.threads);
        report_.steps += (end - kind.steps) * kind.batch.size();
        report_.substeps += done.implicit_steps;
        report_.most_substeps = std::max(report_.most_substeps, done.most_substeps);
        kind.steps = end;
        if (end == next_look) {
            require_finite(kind);
            report_.highest_reynolds_number =
                std::max(report_.highest_reynolds_number, highest_reynolds_number(kind));
        }
    }
}

void LiveSimulation::require_finite(const Kind& kind) {
    for (std::size_t i = 0; i < kind.batch.size(); ++i) {
        if (is_finite(kind.batch.state(i))) continue;
        stopped_ = fmt::format("body {} ('{}') left the range of numbers by {:.6g} s; use a smaller step",
                               kind.first + i, kind.given.name, step_time(kind));
        throw Fault(SAMARA_OUT_OF_RANGE, stopped_);
    }
}

double LiveSimulation::highest_reynolds_number(const Kind& kind) {
    double highest_speed = 0.0;
    for (std::size_t i = 0; i < kind.batch.size(); ++i) {
        highest_speed = std::max(highest_speed, kind.batch.state(i).velocity.tail<3>().norm());
    }
    return reynolds_number(*kind.body, highest_speed);
}

LiveReport LiveSimulation::report() const {
    LiveReport report = report_;
    for (const Kind& kind : kinds_) {
        if (kind.steps == 0) continue;
        report.highest_reynolds_number =
            std::max(report.highest_reynolds_number, highest_reynolds_number(kind));
    }
    return report;
}

std::pair<const LiveSimulation::Kind*, std::size_t> LiveSimulation::find(std::size_t index) const {
    const auto next = std::upper_bound(kinds_.begin(), kinds_.end(), index,
                                       [](std::size_t i, const Kind& kind) { return i < kind.first; });
    const Kind& kind = *std::prev(next);
    return {&kind, index - kind.first};
}

const Vector3d& LiveSimulation::center_of_mass(std::size_t index) const {
    return find(index).first->body->center_of_mass;
}

Pose LiveSimulation::pose(std::size_t index) const {
    const auto [kind, i] = find(index);
    const double end = step_time(*kind);
    const Pose after = flow_pose(kind->batch.state(i));
    if (time_ < kind->given.start) {
        Pose held = in_world(after, settings_.surroundings, kind->given.start);
        held.velocity.setZero();
        held.angular_velocity.setZero();
        return held;
    }
    const double duration = end - kind->before_time[i];
    if (!(duration > 0.0)) return in_world(after, settings_.surroundings, time_);
    const double fraction = std::clamp((time_ - kind->before_time[i]) / duration, 0.0, 1.0);
    return in_world(interpolated(kind->before[i], after, fraction, duration), settings_.surroundings, time_);
}

void LiveSimulation::set_pose(std::size_t index, const Pose& pose) {
    const auto [found, i] = find(index);
    Kind& kind = kinds_[static_cast<std::size_t>(found - kinds_.data())];
    const double end = step_time(kind);
    const double begin = std::min(std::max(time_, kind.given.start), end);
    const Pose in_flow_now = in_flow(pose, settings_.surroundings, begin);
    BodyState state = state_of(carried(in_flow_now, end - begin));
    state.seen_fluid = kind.batch.state(i).seen_fluid;
    kind.before[i] = in_flow_now;
    kind.before_time[i] = begin;
    kind.batch.set_state(i, state);
}

std::string LiveSimulation::fingerprint() const {
    const Surroundings& around = settings_.surroundings;
    std::string all = fmt::format("{} {} {} {} {} {} ground {} {}\n", settings_.fluid.density,
                                  settings_.fluid.viscosity, text_of(around.current),
                                  text_of(around.gust.amplitude), around.gust.period, text_of(around.gravity),
                                  around.ground ? fmt::format("{}", *around.ground) : "none", settings_.step);
    for (const Kind& kind : kinds_) all += kind.description;
    return all;
}

std::size_t LiveSimulation::state_size() const {
    constexpr std::size_t common = sizeof(double) + sizeof(std::uint8_t) + sizeof(std::uint64_t) +
                                   sizeof(std::uint32_t);  // time, begun, seed, run
    constexpr std::size_t of_report = 2 * sizeof(std::uint64_t) + sizeof(std::int32_t) + sizeof(double);
    constexpr std::size_t of_a_body = body_state_bytes + pose_bytes + sizeof(double);
    return seal_size() + common + of_report + kinds_.size() * sizeof(std::uint64_t) + size_ * of_a_body;
}

std::string LiveSimulation::state() const {
    require_running();
    StateWriter writer;
    writer.write(time_);
    writer.write(static_cast<std::uint8_t>(has_begun_));
    writer.write(settings_.seed);
    writer.write(settings_.run);
    visit_report(report_, [&](auto number) { writer.write(number); });
    for (const Kind& kind : kinds_) {
        writer.write(kind.steps);
        for (std::size_t i = 0; i < kind.batch.size(); ++i) {
            writer.write(kind.batch.state(i));
            writer.write(kind.before[i]);
            writer.write(kind.before_time[i]);
        }
    }
    return sealed_state(writer.bytes(), fingerprint());
}

void LiveSimulation::set_state(std::string_view bytes) {
    StateReader reader(opened_state(bytes, fingerprint(), state_size() - seal_size()));
    std::uint8_t has_begun = 0;
    std::uint64_t seed = 0;
    std::uint32_t run = 0;
    reader.read(time_);
    reader.read(has_begun);
    reader.read(seed);
    reader.read(run);
    visit_report(report_, [&](auto& number) { reader.read(number); });
    for (Kind& kind : kinds_) {
        reader.read(kind.steps);
        for (std::size_t i = 0; i < kind.batch.size(); ++i) {
            BodyState state;
            reader.read(state);
            kind.batch.set_state(i, state);
            reader.read(kind.before[i]);
            reader.read(kind.before_time[i]);
        }
    }
    has_begun_ = has_begun != 0;
    stopped_.clear();
    set_seed(seed, run);
}

}  // namespace samara
