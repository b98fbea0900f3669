#include "samara/motion/pose.hpp"

namespace samara {

Pose interpolated(const Pose& before, const Pose& after, double fraction, double duration) {
    const double s = fraction;
    const double r = 1.0 - s;
    return {.position = r * r * (1.0 + 2.0 * s) * before.position + s * s * (3.0 - 2.0 * s) * after.position +
                        s * r * r * duration * before.velocity - s * s * r * duration * after.velocity,
            .orientation = before.orientation.slerp(s, after.orientation),
            .velocity = r * before.velocity + s * after.velocity,
            .angular_velocity = r * before.angular_velocity + s * after.angular_velocity};
}

void keep_sign_continuous(Quaterniond& orientation, const Quaterniond& before) {
    if (orientation.dot(before) < 0.0) orientation.coeffs() = -orientation.coeffs();
}

}  // namespace samara
