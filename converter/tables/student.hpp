#pragma once

namespace samara {

/// By what a standard deviation that was estimated from `degrees` independent values is multiplied so that
/// twice it holds as many new values as two known standard deviations would: t/2, t the quantile of Student's
/// distribution with that many degrees of freedom at the probability that lies within two standard deviations
/// (95.45 %, two-sided). 7.0 for one, 2.3 for two, 1.14 for ten, towards 1 for many; 1 for none.
double student_widening(int degrees);

}  // namespace samara
