#pragma once

#include "support/reference_step.hpp"

namespace samara::peers {

/// One step (s) of Euler's explicit method on the body's equations.
MotionVector euler_step(const EquationsOfMotion& equations, double time_step, const MotionVector& motion);

/// One step (s) of the classical Runge-Kutta method of the fourth order.
MotionVector runge_kutta_step(const EquationsOfMotion& equations, double time_step,
                              const MotionVector& motion);

}  // namespace samara::peers
