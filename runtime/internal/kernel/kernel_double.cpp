#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "internal/kernel/kernel_double.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again for each target.
#include <hwy/highway.h>

#include "internal/kernel/blocks-inl.h"
#include "internal/kernel/kernel.hpp"

HWY_BEFORE_NAMESPACE();
namespace samara::HWY_NAMESPACE {

HWY_INLINE Triple<double> triple_of(const Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}
HWY_INLINE Vector3d vector_of(const Triple<double>& t) {
    return {t.x, t.y, t.z};
}

HWY_INLINE Flight<double> flight_of(const BodyState& state) {
    const Quaterniond& q = state.orientation;
    return {triple_of(state.position),
            {q.w(), {q.x(), q.y(), q.z()}},
            triple_of(state.velocity.head<3>()),
            triple_of(state.velocity.tail<3>()),
            triple_of(state.seen_fluid.velocity),
            triple_of(state.seen_fluid.angular_velocity),
            triple_of(state.acceleration.head<3>()),
            triple_of(state.acceleration.tail<3>())};
}
HWY_INLINE void keep(const Flight<double>& flight, BodyState& state) {
    const Turn<double>& q = flight.orientation;
    state.position = vector_of(flight.position);
    state.orientation = Quaterniond(q.w, q.v.x, q.v.y, q.v.z);
    state.velocity << vector_of(flight.angular_velocity), vector_of(flight.velocity);
    state.seen_fluid = {vector_of(flight.seen_velocity), vector_of(flight.seen_rotation)};
    state.acceleration << vector_of(flight.angular_acceleration), vector_of(flight.acceleration);
}

HWY_INLINE SixNormals<double> normals_at(const Noise& noise, std::uint64_t step) {
    const std::array<double, 4> a = noise.uniforms(step, NoiseStream::seen_fluid);
    const std::array<double, 4> b = noise.uniforms(step, NoiseStream::seen_rotation);
    return six_normals<double>(a, b[0], b[1]);
}

BatchReport advance_double_blocks(const FlightConstants<double>& constants, const kernel::BlockSteps& steps,
                                  FlightBlock<double>* blocks, std::size_t count) {
    return advance_all(constants, steps, blocks, count);
}

void step_one(const FlightConstants<double>& c, const Vector3d& gravity, double h,
              const kernel::SeenStream& stream, int part, int parts, const Wrench* external,
              BodyState& state) {
    Flight<double> flight = flight_of(state);
    Push<double> push{};
    if (external != nullptr) push = {triple_of(external->moment), triple_of(external->force)};
    const Stream<double> whole{triple_of(stream.begin), triple_of(stream.end), triple_of(stream.rotation)};
    implicit_step(c, triple_of(gravity), h, stream.moves, part_of(whole, part, static_cast<double>(parts)),
                  external == nullptr ? nullptr : &push, flight);
    keep(flight, state);
}

void begin_one(const FlightConstants<double>& c, double h, const kernel::WindSource& source,
               const Noise& noise, std::uint64_t step, BodyState& state, kernel::BegunStep& begun) {
    Flight<double> flight = flight_of(state);
    Stream<double> wind = no_stream<double>();
    if (source.meet != nullptr) {
        kernel::MetWind met;
        const Triple<double> place = halfway(c, h, flight);
        met.place[0][0] = place.x;
        met.place[1][0] = place.y;
        met.place[2][0] = place.z;
        source.meet(source.context, step, 1, met);
        const auto first = [](const double(&rows)[3][kernel::MetWind::size]) {
            return Triple<double>{rows[0][0], rows[1][0], rows[2][0]};
        };
        wind = {first(met.begin), first(met.end), first(met.rotation)};
    }
    const bool windy = source.meet != nullptr;
    const Stream<double> stream = meet_fluid(
        c, h, windy, wind, [&] { return normals_at(noise, step); }, 1.0, flight);
    keep(flight, state);
    const bool sees_fluid = windy || sees_turbulence(c);
    begun = {static_cast<int>(substeps_of(c, h, sees_fluid, stream.begin, flight)),
             {vector_of(stream.begin), vector_of(stream.end), vector_of(stream.rotation), sees_fluid}};
}

HWY_INLINE void keep_blocks(const FlightConstants<double>& c, const LoadBlocks<double>& blocks,
                            Matrix6d& matrix) {
    const auto keep_block = [&](const Square<double>& block, Eigen::Index row, Eigen::Index column,
                                double scale) {
        matrix.block<3, 3>(row, column) << block.x.x, block.x.y, block.x.z, block.y.x, block.y.y, block.y.z,
            block.z.x, block.z.y, block.z.z;
        matrix.block<3, 3>(row, column) *= scale;
    };
    const double moment = c.mass_scale * c.length;
    keep_block(blocks.moment_by_turning, 0, 0, moment * c.length);
    keep_block(blocks.moment_by_velocity, 0, 3, moment);
    keep_block(blocks.force_by_turning, 3, 0, moment);
    keep_block(blocks.force_by_velocity, 3, 3, c.mass_scale);
}

void loads_of_one(const FlightConstants<double>& c, const Vector6d& velocity, const Vector3d& seen_rotation,
                  LoadMatrices& loads) {
    const Triple<double> turning = triple_of(velocity.head<3>());
    const Triple<double> moving = c.inverse_length * triple_of(velocity.tail<3>());
    LoadBlocks<double> blocks = relative_load_blocks(c, turning - triple_of(seen_rotation), moving, turning);
    keep_blocks(c, blocks, loads.relative);
    add_transports(c, turning, moving, blocks);
    keep_blocks(c, blocks, loads.whole);
}

void turbulence_of_one(const FlightConstants<double>& c, const Vector3d& velocity, TurbulenceLevel& result) {
    const Level<double> level = turbulence_level(c, c.inverse_length * triple_of(velocity));
    result = {level.turbulent_kinetic_energy, level.dissipation_rate};
}

void seen_fluid_of_one(const FlightConstants<double>& c, const TurbulenceLevel& level, double h,
                       const Noise& noise, std::uint64_t step, BodyState& state) {
    Flight<double> flight = flight_of(state);
    advance_seen_fluid(c, Level<double>{level.turbulent_kinetic_energy, level.dissipation_rate}, h,
                       normals_at(noise, step), flight);
    keep(flight, state);
}

void body_velocity_of_one(const FlightConstants<double>& c, const TurbulenceLevel& level, double h,
                          const Noise& noise, std::uint64_t step, BodyState& state) {
    Flight<double> flight = flight_of(state);
    advance_body_velocity(c, Level<double>{level.turbulent_kinetic_energy, level.dissipation_rate}, h,
                          normals_at(noise, step), flight);
    keep(flight, state);
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
HWY_EXPORT(loads_of_one);
HWY_EXPORT(turbulence_of_one);
HWY_EXPORT(seen_fluid_of_one);
HWY_EXPORT(body_velocity_of_one);
HWY_EXPORT(one_normal_pair);

namespace kernel {

BatchReport advance_blocks(const FlightConstants<double>& constants, const BlockSteps& steps,
                           FlightBlock<double>* blocks, std::size_t count) noexcept {
    return HWY_DYNAMIC_DISPATCH(advance_double_blocks)(constants, steps, blocks, count);
}

void implicit_step(const FlightConstants<double>& constants, const Vector3d& gravity, double h,
                   const SeenStream& stream, int part, int parts, const Wrench* external,
                   BodyState& state) noexcept {
    HWY_DYNAMIC_DISPATCH(step_one)(constants, gravity, h, stream, part, parts, external, state);
}

BegunStep begin_step(const FlightConstants<double>& constants, double h, const WindSource& wind,
                     const Noise& noise, std::uint64_t step, BodyState& state) noexcept {
    BegunStep begun;
    HWY_DYNAMIC_DISPATCH(begin_one)(constants, h, wind, noise, step, state, begun);
    return begun;
}

LoadMatrices load_matrices(const FlightConstants<double>& constants, const Vector6d& velocity,
                           const Vector3d& seen_rotation) noexcept {
    LoadMatrices loads;
    HWY_DYNAMIC_DISPATCH(loads_of_one)(constants, velocity, seen_rotation, loads);
    return loads;
}

TurbulenceLevel turbulence_level(const FlightConstants<double>& constants,
                                 const Vector3d& velocity) noexcept {
    TurbulenceLevel level;
    HWY_DYNAMIC_DISPATCH(turbulence_of_one)(constants, velocity, level);
    return level;
}

void advance_seen_fluid(const FlightConstants<double>& constants, const TurbulenceLevel& level, double h,
                        const Noise& noise, std::uint64_t step, BodyState& state) noexcept {
    HWY_DYNAMIC_DISPATCH(seen_fluid_of_one)(constants, level, h, noise, step, state);
}

void advance_body_velocity(const FlightConstants<double>& constants, const TurbulenceLevel& level, double h,
                           const Noise& noise, std::uint64_t step, BodyState& state) noexcept {
    HWY_DYNAMIC_DISPATCH(body_velocity_of_one)(constants, level, h, noise, step, state);
}

void normal_pair(double first, double second, double& a, double& b) noexcept {
    HWY_DYNAMIC_DISPATCH(one_normal_pair)(first, second, a, b);
}

}  // namespace kernel
}  // namespace samara
#endif
