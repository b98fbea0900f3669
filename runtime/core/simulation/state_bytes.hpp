#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "samara/core/kernel/body_state.hpp"
#include "samara/core/physics/obstacle.hpp"
#include "samara/core/physics/pose.hpp"

namespace samara {

/// Gathers numbers as bytes, in the machine's order.
class StateWriter {
  public:
    template <typename Number>
    void write(const Number& value) {
        static_assert(std::is_arithmetic_v<Number>);
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    void write(const BodyState& state);
    void write(const Pose& pose);
    void write(const std::vector<ObstacleKey>& keys);
    [[nodiscard]] const std::string& bytes() const { return bytes_; }

  private:
    std::string bytes_;
};

/// Reads what StateWriter wrote. There must be as many bytes as are asked for, except for keys.
class StateReader {
  public:
    explicit StateReader(std::string_view bytes) : bytes_(bytes) {}
    template <typename Number>
    void read(Number& value) {
        static_assert(std::is_arithmetic_v<Number>);
        std::memcpy(&value, bytes_.data(), sizeof value);
        bytes_.remove_prefix(sizeof value);
    }
    void read(BodyState& state);
    void read(Pose& pose);
    /// Reads keys of an obstacle; false where the bytes hold none.
    [[nodiscard]] bool read(std::vector<ObstacleKey>& keys);
    /// Returns whether all bytes were read.
    [[nodiscard]] bool at_end() const { return bytes_.empty(); }

  private:
    std::string_view bytes_;
};

/// Returns whether the numbers are those of a state or pose: finite, the orientation of length one.
bool is_sound(const BodyState& state);
bool is_sound(const Pose& pose);

/// The bytes of a body state and a pose.
inline constexpr std::size_t body_state_bytes = 29 * sizeof(double) + sizeof(std::uint8_t);
inline constexpr std::size_t pose_bytes = 13 * sizeof(double);

/// Returns the bytes of the keys of an obstacle.
inline constexpr std::size_t keys_size(std::size_t keys) {
    return sizeof(std::uint64_t) + 8 * sizeof(double) * keys;
}

/// Returns the payload between a head (mark, version, byte order, size, fingerprint) and a hash of all before
/// it.
std::string sealed_state(std::string_view payload, std::string_view fingerprint);

/// Returns the bytes that sealed_state() adds.
std::size_t seal_size();

/// Returns the payload of sealed bytes. Throws SimulationError of a foreign state where they were not made by
/// sealed_state() with this fingerprint and at least this many bytes of payload, or were changed since.
std::string_view opened_state(std::string_view bytes, std::string_view fingerprint,
                              std::size_t least_payload);

}  // namespace samara
