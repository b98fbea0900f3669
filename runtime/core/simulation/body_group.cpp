#include "samara/core/simulation/body_group.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "samara/core/base/parallel_for.hpp"
#include "samara/core/collision/obstacle_contact.hpp"
#include "samara/core/contact/ground_contact.hpp"
#include "samara/core/dynamics/body_size.hpp"
#include "samara/core/dynamics/body_wind.hpp"
#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/dynamics/loads.hpp"
#include "samara/core/integrator/step.hpp"
#include "samara/core/simulation/world_pose.hpp"
#include "samara/core/surface/surface_check.hpp"

namespace samara {
namespace {

/// The number of steps of the grid between samples of the bodies' speeds and checks of their numbers,
/// whatever times are asked for.
constexpr std::uint64_t steps_between_samples = 32;

/// Returns the wrench of a body; zero where there are none.
Wrench wrench_in(const std::vector<Wrench>& wrenches, std::size_t index) {
    return wrenches.empty() ? Wrench{} : wrenches[index];
}

/// Returns the pose after steady motion over `duration` (s).
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

}  // namespace

BodyGroup::BodyGroup(const SimulationSettings& settings, const Surroundings& surroundings,
                     const LoadedBody& body, const BodyPhysics& physics, const Release& release,
                     std::string name, std::size_t first)
    : name_(std::move(name)),
      first_(first),
      surroundings_(surroundings),
      release_(release),
      physics_(physics),
      step_(settings.step),
      threads_(settings.threads),
      collide_(settings.bodies_collide),
      fluid_(settings.fluid),
      loaded_(body),
      touches_(collide_ || has_ground(surroundings)),
      body_(body.prepared->get(*body.body, physics, settings.fluid, name_, touches_)),
      batch_(*body_, static_cast<std::size_t>(settings.runs) * release.copies(), settings.precision),
      before_(batch_.size()),
      before_time_(batch_.size(), 0.0) {
    if (release.start / step_ > most_steps_off) {
        throw SimulationError(SimulationError::Reason::invalid_argument,
                              fmt::format("start {} s is more than {:.0e} steps away; check the unit",
                                          release.start, most_steps_off));
    }
    if (collide_) {
        grid_start_ = steps_reaching(release_.start, step_);
        release_.start = time_of(grid_start_);
        faces_ = hull_faces(body_->contact_points);
    }
    set_seed(settings.seed, settings.first_run);
    draw_starts(settings);
}

void BodyGroup::find_contact_points() {
    if (std::exchange(touches_, true)) return;
    body_ = loaded_.prepared->get(*loaded_.body, physics_, fluid_, name_, true);
    batch_.set_body(*body_);
}

std::string BodyGroup::number_of(std::size_t index) const {
    return release_.simulated > 0 ? fmt::format("copy {}", copy_of(index))
                                  : fmt::format("body {}", first_ + index);
}

void BodyGroup::draw_starts(const SimulationSettings& settings) {
    const auto count = static_cast<std::size_t>(release_.count);
    std::vector<CopyStart> starts;
    for (std::size_t i = 0; i < batch_.size(); ++i) {
        starts.push_back(start_of_copy(release_, step_, noise_of(settings.seed, settings.first_run, i)));
    }
    if (release_.count > 1 && release_.spread_start > 0.0) {
        for (std::size_t i = 0; i < starts.size(); ++i) {
            first_steps_.push_back(starts[i].first_step);
            batch_.set_first_step(i, starts[i].first_step);
        }
    }
    if (release_.spreads_size()) {
        std::vector<double> sizes;
        sizes.reserve(starts.size());
        for (const CopyStart& start : starts) sizes.push_back(start.size);
        batch_.set_sizes(sizes, has_ground(surroundings_));
    }
    for (std::size_t i = 0; i < batch_.size(); ++i) {
        const BodyState state = initial_state(starts[i], body_->center_of_mass, surroundings_, start(i));
        if (!is_sound(state)) {
            throw SimulationError(
                SimulationError::Reason::invalid_argument,
                fmt::format("copy {} of '{}' starts beyond the range of numbers; check the units", copy_of(i),
                            name_));
        }
        const TouchingBody& touching = batch_.touching(i);
        require_above_ground(touching, name_, surroundings_, start(i), state, copy_of(i), count);
        require_outside_obstacles(touching, name_, surroundings_, start(i), state, copy_of(i), count);
        batch_.set_state(i, state);
        before_[i] = flow_pose(state);
    }
}

Noise BodyGroup::noise_of(std::uint64_t seed, std::uint32_t first_run, std::size_t index) const {
    return {seed, name_, first_run + static_cast<std::uint32_t>(index / copies()),
            static_cast<std::uint32_t>(copy_of(index))};
}

void BodyGroup::set_seed(std::uint64_t seed, std::uint32_t first_run) {
    seed_ = seed;
    first_run_ = first_run;
    for (std::size_t i = 0; i < batch_.size(); ++i) batch_.set_noise(i, noise_of(seed, first_run, i));
}

std::uint64_t steps_reaching(double time, double step) {
    const double reached = time * (1.0 - 1e-12);
    auto steps = static_cast<std::uint64_t>(std::max(0.0, std::floor(reached / step)));
    while (static_cast<double>(steps) * step < reached) ++steps;
    return steps;
}

std::uint64_t BodyGroup::steps_until(double time) const {
    if (!collide_) return steps_reaching(time - release_.start, step_);
    const std::uint64_t steps = steps_reaching(time, step_);
    return steps - std::min(steps, grid_start_);
}

void BodyGroup::begin_call(double time, double duration) {
    if (time <= release_.start) wrenches_.clear();  // a waiting body feels none
    take_up_wrenches(duration, steps_until(time) > steps_);
}

void BodyGroup::advance_to(double time, double duration) {
    const std::uint64_t needed = steps_until(time);
    begin_call(time, duration);
    if (needed <= steps_) return;
    step_to(needed - 1);
    record_poses();
    step_to(needed);
    require_finite();
}

void BodyGroup::record_poses() {
    parallel_for(batch_.size(), poses_a_piece, threads_, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (is_removed(i)) continue;
            before_[i] = flow_pose(batch_.state(i));
            before_time_[i] = time_of(steps_);
        }
    });
}

void BodyGroup::wake(std::size_t index) noexcept {
    BodyState state = batch_.own_state(index);
    if (!state.at_rest) return;
    state.at_rest = false;
    batch_.keep_own_state(index, state);
}

void BodyGroup::add_wrench(std::size_t index, const Wrench& wrench) {
    wrenches_.resize(batch_.size());
    wrenches_[index] = wrenches_[index] + wrench;
}

void BodyGroup::take_up_wrenches(double duration, bool has_steps) {
    if (duration > 0.0 && (!wrenches_.empty() || !pushed_.empty())) {
        wrenches_.resize(batch_.size());
        pushed_.resize(batch_.size());
        pushed_time_ += duration;
        for (std::size_t i = 0; i < pushed_.size(); ++i) {
            // The mean over the calls since the last step, so that a constant wrench acts unchanged.
            pushed_[i] = pushed_[i] + (duration / pushed_time_) * (wrenches_[i] + -1.0 * pushed_[i]);
        }
        wrenches_.clear();
    }
    if (!has_steps || (pushed_.empty() && acting_.empty())) return;
    // A body at rest may rest by its wrench, which has changed.
    for (std::size_t i = 0; i < batch_.size(); ++i) {
        if (!(wrench_in(pushed_, i) == wrench_in(acting_, i))) wake(i);
    }
    acting_ = std::exchange(pushed_, {});
    pushed_time_ = 0.0;
    batch_.set_external(acting_);
}

void BodyGroup::add_impulse(std::size_t index, const Wrench& impulse, double time) {
    const double size = size_of(index);
    const double end = time_of(steps_);
    const double begin = std::clamp(time - release_.start, 0.0, end);
    Pose now = pose_in_flow(index, release_.start + begin);
    BodyState state = batch_.own_state(index);
    // In the units of a body of the shape's size (body_size.hpp).
    const Quaterniond to_body = state.orientation.conjugate();
    Vector6d momentum;
    momentum << to_body * impulse.moment / (size * size * size), to_body * impulse.force / (size * size);
    const Vector6d change = body_->inverse_inertia * momentum;
    state.velocity += change;
    state.at_rest = false;
    const Vector3d rotation_change = state.orientation * change.head<3>() / (size * size);
    const Vector3d moving = state.orientation * change.tail<3>() / size;
    Pose change_of_pose;
    change_of_pose.velocity = moving;
    change_of_pose.angular_velocity = rotation_change;
    const bool waits = time < start(index);
    const Pose displacement = carried(change_of_pose, waits ? 0.0 : end - begin);
    state.position += displacement.position / size;
    state.orientation = displacement.orientation * state.orientation;
    batch_.keep_own_state(index, state);
    now.velocity += moving;
    now.angular_velocity += rotation_change;
    before_[index] = now;
    before_time_[index] = begin;
}

void BodyGroup::set_removed(std::size_t index, bool removed) {
    if (removed_.empty() && !removed) return;
    removed_.resize(batch_.size());
    removed_[index] = removed ? 1 : 0;
    batch_.set_first_step(index, removed ? std::numeric_limits<std::uint64_t>::max() : first_step(index));
}

void BodyGroup::remove(std::size_t index, double time) {
    if (is_removed(index)) return;
    before_[index] = pose(index, time);
    set_removed(index, true);
}

FluidLoad BodyGroup::fluid_load(std::size_t index, double time) const {
    if (std::abs(reached() - time) > 1e-6 * step_) {
        throw SimulationError(SimulationError::Reason::invalid_argument,
                              fmt::format("fluid loads are available at whole steps only, but {:.9g} s is "
                                          "within a step; advance by multiples of the step, {:g} s",
                                          time, step_));
    }
    return fluid_load_of(*body_, size_of(index), surroundings_, release_.start, step_,
                         batch_.own_state(index), noise_of(seed_, first_run_, index), steps_);
}

FluidForces BodyGroup::fluid_forces(std::size_t index, double time) const {
    if (is_removed(index) || time < start(index)) return {};
    return fluid_forces_of(*body_, size_of(index), surroundings_, release_.start, step_,
                           batch_.own_state(index), noise_of(seed_, first_run_, index), steps_);
}

void BodyGroup::step_to(std::uint64_t steps) {
    while (steps_ < steps) {
        const std::uint64_t next_sample = (steps_ / steps_between_samples + 1) * steps_between_samples;
        const std::uint64_t end = std::min(steps, next_sample);
        const BatchReport done = take_steps(end - steps_);
        keep_steps(done, end - steps_);
    }
}

BatchReport BodyGroup::take_steps(std::uint64_t count) {
    return batch_.advance(surroundings_, release_.start, step_, steps_, count, threads_);
}

void BodyGroup::keep_steps(const BatchReport& done, std::uint64_t count) {
    report_.add({.steps = steps_between(steps_, steps_ + count),
                 .implicit_steps = done.implicit_steps,
                 .most_substeps = done.most_substeps,
                 .steps_at_limit = done.steps_at_limit});
    steps_ += count;
    if (!done.wind_is_sound) {
        throw SimulationError(SimulationError::Reason::out_of_range,
                              fmt::format("the wind function returned a velocity for '{}' that is not "
                                          "finite, or beyond 1e30 m/s, at {:.6g} s",
                                          name_, release_.start + time_of(steps_)));
    }
    if (steps_ % steps_between_samples != 0) return;
    require_finite();
    report_.add(sampled());
}

std::uint64_t BodyGroup::steps_between(std::uint64_t begin, std::uint64_t end) const {
    if (first_steps_.empty() && removed_.empty()) return (end - begin) * batch_.size();
    std::uint64_t steps = 0;
    for (std::size_t i = 0; i < batch_.size(); ++i) {
        if (!is_removed(i)) steps += end - std::clamp(first_step(i), begin, end);
    }
    return steps;
}

void BodyGroup::require_finite() const {
    const std::size_t lost = batch_.first_not_finite();
    if (lost == batch_.size()) return;
    throw SimulationError(SimulationError::Reason::out_of_range,
                          fmt::format("{} ('{}') diverged at {:.6g} s; use a smaller step", number_of(lost),
                                      name_, release_.start + time_of(steps_)));
}

StepReport BodyGroup::sampled() const {
    const double lowest = body_->tables ? 0.5 * body_->tables->reynolds_numbers.front() : 0.0;
    const double now = release_.start + time_of(steps_);
    StepReport all;
    std::mutex mutex;
    parallel_for(batch_.size(), poses_a_piece, threads_, [&](std::size_t begin, std::size_t end) {
        StepReport piece;
        for (std::size_t i = begin; i < end; ++i) {
            if ((steps_ <= first_step(i) && first_step(i) > 0) || is_removed(i)) continue;
            const BodyState state = batch_.state(i);
            const Vector3d wind = wind_velocity(*body_, surroundings_, state.position, now);
            const Vector3d velocity = state.velocity.tail<3>() - state.orientation.conjugate() * wind;
            const double reynolds = reynolds_number(*body_, velocity.norm()) * size_of(i);
            piece.highest_reynolds_number = std::max(piece.highest_reynolds_number, reynolds);
            if (velocity.isZero(0.0)) continue;
            ++piece.moving;
            piece.below_table += reynolds < lowest ? 1 : 0;
        }
        const std::lock_guard lock(mutex);
        all.add(piece);
    });
    return all;
}

StepReport BodyGroup::report() const {
    StepReport report = report_;
    if (steps_ % steps_between_samples != 0) report.add(sampled());
    return report;
}

Pose BodyGroup::pose_in_flow(std::size_t index, double time) const {
    const Pose after = flow_pose(batch_.state(index));
    if (steps_ == 0) return after;
    const double begin = before_time_[index];
    const double duration = begin == time_of(steps_ - 1) ? step_ : time_of(steps_) - begin;
    if (!(duration > 0.0)) return after;
    return pose_between(before_[index], after, begin, duration, time - release_.start);
}

Pose BodyGroup::pose(std::size_t index, double time) const {
    if (is_removed(index)) return before_[index];
    if (time - start(index) < 0.0) return held(flow_pose(batch_.state(index)), surroundings_, start(index));
    return in_world(pose_in_flow(index, time), surroundings_, time);
}

Pose BodyGroup::pose_in_wind(std::size_t index, double time) const {
    return in_wind(pose_in_flow(index, time), *body_, surroundings_, time);
}

void BodyGroup::set_pose(std::size_t index, const Pose& pose, double time) {
    const double end = time_of(steps_);
    const double begin = std::clamp(time - release_.start, 0.0, end);
    const Pose in_flow_now = in_flow(pose, surroundings_, release_.start + begin);
    BodyState state = state_of(carried(in_flow_now, end - begin));
    if (is_removed(index)) {
        set_removed(index, false);
    } else {
        const BodyState now = batch_.state(index);
        state.sampled_turbulence = now.sampled_turbulence;
        state.wake = now.wake;
    }
    before_[index] = in_flow_now;
    before_time_[index] = begin;
    batch_.set_state(index, state);
}

void BodyGroup::require_outside(const ObstacleSet& obstacles, double time) {
    find_contact_points();
    for (std::size_t i = 0; i < batch_.size(); ++i) {
        if (is_removed(i)) continue;
        const Pose here = pose(i, time);
        const TouchingBody touching = touching_body(*body_, size_of(i));
        const auto overlap =
            first_overlap(obstacles, touching.contact_points, {here.position, here.orientation}, time);
        if (!overlap) continue;
        throw Error(
            fmt::format("copy {} of '{}' is inside obstacle '{}', at {}; add the obstacle elsewhere, or "
                        "move the body first",
                        i, name_, overlap->obstacle, samara::place(overlap->position)));
    }
}

void BodyGroup::set_surroundings(const Surroundings& surroundings) {
    const bool same_flow = surroundings.current == surroundings_.current &&
                           surroundings.gust.amplitude == surroundings_.gust.amplitude &&
                           surroundings.gust.period == surroundings_.gust.period;
    const auto in_new_flow = [&](const Pose& pose, double time) {
        return in_flow(in_world(pose, surroundings_, time), surroundings, time);
    };
    for (std::size_t i = 0; i < batch_.size(); ++i) {
        if (is_removed(i)) continue;
        BodyState state = batch_.state(i);
        state.at_rest = false;
        if (!same_flow) {
            // A waiting body is in the flow of its start.
            const bool waits = reached() < start(i);
            const BodyState moved = state_of(in_new_flow(flow_pose(state), std::max(reached(), start(i))));
            state.position = moved.position;
            state.velocity = moved.velocity;
            before_[i] = waits ? flow_pose(state) : in_new_flow(before_[i], release_.start + before_time_[i]);
        }
        batch_.set_state(i, state);
    }
    surroundings_ = surroundings;
    if (has_ground(surroundings_)) find_contact_points();
    if (!batch_.sizes().empty()) batch_.set_sizes(batch_.sizes(), has_ground(surroundings_));
}

}  // namespace samara
