#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "samara/body/body.hpp"
#include "samara/motion/estimate.hpp"
#include "samara/motion/measures.hpp"
#include "samara/scene/scene.hpp"
#include "samara/simulation/flow_visits.hpp"

namespace samara {

/// The figures of a fall that a bake answers for.
enum class FallMeasure { descent_speed, frequency, inclination_amplitude, rms_angular_speed };
inline constexpr std::size_t fall_measure_count = 4;

/// "descent speed", ...; and "descent_speed", ..., as JSON has it.
const char* title_of(FallMeasure measure);
const char* name_of(FallMeasure measure);

/// What a tolerance allows of a measure, relative: 1, 2, 3 and 3 times the tolerance, in the proportions that
/// `samara compare` judges by.
double allowed_error(FallMeasure measure, double tolerance);

/// What an ensemble of falls of one body does.
struct EnsembleFlight {
    std::array<std::optional<Estimate>, fall_measure_count>
        measures;                    ///< SI; none where too few falls have it
    Regime regime = Regime::steady;  ///< the commonest
    double regime_share = 1.0;
    std::vector<FlowVisit> visits;
};

/// Flies a body of a scene alone, `falls` times, with other noise and starts turned by up to 0.05 rad (or the
/// scene's own spread, if larger), with the body's tables where it has them. Where it has none, table loads
/// become coefficient loads with their defaults, and turbulence from tables a constant one of 10 % intensity:
/// what is known before a bake. The same for any number of threads. Throws Error as Simulation does.
EnsembleFlight fly_ensemble(const Scene& scene, std::size_t body, const Body& of_body, int falls);

}  // namespace samara
