#pragma once

#include <cstddef>
#include <cstdint>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/kernel/body_state.hpp"
#include "samara/core/kernel/noise.hpp"
#include "samara/core/kernel/state_block.hpp"
#include "samara/core/kernel/step_constants.hpp"
#include "samara/core/physics/wrench.hpp"

/// The step's formulas, compiled for every instruction set and chosen once at run time. In double precision
/// each sum and product is rounded by itself, so that one body, or any number of them side by side, gives the
/// same bytes on every instruction set.
namespace samara::kernel {

/// What is done with a body after each implicit step, where there is ground or an obstacle to meet.
struct Contact {
    /// Mends the state of body number `body` after a substep (s) that ended at a time (s, of the world) and
    /// began from `before`.
    using Resolve = void (*)(const void* context, std::size_t body, double time, double substep,
                             const BodyState& before, BodyState& state) noexcept;
    Resolve resolve = nullptr;
    /// Leaves a body at rest on the ground over a step between two times; null where rest must be judged anew
    /// in each step.
    using Stay = void (*)(const void* context, std::size_t body, double begin, double end,
                          BodyState& state) noexcept;
    Stay stay = nullptr;
    bool moves = false;  ///< whether the ground does, in the flow's frame
    const void* context = nullptr;
    double reach = 0.0;   ///< m, in the flow's frame: bodies whose centre is higher do not touch the ground
    double radius = 0.0;  ///< m: of the sphere about the centre that holds any of the bodies
    double ground_speed = 0.0;  ///< m/s, at most
    bool has_obstacles = false;
    /// m, in the flow's frame: no obstacle leaves it.
    Vector3d box_low = Vector3d::Zero(), box_high = Vector3d::Zero();
};

/// What bodies side by side meet of a wind over one step: the stream that each is in, beyond the undisturbed
/// flow (world axes; m/s, rad/s). It changes evenly from `begin` to `end`.
struct SampledWind {
    static constexpr std::size_t size = 16;
    double place[3][size] = {};  ///< m, in the flow's frame: where each centroid is halfway through the step
    double begin[3][size] = {}, end[3][size] = {}, rotation[3][size] = {};
};

/// Where a wind comes from; null where there is none.
struct WindSource {
    /// Fills what the first `count` bodies meet in step number `step`.
    using Meet = void (*)(const void* context, std::uint64_t step, std::size_t count,
                          SampledWind& sampled) noexcept;
    Meet sample = nullptr;
    const void* context = nullptr;
};

/// What a host pushes bodies side by side with, besides fluid, gravity and contact: Wrench of each.
struct ExternalLoads {
    static constexpr std::size_t size = 16;
    double moment[3][size] = {}, force[3][size] = {};
};

/// Steps for blocks to take.
struct BlockSteps {
    const Vector3d* gravities = nullptr;  ///< m/s^2 in each step
    double start = 0.0;                   ///< s, of the world: when step 0 began
    double time_step = 0.0;               ///< s
    std::uint64_t first_step = 0;
    std::uint64_t steps = 0;
    bool sized = false;  ///< whether any body's size is not the shape's
    Contact contact = {};
    WindSource wind = {};
    const ExternalLoads* external = nullptr;  ///< of every 16 bodies of the batch; null: none
};

BatchReport advance_blocks(const StepConstants& constants, const BlockSteps& steps, StateBlock* blocks,
                           std::size_t count) noexcept;

/// The sampled turbulence's velocity over a whole step (m/s, world axes): it changes evenly from `begin` to
/// `end`, while its rotation (rad/s) is held.
struct SeenStream {
    Vector3d begin, end, rotation;
    bool moves = false;           ///< false: the sampled turbulence is taken to be at rest, and not to turn
    bool on_loads_alone = false;  ///< of the loads alone: it neither changes nor turns
    Vector3d wake_fluctuation =
        Vector3d::Zero();  ///< of the wake, in the stream: it presses on the body's sides
};

/// implicit_step() of step.hpp over h, which is the part `part` of `parts` equal ones of a whole step.
/// `external`: null where there is none.
void implicit_step(const StepConstants& constants, const Vector3d& gravity, double h,
                   const SeenStream& stream, int part, int parts, const Wrench* external,
                   BodyState& state) noexcept;

/// How a whole step is taken.
struct BegunStep {
    int parts = 1;  ///< that it is cut into
    SeenStream stream;
};

/// Meets the wind and does the Langevin update over the whole step.
BegunStep begin_step(const StepConstants& constants, double h, const WindSource& wind, const Noise& noise,
                     std::uint64_t step, BodyState& state) noexcept;

/// Whole steps of one body that nothing meets between their parts: `steps` without contact. Its external
/// loads are `external`, null where there are none.
BatchReport advance_one(const StepConstants& constants, const BlockSteps& steps, const Noise& noise,
                        const Wrench* external, BodyState& state) noexcept;

/// load_matrices() of loads.hpp.
LoadMatrices load_matrices(const StepConstants& constants, const Vector6d& velocity,
                           const Vector3d& seen_rotation, const Vector3d& wake_fluctuation,
                           const WakeShares& shares) noexcept;

/// The functions of langevin.hpp; the velocities are the state's.
TurbulenceLevel turbulence_level(const StepConstants& constants, const Vector3d& velocity) noexcept;
void advance_sampled_turbulence(const StepConstants& constants, const TurbulenceLevel& level, double h,
                                const Noise& noise, std::uint64_t step, BodyState& state) noexcept;
void advance_body_velocity(const StepConstants& constants, const TurbulenceLevel& level, double h,
                           const Noise& noise, std::uint64_t step, BodyState& state) noexcept;

/// Two independent normal numbers of two that are uniform in (0, 1): Box and Muller's.
void normal_pair(double first, double second, double& a, double& b) noexcept;

}  // namespace samara::kernel
