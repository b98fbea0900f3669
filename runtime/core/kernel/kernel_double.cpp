#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "samara/core/kernel/kernel_double.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again for each target.
#include <hwy/highway.h>

#include "samara/core/kernel/blocks-inl.h"
#include "samara/core/kernel/kernel.hpp"

HWY_BEFORE_NAMESPACE();
namespace samara::HWY_NAMESPACE {

/// Loads three numbers that are adjacent in memory.
HWY_INLINE void load(const double* numbers, Triple<double>& triple) {
    triple = {numbers[0], numbers[1], numbers[2]};
}
HWY_INLINE void keep(const Triple<double>& triple, double* numbers) {
    numbers[0] = triple.x;
    numbers[1] = triple.y;
    numbers[2] = triple.z;
}
HWY_INLINE double lane(double number) {
    return number;
}
HWY_INLINE Matrix3d matrix_of(const Square<double>& a) {
    return (Matrix3d() << a.x.x, a.x.y, a.x.z, a.y.x, a.y.y, a.y.z, a.z.x, a.z.y, a.z.z).finished();
}

#if SAMARA_PACKS_ONE_BODY
using One = Spread;

HWY_INLINE void load(const double* numbers, Packed& triple) {
    triple = hn::MaskedLoad(hn::FirstN(FourTag(), 3), FourTag(), numbers);
}
HWY_INLINE void keep(const Packed& triple, double* numbers) {
    hn::BlendedStore(triple.raw, hn::FirstN(FourTag(), 3), FourTag(), numbers);
}
HWY_INLINE double lane(Spread number) {
    return hn::GetLane(number.raw);
}
HWY_INLINE Matrix3d matrix_of(const PackedSquare& a) {
    Matrix3d matrix;
    keep(a.x, matrix.data());
    keep(a.y, matrix.data() + 3);
    keep(a.z, matrix.data() + 6);
    return matrix;
}
#else
using One = double;
#endif

HWY_INLINE Triple<One> triple_of(const double* numbers) {
    Triple<One> triple;
    load(numbers, triple);
    return triple;
}
HWY_INLINE Triple<One> triple_of(const Vector3d& v) {
    return triple_of(v.data());
}
HWY_INLINE Vector3d vector_of(const Triple<One>& triple) {
    Vector3d v;
    keep(triple, v.data());
    return v;
}

HWY_INLINE StepState<One> step_state_of(const BodyState& state) {
    const Quaterniond& q = state.orientation;
    return {triple_of(state.position),
            {One(q.w()), triple_of(q.coeffs().data())},
            triple_of(state.velocity.data()),
            triple_of(state.velocity.data() + 3),
            triple_of(state.sampled_turbulence.velocity),
            triple_of(state.sampled_turbulence.angular_velocity),
            triple_of(state.acceleration.data()),
            triple_of(state.acceleration.data() + 3),
            {One(state.wake.formed), triple_of(state.wake.heading)}};
}
HWY_INLINE void keep(const StepState<One>& step_state, BodyState& state) {
    keep(step_state.position, state.position.data());
    keep(step_state.orientation.v, state.orientation.coeffs().data());
    state.orientation.w() = lane(step_state.orientation.w);
    keep(step_state.angular_velocity, state.velocity.data());
    keep(step_state.velocity, state.velocity.data() + 3);
    keep(step_state.sampled_velocity, state.sampled_turbulence.velocity.data());
    keep(step_state.sampled_rotation, state.sampled_turbulence.angular_velocity.data());
    keep(step_state.angular_acceleration, state.acceleration.data());
    keep(step_state.acceleration, state.acceleration.data() + 3);
    state.wake.formed = lane(step_state.wake.formed);
    keep(step_state.wake.heading, state.wake.heading.data());
}

/// The random numbers of one body.
struct OneDraw {
    const Noise& noise;
    std::uint64_t step;

#if SAMARA_PACKS_ONE_BODY
    [[nodiscard]] HWY_INLINE Packed three() const {
        const auto u = noise.uniforms(step, NoiseStream::sampled_turbulence);
        return packed_normals(u, u[0], u[1]).velocity;
    }
    [[nodiscard]] HWY_INLINE SixNormals<Spread> six() const {
        const auto u = noise.uniforms(step, NoiseStream::sampled_turbulence);
        const auto rest = noise.uniforms(step, NoiseStream::sampled_rotation);
        return packed_normals(u, rest[0], rest[1]);
    }

  private:
    /// Returns six_normals(), computed with the pairs side by side.
    static HWY_INLINE SixNormals<Spread> packed_normals(const std::array<double, 4>& first, double fifth,
                                                        double sixth) {
        using Pairs = Lanes<FourTag>;
        Pairs a;
        Pairs b;
        normal_pair(Pairs(FourLanes{_mm256_setr_pd(first[0], first[2], fifth, fifth)}),
                    Pairs(FourLanes{_mm256_setr_pd(first[1], first[3], sixth, sixth)}), a, b);
        const FourLanes low{_mm256_unpacklo_pd(a.raw.raw, b.raw.raw)};   // a0, b0, a2, b2
        const FourLanes high{_mm256_unpackhi_pd(a.raw.raw, b.raw.raw)};  // a1, b1
        return {Packed(blended<0b1100>(low, permuted<0b00'00'00'00>(high))),
                Packed(blended<0b0001>(permuted<0b00'11'10'00>(low), permuted<0b01'01'01'01>(high)))};
    }
#else
    [[nodiscard]] Triple<double> three() const {
        return three_normals(noise.uniforms(step, NoiseStream::sampled_turbulence));
    }
    [[nodiscard]] SixNormals<double> six() const {
        const std::array<double, 4> rest = noise.uniforms(step, NoiseStream::sampled_rotation);
        return six_normals(noise.uniforms(step, NoiseStream::sampled_turbulence), rest[0], rest[1]);
    }
#endif
};

BatchReport advance_double_blocks(const StepConstants& constants, const kernel::BlockSteps& steps,
                                  StateBlock* blocks, std::size_t count) {
    return advance_all(constants, steps, blocks, count);
}

/// Returns a host's wrench, or none.
HWY_INLINE Push<One> push_of_one(const Wrench* external) {
    if (external == nullptr) return {no_vector<One>(), no_vector<One>()};
    return {triple_of(external->moment), triple_of(external->force)};
}

void step_one(const StepConstants& c, const Vector3d& gravity, double h, const kernel::SampledStream& stream,
              int substep, int substeps, const Wrench* external, BodyState& state) {
    StepState<One> step_state = step_state_of(state);
    const Push<One> push = push_of_one(external);
    const Stream<One> whole{triple_of(stream.begin), triple_of(stream.end), triple_of(stream.rotation),
                            stream.on_loads_alone, triple_of(stream.wake_fluctuation)};
    implicit_step(c, triple_of(gravity), One(h), stream.moves, part_of(whole, substep, One(substeps)),
                  external == nullptr ? nullptr : &push, One(0.0), step_state);
    keep(step_state, state);
}

/// BegunStep in the step's numbers.
struct Beginning {
    int substeps;
    bool sees_fluid;
    Stream<One> stream;
};
HWY_INLINE Beginning beginning(const StepConstants& c, double h, const kernel::WindSource& source,
                               const Noise& noise, std::uint64_t step, StepState<One>& step_state) {
    Stream<One> wind = no_stream<One>();
    const bool windy = source.sample != nullptr;
    if (windy) {
        kernel::SampledWind sampled;
        const Vector3d place = vector_of(halfway(c, One(h), step_state));
        for (Eigen::Index axis = 0; axis < 3; ++axis) sampled.place[axis][0] = place[axis];
        source.sample(source.context, step, 1, sampled);
        const auto first = [](const double(&rows)[3][kernel::SampledWind::size])
                               HWY_ATTR { return triple_of(Vector3d(rows[0][0], rows[1][0], rows[2][0])); };
        wind = {first(sampled.begin), first(sampled.end), first(sampled.rotation), false, no_vector<One>()};
    }
    const Stream<One> stream =
        sample_fluid(c, One(h), windy, wind, OneDraw{noise, step}, One(1.0), step_state);
    const bool sees_fluid = windy || sees_turbulence(c);
    return {static_cast<int>(lane(substeps_of(c, One(h), sees_fluid, stream.begin, step_state))), sees_fluid,
            stream};
}

void begin_one(const StepConstants& c, double h, const kernel::WindSource& source, const Noise& noise,
               std::uint64_t step, BodyState& state, kernel::BegunStep& begun) {
    StepState<One> step_state = step_state_of(state);
    const Beginning b = beginning(c, h, source, noise, step, step_state);
    keep(step_state, state);
    begun = {b.substeps,
             {vector_of(b.stream.begin), vector_of(b.stream.end), vector_of(b.stream.rotation), b.sees_fluid,
              b.stream.on_loads_alone, vector_of(b.stream.wake_fluctuation)}};
}

void lone_steps(const StepConstants& c, const kernel::BlockSteps& task, const Noise& noise,
                const Wrench* external, BodyState& state, BatchReport& report) {
    StepState<One> step_state = step_state_of(state);
    const Push<One> push = push_of_one(external);
    for (std::uint64_t number = 0; number < task.steps; ++number) {
        const Beginning begun =
            beginning(c, task.time_step, task.wind, noise, task.first_step + number, step_state);
        const Triple<One> gravity = triple_of(task.gravities[number]);
        report.count(begun.substeps);
        // Most steps are whole: the rest need not wait for the division that decides it.
        const bool is_whole = begun.substeps == 1;
        const One h(is_whole ? task.time_step : task.time_step / begun.substeps);
        for (int i = 0; i < begun.substeps; ++i) {
            implicit_step(c, gravity, h, begun.sees_fluid,
                          is_whole ? begun.stream : part_of(begun.stream, i, One(begun.substeps)),
                          external == nullptr ? nullptr : &push, One(0.0), step_state);
        }
    }
    keep(step_state, state);
}

HWY_INLINE void keep_blocks(const StepConstants& c, const LoadBlocks<One>& blocks, Matrix6d& matrix) {
    const double moment = c.mass_scale * c.length;
    matrix.topLeftCorner<3, 3>() = moment * c.length * matrix_of(blocks.moment_by_rotation);
    matrix.topRightCorner<3, 3>() = moment * matrix_of(blocks.moment_by_velocity);
    matrix.bottomLeftCorner<3, 3>() = moment * matrix_of(blocks.force_by_rotation);
    matrix.bottomRightCorner<3, 3>() = c.mass_scale * matrix_of(blocks.force_by_velocity);
}

void loads_of_one(const StepConstants& c, const Vector6d& velocity, const Vector3d& sampled_rotation,
                  const Vector3d& wake_fluctuation, const WakeShares& shares, LoadMatrices& loads) {
    const Triple<One> angular = triple_of(velocity.data());
    const Triple<One> linear = One(c.inverse_length) * triple_of(velocity.data() + 3);
    const WakeShares there = c.wake_forms ? shares : WakeShares{};
    LoadBlocks<One> blocks =
        relative_load_blocks(c, angular - triple_of(sampled_rotation), linear, angular, One(there.moment));
    keep_blocks(c, blocks, loads.relative);
    add_transport(c, angular, linear, One(there.transport), blocks);
    if (c.has_side_pressure) {
        add_side_pressure(c, linear, One(c.inverse_length) * triple_of(wake_fluctuation), blocks);
    }
    keep_blocks(c, blocks, loads.whole);
}

void turbulence_of_one(const StepConstants& c, const Vector3d& velocity, TurbulenceLevel& result) {
    const Level<One> level = turbulence_level(c, One(c.inverse_length) * triple_of(velocity));
    result = {lane(level.turbulent_kinetic_energy), lane(level.dissipation_rate)};
}

void sampled_turbulence_of_one(const StepConstants& c, const TurbulenceLevel& level, double h,
                               const Noise& noise, std::uint64_t step, BodyState& state) {
    StepState<One> step_state = step_state_of(state);
    advance_sampled_turbulence(c,
                               Level<One>{One(level.turbulent_kinetic_energy), One(level.dissipation_rate)},
                               One(h), OneDraw{noise, step}.six(), step_state);
    keep(step_state, state);
}

void body_velocity_of_one(const StepConstants& c, const TurbulenceLevel& level, double h, const Noise& noise,
                          std::uint64_t step, BodyState& state) {
    StepState<One> step_state = step_state_of(state);
    advance_body_velocity(c, Level<One>{One(level.turbulent_kinetic_energy), One(level.dissipation_rate)},
                          One(h), OneDraw{noise, step}.six(), step_state);
    keep(step_state, state);
}

void one_normal_pair(double first, double second, double& a, double& b) {
    normal_pair(first, second, a, b);
}

}  // namespace samara::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace samara {

HWY_EXPORT(advance_double_blocks);
HWY_EXPORT(step_one);
HWY_EXPORT(begin_one);
HWY_EXPORT(lone_steps);
HWY_EXPORT(loads_of_one);
HWY_EXPORT(turbulence_of_one);
HWY_EXPORT(sampled_turbulence_of_one);
HWY_EXPORT(body_velocity_of_one);
HWY_EXPORT(one_normal_pair);

namespace kernel {

BatchReport advance_blocks(const StepConstants& constants, const BlockSteps& steps, StateBlock* blocks,
                           std::size_t count) noexcept {
    return HWY_DYNAMIC_DISPATCH(advance_double_blocks)(constants, steps, blocks, count);
}

void implicit_step(const StepConstants& constants, const Vector3d& gravity, double h,
                   const SampledStream& stream, int substep, int substeps, const Wrench* external,
                   BodyState& state) noexcept {
    HWY_DYNAMIC_DISPATCH(step_one)(constants, gravity, h, stream, substep, substeps, external, state);
}

BegunStep begin_step(const StepConstants& constants, double h, const WindSource& wind, const Noise& noise,
                     std::uint64_t step, BodyState& state) noexcept {
    BegunStep begun;
    HWY_DYNAMIC_DISPATCH(begin_one)(constants, h, wind, noise, step, state, begun);
    return begun;
}

BatchReport advance_one(const StepConstants& constants, const BlockSteps& steps, const Noise& noise,
                        const Wrench* external, BodyState& state) noexcept {
    BatchReport report;
    HWY_DYNAMIC_DISPATCH(lone_steps)(constants, steps, noise, external, state, report);
    return report;
}

LoadMatrices load_matrices(const StepConstants& constants, const Vector6d& velocity,
                           const Vector3d& sampled_rotation, const Vector3d& wake_fluctuation,
                           const WakeShares& shares) noexcept {
    LoadMatrices loads;
    HWY_DYNAMIC_DISPATCH(loads_of_one)
    (constants, velocity, sampled_rotation, wake_fluctuation, shares, loads);
    return loads;
}

TurbulenceLevel turbulence_level(const StepConstants& constants, const Vector3d& velocity) noexcept {
    TurbulenceLevel level;
    HWY_DYNAMIC_DISPATCH(turbulence_of_one)(constants, velocity, level);
    return level;
}

void advance_sampled_turbulence(const StepConstants& constants, const TurbulenceLevel& level, double h,
                                const Noise& noise, std::uint64_t step, BodyState& state) noexcept {
    HWY_DYNAMIC_DISPATCH(sampled_turbulence_of_one)(constants, level, h, noise, step, state);
}

void advance_body_velocity(const StepConstants& constants, const TurbulenceLevel& level, double h,
                           const Noise& noise, std::uint64_t step, BodyState& state) noexcept {
    HWY_DYNAMIC_DISPATCH(body_velocity_of_one)(constants, level, h, noise, step, state);
}

void normal_pair(double first, double second, double& a, double& b) noexcept {
    HWY_DYNAMIC_DISPATCH(one_normal_pair)(first, second, a, b);
}

}  // namespace kernel
}  // namespace samara
#endif
