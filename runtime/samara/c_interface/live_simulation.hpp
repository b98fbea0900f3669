#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "samara/body/body.hpp"
#include "samara/c_interface/prepared_bodies.hpp"
#include "samara/c_interface/settings.hpp"
#include "samara/dynamics/batch.hpp"
#include "samara/dynamics/immersed_body.hpp"
#include "samara/motion/pose.hpp"

namespace samara {

/// What a live simulation did so far, over all bodies.
struct LiveReport {
    std::uint64_t steps = 0;
    std::uint64_t substeps = 0;
    std::int32_t most_substeps = 1;
    double highest_reynolds_number = 0.0;
};

/// Bodies that are moved on call by call, and can be looked at and put elsewhere between the calls. The
/// motion is that of simulate(), to rounding. Poses are those of centres of mass.
class LiveSimulation {
  public:
    explicit LiveSimulation(const SimulationSettings& settings);

    /// Adds all bodies of a kind, before the first advance, and returns the number of the first. `hash`: of
    /// the body file; `prepared`: of this body. Throws Fault where the body lacks what the kind asks for,
    /// where the name is taken, or where the simulation has begun; Error where the inertia is not that of any
    /// body, or a body starts below the ground.
    std::size_t add(const Body& body, PreparedBodies& prepared, const std::string& hash,
                    const SceneBody& kind);

    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    [[nodiscard]] double time() const noexcept { return time_; }
    [[nodiscard]] LiveReport report() const;

    /// Throws Fault where the simulation has stopped, since a body's motion left the range of numbers.
    void require_running() const;

    /// Steps all bodies to a time (s). Throws Fault where it lies before time() or too far off, and where a
    /// body's motion leaves the range of numbers: then, and from then on.
    void advance_to(double time);

    /// Of body `index` at time().
    [[nodiscard]] Pose pose(std::size_t index) const;
    void set_pose(std::size_t index, const Pose& pose);
    /// m, shape axes.
    [[nodiscard]] const Vector3d& center_of_mass(std::size_t index) const;

    void set_seed(std::uint64_t seed, std::uint32_t run);

    [[nodiscard]] std::size_t state_size() const;
    /// The state (state_bytes.hpp says in which form). Throws Fault where the simulation has stopped.
    [[nodiscard]] std::string state() const;
    /// Throws Fault, and changes nothing, where the bytes are not the state of a simulation like this one.
    void set_state(std::string_view bytes);

  private:
    /// The bodies of a kind on their own grid of steps, which begins at their start.
    struct Kind {
        SceneBody given;
        std::string description;  ///< of all that shapes the motion: states fit equal descriptions
        std::shared_ptr<const ImmersedBody> body;
        Batch batch;
        std::size_t first = 0;
        std::uint64_t steps = 0;
        std::vector<Pose> before;         ///< in the flow's frame: where the bodies were at `before_time`
        std::vector<double> before_time;  ///< s
    };

    [[nodiscard]] double step_time(const Kind& kind) const;
    [[nodiscard]] std::pair<const Kind*, std::size_t> find(std::size_t index) const;
    /// How many steps reach a time in a kind's flight (s), to rounding.
    [[nodiscard]] std::uint64_t steps_until(double time_in_flight) const;
    /// Steps on until the kind has taken `steps`.
    void step_to(Kind& kind, std::uint64_t steps);
    /// Stops the simulation, with a Fault, where a body's motion left the range of numbers.
    void require_finite(const Kind& kind);
    [[nodiscard]] static double highest_reynolds_number(const Kind& kind);
    void key_noise(Kind& kind);
    [[nodiscard]] std::string fingerprint() const;

    SimulationSettings settings_;
    std::vector<Kind> kinds_;
    std::size_t size_ = 0;
    double time_ = 0.0;
    bool has_begun_ = false;
    std::string stopped_;  ///< why; empty: it has not
    LiveReport report_;
};

}  // namespace samara
