#pragma once

#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/kernel/flight_constants.hpp"

namespace samara {

/// Works out what the step needs of a body.
template <class Real>
FlightConstants<Real> flight_constants(const ImmersedBody& body);

extern template FlightConstants<float> flight_constants<float>(const ImmersedBody&);
extern template FlightConstants<double> flight_constants<double>(const ImmersedBody&);

}  // namespace samara
