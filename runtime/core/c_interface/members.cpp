#include "samara/core/c_interface/members.hpp"

#include <algorithm>
#include <cmath>

#include "samara/core/base/numbers.hpp"
#include "samara/core/base/text.hpp"

namespace samara {

void reject(const std::string& member, const std::string& why) {
    throw StatusError(SAMARA_INVALID_ARGUMENT, fmt::format("{} {}", member, why));
}

void require_rules(const std::optional<BrokenRule>& broken) {
    if (!broken) return;
    std::string member = broken->member;
    if (member == "spread.size") reject("smallest_size and largest_size", broken->what);
    if (member == "fluid.gust.period") member = "gust.period";
    std::ranges::replace(member, '.', '_');
    reject(member, broken->what);
}

double finite(double value, const char* member) {
    if (!std::isfinite(value)) reject(member, "is not a finite number");
    if (std::abs(value) > largest_number) {
        reject(member, fmt::format("is {}, beyond {:.0e}; check the unit", value, largest_number));
    }
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
    if (!is_plain_name(name)) reject(member, std::string(plain_name_words));
    return name;
}

}  // namespace samara
