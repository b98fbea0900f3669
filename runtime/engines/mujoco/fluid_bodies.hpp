#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <mujoco/mujoco.h>

#include "samara.h"

namespace samara::mujoco {

/// What is wrong with a model or its body file, in one line.
class ModelError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Returns the text that the model's XML gives for a key of the fluid, empty where it gives none.
using Settings = std::function<std::string(const char* key)>;

/// The keys of the fluid that a model's XML may have (docs/how-to/other-engines.md).
inline constexpr const char* setting_keys[] = {"file", "fluid",      "density", "viscosity",
                                               "seed", "turbulence", "wind"};

/// Samara's fluid around bodies of one model that share a body file: a simulation which gives loads, while
/// MuJoCo moves the bodies. What goes on in the fluid (turbulence, wake, time) is kept in numbers of each
/// mjData, so that one of these serves them all, one after the other.
class FluidBodies {
  public:
    /// Takes the mass properties of the bodies, gravity and step from the model. Throws ModelError where the
    /// body file cannot be read, a setting is wrong, or MuJoCo keeps a body's inertia as a diagonal.
    FluidBodies(const mjModel& model, std::vector<int> bodies, const Settings& settings);

    /// How many numbers of each mjData hold the fluid's state. All zero: bodies that start now.
    [[nodiscard]] std::size_t state_size() const;
    /// Whether the model still has the step, gravity and mass properties that this was made of.
    [[nodiscard]] bool fits(const mjModel& model) const;
    /// Adds the fluid's inertia and damping to MuJoCo's inertia matrix, whose factors are not renewed, and
    /// its wrench to the passive forces. Lets the fluid's time go on by a step where mjData has made one.
    /// Needs mj_comVel. Throws ModelError where samara rejects the motion.
    void apply(const mjModel& model, mjData& data, mjtNum* state);

  private:
    /// Makes the simulation hold that state, at the time of mjData.
    void resume(double time, mjtNum* state);
    void keep(mjtNum* state);
    void add(const mjModel& model, mjData& data, std::size_t number);

    struct Free {
        void operator()(samara_simulation* simulation) const { samara_simulation_free(simulation); }
    };
    std::vector<int> bodies_;      ///< of MuJoCo, in samara's order
    std::vector<double> made_of_;  ///< of the model, to see whether it has changed
    std::unique_ptr<samara_simulation, Free> simulation_;
    double step_;                       ///< s
    std::vector<std::uint32_t> start_;  ///< the state at time 0, in words
    std::vector<std::uint32_t> held_;   ///< the state that the simulation is in
};

}  // namespace samara::mujoco
