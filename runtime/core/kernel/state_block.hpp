#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "samara/core/kernel/body_state.hpp"

namespace samara {

/// The steps of bodies that are stepped together.
struct BatchReport {
    std::uint64_t implicit_steps = 0;  ///< over all bodies
    int most_substeps = 1;             ///< the most of any body in one step
    std::uint64_t steps_at_limit = 0;  ///< steps, over all bodies, with samara::most_substeps substeps
    bool wind_is_sound = true;         ///< false: a caller's wind gave a velocity that is not finite

    /// Counts one step of one body that was cut into `substeps`.
    void count(int substeps) noexcept {
        implicit_steps += static_cast<std::uint64_t>(substeps);
        most_substeps = std::max(most_substeps, substeps);
        steps_at_limit += substeps == samara::most_substeps ? 1 : 0;
    }
    void add(const BatchReport& other) noexcept {
        implicit_steps += other.implicit_steps;
        most_substeps = std::max(most_substeps, other.most_substeps);
        steps_at_limit += other.steps_at_limit;
        wind_is_sound = wind_is_sound && other.wind_is_sound;
    }
};

/// Up to 16 bodies that are stepped side by side: each field of their states is a row of lanes.
struct alignas(64) StateBlock {
    static constexpr std::size_t size = 16;
    static constexpr std::size_t fields = 29;

    /// Position, orientation (w, x, y, z), angular velocity, velocity, sampled velocity, sampled rotation,
    /// acceleration (angular, linear), formed wake, heading.
    double numbers[fields][size];
    /// The size of each body relative to the shape's. The numbers of a body of another size are those of the
    /// shape's own motion that is similar (body_size.hpp).
    double size_of[size];
    std::uint32_t noise[4][size];    ///< key (2), copy, run
    std::uint32_t at_rest[size];     ///< 0 or 1
    std::uint64_t bodies;            ///< lanes in use
    std::uint64_t first_body;        ///< number in the batch of lane 0
    std::uint64_t first_step[size];  ///< before it the body waits in its place
    std::uint64_t last_start;        ///< the largest of them
};

inline BodyState state_of(const StateBlock& block, std::size_t lane) noexcept {
    const auto number = [&](std::size_t i) { return block.numbers[i][lane]; };
    BodyState state;
    state.position = {number(0), number(1), number(2)};
    state.orientation = Quaterniond(number(3), number(4), number(5), number(6));
    for (std::size_t i = 0; i < 6; ++i) state.velocity[static_cast<Eigen::Index>(i)] = number(7 + i);
    state.sampled_turbulence.velocity = {number(13), number(14), number(15)};
    state.sampled_turbulence.angular_velocity = {number(16), number(17), number(18)};
    for (std::size_t i = 0; i < 6; ++i) state.acceleration[static_cast<Eigen::Index>(i)] = number(19 + i);
    state.wake = {number(25), {number(26), number(27), number(28)}};
    state.at_rest = block.at_rest[lane] != 0;
    return state;
}

inline void keep_state(const BodyState& state, StateBlock& block, std::size_t lane) noexcept {
    const auto keep = [&](std::size_t i, double number) { block.numbers[i][lane] = number; };
    const Quaterniond& q = state.orientation;
    keep(3, q.w());
    keep(4, q.x());
    keep(5, q.y());
    keep(6, q.z());
    for (std::size_t i = 0; i < 3; ++i) {
        const auto axis = static_cast<Eigen::Index>(i);
        keep(i, state.position[axis]);
        keep(7 + i, state.velocity[axis]);
        keep(10 + i, state.velocity[axis + 3]);
        keep(13 + i, state.sampled_turbulence.velocity[axis]);
        keep(16 + i, state.sampled_turbulence.angular_velocity[axis]);
        keep(19 + i, state.acceleration[axis]);
        keep(22 + i, state.acceleration[axis + 3]);
        keep(26 + i, state.wake.heading[axis]);
    }
    keep(25, state.wake.formed);
    block.at_rest[lane] = state.at_rest ? 1 : 0;
}

/// Returns whether a body samples no turbulence.
inline bool is_still(const StateBlock& block, std::size_t lane) noexcept {
    return std::all_of(block.numbers + 13, block.numbers + 19,
                       [&](const double(&row)[StateBlock::size]) { return row[lane] == 0.0; });
}

}  // namespace samara
