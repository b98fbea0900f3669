#pragma once

#include "converter/falls/fall_record.hpp"
#include "samara/core/body/body.hpp"
#include "samara/core/integrator/step.hpp"

namespace samara::test {

/// The rubber ellipsoid (known_bodies.hpp) with blunt tables, without dynamic coefficients.
Body ellipsoid_with_tables();

/// A fall of the body from rest in water, at density 1200 and oblique to all its axes, with a
/// step of 0.01 L/U. The case's axes are not the body's, and the centre of mass is off the centroid.
FreeFall oblique_fall(const Body& body, double duration);

/// Returns a record of the fall as simulated by the runtime with the coefficients, with steps a fifth as
/// long. The loads are not filled in.
FallRecord record_of(const Body& body, const FreeFall& fall, const DynamicCoefficients& coefficients);

/// One sample of a fall in the units and axes of its case: states_of() of converter/falls/fall_record.hpp the
/// other way.
FallSample sample_of(const FreeFall& fall, double time, const BodyState& state);

}  // namespace samara::test
