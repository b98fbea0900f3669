#include "samara/core/kernel/noise.hpp"

#include <cmath>

#include <Random123/philox.h>
#include <gtest/gtest.h>

namespace samara {
namespace {

TEST(Noise, PhiloxGivesItsKnownAnswer) {
    // The known-answer file kat_vectors of Random123: philox4x32, 10 rounds, counter and key zero.
    const auto bits = r123::Philox4x32{}({{0, 0, 0, 0}}, {{0, 0}});
    EXPECT_EQ(bits[0], 0x6627e8d5U);
    EXPECT_EQ(bits[1], 0xe169c58dU);
    EXPECT_EQ(bits[2], 0xbc57ac4cU);
    EXPECT_EQ(bits[3], 0x9b00dbd8U);
}

TEST(Noise, EverythingInTheKeyChangesTheNumbers) {
    const auto base = Noise(1, "a", 0, 0).normals(5, NoiseStream::sampled_turbulence);
    EXPECT_EQ(base, Noise(1, "a", 0, 0).normals(5, NoiseStream::sampled_turbulence));
    EXPECT_NE(base, Noise(2, "a", 0, 0).normals(5, NoiseStream::sampled_turbulence));
    EXPECT_NE(base, Noise(1, "b", 0, 0).normals(5, NoiseStream::sampled_turbulence));
    EXPECT_NE(base, Noise(1, "a", 1, 0).normals(5, NoiseStream::sampled_turbulence));
    EXPECT_NE(base, Noise(1, "a", 0, 1).normals(5, NoiseStream::sampled_turbulence));
    EXPECT_NE(base, Noise(1, "a", 0, 0).normals(6, NoiseStream::sampled_turbulence));
    EXPECT_NE(base, Noise(1, "a", 0, 0).normals(5, NoiseStream::sampled_rotation));
    EXPECT_NE(base,
              Noise(1, "a", 0, 0).normals(5 + (std::uint64_t{1} << 32U), NoiseStream::sampled_turbulence));
}

TEST(Noise, NormalsHaveTheMomentsOfTheNormalDistribution) {
    const Noise noise(7, "moments", 0, 0);
    constexpr int draws = 50'000;
    double moments[5] = {};
    for (int step = 0; step < draws; ++step) {
        for (const double value :
             noise.normals(static_cast<std::uint64_t>(step), NoiseStream::sampled_turbulence)) {
            double power = 1.0;
            for (double& moment : moments) {
                moment += power / (4.0 * draws);
                power *= value;
            }
        }
    }
    // Five standard errors of 200,000 numbers each.
    EXPECT_NEAR(moments[1], 0.0, 5.0 * std::sqrt(1.0 / 200'000));
    EXPECT_NEAR(moments[2], 1.0, 5.0 * std::sqrt(2.0 / 200'000));
    EXPECT_NEAR(moments[3], 0.0, 5.0 * std::sqrt(15.0 / 200'000));
    EXPECT_NEAR(moments[4], 3.0, 5.0 * std::sqrt(96.0 / 200'000));
}

}  // namespace
}  // namespace samara
