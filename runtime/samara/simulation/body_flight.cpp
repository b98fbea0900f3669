#include "samara/simulation/body_flight.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include <fmt/format.h>

#include "samara/base/error.hpp"
#include "samara/base/parallel_for.hpp"
#include "samara/dynamics/loads.hpp"
#include "samara/simulation/world_pose.hpp"

namespace samara {
namespace {

constexpr std::size_t poses_a_piece = 256;
constexpr std::uint64_t most_steps_a_call = 4096;  // what a call keeps in memory grows with its steps

}  // namespace

Surroundings surroundings_of(const Scene& scene) {
    return {.gravity = scene.gravity,
            .current = scene.fluid.current,
            .gust = scene.fluid.gust,
            .ground = scene.ground};
}

double share_below_table(const FlightReport& report) {
    if (report.moving == 0) return 0.0;
    return static_cast<double>(report.below_table) / static_cast<double>(report.moving);
}

BodyFlight::BodyFlight(const Scene& scene, const SceneBody& scene_body, const ImmersedBody& body, int runs,
                       int threads)
    : body_(body),
      surroundings_(surroundings_of(scene)),
      start_(scene_body.start),
      step_(scene.step),
      copies_(static_cast<std::size_t>(scene_body.count)),
      threads_(threads),
      batch_(body, static_cast<std::size_t>(runs) * copies_),
      after_(batch_.size()),
      last_(batch_.size()),
      errors_met_(batch_.size()) {
    for (std::size_t i = 0; i < batch_.size(); ++i) {
        const auto run = static_cast<std::uint32_t>(i / copies_);
        const auto copy = static_cast<std::uint32_t>(i % copies_);
        const Noise noise(scene.seed, scene_body.name, run, copy);
        const BodyState state = initial_state(scene_body, body.center_of_mass, surroundings_, noise);
        require_above_ground(body, body.name, surroundings_, start_, state, copy, copies_);
        batch_.set_noise(i, noise);
        batch_.set_state(i, state);
        after_[i] = flow_pose(state);
        last_[i] = state.orientation;
    }
    before_ = after_;
}

void BodyFlight::fly_to(double time, Pose* poses, std::size_t run_stride) {
    const double in_flight = time - start_;
    const auto place = [&](std::size_t i) { return (i / copies_) * run_stride + i % copies_; };
    if (in_flight < 0.0) {
        for (std::size_t i = 0; i < batch_.size(); ++i) poses[place(i)] = held(i);
        return;
    }
    step_to(in_flight);
    const double begin = (static_cast<double>(steps_) - 1.0) * step_;
    const double fraction = steps_ == 0 ? 1.0 : std::clamp((in_flight - begin) / step_, 0.0, 1.0);
    parallel_for(batch_.size(), poses_a_piece, threads_, [&](std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; ++i) {
            Pose& pose = poses[place(i)];
            const Pose in_flow = interpolated(before_[i], after_[i], fraction, step_);
            errors_met_[i].add(table_errors_met(body_, in_flow));
            pose = in_world(in_flow, surroundings_, time);
            keep_sign_continuous(pose.orientation, last_[i]);
            last_[i] = pose.orientation;
        }
    });
}

void BodyFlight::step_to(double time_in_flight) {
    const auto needed = static_cast<std::uint64_t>(std::ceil(time_in_flight * (1.0 - 1e-12) / step_));
    if (needed <= steps_) return;
    if (needed - 1 > steps_) {
        advance(needed - 1 - steps_);
        note_poses();
    }
    before_.swap(after_);
    advance(1);
    note_poses();
    if (const auto lost = std::find_if(after_.begin(), after_.end(),
                                       [](const Pose& pose) {
                                           return !pose.position.allFinite() || !pose.velocity.allFinite() ||
                                                  !pose.angular_velocity.allFinite();
                                       });
        lost != after_.end()) {
        throw Error(fmt::format("body '{}' left the range of numbers at {:.4g} s; use a smaller step",
                                body_.name, start_ + static_cast<double>(steps_) * step_));
    }
}

void BodyFlight::advance(std::uint64_t steps) {
    const std::uint64_t end = steps_ + steps;
    while (steps_ < end) {
        const std::uint64_t now = std::min(end - steps_, most_steps_a_call);
        const BatchReport done = batch_.advance(surroundings_, start_, step_, steps_, now, threads_);
        steps_ += now;
        report_.steps += now * batch_.size();
        report_.batch.add(done);
    }
}

void BodyFlight::note_poses() {
    const double lowest = body_.tables ? 0.5 * body_.tables->reynolds_numbers.front() : 0.0;
    std::mutex mutex;
    parallel_for(batch_.size(), poses_a_piece, threads_, [&](std::size_t first, std::size_t end) {
        FlightReport piece;
        for (std::size_t i = first; i < end; ++i) {
            after_[i] = flow_pose(batch_.state(i));
            const double reynolds = reynolds_number(body_, after_[i].velocity.norm());
            piece.highest_reynolds_number = std::max(piece.highest_reynolds_number, reynolds);
            if (after_[i].velocity.isZero(0.0)) continue;
            ++piece.moving;
            piece.below_table += reynolds < lowest ? 1 : 0;
        }
        const std::lock_guard lock(mutex);
        report_.highest_reynolds_number =
            std::max(report_.highest_reynolds_number, piece.highest_reynolds_number);
        report_.moving += piece.moving;
        report_.below_table += piece.below_table;
    });
}

FlightReport BodyFlight::report() const {
    FlightReport report = report_;
    for (const TableErrorsMet& met : errors_met_) report.table_errors.add(met);
    return report;
}

Pose BodyFlight::held(std::size_t index) const {
    Pose pose = in_world(after_[index], surroundings_, start_);
    pose.velocity.setZero();
    pose.angular_velocity.setZero();
    return pose;
}

}  // namespace samara
