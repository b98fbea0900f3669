#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "samara/core/base/error.hpp"
#include "samara/core/physics/body_physics.hpp"
#include "samara/core/physics/contact_record.hpp"
#include "samara/core/physics/fluid.hpp"
#include "samara/core/physics/fluid_load.hpp"
#include "samara/core/physics/obstacle.hpp"
#include "samara/core/physics/pose.hpp"
#include "samara/core/physics/precision.hpp"
#include "samara/core/physics/release.hpp"
#include "samara/core/physics/wrench.hpp"
#include "samara/core/simulation/loaded_body.hpp"
#include "samara/core/wind/wind.hpp"

namespace samara {

/// The surroundings of the bodies of a simulation, and its steps.
struct SimulationSettings {
    Fluid fluid = {};                              ///< the fluid around the bodies
    Vector3d gravity = Vector3d(0.0, 0.0, -9.81);  ///< m/s^2, world axes
    std::optional<double> ground = {};             ///< m: the height (world z) of level ground
    std::vector<Obstacle> obstacles = {};          ///< obstacles that bodies touch
    Wind wind = {};                                ///< in addition to current and gust
    /// Whether the bodies of a run touch each other as they touch the ground. All groups then share one grid
    /// of steps, and start at the next of its steps.
    bool bodies_collide = false;
    double step = 0.002;                                ///< s
    Precision precision = Precision::double_precision;  ///< of the steps
    std::uint64_t seed = 1;                             ///< of all random numbers
    std::uint32_t first_run = 0;  ///< number of the first run, on which the noise depends
    int runs = 1;                 ///< the number of runs, which differ by their random numbers alone
    int threads = 1;              ///< 0: all cores; the poses are the same for any number
};

/// The steps and Reynolds numbers of the bodies of a group, or of all, so far.
struct StepReport {
    std::uint64_t steps = 0;           ///< of the settings' step, over all bodies
    std::uint64_t implicit_steps = 0;  ///< implicit steps within them
    int most_substeps = 1;             ///< the most implicit steps of a body in one step
    std::uint64_t steps_at_limit = 0;  ///< steps with the largest number of implicit steps
    /// The values below are of the bodies as they were after every 32nd step, and are now.
    double highest_reynolds_number = 0.0;
    std::uint64_t moving = 0;       ///< bodies that moved through the fluid
    std::uint64_t below_table = 0;  ///< those of them at less than half the table's lowest Reynolds number

    /// Adds the counts of another report.
    void add(const StepReport& other);
    /// Returns below_table / moving; 0 where none moved.
    [[nodiscard]] double share_below_table() const;
};

/// An error in a request to a simulation; its reason tells programs what its text tells people.
class SimulationError : public Error {
  public:
    /// The reason of the error.
    enum class Reason {
        invalid_argument,
        time_passed,   ///< the simulation cannot go back
        out_of_range,  ///< a body's motion left the range of numbers; the simulation has stopped
        foreign_state  ///< the bytes are not a state of this simulation
    };
    /// Makes an error with that reason and text.
    SimulationError(Reason reason, const std::string& text) : Error(text), reason_(reason) {}
    /// The reason of the error.
    [[nodiscard]] Reason reason() const noexcept { return reason_; }

  private:
    Reason reason_;
};

class BodyGroup;

/// A simulation of falling bodies. Those of a group share their physics and a grid of steps that begins at
/// their start; until then they are held in place. Any time may be asked for: poses between two steps are
/// interpolated, so that the motion does not depend on the times asked for nor on the division into calls.
/// Not to be used by several threads at a time.
class Simulation {
  public:
    /// Makes an empty simulation at time 0. Throws SimulationError where the step is not a positive number.
    explicit Simulation(const SimulationSettings& settings = {});
    ~Simulation();
    /// Moves the bodies; the other may then only be assigned to or destroyed. bodies, fit to be assigned to
    /// or destroyed.
    Simulation(Simulation&&) noexcept;
    /// Moves the bodies; the other may then only be assigned to or destroyed. bodies, fit to be assigned to
    /// or destroyed.
    Simulation& operator=(Simulation&&) noexcept;

    /// Returns a simulation at time 0 with these settings and surroundings, which both share, without bodies.
    /// Neither's obstacles, ground or wind may then change. `threads`: 0: all cores.
    [[nodiscard]] Simulation without_bodies(int threads) const;

    /// Adds an obstacle, at any time, and returns its number, from 0; bodies at rest wake. Its surface must
    /// be welded and sound. Throws SimulationError where the name is taken, Error where a body is inside of
    /// it.
    std::size_t add_obstacle(Obstacle obstacle);
    /// Removes an obstacle: bodies that it bore fall. The others keep their numbers. Needs index <
    /// obstacle_count().
    void remove_obstacle(std::size_t index);
    /// Returns whether an obstacle is removed. Needs index < obstacle_count().
    [[nodiscard]] bool is_obstacle_removed(std::size_t index) const;

    /// Adds all bodies of a group, which start at time() or later, and returns the number of the first: copy
    /// c of run r has the number first + r * count + c (of the copies that are simulated). `name`, on which
    /// the random numbers depend, is the body's own where it is empty. Throws SimulationError where the name
    /// is taken or the start has passed; Error where the body lacks what its physics needs, the inertia is
    /// that of no body, or a copy starts below the ground or inside an obstacle.
    std::size_t add(const LoadedBody& body, const BodyPhysics& physics, const Release& release,
                    const std::string& name = {});

    /// Returns the number of bodies.
    [[nodiscard]] std::size_t size() const noexcept;
    /// Returns the time (s).
    [[nodiscard]] double time() const noexcept;
    /// Returns the report since the start.
    [[nodiscard]] StepReport report() const;
    /// Returns the number of steps taken so far, over all bodies.
    [[nodiscard]] std::uint64_t steps() const noexcept;

    /// Advances all bodies to a time (s). Throws SimulationError where it lies before time() or more than
    /// 1e10 steps ahead, and where a body's motion leaves the range of numbers: then, and from then on.
    void advance_to(double time);

    /// Advances to a time (s) as advance_to() does, step by step, but takes no further step where that would
    /// probably end later than `seconds` after the call, by the clock on the wall; one step at least. The
    /// motion is the same: where time() is less than `time` then, the next call takes up the rest. Wrenches
    /// act in all steps that are taken. Throws as advance_to() does.
    void advance_within(double time, double seconds);

    /// Throws SimulationError where advance_to() would not accept that time: nothing has changed then.
    void require_time(double time) const;

    /// Returns the pose of a body's centre of mass at time(). Needs index < size().
    [[nodiscard]] Pose pose(std::size_t index) const;
    /// Fills `poses[i]` for `count` bodies from number `first` on.
    void poses(std::size_t first, std::size_t count, Pose* poses) const;
    /// Places a body elsewhere, from time() on; it keeps its wake. Needs finite numbers and an orientation of
    /// length one.
    void set_pose(std::size_t index, const Pose& pose);
    /// Adds a wrench on a body, in addition to fluid, gravity and contacts, in all steps of the next
    /// advance_to() to a later time; several add up, and a body that waits for its start feels none. Calls
    /// without a step pass theirs on, as a mean, to the next call with one. Needs index < size() and finite
    /// numbers.
    void add_wrench(std::size_t index, const Wrench& wrench);
    /// Gives a body an impulse (N s, N m s) at time(): body and fluid take it together, by K. Needs index <
    /// size() and finite numbers.
    void add_impulse(std::size_t index, const Wrench& impulse);
    /// Removes a body: it stays in its place, costs no steps, and keeps its number. set_pose() returns it.
    void remove(std::size_t index);
    /// Returns whether a body is removed.
    [[nodiscard]] bool is_removed(std::size_t index) const;
    /// Returns whether a body is at rest on the ground, an obstacle or other bodies.
    [[nodiscard]] bool is_at_rest(std::size_t index) const;
    /// Records contacts of bodies with ground, obstacles and each other from now on, or no longer.
    void watch_contacts(bool watch);
    /// Returns a body's contacts since they were last taken. Throws SimulationError where watch_contacts() is
    /// off.
    ContactRecord take_contacts(std::size_t index);
    /// Returns the fluid's load on a body in its next step, for a host that integrates the body itself: it
    /// places the body by set_pose(), asks, and advances by a step. Throws SimulationError where time() lies
    /// within a step of the body.
    [[nodiscard]] FluidLoad fluid_load(std::size_t index) const;
    /// Returns the fluid's forces on a body, by their causes, at the end of the step that holds time(); none
    /// before its start and once it is removed. Needs index < size().
    [[nodiscard]] FluidForces fluid_forces(std::size_t index) const;
    /// Returns a body's size relative to the shape's. Needs index < size().
    [[nodiscard]] double size_of(std::size_t index) const;
    /// Returns the mass (kg) of the body alone, at its size.
    [[nodiscard]] double mass(std::size_t index) const;
    /// Returns the inertia (kg m^2) of the body alone about its centre of mass, shape axes, at its size.
    [[nodiscard]] Matrix3d inertia(std::size_t index) const;
    /// Returns a body's centre of mass (m from the shape's origin, shape axes), at the body's size.
    [[nodiscard]] Vector3d center_of_mass(std::size_t index) const;

    /// Returns the number of obstacles, with those that were removed.
    [[nodiscard]] std::size_t obstacle_count() const noexcept;
    /// Replaces the keys of an obstacle: one at least, in ascending order of time. Later than the first
    /// advance the obstacle moves evenly from its place at time() to the first key that lies half a step
    /// after the last step, or to the last key within a step where none does. Needs index < obstacle_count().
    void set_obstacle_keys(std::size_t index, const std::vector<ObstacleKey>& keys);
    /// Replaces the ground from the last step on: bodies below it are lifted onto it in the next step.
    void set_ground(std::optional<double> ground);
    /// Returns the height (m) of level ground, where there is any.
    [[nodiscard]] const std::optional<double>& ground() const noexcept;
    /// Replaces the wind from the last step on; gusts without a seed have the one that the simulation was
    /// made with.
    void set_wind(const Wind& wind);
    /// Returns the wind.
    [[nodiscard]] const Wind& wind() const noexcept;

    /// Replaces the random numbers from the next step on; run r of the simulation is then run first_run + r.
    void set_seed(std::uint64_t seed, std::uint32_t first_run);

    /// Returns the number of bytes of state(), which grows with the obstacles' keys.
    [[nodiscard]] std::size_t state_size() const;
    /// Returns all that the rest of the simulation depends on, but for wrenches that no step has used yet and
    /// recorded contacts. Throws SimulationError where the simulation has stopped.
    [[nodiscard]] std::string state() const;
    /// Continues from a state of a simulation with the same settings, ground, wind, obstacles, groups and
    /// bodies; obstacles get their keys from it. Throws SimulationError, and changes nothing, where the bytes
    /// are no such state.
    void set_state(std::string_view bytes);

    /// Throws SimulationError where the simulation has stopped because a body's motion left the range of
    /// numbers.
    void require_running() const;

    /// Returns the groups in the order in which they were added (core/simulation/body_group.hpp).
    [[nodiscard]] const std::vector<std::unique_ptr<BodyGroup>>& groups() const noexcept;

  private:
    struct Parts;
    [[nodiscard]] BodyGroup& group_of(std::size_t index) const;
    [[nodiscard]] std::string fingerprint() const;
    [[nodiscard]] std::size_t fixed_state_size() const;
    void renew_surroundings();
    void advance_together(double time);
    void wake_all();
    bool read_state(std::string_view payload, bool keep);

    std::unique_ptr<Parts> members_;
};

}  // namespace samara
