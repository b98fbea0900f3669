#pragma once

#include <functional>
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
    std::size_t frames = 0;          ///< frames that were simulated
    bool interrupted = false;        ///< whether `progress` ended the simulation before the last frame
    double seconds = 0.0;            ///< wall time of the stepping
    std::vector<BodyReport> bodies;  ///< one for each body of the scene
};

/// Simulates every body of a scene with every copy in `runs` runs that differ by their noise alone. Frames
/// lie at whole multiples of 1/frame_rate and are interpolated from the steps, which they do not change. A
/// body is held in place until its start.
class SceneSimulation {
  public:
    /// Receives the block's poses of body number `body` from frame `first_frame` on: (run, frame, copy) in
    /// row-major order.
    using Sink =
        std::function<void(std::size_t body, std::size_t first_frame, const std::vector<Pose>& poses)>;
    /// Is called with the copies x runs x steps done and in total at every frame and, where bodies touch,
    /// every step; returns false to end the simulation at this frame, or with the one before.
    using Progress = std::function<bool(double done, double total)>;

    /// Prepares a simulation. `loaded[i]` is the body of scene.bodies[i]. `threads`: 0 for all cores; the
    /// poses are the same for any number. `forces`: whether frames hold the fluid's forces too. Throws Error
    /// where a body lacks what the scene asks of it or starts
    /// below the ground.
    SceneSimulation(const Scene& scene, const std::vector<LoadedBody>& loaded, int runs, int threads = 0,
                    bool forces = false);

    /// Returns the motion without its poses.
    [[nodiscard]] const Motion& motion() const { return motion_; }

    /// Simulates from the first frame to the last, once. Blocks are those of frames_in_block(), so memory
    /// does not grow with the number of frames.
    SimulationReport fly(const Sink& sink, const Progress& progress);

    /// Returns the forces beside the poses that the sink is given; empty where they were not asked for.
    [[nodiscard]] const std::vector<FluidForces>& forces() const { return given_forces_; }

  private:
    /// Sums over the frames of a body so far, copy by copy, so that they are added in one order.
    struct Frames {
        std::vector<Quaterniond> last;  ///< orientations at the last frame
        std::vector<TableErrorsOnPath> table_errors;
    };
    void take_frame(std::size_t group, double time, Pose* poses, FluidForces* forces, std::size_t run_stride);
    bool advance_to(double time, const Progress& progress);

    Motion motion_;
    int threads_;
    double piece_;  ///< s, after which progress is told at the latest; infinite: by frames alone
    Simulation simulation_;
    std::vector<Frames> frames_;
    std::vector<FluidForces> given_forces_;
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
