#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "samara/core/simulation/simulation.hpp"
#include "samara/motion/motion.hpp"
#include "samara/scene/scene.hpp"
#include "samara/scene/table_errors_on_path.hpp"

namespace samara {

struct Surroundings;

/// Returns the times of a scene's frames (s), from 0 to its duration.
std::vector<double> frame_times(const Scene& scene);

/// Returns the surroundings of the bodies of a scene: fluid, wind, ground and obstacles.
Surroundings surroundings_of(const Scene& scene);

/// Returns the settings of a simulation of the scene in `runs` runs on `threads` threads (0: all cores).
SimulationSettings simulation_settings(const Scene& scene, int runs, int threads);

/// Returns a simulation with these settings and all bodies of the scene, in its order: its body group i is
/// scene.bodies[i], with the body `loaded[i]`. Throws Error where a body lacks what the scene asks of it or
/// starts below the ground or inside an obstacle.
Simulation simulation_of(const Scene& scene, const std::vector<LoadedBody>& loaded, int runs, int threads);

/// Summary of the steps of all copies of a body of a scene in all runs.
struct BodyReport : StepReport {
    TableErrorsOnPath table_errors;  ///< sums over the frames; in a crowd over a thousand bodies or more
};

/// Summary of a simulation's steps over all bodies, copies and runs.
struct SimulationReport : StepReport {
    std::size_t frames = 0;           ///< frames that were simulated
    std::vector<std::size_t> copies;  ///< of each body: those that were simulated for all these frames
    bool interrupted = false;         ///< whether `progress` ended the simulation before the last frame
    double seconds = 0.0;             ///< wall time of the stepping
    std::vector<BodyReport> bodies;   ///< one for each body of the scene
};

/// Simulates every body of a scene with every copy in `runs` runs that differ by their noise alone. Frames
/// lie at whole multiples of 1/frame_rate and are interpolated from the steps, which they do not change. A
/// body is held in place until its start.
class SceneSimulation {
  public:
    /// Receives the blocks of the motion one after another, not always on the thread of the caller.
    using Sink = std::function<void(const MotionBlock& block)>;
    /// Is called with the copies x runs x steps done and in total at every frame, in a crowd less often, and,
    /// where bodies touch, every step; returns false to end the simulation at this frame, or with one before.
    using Progress = std::function<bool(double done, double total)>;

    /// Prepares a simulation. `loaded[i]` is the body of scene.bodies[i]. `threads`: 0 for all cores; the
    /// poses are the same for any number. `forces`: whether frames hold the fluid's forces too. Throws Error
    /// where a body lacks what the scene asks of it or starts
    /// below the ground.
    SceneSimulation(const Scene& scene, const std::vector<LoadedBody>& loaded, int runs, int threads = 0,
                    bool forces = false);
    ~SceneSimulation();
    SceneSimulation(const SceneSimulation&) = delete;
    SceneSimulation& operator=(const SceneSimulation&) = delete;

    /// Returns the motion without its poses.
    [[nodiscard]] const Motion& motion() const { return motion_; }

    /// Simulates from the first frame to the last, once. Blocks are those of frames_in_block() and, where
    /// bodies do not touch each other, of the copies of a section, so memory grows neither with the number of
    /// frames nor with a crowd. An interrupt leaves the frames so far or, after the first section, the
    /// copies.
    SimulationReport fly(const Sink& sink, const Progress& progress);

  private:
    struct Part;
    /// Returns how many bodies of a group there are for each whose table errors are judged.
    [[nodiscard]] std::size_t judged_every(std::size_t body) const;
    /// Prepares the bodies of a section, in parts that are simulated side by side.
    void begin_section(std::size_t section);
    [[nodiscard]] std::unique_ptr<Part> part_of(const std::vector<CopySpan>& copies, int threads) const;
    /// Simulates the bodies of the section into the blocks, one for each body. Returns the number of frames
    /// that all are simulated for; sets `stop` where `progress` ends it.
    std::size_t fly_block(std::vector<MotionBlock>& blocks, std::size_t planned, const Progress& progress,
                          std::atomic<bool>& stop);
    /// Keeps a part's poses as frame number `frame` of the `planned` frames of the blocks.
    void take_frame(Part& part, std::size_t frame, std::size_t planned, std::vector<MotionBlock>& blocks);

    Scene scene_;
    std::vector<LoadedBody> loaded_;
    Motion motion_;
    int threads_;
    double piece_;  ///< s, after which progress is told at the latest; infinite: by frames alone
    Simulation empty_;
    std::vector<CopySpan> section_;  ///< of each body: the copies that are simulated now
    std::vector<std::unique_ptr<Part>> parts_;
    /// Sums over the frames so far of each body, copy by copy, so that they are added in one order.
    std::vector<std::vector<TableErrorsOnPath>> table_errors_;
    std::atomic<std::uint64_t> steps_ = 0;
    double total_steps_ = 0.0;
};

/// The result of simulate().
struct SimulationResult {
    Motion motion;            ///< all bodies, runs and frames
    SimulationReport report;  ///< steps, time and errors of tables
};

/// Simulates a scene and keeps all poses in memory. Throws Error also where `progress` ends it.
SimulationResult simulate(const Scene& scene, const std::vector<LoadedBody>& loaded, int runs,
                          const SceneSimulation::Progress& progress, int threads = 0, bool forces = false);

}  // namespace samara
