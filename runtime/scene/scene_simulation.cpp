#include "samara/scene/scene_simulation.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <exception>
#include <future>
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
/// The bodies that are simulated together where there are many: their states stay in a core's cache.
constexpr std::size_t bodies_in_part = 1024;
constexpr std::size_t fewest_in_parts = 4 * bodies_in_part;

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

/// Calls `work` with each number below `count`, on several threads; throws what the first of them threw.
template <typename Work>
void for_each_part(std::size_t count, int threads, const Work& work,
                   const std::function<void(double)>& progress = {}) {
    std::vector<std::exception_ptr> failures(count);
    const auto guarded = [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            try {
                work(i);
            } catch (...) {
                failures[i] = std::current_exception();
            }
        }
    };
    parallel_for(count, 1, threads, guarded, progress);
    for (const std::exception_ptr& failure : failures) {
        if (failure) std::rethrow_exception(failure);
    }
}

/// Gives blocks to a sink, where there are several threads while the next are filled.
class Handover {
  public:
    Handover(const SceneSimulation::Sink& sink, int threads)
        : sink_(sink), beside_(thread_count(threads) > 1) {}

    /// Returns the blocks to fill.
    std::vector<MotionBlock>& next() { return blocks_[turn_]; }
    /// Gives the blocks that were filled. `more`: whether others follow. Throws what the sink threw.
    void give(bool more) {
        if (running_.valid()) running_.get();
        const auto work = [this, &given = blocks_[turn_]] {
            for (const MotionBlock& block : given) {
                if (!block.poses.empty()) sink_(block);
            }
        };
        turn_ = 1 - turn_;
        if (!more || !beside_) return work();
        running_ = std::async(std::launch::async, work);
    }

  private:
    const SceneSimulation::Sink& sink_;
    bool beside_;
    std::array<std::vector<MotionBlock>, 2> blocks_;
    std::size_t turn_ = 0;
    std::future<void> running_;  // waited for before all else goes
};

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

/// Bodies of a section that are simulated together.
struct SceneSimulation::Part {
    struct Copies : CopySpan {
        const BodyGroup* group = nullptr;  ///< null: none of the body's copies
        std::vector<Quaterniond> last;     ///< orientations at the last frame
    };
    Simulation simulation;
    std::vector<Copies> bodies;
    std::uint64_t counted_steps = 0;
};

SceneSimulation::SceneSimulation(const Scene& scene, const std::vector<LoadedBody>& loaded, int runs,
                                 int threads, bool forces)
    : scene_(scene),
      loaded_(loaded),
      threads_(threads),
      // Steps of bodies that touch may be slow, and are taken one by one anyway.
      piece_(scene.bodies_collide ? scene.step : std::numeric_limits<double>::infinity()),
      empty_(simulation_settings(scene, runs, threads)) {
    motion_.times = frame_times(scene);
    motion_.runs = runs;
    motion_.frame_rate = scene.frame_rate;
    motion_.gravity = scene.gravity;
    motion_.ground = scene.ground;
    motion_.obstacles = scene.obstacles;
    motion_.seed = scene.seed;
    motion_.has_forces = forces;
    motion_.scene_text = scene.text;
    for (const SceneBody& body : scene.bodies) motion_.bodies.emplace_back().copies = body.count;
    begin_section(0);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        const SceneBody& scene_body = scene.bodies[i];
        BodyMotion& motion = motion_.bodies[i];
        const ImmersedBody& immersed = parts_.front()->bodies[i].group->body();
        motion = empty_motion(scene_body, immersed, loaded[i]);
        if (scene.ground) motion.contact_points = immersed.contact_points;
        const double copies = scene_body.count;
        for (const auto& part : parts_) {
            const BodyGroup* group = part->bodies[i].group;
            if (group == nullptr) continue;
            total_steps_ += steps_of(scene, *group) * copies / static_cast<double>(section_[i].count);
        }
        const auto all = static_cast<std::uint32_t>(scene_body.count);
        for (std::uint32_t run = 0; scene_body.spreads_size() && run < static_cast<std::uint32_t>(runs);
             ++run) {
            for (std::uint32_t copy = 0; copy < all; ++copy) {
                const Noise noise(scene.seed, scene_body.name, run, copy);
                motion.sizes.push_back(start_of_copy(scene_body, scene.step, noise).size);
            }
        }
        table_errors_.emplace_back(static_cast<std::size_t>(runs) * all / judged_every(i) + 1);
    }
}

SceneSimulation::~SceneSimulation() = default;

std::size_t SceneSimulation::judged_every(std::size_t body) const {
    const auto copies = static_cast<std::size_t>(motion_.bodies[body].copies);
    return std::max<std::size_t>(1, static_cast<std::size_t>(motion_.runs) * copies / judged_copies);
}

void SceneSimulation::begin_section(std::size_t section) {
    section_.clear();
    std::size_t bodies = 0;
    for (const BodyMotion& body : motion_.bodies) {
        const CopySpan all{0, static_cast<std::size_t>(body.copies)};
        section_.push_back(scene_.bodies_collide ? all : copies_in_section(motion_, body, section));
        bodies += static_cast<std::size_t>(motion_.runs) * section_.back().count;
    }
    const bool whole = scene_.bodies_collide || bodies < fewest_in_parts;
    const std::size_t count = whole ? 1 : bodies / bodies_in_part;
    parts_.clear();
    parts_.resize(count);
    for_each_part(count, threads_, [&](std::size_t part) {
        std::vector<CopySpan> copies;
        for (const CopySpan& all : section_) {
            const std::size_t blocks = all.count / (StateBlock::size * count) + 1;
            const std::size_t length = whole ? all.count : blocks * StateBlock::size;
            const std::size_t first = std::min(all.count, part * length);
            copies.push_back({all.first + first, std::min(length, all.count - first)});
        }
        parts_[part] = part_of(copies, whole ? threads_ : 1);
    });
}

std::unique_ptr<SceneSimulation::Part> SceneSimulation::part_of(const std::vector<CopySpan>& copies,
                                                                int threads) const {
    auto part = std::make_unique<Part>(Part{empty_.without_bodies(threads), {}});
    for (std::size_t i = 0; i < copies.size(); ++i) {
        Part::Copies& flown = part->bodies.emplace_back(Part::Copies{copies[i], nullptr, {}});
        if (flown.count == 0) continue;
        const SceneBody& body = scene_.bodies[i];
        Release release = body;
        if (flown.count < static_cast<std::size_t>(body.count)) {
            release.first_copy = static_cast<int>(flown.first);
            release.simulated = static_cast<int>(flown.count);
        }
        part->simulation.add(loaded_[i], body, release, body.name);
        flown.group = part->simulation.groups().back().get();
        for (std::size_t k = 0; k < flown.group->size(); ++k) {
            flown.last.push_back(flown.group->pose(k, 0.0).orientation);
        }
    }
    return part;
}

void SceneSimulation::take_frame(Part& part, std::size_t frame, std::size_t planned,
                                 std::vector<MotionBlock>& blocks) {
    for (std::size_t body = 0; body < blocks.size(); ++body) {
        Part::Copies& flown = part.bodies[body];
        if (flown.group == nullptr) continue;
        const BodyGroup& group = *flown.group;
        MotionBlock& block = blocks[body];
        const double time = motion_.times[block.first_frame + frame];
        const auto all = static_cast<std::size_t>(motion_.bodies[body].copies);
        const std::size_t judged = judged_every(body);
        parallel_for(
            group.size(), poses_a_piece, parts_.size() == 1 ? threads_ : 1,
            [&](std::size_t first, std::size_t end) {
                for (std::size_t i = first; i < end; ++i) {
                    const std::size_t run = i / flown.count;
                    const std::size_t copy = flown.first + i % flown.count;
                    const std::size_t place =
                        (run * planned + frame) * block.copies.count + copy - block.copies.first;
                    Pose& pose = block.poses[place];
                    pose = group.pose(i, time);
                    if (motion_.has_forces) block.forces[place] = group.fluid_forces(i, time);
                    if (time < group.start(i)) continue;
                    keep_sign_continuous(pose.orientation, flown.last[i]);
                    flown.last[i] = pose.orientation;
                    const std::size_t number = run * all + copy;
                    if (number % judged != 0) continue;
                    const Pose in_flow = in_own_units(group.pose_in_wind(i, time), group.size_of(i));
                    table_errors_[body][number / judged].add(table_errors_on_path(group.body(), in_flow));
                }
            });
    }
}

std::size_t SceneSimulation::fly_block(std::vector<MotionBlock>& blocks, std::size_t planned,
                                       const Progress& progress, std::atomic<bool>& stop) {
    const std::size_t first = blocks.front().first_frame;
    const bool alone = parts_.size() == 1;
    std::vector<std::size_t> stored(parts_.size(), 0);
    const auto tell = [&] {
        if (!progress(static_cast<double>(steps_), total_steps_)) stop = true;
    };
    const auto advance = [&](Part& part, double time) {
        part.simulation.advance_to(time);
        const std::uint64_t steps = part.simulation.steps();
        steps_ += steps - std::exchange(part.counted_steps, steps);
    };
    const auto fly_part = [&](std::size_t index) {
        Part& part = *parts_[index];
        std::size_t& frame = stored[index];
        while (frame < planned && (!stop || first + frame == 0)) {
            const double time = motion_.times[first + frame];
            while (!stop && part.simulation.time() + piece_ < time) {
                advance(part, part.simulation.time() + piece_);
                tell();
            }
            if (stop && first + frame > 0) break;
            advance(part, time);
            take_frame(part, frame, planned, blocks);
            ++frame;
            if (alone) tell();
        }
    };
    const auto tell_of_parts = [&](double /*share*/) {
        if (!alone) tell();
    };
    for_each_part(parts_.size(), threads_, fly_part, tell_of_parts);
    return *std::min_element(stored.begin(), stored.end());
}

SimulationReport SceneSimulation::fly(const Sink& sink, const Progress& progress) {
    SimulationReport report;
    const auto runs = static_cast<std::size_t>(motion_.runs);
    const std::size_t all = motion_.times.size();
    const std::size_t sections = scene_.bodies_collide ? 1 : section_count(motion_);
    report.bodies.resize(motion_.bodies.size());
    report.copies.resize(motion_.bodies.size());
    Handover handover(sink, threads_);
    for (std::size_t section = 0; section < sections && !report.interrupted; ++section) {
        if (section > 0) begin_section(section);
        std::size_t frames = 0;
        while (frames < all && !report.interrupted) {
            const std::size_t planned = std::min(frames_in_block(motion_), all - frames);
            std::vector<MotionBlock>& blocks = handover.next();
            blocks.resize(section_.size());
            for (std::size_t i = 0; i < blocks.size(); ++i) {
                blocks[i].body = i;
                blocks[i].first_frame = frames;
                blocks[i].copies = section_[i];
                blocks[i].poses.resize(runs * planned * section_[i].count);
                if (motion_.has_forces) blocks[i].forces.resize(blocks[i].poses.size());
            }
            const auto start = std::chrono::steady_clock::now();
            std::atomic<bool> stop = false;
            const std::size_t stored = fly_block(blocks, planned, progress, stop);
            report.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            for (MotionBlock& block : blocks) {
                shorten(block.poses, runs, planned * block.copies.count, stored * block.copies.count);
                shorten(block.forces, runs, planned * block.copies.count, stored * block.copies.count);
            }
            frames += stored;
            const bool done = frames == all && section + 1 == sections;
            report.interrupted = stop && !done;
            handover.give(!done && !report.interrupted);
        }
        for (std::size_t i = 0; i < section_.size(); ++i) {
            for (const auto& part : parts_) {
                if (part->bodies[i].group != nullptr) report.bodies[i].add(part->bodies[i].group->report());
            }
            if (section == 0) report.frames = frames;
            if (frames == report.frames) report.copies[i] = section_[i].first + section_[i].count;
        }
    }
    for (std::size_t i = 0; i < report.bodies.size(); ++i) {
        for (const TableErrorsOnPath& errors : table_errors_[i]) report.bodies[i].table_errors.add(errors);
        report.add(report.bodies[i]);
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
    const auto keep = [&](const MotionBlock& block) {
        BodyMotion& body = motion.bodies[block.body];
        const std::size_t copies = block.copies.count;
        const std::size_t rows = block.poses.size() / copies;
        const std::size_t frames = rows / static_cast<std::size_t>(runs);
        for (std::size_t row = 0; row < rows; ++row) {
            const std::size_t place = motion.index(body, static_cast<int>(row / frames),
                                                   static_cast<int>(block.first_frame + row % frames),
                                                   static_cast<int>(block.copies.first));
            std::copy_n(&block.poses[row * copies], copies, &body.poses[place]);
            if (forces) std::copy_n(&block.forces[row * copies], copies, &body.forces[place]);
        }
    };
    result.report = simulation.fly(keep, progress);
    if (result.report.interrupted) throw Error("interrupted: nothing was written");
    return result;
}

}  // namespace samara
