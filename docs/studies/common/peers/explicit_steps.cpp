#include "peers/explicit_steps.hpp"

namespace samara::peers {
namespace {

/// Off the unit sphere the equations hold as well, but the body would grow: R(q) holds |q|^2.
MotionVector with_unit_quaternion(MotionVector motion) {
    motion.segment<4>(6).normalize();
    return motion;
}

}  // namespace

MotionVector euler_step(const EquationsOfMotion& equations, double time_step, const MotionVector& motion) {
    return with_unit_quaternion(motion + time_step * equations.rate(motion));
}

MotionVector runge_kutta_step(const EquationsOfMotion& equations, double time_step,
                              const MotionVector& motion) {
    const MotionVector first = equations.rate(motion);
    const MotionVector second = equations.rate(motion + 0.5 * time_step * first);
    const MotionVector third = equations.rate(motion + 0.5 * time_step * second);
    const MotionVector fourth = equations.rate(motion + time_step * third);
    return with_unit_quaternion(motion + time_step / 6.0 * (first + 2.0 * second + 2.0 * third + fourth));
}

}  // namespace samara::peers
