#pragma once

#include <cstddef>
#include <cstdint>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/kernel/body_state.hpp"
#include "samara/core/kernel/noise.hpp"
#include "samara/core/kernel/state_block.hpp"
#include "samara/core/kernel/step_constants.hpp"
#include "samara/core/physics/wrench.hpp"

/// The step's formulas, compiled for every instruction set and chosen once at run time. Each sum and product
/// in double precision is rounded by itself, so that a body gives the same bytes alone, beside others, and on
/// every instruction set.
namespace samara::kernel {

/// When a body that is at rest is judged anew; in all other steps it keeps its place.
struct RestJudgement {
    std::uint64_t every = 0;  ///< steps between two judgements; 0: none, where no load on it changes

    /// Returns whether a body at rest keeps its place in a step without a judgement. `is_still`: it samples
    /// no turbulence.
    [[nodiscard]] bool skips(std::uint64_t step, bool is_still) const noexcept {
        return every == 0 ? is_still : step % every != 0;
    }
};

/// The contacts of a body after each implicit step, where there is ground or an obstacle.
struct Contact {
    /// Corrects the state of body number `body` after a substep (s) that ended at a time (s, of the world)
    /// and began from `before`.
    using Resolve = void (*)(const void* context, std::size_t body, double time, double substep,
                             const BodyState& before, BodyState& state) noexcept;
    Resolve resolve = nullptr;
    /// Keeps a body at rest on the ground over a step between two times.
    using Stay = void (*)(const void* context, std::size_t body, double begin, double end,
                          BodyState& state) noexcept;
    Stay stay = nullptr;
    RestJudgement judgement;
    bool moves = false;  ///< whether the ground moves, in the flow's frame
    const void* context = nullptr;
    double reach = 0.0;   ///< m, in the flow's frame: bodies whose centre is higher do not touch the ground
    double radius = 0.0;  ///< m: of the sphere about the centre that holds any of the bodies
    double ground_speed = 0.0;  ///< m/s, at most
    bool has_obstacles = false;
    /// m, in the flow's frame: a box that no obstacle leaves
    Vector3d box_low = Vector3d::Zero(), box_high = Vector3d::Zero();
};

/// The wind on bodies side by side over one step: the stream that each is in, beyond the undisturbed flow
/// (world axes; m/s, rad/s). It changes evenly from `begin` to `end`.
struct SampledWind {
    static constexpr std::size_t size = 16;
    double place[3][size] = {};  ///< m, in the flow's frame: the place of each centroid at mid-step
    double begin[3][size] = {}, end[3][size] = {}, rotation[3][size] = {};
};

/// The source of a wind; null where there is none.
struct WindSource {
    /// Fills the wind on the first `count` bodies in step number `step`.
    using Sample = void (*)(const void* context, std::uint64_t step, std::size_t count,
                            SampledWind& sampled) noexcept;
    Sample sample = nullptr;
    const void* context = nullptr;
};

/// External wrenches on bodies side by side, in addition to fluid, gravity and contact.
struct ExternalLoads {
    static constexpr std::size_t size = 16;
    double moment[3][size] = {}, force[3][size] = {};
};

/// Steps for blocks to take.
struct BlockSteps {
    const Vector3d* gravities = nullptr;  ///< m/s^2 in each step
    double start = 0.0;                   ///< s, of the world: the begin of step 0
    double time_step = 0.0;               ///< s
    std::uint64_t first_step = 0;
    std::uint64_t steps = 0;
    bool sized = false;  ///< whether any body's size is not the shape's
    Contact contact = {};
    WindSource wind = {};
    const ExternalLoads* external = nullptr;  ///< of every 16 bodies of the batch; null: none
};

/// Takes the steps of blocks of bodies. In single precision all but the positions is rounded to it in every
/// step, so that the motion is the same however the steps are divided into calls.
BatchReport advance_blocks(const StepConstants& constants, const BlockSteps& steps, StateBlock* blocks,
                           std::size_t count) noexcept;
BatchReport advance_blocks(const StepConstantsIn<float>& constants, const BlockSteps& steps,
                           StateBlock* blocks, std::size_t count) noexcept;

/// The sampled turbulence's velocity over a whole step (m/s, world axes): it changes evenly from `begin` to
/// `end`, while its rotation (rad/s) is held.
struct SampledStream {
    Vector3d begin, end, rotation;
    bool moves = false;           ///< false: the sampled turbulence is at rest and does not rotate
    bool on_loads_alone = false;  ///< it affects the loads alone: it neither changes nor rotates
    /// the part by the body's own wake: it presses on the body's sides
    Vector3d wake_fluctuation = Vector3d::Zero();
};

/// implicit_step() of step.hpp over h, substep number `substep` of `substeps` equal ones of a whole step.
/// `external`: null where there is none.
void implicit_step(const StepConstants& constants, const Vector3d& gravity, double h,
                   const SampledStream& stream, int substep, int substeps, const Wrench* external,
                   BodyState& state) noexcept;

/// The division of a whole step, and its stream.
struct BegunStep {
    int substeps = 1;  ///< number of substeps
    SampledStream stream;
};

/// Samples the wind and does the Langevin update over the whole step.
BegunStep begin_step(const StepConstants& constants, double h, const WindSource& wind, const Noise& noise,
                     std::uint64_t step, BodyState& state) noexcept;

/// Takes whole steps of one body without contact between their substeps. `external`: its external loads, null
/// where there are none.
BatchReport advance_one(const StepConstants& constants, const BlockSteps& steps, const Noise& noise,
                        const Wrench* external, BodyState& state) noexcept;

/// load_matrices() of loads.hpp.
LoadMatrices load_matrices(const StepConstants& constants, const Vector6d& velocity,
                           const Vector3d& sampled_rotation, const Vector3d& wake_fluctuation,
                           const WakeShares& shares) noexcept;

/// The functions of langevin.hpp; the velocities are the state's.
TurbulenceLevel turbulence_level(const StepConstants& constants, const Vector3d& velocity) noexcept;
void advance_sampled_turbulence(const StepConstants& constants, const TurbulenceLevel& level, double h,
                                const Noise& noise, std::uint64_t step, BodyState& state) noexcept;
void advance_body_velocity(const StepConstants& constants, const TurbulenceLevel& level, double h,
                           const Noise& noise, std::uint64_t step, BodyState& state) noexcept;

/// Makes two independent normal numbers of two that are uniform in (0, 1), by Box and Muller's transform.
void normal_pair(double first, double second, double& a, double& b) noexcept;

}  // namespace samara::kernel
