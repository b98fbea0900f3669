#include "samara/core/c_interface/members.hpp"

#include <cmath>

#include "samara/core/base/numbers.hpp"
#include "samara/core/base/text.hpp"

namespace samara {

void reject(const char* member, const std::string& why) {
    throw StatusError(SAMARA_INVALID_ARGUMENT, fmt::format("{} {}", member, why));
}

double finite(double value, const char* member) {
    if (!std::isfinite(value)) reject(member, "is not a finite number");
    if (std::abs(value) > largest_number) {
        reject(member, fmt::format("is {}, beyond {:.0e}; is a unit wrong?", value, largest_number));
    }
    return value;
}

double non_negative(double value, const char* member) {
    if (finite(value, member) < 0.0) reject(member, "must not be negative");
    if (value > 0.0 && value < smallest_number) {
        reject(member, fmt::format("is {}, below {:.0e}; is a unit wrong?", value, smallest_number));
    }
    return value;
}

double positive(double value, const char* member) {
    if (!(non_negative(value, member) > 0.0)) reject(member, "must be above zero");
    return value;
}

Vector3d vector(const double (&values)[3], const char* member) {
    for (const double value : values) finite(value, member);
    return {values[0], values[1], values[2]};
}

Quaterniond orientation(const double (&values)[4], const char* member) {
    for (const double value : values) finite(value, member);
    const Quaterniond turn(values[0], values[1], values[2], values[3]);
    if (!(turn.norm() >= 1e-6)) reject(member, "must be a quaternion that is not zero");
    return turn.normalized();
}

std::string plain_name(const char* name, const char* member) {
    if (!is_plain_name(name)) reject(member, "may hold letters, digits, '-' and '_' alone, 64 at most");
    return name;
}

}  // namespace samara
