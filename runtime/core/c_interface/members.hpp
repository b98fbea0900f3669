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

// Members of a caller's structs, checked. Each throws Fault of SAMARA_INVALID_ARGUMENT that names the member.

namespace samara {

/// Throws that fault: the member, and why it is refused.
[[noreturn]] void reject(const std::string& member, const std::string& why);

/// Throws that fault where a rule is broken.
void require_rules(const std::optional<BrokenRule>& broken);

/// The number, where it is finite and not beyond any unit's.
double finite(double value, const char* member);

/// Three finite numbers.
Vector3d vector(const double (&values)[3], const char* member);

/// Copies three numbers into a caller's struct.
inline void copy(const Vector3d& from, double (&to)[3]) {
    std::memcpy(to, from.data(), sizeof to);
}

/// A turn given as (w, x, y, z), made one of length one.
Quaterniond orientation(const double (&values)[4], const char* member);

/// A name that can stand in files of all kinds.
std::string plain_name(const char* name, const char* member);

/// One of the values of an enumeration from 0 to `last`.
template <typename Choice>
Choice choice(std::int32_t value, std::int32_t last, const char* member) {
    if (value < 0 || value > last) reject(member, fmt::format("is {}, which names nothing", value));
    return static_cast<Choice>(value);
}

/// The caller's struct as far as it goes, over the defaults of what it lacks.
template <typename Struct>
Struct known_part(const Struct& given, Struct defaults, std::size_t first_size, const char* name) {
    if (given.size < first_size || given.size > sizeof(Struct)) {
        throw StatusError(
            SAMARA_INVALID_ARGUMENT,
            fmt::format("{0}.size is {1}, but this library knows {2} to {3} bytes; fill the struct with "
                        "samara_default_{0}, and use a library as new as samara.h",
                        name, given.size, first_size, sizeof(Struct)));
    }
    std::memcpy(&defaults, &given, given.size);
    return defaults;
}

/// Fills as much of a caller's struct as the caller knows.
template <typename Struct>
void fill(Struct* target, std::size_t size, const Struct& defaults, const char* name) {
    require(target, name);
    if (size < sizeof(std::size_t) || size > sizeof(Struct)) {
        throw StatusError(
            SAMARA_INVALID_ARGUMENT,
            fmt::format("size is {}, but this library knows {} bytes of the {}; give sizeof, and use a "
                        "library as new as samara.h",
                        size, sizeof(Struct), name));
    }
    Struct filled = defaults;
    filled.size = size;
    std::memcpy(target, &filled, size);
}

}  // namespace samara
