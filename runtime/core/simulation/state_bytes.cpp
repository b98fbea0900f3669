#include "samara/core/simulation/state_bytes.hpp"

#include <cmath>

#include <fmt/format.h>

#include "samara/core/files/content_hash.hpp"
#include "samara/core/simulation/simulation.hpp"

namespace samara {
namespace {

constexpr std::string_view mark = "samara state\n\x1a";
constexpr std::uint32_t state_version = 8;
constexpr std::uint32_t byte_order = 0x01020304;
constexpr std::size_t hash_size = 32;  // of content_hash

// A new member would be lost: write it, and raise state_version.
static_assert(sizeof(BodyState) == 256 && sizeof(SampledTurbulence) == 48);

[[noreturn]] void reject(const std::string& why) {
    throw SimulationError(SimulationError::Reason::foreign_state, why);
}

bool is_unit(const Quaterniond& orientation) {
    return std::abs(orientation.norm() - 1.0) <= 1e-6;
}

/// Calls visit(coefficient) for each number.
template <typename State, typename Visit>
void visit_state(State& state, const Visit& visit) {
    for (auto& number : state.position) visit(number);
    for (auto& number : state.orientation.coeffs()) visit(number);
    for (auto& number : state.velocity) visit(number);
    for (auto& number : state.sampled_turbulence.velocity) visit(number);
    for (auto& number : state.sampled_turbulence.angular_velocity) visit(number);
    for (auto& number : state.acceleration) visit(number);
    visit(state.wake.formed);
    for (auto& number : state.wake.heading) visit(number);
}

template <typename AnyPose, typename Visit>
void visit_pose(AnyPose& pose, const Visit& visit) {
    for (auto& number : pose.position) visit(number);
    for (auto& number : pose.orientation.coeffs()) visit(number);
    for (auto& number : pose.velocity) visit(number);
    for (auto& number : pose.angular_velocity) visit(number);
}

template <typename Key, typename Visit>
void visit_key(Key& key, const Visit& visit) {
    visit(key.time);
    for (auto& number : key.position) visit(number);
    for (auto& number : key.orientation.coeffs()) visit(number);
}

bool is_sound(const Wake& wake) {
    return wake.formed >= -1e-6 && wake.formed <= 1.0 + 1e-6 && wake.heading.norm() <= 1.0 + 1e-6;
}

}  // namespace

bool is_sound(const BodyState& state) {
    return state.position.allFinite() && is_unit(state.orientation) && state.velocity.allFinite() &&
           state.sampled_turbulence.velocity.allFinite() &&
           state.sampled_turbulence.angular_velocity.allFinite() && state.acceleration.allFinite() &&
           is_sound(state.wake);
}

bool is_sound(const Pose& pose) {
    return pose.position.allFinite() && is_unit(pose.orientation) && pose.velocity.allFinite() &&
           pose.angular_velocity.allFinite();
}

void StateWriter::write(const BodyState& state) {
    visit_state(state, [&](double number) { write(number); });
    write(static_cast<std::uint8_t>(state.at_rest));
}

void StateWriter::write(const Pose& pose) {
    visit_pose(pose, [&](double number) { write(number); });
}

void StateReader::read(BodyState& state) {
    visit_state(state, [&](double& number) { read(number); });
    std::uint8_t at_rest = 0;
    read(at_rest);
    state.at_rest = at_rest != 0;
}

void StateReader::read(Pose& pose) {
    visit_pose(pose, [&](double& number) { read(number); });
}

void StateWriter::write(const std::vector<ObstacleKey>& keys) {
    write(static_cast<std::uint64_t>(keys.size()));
    for (const ObstacleKey& key : keys) visit_key(key, [&](double number) { write(number); });
}

bool StateReader::read(std::vector<ObstacleKey>& keys) {
    if (bytes_.size() < keys_size(1)) return false;
    std::uint64_t count = 0;
    read(count);
    if (count < 1 || count > bytes_.size() / (keys_size(1) - keys_size(0))) return false;
    keys.resize(static_cast<std::size_t>(count));
    for (ObstacleKey& key : keys) visit_key(key, [&](double& number) { read(number); });
    return true;
}

std::size_t seal_size() {
    return mark.size() + 2 * sizeof(std::uint32_t) + sizeof(std::uint64_t) + 2 * hash_size;
}

std::string sealed_state(std::string_view payload, std::string_view fingerprint) {
    StateWriter numbers;
    numbers.write(state_version);
    numbers.write(byte_order);
    numbers.write(static_cast<std::uint64_t>(payload.size()));
    std::string bytes;
    bytes.reserve(payload.size() + seal_size());
    bytes.append(mark).append(numbers.bytes()).append(content_hash(fingerprint)).append(payload);
    return bytes.append(content_hash(bytes));
}

std::string_view opened_state(std::string_view bytes, std::string_view fingerprint,
                              std::size_t least_payload) {
    if (bytes.substr(0, mark.size()) != mark) reject("the bytes are not a state of a simulation");
    if (bytes.size() < seal_size()) reject("the state is truncated");
    StateReader numbers(bytes.substr(mark.size()));
    std::uint32_t version = 0;
    std::uint32_t order = 0;
    std::uint64_t size = 0;
    numbers.read(version);
    numbers.read(order);
    numbers.read(size);
    if (order != byte_order) reject("the state is from a machine with another byte order");
    if (version != state_version) {
        reject(fmt::format("the state has version {}, but this library reads {}; save it again", version,
                           state_version));
    }
    if (bytes.size() - seal_size() != size) {
        reject(fmt::format("the state should have {} bytes, but has {}", size + seal_size(), bytes.size()));
    }
    const std::string_view whole = bytes.substr(0, bytes.size() - hash_size);
    if (content_hash(whole) != bytes.substr(whole.size())) reject("the state is damaged");
    const std::size_t head = seal_size() - 2 * hash_size;
    if (size < least_payload || content_hash(fingerprint) != bytes.substr(head, hash_size)) {
        reject(
            "the state belongs to a simulation with other settings, body groups or bodies; restore it into "
            "an equal simulation");
    }
    return whole.substr(head + hash_size);
}

}  // namespace samara
