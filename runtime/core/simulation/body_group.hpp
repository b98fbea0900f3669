#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "samara/core/collision/hull_pair.hpp"
#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/dynamics/surroundings.hpp"
#include "samara/core/integrator/batch.hpp"
#include "samara/core/kernel/noise.hpp"
#include "samara/core/physics/fluid_load.hpp"
#include "samara/core/simulation/simulation.hpp"
#include "samara/core/simulation/state_bytes.hpp"

namespace samara {

/// The most steps ahead that a time may lie: beyond it its unit is wrong.
inline constexpr double most_steps_off = 1e10;
/// The number of poses that a thread computes at a time.
inline constexpr std::size_t poses_a_piece = 256;

/// Returns the number of steps from time 0 on that reach a time (s), to rounding.
std::uint64_t steps_reaching(double time, double step);

/// The bodies of one group in all runs, on their own grid of steps, which begins at their start. Bodies are
/// numbered run by run, copy by copy; times are the world's (s).
class BodyGroup {
  public:
    /// Makes the bodies of a group. `surroundings`: those of the settings. Throws as Simulation::add() does
    /// for the body and its release.
    BodyGroup(const SimulationSettings& settings, const Surroundings& surroundings, const LoadedBody& body,
              const BodyPhysics& physics, const Release& release, std::string name, std::size_t first);

    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    [[nodiscard]] std::size_t first() const noexcept { return first_; }
    [[nodiscard]] std::size_t size() const noexcept { return batch_.size(); }
    /// Returns the start of a body (s).
    [[nodiscard]] double start(std::size_t index) const noexcept {
        return release_.start + time_of(first_step(index));
    }
    /// Returns a body's size relative to the shape's.
    [[nodiscard]] double size_of(std::size_t index) const noexcept { return batch_.size_of(index); }
    [[nodiscard]] const ImmersedBody& body() const noexcept { return *body_; }
    [[nodiscard]] StepReport report() const;
    /// Returns the number of steps taken so far, over all bodies.
    [[nodiscard]] std::uint64_t steps() const noexcept { return report_.steps; }

    /// Takes steps until the last one ends at `time` or after it, and the one before it earlier. Wrenches
    /// that were added act in its steps and end with them; `duration` (s): of the call. Throws
    /// SimulationError where a body's motion leaves the range of numbers.
    void advance_to(double time, double duration);
    /// The parts of advance_to(), for bodies that touch each other: the preparation before the steps; the
    /// record of the poses before the last of them; one step, which can be undone by the bodies' states; and
    /// the work after it.
    void begin_call(double time, double duration);
    void record_poses();
    [[nodiscard]] BatchReport take_steps(std::uint64_t count);
    void keep_steps(const BatchReport& done, std::uint64_t count);
    void require_finite() const;
    /// Returns the number of steps of the simulation before the first of this group. For bodies that touch
    /// each other alone.
    [[nodiscard]] std::uint64_t grid_start() const noexcept { return grid_start_; }
    /// Returns whether a body takes part in the next step: it has started, and was not removed.
    [[nodiscard]] bool is_there(std::size_t index) const noexcept {
        return !is_removed(index) && steps_ >= first_step(index);
    }
    [[nodiscard]] std::size_t copies() const noexcept { return release_.copies(); }
    [[nodiscard]] Batch& batch() noexcept { return batch_; }
    [[nodiscard]] const Batch& batch() const noexcept { return batch_; }
    [[nodiscard]] const Surroundings& surroundings() const noexcept { return surroundings_; }
    /// Returns the faces of the bodies' hull, for bodies that touch each other.
    [[nodiscard]] const std::vector<HullFace>& faces() const noexcept { return faces_; }
    /// Ends the rest of a body, so that it is judged anew.
    void wake(std::size_t index) noexcept;
    /// Returns the number of steps that reach a time, to rounding.
    [[nodiscard]] std::uint64_t steps_until(double time) const;

    /// Returns the pose of a body in the world at a time between the last two steps; before the start, held
    /// in place.
    [[nodiscard]] Pose pose(std::size_t index, double time) const;
    /// Returns the pose of a body in the flow's frame, not held before the start.
    [[nodiscard]] Pose pose_in_flow(std::size_t index, double time) const;
    /// Returns the pose of a body in the flow's frame, its velocity relative to the wind there.
    [[nodiscard]] Pose pose_in_wind(std::size_t index, double time) const;
    void set_pose(std::size_t index, const Pose& pose, double time);
    /// Adds a wrench (N, N m) on a body over the next advance_to().
    void add_wrench(std::size_t index, const Wrench& wrench);
    /// Keep the wrenches of the next advance_to(), and give them again to one after it.
    void keep_wrenches() { kept_wrenches_ = wrenches_; }
    void repeat_wrenches() { wrenches_ = kept_wrenches_; }
    /// Gives a body an impulse (N s, N m s) at a time between the last two steps.
    void add_impulse(std::size_t index, const Wrench& impulse, double time);
    /// Removes a body in its place: it moves no more, until it is placed elsewhere.
    void remove(std::size_t index, double time);
    [[nodiscard]] bool is_removed(std::size_t index) const noexcept {
        return !removed_.empty() && removed_[index] != 0;
    }
    /// Returns whether a body is at rest on what it touches.
    [[nodiscard]] bool is_at_rest(std::size_t index) const noexcept { return batch_.state(index).at_rest; }
    /// Records the contacts of bodies with ground and obstacles, or no longer.
    void watch_contacts(bool watch) { batch_.watch_contacts(watch); }
    /// Returns a body's contacts since they were last taken; none where not recorded.
    ContactRecord take_contacts(std::size_t index) noexcept {
        return batch_.watches_contacts() ? batch_.take_contacts(index) : ContactRecord{};
    }
    /// Returns the fluid's load on a body in its next step. Throws SimulationError where `time` is not the
    /// end of a step, or the body is of another size than the shape's.
    [[nodiscard]] FluidLoad fluid_load(std::size_t index, double time) const;
    /// Throws Error where a body is inside one of these obstacles, or across a face, at a time (s).
    void require_outside(const ObstacleSet& obstacles, double time);
    /// Returns the forces on a body at the end of its last step; none at a time (s) before its start.
    [[nodiscard]] FluidForces fluid_forces(std::size_t index, double time) const;
    void set_seed(std::uint64_t seed, std::uint32_t first_run);
    /// Replaces the surroundings from the last step on: bodies keep place and motion in the world, and wake.
    void set_surroundings(const Surroundings& surroundings);
    /// Returns the end of the last step or, before the first, the beginning of the group's grid (s, of the
    /// world).
    [[nodiscard]] double reached() const noexcept { return release_.start + time_of(steps_); }

    /// Returns a description of all that determines the motion, exactly: states fit equal descriptions.
    [[nodiscard]] std::string description() const;
    [[nodiscard]] std::size_t state_size() const;
    void write(StateWriter& writer) const;
    /// Reads the state of a simulation that is at `time`, and keeps it or not. Returns whether its numbers
    /// are those of a simulation.
    bool read(StateReader& reader, double time, bool keep);

  private:
    /// Returns a body's number among all copies.
    [[nodiscard]] std::size_t copy_of(std::size_t index) const noexcept {
        return static_cast<std::size_t>(release_.first_copy) + index % copies();
    }
    /// Returns the number by which messages name a body.
    [[nodiscard]] std::string number_of(std::size_t index) const;
    [[nodiscard]] Noise noise_of(std::uint64_t seed, std::uint32_t first_run, std::size_t index) const;
    [[nodiscard]] double time_of(std::uint64_t step) const noexcept {
        return static_cast<double>(step) * step_;
    }
    [[nodiscard]] std::uint64_t first_step(std::size_t index) const noexcept {
        return first_steps_.empty() ? 0 : first_steps_[index];
    }
    /// Passes the wrenches of a call of that `duration` (s) to the batch, or keeps them for the next call
    /// where this one takes no step.
    void take_up_wrenches(double duration, bool has_steps);
    void set_removed(std::size_t index, bool removed);
    /// Finds the points with which the bodies touch others, where that was not done before.
    void find_contact_points();
    void draw_starts(const SimulationSettings& settings);
    /// Returns the number of steps that the bodies take, all together, between two steps of the grid.
    [[nodiscard]] std::uint64_t steps_between(std::uint64_t begin, std::uint64_t end) const;
    void step_to(std::uint64_t steps);
    [[nodiscard]] StepReport sampled() const;

    std::string name_;
    std::size_t first_;
    Surroundings surroundings_;
    Release release_;
    BodyPhysics physics_;
    double step_;
    int threads_;
    bool collide_;  ///< whether bodies touch each other
    std::uint64_t grid_start_ = 0;
    std::vector<HullFace> faces_;
    Fluid fluid_;
    LoadedBody loaded_;
    bool touches_;  ///< whether there is something to touch, or was
    std::shared_ptr<const ImmersedBody> body_;
    Batch batch_;
    std::vector<std::uint64_t> first_steps_;  ///< of each body; empty where all begin with the grid
    std::uint64_t steps_ = 0;
    std::vector<Pose> before_;         ///< in the flow's frame: the poses at before_time_
    std::vector<double> before_time_;  ///< s, since the start
    StepReport report_;
    std::vector<Wrench> wrenches_;  ///< over the next advance_to; empty where there are none
    std::vector<Wrench> kept_wrenches_;
    /// their mean over the calls since the last step; empty where there are none
    std::vector<Wrench> pushed_;
    double pushed_time_ = 0.0;           ///< s: the duration of these calls
    std::vector<Wrench> acting_;         ///< in the last steps; empty where there were none
    std::vector<std::uint8_t> removed_;  ///< of each body 1 or 0; empty where none is removed
    std::uint64_t seed_ = 1;
    std::uint32_t first_run_ = 0;
};

}  // namespace samara
