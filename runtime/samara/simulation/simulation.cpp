#include "samara/simulation/simulation.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "samara/base/error.hpp"
#include "samara/motion/motion_writer.hpp"

namespace samara {
namespace {

/// Frame times from 0 to the duration.
std::vector<double> frame_times(const Scene& scene) {
    const auto last = static_cast<int>(std::floor(scene.duration * scene.frame_rate * (1.0 + 1e-12)));
    std::vector<double> times(static_cast<std::size_t>(last) + 1);
    for (std::size_t frame = 0; frame < times.size(); ++frame) {
        times[frame] = static_cast<double>(frame) / scene.frame_rate;
    }
    return times;
}

std::string models_of(const SceneBody& scene_body, const ImmersedBody& body) {
    constexpr const char* loads[] = {"none", "coefficients", "table"};
    constexpr const char* turbulence[] = {"none", "constant", "table"};
    constexpr const char* langevin[] = {"seen-fluid", "body-velocity"};
    std::string text = fmt::format("loads {}; turbulence {}", loads[static_cast<int>(scene_body.loads)],
                                   turbulence[static_cast<int>(scene_body.turbulence)]);
    if (scene_body.turbulence != Turbulence::none) {
        text += fmt::format(" ({})", langevin[static_cast<int>(scene_body.langevin)]);
    }
    if (scene_body.table_reynolds_number && body.tables) {
        text +=
            fmt::format("; tables at the Reynolds number {:.4g} alone", *scene_body.table_reynolds_number);
    }
    if (!scene_body.added_mass) text += "; no added mass";
    if (!body.dynamic.origin.empty()) text += "; " + body.dynamic.origin;
    if (scene_body.models_auto) text += R"(; chosen by models = "auto")";
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

/// Steps that a body takes until the end.
double steps_of(const Scene& scene, const SceneBody& body, int runs) {
    return std::max(0.0, scene.duration - body.start) / scene.step * body.count * runs;
}

}  // namespace

Simulation::Simulation(const Scene& scene, const std::vector<CastBody>& cast, int runs, int threads) {
    motion_.times = frame_times(scene);
    motion_.runs = runs;
    motion_.frame_rate = scene.frame_rate;
    motion_.gravity = scene.gravity;
    motion_.ground = scene.ground;
    motion_.seed = scene.seed;
    motion_.scene_text = scene.text;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        bodies_.push_back(make_immersed_body(cast[i].body, scene.bodies[i], scene.fluid));
        motion_.bodies.push_back(empty_motion(scene.bodies[i], bodies_[i], cast[i]));
        if (scene.ground) motion_.bodies[i].contact_points = bodies_[i].contact_points;
        total_steps_ += steps_of(scene, scene.bodies[i], runs);
    }
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        flights_.emplace_back(scene, scene.bodies[i], bodies_[i], runs, threads);
    }
}

SimulationReport Simulation::fly(const Sink& sink, const Progress& progress) {
    SimulationReport report;
    const auto runs = static_cast<std::size_t>(motion_.runs);
    const std::size_t all = motion_.times.size();
    const std::size_t block = frames_in_block(motion_);
    std::vector<std::vector<Pose>> poses(flights_.size());
    while (report.frames < all && !report.interrupted) {
        const std::size_t planned = std::min(block, all - report.frames);
        for (std::size_t i = 0; i < flights_.size(); ++i) {
            poses[i].resize(runs * planned * static_cast<std::size_t>(motion_.bodies[i].copies));
        }
        std::size_t flown = 0;
        while (flown < planned && !report.interrupted) {
            const auto start = std::chrono::steady_clock::now();
            for (std::size_t i = 0; i < flights_.size(); ++i) {
                const auto copies = static_cast<std::size_t>(motion_.bodies[i].copies);
                flights_[i].fly_to(motion_.times[report.frames + flown], &poses[i][flown * copies],
                                   planned * copies);
            }
            report.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            ++flown;
            report.interrupted = !progress(done(), total_steps_) && report.frames + flown < all;
        }
        for (std::size_t i = 0; i < flights_.size(); ++i) {
            if (flown < planned) {  // the runs stand closer together
                const auto copies = static_cast<std::size_t>(motion_.bodies[i].copies);
                for (std::size_t run = 1; run < runs; ++run) {
                    std::copy_n(&poses[i][run * planned * copies], flown * copies,
                                &poses[i][run * flown * copies]);
                }
                poses[i].resize(runs * flown * copies);
            }
            sink(i, report.frames, poses[i]);
        }
        report.frames += flown;
    }
    for (const BodyFlight& flight : flights_) {
        const FlightReport body = flight.report();
        report.steps += body.steps;
        report.implicit_steps += body.batch.implicit_steps;
        report.steps_at_limit += body.batch.steps_at_limit;
        report.most_substeps = std::max(report.most_substeps, body.batch.most_substeps);
        report.bodies.push_back(body);
    }
    return report;
}

double Simulation::done() const {
    double steps = 0.0;
    for (const BodyFlight& flight : flights_) steps += static_cast<double>(flight.steps());
    return steps;
}

SimulationResult simulate(const Scene& scene, const std::vector<CastBody>& cast, int runs,
                          const Simulation::Progress& progress, int threads) {
    Simulation simulation(scene, cast, runs, threads);
    SimulationResult result{simulation.motion(), {}};
    Motion& motion = result.motion;
    for (BodyMotion& body : motion.bodies) {
        body.poses.resize(static_cast<std::size_t>(runs) * motion.times.size() *
                          static_cast<std::size_t>(body.copies));
    }
    const auto keep = [&](std::size_t index, std::size_t first, const std::vector<Pose>& poses) {
        BodyMotion& body = motion.bodies[index];
        const auto copies = static_cast<std::size_t>(body.copies);
        const std::size_t row = poses.size() / static_cast<std::size_t>(runs);
        for (std::size_t run = 0; run < static_cast<std::size_t>(runs); ++run) {
            std::copy_n(&poses[run * row], row, &body.poses[(run * motion.times.size() + first) * copies]);
        }
    };
    result.report = simulation.fly(keep, progress);
    if (result.report.interrupted) throw Error("interrupted: nothing was written");
    return result;
}

}  // namespace samara
