#pragma once

#include <cstdint>
#include <vector>

#include "samara/dynamics/batch.hpp"
#include "samara/motion/motion.hpp"
#include "samara/scene/scene.hpp"
#include "samara/simulation/table_errors_met.hpp"

namespace samara {

/// What surrounds the bodies of a scene.
Surroundings surroundings_of(const Scene& scene);

/// What happened to a body on the way, over its copies and runs.
struct FlightReport {
    std::uint64_t steps = 0;  ///< of the scene's step
    BatchReport batch;
    double highest_reynolds_number = 0.0;  ///< at the frames
    std::uint64_t moving = 0;              ///< poses at the frames of bodies that move through the fluid
    std::uint64_t below_table = 0;         ///< those of them below half the table's lowest Reynolds number
    TableErrorsMet table_errors;           ///< at the frames asked for
};

/// The share of the poses of bodies that move that lie below half the table's lowest Reynolds number.
double share_below_table(const FlightReport& report);

/// All copies of one body of a scene in all runs, flown frame by frame.
class BodyFlight {
  public:
    /// `body` must outlive the flight. `threads`: 0 for all cores. Throws Error where a copy starts below the
    /// ground.
    BodyFlight(const Scene& scene, const SceneBody& scene_body, const ImmersedBody& body, int runs,
               int threads);

    /// Puts the poses at a time (s), which must not lie before the last one asked for, into
    /// poses[run * run_stride + copy]. The same for any number of threads. Throws Error where a body left the
    /// range of numbers.
    void fly_to(double time, Pose* poses, std::size_t run_stride);

    [[nodiscard]] FlightReport report() const;
    /// Steps flown so far, over copies and runs.
    [[nodiscard]] std::uint64_t steps() const { return report_.steps; }

  private:
    void step_to(double time_in_flight);
    void advance(std::uint64_t steps);
    void note_poses();
    [[nodiscard]] Pose held(std::size_t index) const;

    const ImmersedBody& body_;
    Surroundings surroundings_;
    double start_;
    double step_;
    std::size_t copies_;
    int threads_;
    Batch batch_;
    std::uint64_t steps_ = 0;
    std::vector<Pose> before_;  ///< one step before after_; both in the flow's frame
    std::vector<Pose> after_;
    std::vector<Quaterniond> last_;           ///< orientations at the last frame
    std::vector<TableErrorsMet> errors_met_;  ///< each body's own, so that the sum has one order
    FlightReport report_;
};

}  // namespace samara
