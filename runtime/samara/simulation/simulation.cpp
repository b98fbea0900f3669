#include "samara/simulation/simulation.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "samara/base/error.hpp"
#include "samara/dynamics/immersed_body.hpp"
#include "samara/dynamics/loads.hpp"
#include "samara/dynamics/step.hpp"
#include "samara/simulation/world_pose.hpp"

namespace samara {
namespace {

constexpr std::uint64_t steps_between_progress = 4096;

/// Frame times from 0 to the duration.
std::vector<double> frame_times(const Scene& scene) {
    const auto last = static_cast<int>(std::floor(scene.duration * scene.frame_rate * (1.0 + 1e-12)));
    std::vector<double> times(static_cast<std::size_t>(last) + 1);
    for (std::size_t frame = 0; frame < times.size(); ++frame) {
        times[frame] = static_cast<double>(frame) / scene.frame_rate;
    }
    return times;
}

Surroundings surroundings_of(const Scene& scene) {
    return {.gravity = scene.gravity, .current = scene.fluid.current};
}

/// The whole flight of one copy in one run.
class Flight {
  public:
    Flight(const Scene& scene, const SceneBody& scene_body, const ImmersedBody& body, const Noise& noise)
        : scene_(scene),
          scene_body_(scene_body),
          body_(body),
          noise_(noise),
          surroundings_(surroundings_of(scene)),
          state_(initial_state(scene_body, body.center_of_mass, surroundings_, noise)),
          after_(pose_of(state_, surroundings_, scene_body.start)),
          before_(after_) {
        held_ = after_;
        held_.velocity.setZero();
        held_.angular_velocity.setZero();
    }

    /// The pose at a time (s), not before the last one asked for.
    Pose at(double time) {
        const double in_flight = time - scene_body_.start;
        if (in_flight < 0.0) return held_;
        while (static_cast<double>(steps_) * scene_.step < in_flight * (1.0 - 1e-12)) step();
        if (steps_ == 0) return after_;
        const double begin = static_cast<double>(steps_ - 1) * scene_.step;
        const double fraction = std::clamp((in_flight - begin) / scene_.step, 0.0, 1.0);
        return interpolated(before_, after_, fraction, scene_.step);
    }

    [[nodiscard]] std::uint64_t steps() const { return steps_; }
    [[nodiscard]] std::uint64_t implicit_steps() const { return implicit_steps_; }
    [[nodiscard]] int most_substeps() const { return most_substeps_; }
    [[nodiscard]] double highest_reynolds_number() const { return reynolds_number(body_, highest_speed_); }

  private:
    /// The world's time (s) that the steps have come to.
    [[nodiscard]] double step_time() const {
        return scene_body_.start + static_cast<double>(steps_) * scene_.step;
    }

    void step() {
        const StepResult result =
            advance(body_, surroundings_, step_time(), scene_.step, state_, noise_, steps_);
        state_ = result.state;
        if (!state_.velocity.allFinite() || !state_.position.allFinite()) {
            throw Error(fmt::format("body '{}' left the range of numbers at {:.4g} s; use a smaller step",
                                    body_.name, step_time()));
        }
        ++steps_;
        implicit_steps_ += static_cast<std::uint64_t>(result.substeps);
        most_substeps_ = std::max(most_substeps_, result.substeps);
        highest_speed_ = std::max(highest_speed_, state_.velocity.tail<3>().norm());
        before_ = after_;
        after_ = pose_of(state_, surroundings_, step_time());
        keep_sign_continuous(after_.orientation, before_.orientation);
    }

    const Scene& scene_;
    const SceneBody& scene_body_;
    const ImmersedBody& body_;
    const Noise noise_;
    const Surroundings surroundings_;
    BodyState state_;
    Pose after_;
    Pose before_;
    Pose held_;
    std::uint64_t steps_ = 0;
    std::uint64_t implicit_steps_ = 0;
    int most_substeps_ = 1;
    double highest_speed_ = 0.0;
};

std::string models_of(const SceneBody& scene_body, const ImmersedBody& body) {
    constexpr const char* loads[] = {"none", "coefficients", "table"};
    constexpr const char* turbulence[] = {"none", "constant", "table"};
    constexpr const char* langevin[] = {"seen-fluid", "body-velocity"};
    std::string text = fmt::format("loads {}; turbulence {}", loads[static_cast<int>(scene_body.loads)],
                                   turbulence[static_cast<int>(scene_body.turbulence)]);
    if (scene_body.turbulence != Turbulence::none) {
        text += fmt::format(" ({})", langevin[static_cast<int>(scene_body.langevin)]);
    }
    if (!body.dynamic.origin.empty()) text += "; " + body.dynamic.origin;
    return text;
}

BodyMotion empty_motion(const SceneBody& scene_body, const ImmersedBody& immersed, const CastBody& cast) {
    BodyMotion motion;
    motion.name = scene_body.name;
    motion.center_of_mass = immersed.center_of_mass;
    motion.shortest_axis = principal_axes(cast.body.moments).col(0);
    motion.body_hash = cast.hash;
    motion.models = models_of(scene_body, immersed);
    motion.surface = cast.body.surface;
    motion.copies = scene_body.count;
    return motion;
}

/// One body of the scene: flies all its copies in all runs.
class BodyFlights {
  public:
    BodyFlights(const Scene& scene, const SceneBody& scene_body, const ImmersedBody& body,
                const std::function<bool(double done)>& progress, SimulationReport& report)
        : scene_(scene), scene_body_(scene_body), body_(body), progress_(progress), report_(report) {}

    /// Fills the poses of `motion`, and returns the highest Reynolds number met.
    double fly(const std::vector<double>& times, int runs, BodyMotion& motion) {
        const std::size_t frames = times.size();
        const auto copies = static_cast<std::size_t>(motion.copies);
        motion.poses.resize(static_cast<std::size_t>(runs) * frames * copies);
        double highest_reynolds_number = 0.0;
        for (std::size_t run = 0; run < static_cast<std::size_t>(runs); ++run) {
            for (std::size_t copy = 0; copy < copies; ++copy) {
                const Noise noise(scene_.seed, scene_body_.name, static_cast<std::uint32_t>(run),
                                  static_cast<std::uint32_t>(copy));
                Flight flight(scene_, scene_body_, body_, noise);
                fly_one(flight, times, &motion.poses[run * frames * copies + copy], copies);
                highest_reynolds_number = std::max(highest_reynolds_number, flight.highest_reynolds_number());
            }
        }
        return highest_reynolds_number;
    }

  private:
    /// One flight; its pose at frame f goes to poses[f * stride].
    void fly_one(Flight& flight, const std::vector<double>& times, Pose* poses, std::size_t stride) {
        std::uint64_t told = 0;
        for (std::size_t frame = 0; frame < times.size(); ++frame) {
            Pose& pose = poses[frame * stride];
            pose = flight.at(times[frame]);
            if (frame > 0) keep_sign_continuous(pose.orientation, poses[(frame - 1) * stride].orientation);
            if (flight.steps() - told < steps_between_progress) continue;
            told = flight.steps();
            if (!progress_(static_cast<double>(report_.steps + told)))
                throw Error("interrupted: nothing was written");
        }
        report_.steps += flight.steps();
        report_.implicit_steps += flight.implicit_steps();
        report_.most_substeps = std::max(report_.most_substeps, flight.most_substeps());
    }

    const Scene& scene_;
    const SceneBody& scene_body_;
    const ImmersedBody& body_;
    const std::function<bool(double)>& progress_;
    SimulationReport& report_;
};

/// Steps that the whole scene takes.
double total_steps(const Scene& scene, int runs) {
    double copies = 0.0;
    for (const SceneBody& body : scene.bodies) copies += body.count;
    return copies * runs * scene.duration / scene.step;
}

}  // namespace

SimulationResult simulate(const Scene& scene, const std::vector<CastBody>& cast, int runs,
                          const std::function<bool(double, double)>& progress) {
    SimulationResult result;
    Motion& motion = result.motion;
    motion.times = frame_times(scene);
    motion.runs = runs;
    motion.frame_rate = scene.frame_rate;
    motion.gravity = scene.gravity;
    motion.seed = scene.seed;
    motion.scene_text = scene.text;

    std::vector<ImmersedBody> bodies;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        bodies.push_back(make_immersed_body(cast[i].body, scene.bodies[i], scene.fluid));
    }
    const double total = total_steps(scene, runs);
    const std::function<bool(double)> tell = [&](double done) { return progress(done, total); };
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        motion.bodies.push_back(empty_motion(scene.bodies[i], bodies[i], cast[i]));
        BodyFlights flights(scene, scene.bodies[i], bodies[i], tell, result.report);
        result.report.highest_reynolds_number.push_back(
            flights.fly(motion.times, runs, motion.bodies.back()));
    }
    result.report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

}  // namespace samara
