#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace samara {

/// The purpose of a random number: numbers of different streams are independent.
enum class NoiseStream : std::uint16_t {
    sampled_turbulence = 0,
    sampled_rotation = 1,
    start_position = 2,
    start_angle = 3,
    table_error = 4,
    gust_wave = 5,
    gust_direction = 6,
    start_size_and_time = 7,
    start_emission = 8
};

/// A counter-based source of random numbers for one copy of a body in one run: the numbers depend on (seed,
/// body's name, run, copy, step, stream) alone, not on the order of calls, threads or bodies. Philox4x32-10:
/// Salmon, Moraes, Dror, Shaw, Parallel random numbers: as easy as 1, 2, 3, SC11.
class Noise {
  public:
    Noise(std::uint64_t seed, std::string_view body_name, std::uint32_t run, std::uint32_t copy) noexcept;

    /// Returns four independent standard normal numbers (Box-Muller).
    [[nodiscard]] std::array<double, 4> normals(std::uint64_t step, NoiseStream stream) const noexcept;
    /// Returns four independent numbers, uniform in (0, 1).
    [[nodiscard]] std::array<double, 4> uniforms(std::uint64_t step, NoiseStream stream) const noexcept;

    /// Makes the source with these words().
    explicit Noise(const std::array<std::uint32_t, 4>& words) noexcept
        : key_{words[0], words[1]}, run_(words[3]), copy_(words[2]) {}

    /// Returns the identity of the source: the key (two words), the copy and the run.
    [[nodiscard]] std::array<std::uint32_t, 4> words() const noexcept {
        return {key_[0], key_[1], copy_, run_};
    }

  private:
    std::array<std::uint32_t, 2> key_;
    std::uint32_t run_;
    std::uint32_t copy_;
};

}  // namespace samara
