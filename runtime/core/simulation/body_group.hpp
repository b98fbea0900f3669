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

/// A time that is more steps off than this is taken for a wrong unit.
inline constexpr double most_steps_off = 1e10;
/// How many poses a thread takes at a time.
inline constexpr std::size_t poses_a_piece = 256;

/// How many steps from time 0 on reach a time (s), to rounding.
std::uint64_t steps_reaching(double time, double step);

/// The bodies of one kind in all runs, on their own grid of steps, which begins at their start. Bodies are
/// numbered run by run, copy by copy; times are the world's (s).
class BodyGroup {
  public:
    /// `surroundings`: those of the settings. Throws what Simulation::add throws of the body and its release.
    BodyGroup(const SimulationSettings& settings, const Surroundings& surroundings, const LoadedBody& body,
              const BodyPhysics& physics, const Release& release, std::string name, std::size_t first);

    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    [[nodiscard]] std::size_t first() const noexcept { return first_; }
    [[nodiscard]] std::size_t size() const noexcept { return batch_.size(); }
    /// When a body starts (s).
    [[nodiscard]] double start(std::size_t index) const noexcept {
        return release_.start + time_of(first_step(index));
    }
    /// Over the shape's lengths.
    [[nodiscard]] double size_of(std::size_t index) const noexcept { return batch_.size_of(index); }
    [[nodiscard]] const ImmersedBody& body() const noexcept { return *body_; }
    [[nodiscard]] StepReport report() const;
    /// Taken so far, over all bodies.
    [[nodiscard]] std::uint64_t steps() const noexcept { return report_.steps; }

    /// Steps on until the last step lies at the time or after it, the one before before it. The wrenches that
    /// were added act in its steps, and are gone; `duration` (s): of the call. Throws SimulationError where a
    /// body's motion leaves the range of numbers.
    void advance_to(double time, double duration);
    /// The same in parts, for bodies that meet: what comes before the steps; the poses before the last of
    /// them; one step, which may be taken back by the bodies' states; and what comes after it.
    void begin_call(double time, double duration);
    void note_poses();
    [[nodiscard]] BatchReport take_steps(std::uint64_t count);
    void keep_steps(const BatchReport& done, std::uint64_t count);
    void require_finite() const;
    /// How many steps of the flight lie before the first of this kind. Of bodies that meet alone.
    [[nodiscard]] std::uint64_t grid_start() const noexcept { return grid_start_; }
    /// Whether a body is there in the next step: it has started, and was not removed.
    [[nodiscard]] bool is_there(std::size_t index) const noexcept {
        return !is_removed(index) && steps_ >= first_step(index);
    }
    [[nodiscard]] std::size_t copies() const noexcept { return static_cast<std::size_t>(release_.count); }
    [[nodiscard]] Batch& batch() noexcept { return batch_; }
    [[nodiscard]] const Batch& batch() const noexcept { return batch_; }
    [[nodiscard]] const Surroundings& surroundings() const noexcept { return surroundings_; }
    /// Of the bodies' hull, where they meet others.
    [[nodiscard]] const std::vector<HullFace>& faces() const noexcept { return faces_; }
    /// Lets a body that lies still be judged anew.
    void wake(std::size_t index) noexcept;
    /// How many steps reach a time, to rounding.
    [[nodiscard]] std::uint64_t steps_until(double time) const;

    /// In the world, at a time between the last two steps; before the start, held in place.
    [[nodiscard]] Pose pose(std::size_t index, double time) const;
    /// The same in the flow's frame, and not held.
    [[nodiscard]] Pose pose_in_flow(std::size_t index, double time) const;
    /// The same with the velocity relative to the wind there.
    [[nodiscard]] Pose pose_in_wind(std::size_t index, double time) const;
    void set_pose(std::size_t index, const Pose& pose, double time);
    /// Adds to what pushes a body (N, N m) over the next advance_to.
    void add_wrench(std::size_t index, const Wrench& wrench);
    /// Gives a body an impulse (N s, N m s) at a time between the last two steps.
    void add_impulse(std::size_t index, const Wrench& impulse, double time);
    /// Takes a body out where it is: it moves no more, until it is put elsewhere.
    void remove(std::size_t index, double time);
    [[nodiscard]] bool is_removed(std::size_t index) const noexcept {
        return !removed_.empty() && removed_[index] != 0;
    }
    /// Whether a body lies still on what it touches.
    [[nodiscard]] bool is_at_rest(std::size_t index) const noexcept { return batch_.state(index).at_rest; }
    /// Notes what bodies meet of ground and obstacles, or not.
    void watch_contacts(bool watch) { batch_.watch_contacts(watch); }
    /// What a body met since it was last asked; nothing where it is not noted.
    ContactRecord take_contacts(std::size_t index) noexcept {
        return batch_.watches_contacts() ? batch_.take_contacts(index) : ContactRecord{};
    }
    /// What the fluid does to a body in its next step. Throws SimulationError where `time` is not the end of
    /// a step, or the body is of another size than the shape's.
    [[nodiscard]] FluidLoad fluid_load(std::size_t index, double time) const;
    void set_seed(std::uint64_t seed, std::uint32_t first_run);
    /// Other surroundings from the last step on: bodies keep place and motion in the world, and wake.
    void set_surroundings(const Surroundings& surroundings);
    /// When the last step ended or, before the first, the flight begins (s, of the world).
    [[nodiscard]] double reached() const noexcept { return release_.start + time_of(steps_); }

    /// All that shapes the motion, exactly: states fit equal descriptions.
    [[nodiscard]] std::string description() const;
    [[nodiscard]] std::size_t state_size() const;
    void write(StateWriter& writer) const;
    /// Reads what was written, of a flight that is at `time`, and keeps it or not. Returns whether its
    /// numbers are those of a flight.
    bool read(StateReader& reader, double time, bool keep);

  private:
    [[nodiscard]] Noise noise_of(std::uint64_t seed, std::uint32_t first_run, std::size_t index) const;
    [[nodiscard]] double time_of(std::uint64_t step) const noexcept {
        return static_cast<double>(step) * step_;
    }
    [[nodiscard]] std::uint64_t first_step(std::size_t index) const noexcept {
        return first_steps_.empty() ? 0 : first_steps_[index];
    }
    /// Hands what pushes the bodies in a call of that `duration` (s) to the batch, or keeps it for the next
    /// where it takes no step.
    void take_up_wrenches(double duration, bool has_steps);
    void set_removed(std::size_t index, bool removed);
    void draw_starts(const SimulationSettings& settings);
    /// How many steps the bodies take, all together, between two of the grid.
    [[nodiscard]] std::uint64_t steps_between(std::uint64_t begin, std::uint64_t end) const;
    void step_to(std::uint64_t steps);
    [[nodiscard]] StepReport sampled() const;

    std::string name_;
    std::size_t first_;
    Surroundings surroundings_;
    Release release_;
    BodyPhysics physics_;
    std::string hash_;
    double step_;
    int threads_;
    bool collide_;  ///< whether bodies touch each other
    std::uint64_t grid_start_ = 0;
    std::vector<HullFace> faces_;
    std::shared_ptr<const ImmersedBody> body_;
    Batch batch_;
    std::vector<std::uint64_t> first_steps_;  ///< of each body; none where all begin with the grid
    std::uint64_t steps_ = 0;
    std::vector<Pose> before_;         ///< in the flow's frame: where the bodies were at before_time_
    std::vector<double> before_time_;  ///< s, since the start
    StepReport report_;
    std::vector<Wrench> wrenches_;       ///< over the next advance_to; none where nothing is pushed
    std::vector<Wrench> pushed_;         ///< their mean over the calls since the last step, or none
    double pushed_time_ = 0.0;           ///< s: how long these calls were
    std::vector<Wrench> acting_;         ///< in the last steps; none where nothing was pushed
    std::vector<std::uint8_t> removed_;  ///< of each body 1 or 0; none where all are there
    std::uint64_t seed_ = 1;
    std::uint32_t first_run_ = 0;
};

}  // namespace samara
