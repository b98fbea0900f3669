#pragma once

#include <functional>
#include <vector>

#include "samara/core/simulation/simulation.hpp"
#include "samara/motion/motion.hpp"
#include "samara/scene/scene.hpp"
#include "samara/scene/table_errors_on_path.hpp"

namespace samara {

/// What happened to the copies of a body of a scene in all runs.
struct BodyReport : StepReport {
    TableErrorsOnPath table_errors;  ///< at the frames; of a crowd a thousand bodies or more stand for all
};

/// What happened on the way, over all bodies, copies and runs.
struct SimulationReport : StepReport {
    std::size_t frames = 0;          ///< that were flown
    bool interrupted = false;        ///< whether `progress` ended the flight before the last frame
    double seconds = 0.0;            ///< wall time of the stepping
    std::vector<BodyReport> bodies;  ///< one for each body of the scene
};

/// Every body of a scene with every copy in `runs` runs that differ by their noise alone. Frames lie at whole
/// multiples of 1/frame_rate and are interpolated from the steps, which they do not change. A body is held in
/// place until its start.
class SceneSimulation {
  public:
    /// Takes the block's poses of body number `body` from frame `first_frame` on: (run, frame, copy) in
    /// row-major order.
    using Sink =
        std::function<void(std::size_t body, std::size_t first_frame, const std::vector<Pose>& poses)>;
    /// Told of (done, total) copies x runs x steps at every frame and, where bodies meet, every step; false
    /// ends the flight at this frame, or with the one before.
    using Progress = std::function<bool(double done, double total)>;

    /// `loaded[i]` is the body of scene.bodies[i]. `threads`: 0 for all cores; the poses are the same for any
    /// number. Throws Error where a body lacks what the scene asks of it or starts below the ground.
    SceneSimulation(const Scene& scene, const std::vector<LoadedBody>& loaded, int runs, int threads = 0);

    /// The motion without its poses.
    [[nodiscard]] const Motion& motion() const { return motion_; }

    /// Flies from the first frame to the last, once. Blocks are those of frames_in_block(), so memory does
    /// not grow with the number of frames.
    SimulationReport fly(const Sink& sink, const Progress& progress);

  private:
    /// What the frames of a body have so far, body by body, so that sums have one order.
    struct Frames {
        std::vector<Quaterniond> last;  ///< orientations at the last frame
        std::vector<TableErrorsOnPath> table_errors;
    };
    void take_frame(std::size_t group, double time, Pose* poses, std::size_t run_stride);
    bool advance_to(double time, const Progress& progress);

    Motion motion_;
    int threads_;
    double piece_;  ///< s, after which progress is told at the latest; infinite: by frames alone
    Simulation simulation_;
    std::vector<Frames> frames_;
    double total_steps_ = 0.0;
};

/// What a scene's flight gives.
struct SimulationResult {
    Motion motion;            ///< of all bodies, runs and frames
    SimulationReport report;  ///< steps, time, what was met
};

/// A simulation whose poses are all kept in memory. Throws Error also where `progress` ends it.
SimulationResult simulate(const Scene& scene, const std::vector<LoadedBody>& loaded, int runs,
                          const SceneSimulation::Progress& progress, int threads = 0);

}  // namespace samara
