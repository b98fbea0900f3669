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
#include "samara/core/physics/release.hpp"
#include "samara/core/physics/wrench.hpp"
#include "samara/core/simulation/loaded_body.hpp"
#include "samara/core/wind/wind.hpp"

namespace samara {

/// What surrounds the bodies of a flight, and how it is stepped.
struct SimulationSettings {
    Fluid fluid = {};                              ///< what the bodies are in
    Vector3d gravity = Vector3d(0.0, 0.0, -9.81);  ///< m/s^2, world axes
    std::optional<double> ground = {};             ///< m: the height (world z) of level ground
    std::vector<Obstacle> obstacles = {};          ///< what bodies touch besides
    Wind wind = {};                                ///< beside current and gust
    /// Whether the bodies of a run touch each other as they touch the ground. All then fly on one grid of
    /// steps: kinds start at the next of its steps.
    bool bodies_collide = false;
    double step = 0.002;          ///< s
    std::uint64_t seed = 1;       ///< of all random numbers
    std::uint32_t first_run = 0;  ///< of the noise: runs differ by it
    int runs = 1;     ///< how many runs fly side by side, that differ by their random numbers alone
    int threads = 1;  ///< 0: all cores; the poses are the same for any number
};

/// What happened on the way to the bodies of a kind, or to all of them.
struct StepReport {
    std::uint64_t steps = 0;           ///< of the settings' step, over all bodies
    std::uint64_t implicit_steps = 0;  ///< into which they were cut
    int most_substeps = 1;             ///< that a body took in one step
    std::uint64_t steps_at_limit = 0;  ///< steps that took the most substeps there may be
    /// The rest is of the bodies as they were after every 32nd step, and are now.
    double highest_reynolds_number = 0.0;
    std::uint64_t moving = 0;       ///< bodies that moved through the fluid
    std::uint64_t below_table = 0;  ///< those of them below half the table's lowest Reynolds number

    /// Adds the counts of another flight.
    void add(const StepReport& other);
    /// below_table / moving; 0 where none moved.
    [[nodiscard]] double share_below_table() const;
};

/// A fault of what is asked of a flight; its kind tells programs what its text tells people.
class SimulationError : public Error {
  public:
    /// What is at fault.
    enum class Reason {
        invalid_argument,
        time_passed,   ///< the flight cannot go back
        out_of_range,  ///< a body's motion left the range of numbers; the flight has stopped
        foreign_state  ///< the bytes are not the state of this flight
    };
    /// An error of that kind and text.
    SimulationError(Reason reason, const std::string& text) : Error(text), reason_(reason) {}
    /// What is at fault.
    [[nodiscard]] Reason reason() const noexcept { return reason_; }

  private:
    Reason reason_;
};

class BodyGroup;

/// Bodies that fall. Those of a kind share their physics and fly on a grid of steps that begins at their
/// start; until then they are held in place. Any time may be asked for: poses between two steps are
/// interpolated, so that the motion depends neither on the times asked for nor on how they are cut into
/// calls. Not to be used by several threads at a time.
class Simulation {
  public:
    /// Throws SimulationError where the step is not a positive number.
    explicit Simulation(const SimulationSettings& settings = {});
    ~Simulation();
    /// The other is left without bodies, fit to be assigned to or destroyed.
    Simulation(Simulation&&) noexcept;
    /// The other is left without bodies, fit to be assigned to or destroyed.
    Simulation& operator=(Simulation&&) noexcept;

    /// Adds an obstacle, before the first kind, and returns its number, from 0. Its surface must be welded
    /// and sound. Throws SimulationError where there is a kind already, or the name is taken.
    std::size_t add_obstacle(Obstacle obstacle);

    /// Adds all bodies of a kind, which start at time() or later, and returns the number of the first: copy c
    /// of run r has the number first + r * count + c. `name`, on which the random numbers depend, is the
    /// body's own where it is empty. Throws SimulationError where the name is taken or the start has passed;
    /// Error where the body lacks what its physics asks for, the inertia is that of no body, or a copy starts
    /// below the ground or inside an obstacle.
    std::size_t add(const LoadedBody& body, const BodyPhysics& physics, const Release& release,
                    const std::string& name = {});

    /// How many bodies there are.
    [[nodiscard]] std::size_t size() const noexcept;
    /// s.
    [[nodiscard]] double time() const noexcept;
    /// What has been counted since the start.
    [[nodiscard]] StepReport report() const;
    /// Steps taken so far, over all bodies.
    [[nodiscard]] std::uint64_t steps() const noexcept;

    /// Steps all bodies to a time (s). Throws SimulationError where it lies before time() or more than 1e10
    /// steps off, and where a body's motion leaves the range of numbers: then, and from then on.
    void advance_to(double time);

    /// Throws SimulationError where advance_to() could not go to that time: then nothing has changed.
    void require_time(double time) const;

    /// The pose of a body's centre of mass at time(). Needs index < size().
    [[nodiscard]] Pose pose(std::size_t index) const;
    /// Those of `count` bodies from number `first` on, `poses[i]` each.
    void poses(std::size_t first, std::size_t count, Pose* poses) const;
    /// Puts a body elsewhere, from time() on; it keeps the wake that it has. Needs finite numbers and an
    /// orientation of length one.
    void set_pose(std::size_t index, const Pose& pose);
    /// Pushes a body, besides fluid, gravity and what it touches, in all steps of the next advance_to to a
    /// later time; several add up, and a body that waits for its start feels none. Calls that take no step
    /// hand theirs on, as a mean, to the next that does. Needs index < size() and finite numbers.
    void add_wrench(std::size_t index, const Wrench& wrench);
    /// Gives a body an impulse (N s, N m s) at time(): body and fluid take it together, by K. The same needs.
    void add_impulse(std::size_t index, const Wrench& impulse);
    /// Takes a body out: it stays where it is, costs no steps, and keeps its number. set_pose() puts it back.
    void remove(std::size_t index);
    /// Whether it is out.
    [[nodiscard]] bool is_removed(std::size_t index) const;
    /// Whether a body lies still on ground or an obstacle.
    [[nodiscard]] bool is_at_rest(std::size_t index) const;
    /// Notes from now on what bodies meet of ground and obstacles, or no longer.
    void watch_contacts(bool watch);
    /// What a body met since it was last asked. Throws SimulationError where watch_contacts() does not hold.
    ContactRecord take_contacts(std::size_t index);
    /// What the fluid does to a body in its next step, for a host that integrates it itself: it puts the body
    /// where it has come to by set_pose(), asks, and advances by a step. Throws SimulationError where time()
    /// lies within a step of the body.
    [[nodiscard]] FluidLoad fluid_load(std::size_t index) const;
    /// Over the shape's lengths. Needs index < size().
    [[nodiscard]] double size_of(std::size_t index) const;
    /// kg: of the body alone, at its size.
    [[nodiscard]] double mass(std::size_t index) const;
    /// kg m^2: of the body alone about its centre of mass, shape axes, at its size.
    [[nodiscard]] Matrix3d inertia(std::size_t index) const;
    /// Of a body: m from the shape's origin, at the body's size, shape axes.
    [[nodiscard]] Vector3d center_of_mass(std::size_t index) const;

    /// How many obstacles there are.
    [[nodiscard]] std::size_t obstacle_count() const noexcept;
    /// Other keys of an obstacle, one at least, in ascending order of time. Before the first advance they
    /// take the place of its own. Later the obstacle goes from where it is at time() evenly to the first that
    /// lies half a step behind the last step taken, and to the last within a step where none does. Needs
    /// index < obstacle_count().
    void set_obstacle_keys(std::size_t index, const std::vector<ObstacleKey>& keys);
    /// Other ground from the last step on: what is below it is lifted onto it in the next one.
    void set_ground(std::optional<double> ground);
    /// m: the height of level ground, where there is some.
    [[nodiscard]] const std::optional<double>& ground() const noexcept;
    /// Another wind from the last step on; its gusts have the seed that the flight was made with, where they
    /// have none.
    void set_wind(const Wind& wind);
    /// The one that blows.
    [[nodiscard]] const Wind& wind() const noexcept;

    /// Other random numbers from the next step on; run r of the flight is then run first_run + r.
    void set_seed(std::uint64_t seed, std::uint32_t first_run);

    /// Bytes of state(), which grow with the obstacles' keys.
    [[nodiscard]] std::size_t state_size() const;
    /// All that the rest of the flight depends on, but for wrenches that no call has flown yet and contacts
    /// that were noted. Throws SimulationError where the flight has stopped.
    [[nodiscard]] std::string state() const;
    /// Goes on from such a state, of a flight with the same settings, ground, wind, obstacles, kinds and
    /// bodies; obstacles get their keys from it. Throws SimulationError, and changes nothing, where the bytes
    /// are none.
    void set_state(std::string_view bytes);

    /// Throws SimulationError where the flight has stopped, since a body's motion left the range of numbers.
    void require_running() const;

    /// The kinds in the order in which they were added (core/simulation/body_group.hpp).
    [[nodiscard]] const std::vector<std::unique_ptr<BodyGroup>>& groups() const noexcept;

  private:
    struct Parts;
    [[nodiscard]] BodyGroup& kind_of(std::size_t index) const;
    [[nodiscard]] std::string fingerprint() const;
    [[nodiscard]] std::size_t fixed_state_size() const;
    void renew_surroundings();
    void fly_together(double time);
    void wake_all();
    bool read_state(std::string_view payload, bool keep);

    std::unique_ptr<Parts> parts_;
};

}  // namespace samara
