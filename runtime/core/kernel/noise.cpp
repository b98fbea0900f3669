#include "samara/core/kernel/noise.hpp"

#include <Random123/philox.h>

#include "samara/core/kernel/kernel.hpp"

namespace samara {
namespace {

/// FNV-1a, 64 bits: spreads a body's name over the key.
std::uint64_t name_hash(std::string_view name) noexcept {
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const char letter : name) hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001b3U;
    return hash;
}

/// Returns the middle of one of the 2^32 equal parts of (0, 1): never 0 or 1.
double unit_interval(std::uint32_t bits) noexcept {
    return (bits + 0.5) * 0x1p-32;
}

}  // namespace

Noise::Noise(std::uint64_t seed, std::string_view body_name, std::uint32_t run, std::uint32_t copy) noexcept
    : run_(run), copy_(copy) {
    const std::uint64_t key = seed ^ name_hash(body_name);
    key_ = {static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32U)};
}

std::array<double, 4> Noise::uniforms(std::uint64_t step, NoiseStream stream) const noexcept {
    const r123::Philox4x32::ctr_type counter = {
        {static_cast<std::uint32_t>(step),
         static_cast<std::uint32_t>(step >> 32U) | (static_cast<std::uint32_t>(stream) << 16U), copy_, run_}};
    const r123::Philox4x32::key_type key = {{key_[0], key_[1]}};
    const auto bits = r123::Philox4x32{}(counter, key);
    return {unit_interval(bits[0]), unit_interval(bits[1]), unit_interval(bits[2]), unit_interval(bits[3])};
}

std::array<double, 4> Noise::normals(std::uint64_t step, NoiseStream stream) const noexcept {
    const std::array<double, 4> uniform = uniforms(step, stream);
    std::array<double, 4> normal{};
    kernel::normal_pair(uniform[0], uniform[1], normal[0], normal[1]);
    kernel::normal_pair(uniform[2], uniform[3], normal[2], normal[3]);
    return normal;
}

}  // namespace samara
