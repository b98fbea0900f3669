#include "samara/scene/scene_simulation.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/base/parallel_for.hpp"
#include "samara/core/dynamics/body_size.hpp"
#include "samara/core/dynamics/surroundings.hpp"
#include "samara/core/simulation/body_group.hpp"
#include "samara/core/simulation/world_pose.hpp"
#include "samara/motion/motion_writer.hpp"

namespace samara {
namespace {

/// Bodies of a group that are enough to know the mean errors of its tables along all paths.
constexpr std::size_t judged_copies = 1000;

std::string models_of(const SceneBody& scene_body, const ImmersedBody& body) {
    constexpr const char* langevin[] = {"seen-fluid", "body-velocity", "wake"};
    std::string text =
        fmt::format("loads {}; turbulence {}", name_of(scene_body.loads), name_of(scene_body.turbulence));
    if (scene_body.turbulence != Turbulence::none) {
        text += fmt::format(" ({})", langevin[static_cast<int>(body.constants.langevin)]);
    }
    if (scene_body.table_reynolds_number && body.tables) {
        text +=
            fmt::format("; tables at the Reynolds number {:.4g} alone", *scene_body.table_reynolds_number);
    }
    if (scene_body.patches > 1) text += fmt::format("; in {} patches", scene_body.patches);
    if (!scene_body.added_mass) text += "; no added mass";
    if (!body.dynamic.origin.empty()) text += "; " + body.dynamic.origin;
    if (scene_body.models_auto) text += R"(; chosen by models = "auto")";
    return text;
}

BodyMotion empty_motion(const SceneBody& scene_body, const ImmersedBody& immersed, const LoadedBody& loaded) {
    BodyMotion motion;
    motion.name = scene_body.name;
    motion.center_of_mass = immersed.center_of_mass;
    motion.shortest_axis = principal_axes(loaded.body->moments).col(0);
    motion.body_hash = loaded.hash;
    motion.models = models_of(scene_body, immersed);
    motion.surface = loaded.body->surface;
    motion.display = scene_body.display;
    motion.copies = scene_body.count;
    return motion;
}

/// Returns the steps that the bodies of a group take until the end.
double steps_of(const Scene& scene, const BodyGroup& group) {
    double seconds = 0.0;
    for (std::size_t i = 0; i < group.size(); ++i) seconds += std::max(0.0, scene.duration - group.start(i));
    return seconds / scene.step;
}

/// Moves the rows of the runs, of `planned` values each, together to `stored` each.
template <typename Value>
void shorten(std::vector<Value>& rows, std::size_t runs, std::size_t planned, std::size_t stored) {
    if (rows.empty() || stored == planned) return;
    for (std::size_t run = 1; run < runs; ++run) {
        std::copy_n(&rows[run * planned], stored, &rows[run * stored]);
    }
    rows.resize(runs * stored);
}

}  // namespace

std::vector<double> frame_times(const Scene& scene) {
    const auto last = static_cast<int>(std::floor(scene.duration * scene.frame_rate * (1.0 + 1e-12)));
    std::vector<double> times(static_cast<std::size_t>(last) + 1);
    for (std::size_t frame = 0; frame < times.size(); ++frame) {
        times[frame] = static_cast<double>(frame) / scene.frame_rate;
    }
    return times;
}

SimulationSettings simulation_settings(const Scene& scene, int runs, int threads) {
    return {.fluid = scene.fluid,
            .gravity = scene.gravity,
            .ground = scene.ground,
            .obstacles = scene.obstacles,
            .wind = scene.wind,
            .bodies_collide = scene.bodies_collide,
            .step = scene.step,
            .precision = scene.precision,
            .seed = scene.seed,
            .runs = runs,
            .threads = threads};
}

Simulation simulation_of(const Scene& scene, const std::vector<LoadedBody>& loaded, int runs, int threads) {
    Simulation simulation(simulation_settings(scene, runs, threads));
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        const SceneBody& body = scene.bodies[i];
        simulation.add(loaded[i], body, body, body.name);
    }
    return simulation;
}

Surroundings surroundings_of(const Scene& scene) {
    return surroundings_of(simulation_settings(scene, 1, 1));
}

SceneSimulation::SceneSimulation(const Scene& scene, const std::vector<LoadedBody>& loaded, int runs,
                                 int threads, bool forces)
    : threads_(threads),
      // Steps of bodies that touch may be slow, and are taken one by one anyway.
      piece_(scene.bodies_collide ? scene.step : std::numeric_limits<double>::infinity()),
      simulation_(simulation_of(scene, loaded, runs, threads)) {
    motion_.times = frame_times(scene);
    motion_.runs = runs;
    motion_.frame_rate = scene.frame_rate;
    motion_.gravity = scene.gravity;
    motion_.ground = scene.ground;
    motion_.obstacles = scene.obstacles;
    motion_.seed = scene.seed;
    motion_.has_forces = forces;
    motion_.scene_text = scene.text;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        const SceneBody& scene_body = scene.bodies[i];
        const BodyGroup& group = *simulation_.groups()[i];
        motion_.bodies.push_back(empty_motion(scene_body, group.body(), loaded[i]));
        if (scene.ground) motion_.bodies[i].contact_points = group.body().contact_points;
        total_steps_ += steps_of(scene, group);
        for (std::size_t k = 0; scene_body.spreads_size() && k < group.size(); ++k) {
            motion_.bodies[i].sizes.push_back(group.size_of(k));
        }
        Frames frames{{}, std::vector<TableErrorsOnPath>(group.size())};
        for (std::size_t k = 0; k < group.size(); ++k) frames.last.push_back(group.pose(k, 0.0).orientation);
        frames_.push_back(std::move(frames));
    }
}

void SceneSimulation::take_frame(std::size_t index, double time, Pose* poses, FluidForces* forces,
                                 std::size_t run_stride) {
    const BodyGroup& group = *simulation_.groups()[index];
    Frames& frames = frames_[index];
    const auto copies = static_cast<std::size_t>(motion_.bodies[index].copies);
    const std::size_t judged = std::max<std::size_t>(1, group.size() / judged_copies);
    parallel_for(group.size(), poses_a_piece, threads_, [&](std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; ++i) {
            const std::size_t place = (i / copies) * run_stride + i % copies;
            Pose& pose = poses[place];
            pose = group.pose(i, time);
            if (forces != nullptr) forces[place] = group.fluid_forces(i, time);
            if (time < group.start(i)) continue;
            keep_sign_continuous(pose.orientation, frames.last[i]);
            frames.last[i] = pose.orientation;
            if (i % judged != 0) continue;
            const Pose in_flow = in_own_units(group.pose_in_wind(i, time), group.size_of(i));
            frames.table_errors[i].add(table_errors_on_path(group.body(), in_flow));
        }
    });
}

bool SceneSimulation::advance_to(double time, const Progress& progress) {
    while (simulation_.time() + piece_ < time) {
        simulation_.advance_to(simulation_.time() + piece_);
        if (!progress(static_cast<double>(simulation_.steps()), total_steps_)) return false;
    }
    simulation_.advance_to(time);
    return true;
}

SimulationReport SceneSimulation::fly(const Sink& sink, const Progress& progress) {
    SimulationReport report;
    const auto runs = static_cast<std::size_t>(motion_.runs);
    const std::size_t all = motion_.times.size();
    const std::size_t block = frames_in_block(motion_);
    std::vector<std::vector<Pose>> poses(motion_.bodies.size());
    std::vector<std::vector<FluidForces>> forces(motion_.bodies.size());
    while (report.frames < all && !report.interrupted) {
        const std::size_t planned = std::min(block, all - report.frames);
        for (std::size_t i = 0; i < motion_.bodies.size(); ++i) {
            poses[i].resize(runs * planned * static_cast<std::size_t>(motion_.bodies[i].copies));
            if (motion_.has_forces) forces[i].resize(poses[i].size());
        }
        std::size_t stored = 0;
        while (stored < planned && !report.interrupted) {
            const auto start = std::chrono::steady_clock::now();
            const double time = motion_.times[report.frames + stored];
            if (!advance_to(time, progress)) {
                report.interrupted = true;
                break;
            }
            for (std::size_t i = 0; i < motion_.bodies.size(); ++i) {
                const auto copies = static_cast<std::size_t>(motion_.bodies[i].copies);
                take_frame(i, time, &poses[i][stored * copies],
                           motion_.has_forces ? &forces[i][stored * copies] : nullptr, planned * copies);
            }
            report.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            ++stored;
            report.interrupted = !progress(static_cast<double>(simulation_.steps()), total_steps_) &&
                                 report.frames + stored < all;
        }
        for (std::size_t i = 0; i < motion_.bodies.size() && stored > 0; ++i) {
            const auto copies = static_cast<std::size_t>(motion_.bodies[i].copies);
            shorten(poses[i], runs, planned * copies, stored * copies);
            shorten(forces[i], runs, planned * copies, stored * copies);
            given_forces_.swap(forces[i]);
            sink(i, report.frames, poses[i]);
            given_forces_.swap(forces[i]);
        }
        report.frames += stored;
    }
    for (std::size_t i = 0; i < motion_.bodies.size(); ++i) {
        BodyReport body{simulation_.groups()[i]->report(), {}};
        for (const TableErrorsOnPath& errors : frames_[i].table_errors) body.table_errors.add(errors);
        report.add(body);
        report.bodies.push_back(body);
    }
    return report;
}

SimulationResult simulate(const Scene& scene, const std::vector<LoadedBody>& loaded, int runs,
                          const SceneSimulation::Progress& progress, int threads, bool forces) {
    SceneSimulation simulation(scene, loaded, runs, threads, forces);
    SimulationResult result{simulation.motion(), {}};
    Motion& motion = result.motion;
    for (BodyMotion& body : motion.bodies) {
        body.poses.resize(static_cast<std::size_t>(runs) * motion.times.size() *
                          static_cast<std::size_t>(body.copies));
        if (forces) body.forces.resize(body.poses.size());
    }
    const auto keep = [&](std::size_t index, std::size_t first, const std::vector<Pose>& poses) {
        BodyMotion& body = motion.bodies[index];
        const auto copies = static_cast<std::size_t>(body.copies);
        const std::size_t row = poses.size() / static_cast<std::size_t>(runs);
        for (std::size_t run = 0; run < static_cast<std::size_t>(runs); ++run) {
            const std::size_t place = (run * motion.times.size() + first) * copies;
            std::copy_n(&poses[run * row], row, &body.poses[place]);
            if (forces) std::copy_n(&simulation.forces()[run * row], row, &body.forces[place]);
        }
    };
    result.report = simulation.fly(keep, progress);
    if (result.report.interrupted) throw Error("interrupted: nothing was written");
    return result;
}

}  // namespace samara
