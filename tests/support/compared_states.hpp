#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "samara/core/integrator/batch.hpp"
#include "samara/core/integrator/step.hpp"
#include "samara/core/physics/pose.hpp"

namespace samara::test {

/// Returns all numbers of a state.
inline std::array<double, 29> numbers_of(const BodyState& state) {
    std::array<double, 29> numbers{};
    std::size_t next = 0;
    const auto add = [&](const auto& part) {
        for (const double number : part) numbers[next++] = number;
    };
    add(state.position);
    add(state.orientation.coeffs());
    add(state.velocity);
    add(state.sampled_turbulence.velocity);
    add(state.sampled_turbulence.angular_velocity);
    add(state.acceleration);
    numbers[next++] = state.wake.formed;
    add(state.wake.heading);
    return numbers;
}

/// Returns the distance (m) between the motions of a body that reaches 5 cm: of its place and rotation, and
/// of the change of both in 0.1 s by the difference of the velocities.
inline double distance(const BodyState& a, const BodyState& b) {
    return (a.position - b.position).norm() + 0.05 * a.orientation.angularDistance(b.orientation) +
           0.1 * (a.velocity.tail<3>() - b.velocity.tail<3>()).norm() +
           0.005 * (a.velocity.head<3>() - b.velocity.head<3>()).norm();
}

/// Returns whether all numbers of two poses are equal.
inline bool same(const Pose& a, const Pose& b) {
    return a.position == b.position && a.orientation.coeffs() == b.orientation.coeffs() &&
           a.velocity == b.velocity && a.angular_velocity == b.angular_velocity;
}

/// Expects of a batch without noise that its bodies, over 100 steps of 0.01 s in calls of five, move as each
/// does alone, to the last bit.
inline void expect_batch_as_alone(const ImmersedBody& body, const Surroundings& surroundings,
                                  std::vector<BodyState> alone, int threads) {
    constexpr double step = 0.01;
    Batch batch(body, alone.size());
    for (std::size_t i = 0; i < alone.size(); ++i) batch.set_state(i, alone[i]);
    const Noise noise(0, "", 0, 0);
    for (std::uint64_t call = 0; call < 20; ++call) {
        batch.advance(surroundings, 0.0, step, 5 * call, 5, threads);
        for (std::size_t i = 0; i < alone.size(); ++i) {
            for (std::uint64_t k = 0; k < 5; ++k) {
                alone[i] = advance(body, surroundings, 0.0, step, alone[i], noise, 5 * call + k).state;
            }
            ASSERT_EQ(batch.state(i).position, alone[i].position) << i << " at call " << call;
            ASSERT_EQ(batch.state(i).velocity, alone[i].velocity) << i << " at call " << call;
        }
    }
}

}  // namespace samara::test
