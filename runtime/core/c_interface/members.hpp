#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/c_interface/guard.hpp"
#include "samara/core/physics/broken_rule.hpp"

// Checks of the members of a caller's structs. Each throws StatusError of SAMARA_INVALID_ARGUMENT that names
// the member.

namespace samara {

/// Throws StatusError of SAMARA_INVALID_ARGUMENT: the member, and why it is rejected.
[[noreturn]] void reject(const std::string& member, const std::string& why);

/// Throws StatusError of SAMARA_INVALID_ARGUMENT where a rule is broken.
void require_rules(const std::optional<BrokenRule>& broken);

/// Returns the number, which must be finite and within largest_number.
double finite(double value, const char* member);

/// Returns three finite numbers as a vector.
Vector3d vector(const double (&values)[3], const char* member);

/// Copies three numbers into a caller's struct.
inline void copy(const Vector3d& from, double (&to)[3]) {
    std::memcpy(to, from.data(), sizeof to);
}

/// Returns an orientation given as (w, x, y, z), normalised.
Quaterniond orientation(const double (&values)[4], const char* member);

/// Returns a name that may stand in files of all formats.
std::string plain_name(const char* name, const char* member);

/// Returns one of the values of an enumeration from 0 to `last`.
template <typename Choice>
Choice choice(std::int32_t value, std::int32_t last, const char* member) {
    if (value < 0 || value > last) reject(member, fmt::format("is {}, which is not a valid value", value));
    return static_cast<Choice>(value);
}

/// Returns the caller's struct, with defaults for the members that it lacks.
template <typename Struct>
Struct known_part(const Struct& given, Struct defaults, std::size_t first_size, const char* name) {
    if (given.size < first_size || given.size > sizeof(Struct)) {
        throw StatusError(SAMARA_INVALID_ARGUMENT,
                          fmt::format("{0}.size is {1}, but this library supports {2} to {3} bytes; fill the "
                                      "struct with samara_default_{0}, and use a library as new as samara.h",
                                      name, given.size, first_size, sizeof(Struct)));
    }
    std::memcpy(&defaults, &given, given.size);
    return defaults;
}

/// Fills the members of a caller's struct that the caller knows.
template <typename Struct>
void fill(Struct* target, std::size_t size, const Struct& defaults, const char* name) {
    require(target, name);
    if (size < sizeof(std::size_t) || size > sizeof(Struct)) {
        throw StatusError(SAMARA_INVALID_ARGUMENT,
                          fmt::format("size is {}, but this library supports {} bytes for the {}; give "
                                      "sizeof, and use a library as new as samara.h",
                                      size, sizeof(Struct), name));
    }
    Struct filled = defaults;
    filled.size = size;
    std::memcpy(target, &filled, size);
}

}  // namespace samara
