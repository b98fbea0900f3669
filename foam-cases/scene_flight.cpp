#include "foam-cases/scene_flight.hpp"

#include <algorithm>
#include <cmath>

#include "foam-cases/terminal_speed.hpp"
#include "samara/dynamics/immersed_body.hpp"
#include "samara/simulation/simulation.hpp"

namespace samara {
namespace {

constexpr double least_spread_angle = 0.05;        // rad
constexpr double unknown_intensity = 0.1;          // rms fluctuation over the terminal speed
constexpr double frames_per_length_of_way = 20.0;  // enough to see a body turn

/// What stands in for tables before there are any.
void use_guesses(SceneBody& scene_body, const Body& body, double speed) {
    if (scene_body.loads == Loads::table) scene_body.loads = Loads::coefficients;
    if (scene_body.turbulence != Turbulence::table) return;
    const double energy = 1.5 * unknown_intensity * unknown_intensity * speed * speed;
    scene_body.turbulence = Turbulence::constant;
    scene_body.turbulent_kinetic_energy = energy;
    scene_body.dissipation_rate = std::pow(energy, 1.5) / reference_length(body.moments.surface_area);
}

/// The scene with that body alone and so many copies of it.
Scene scene_of(const Scene& scene, std::size_t index, const Body& body, int falls) {
    Scene alone = scene;
    alone.bodies = {scene.bodies[index]};
    SceneBody& scene_body = alone.bodies.front();
    const double speed =
        terminal_speed(body, scene.fluid, mass_of(scene_body.mass, body), scene.gravity.norm());
    if (!body.tables) use_guesses(scene_body, body, speed);
    scene_body.count = falls;
    scene_body.spread_angle = std::max(scene_body.spread_angle, least_spread_angle);
    alone.frame_rate = std::max(
        scene.frame_rate, frames_per_length_of_way * speed / reference_length(body.moments.surface_area));
    return alone;
}

std::optional<double> figure(const Measures& measures, FallMeasure measure) {
    switch (measure) {
        case FallMeasure::descent_speed:
            return measures.descent_speed;
        case FallMeasure::frequency:
            return measures.frequency;
        case FallMeasure::inclination_amplitude:
            return measures.inclination_amplitude;
        case FallMeasure::rms_angular_speed:
            return measures.rms_angular_speed;
    }
    return std::nullopt;
}

}  // namespace

const char* title_of(FallMeasure measure) {
    constexpr const char* titles[] = {"descent speed", "frequency", "amplitude", "rms angular speed"};
    return titles[static_cast<std::size_t>(measure)];
}

const char* name_of(FallMeasure measure) {
    constexpr const char* names[] = {"descent_speed", "frequency", "inclination_amplitude",
                                     "rms_angular_speed"};
    return names[static_cast<std::size_t>(measure)];
}

double allowed_error(FallMeasure measure, double tolerance) {
    constexpr double shares[] = {1.0, 2.0, 3.0, 3.0};
    return shares[static_cast<std::size_t>(measure)] * tolerance;
}

EnsembleFlight fly_ensemble(const Scene& scene, std::size_t body, const Body& of_body, int falls) {
    const Scene alone = scene_of(scene, body, of_body, falls);
    const SimulationResult flown =
        simulate(alone, {CastBody{of_body, ""}}, 1, [](double, double) { return true; });
    const BodyMotion& motion = flown.motion.bodies.front();
    EnsembleFlight flight;
    std::array<std::vector<Estimate>, fall_measure_count> figures;
    std::array<int, 4> regimes = {};
    for (int copy = 0; copy < falls; ++copy) {
        const Measures measures = measure(flown.motion, motion, 0, copy);
        ++regimes[static_cast<std::size_t>(measures.regime)];
        for (std::size_t i = 0; i < fall_measure_count; ++i) {
            if (const auto value = figure(measures, static_cast<FallMeasure>(i))) {
                figures[i].push_back({*value, std::nullopt, std::nullopt});
            }
        }
    }
    for (std::size_t i = 0; i < fall_measure_count; ++i) {
        // A frequency that few falls have is none of the ensemble.
        if (2 * figures[i].size() < static_cast<std::size_t>(falls)) continue;
        flight.measures[i] = mean_of(figures[i], static_cast<FallMeasure>(i) == FallMeasure::rms_angular_speed
                                                     ? Mean::root_mean_square
                                                     : Mean::arithmetic);
    }
    if (of_body.symmetry.kind == Symmetry::Kind::spherical) {
        // A ball has no shortest axis: its inclination says nothing.
        flight.measures[static_cast<std::size_t>(FallMeasure::frequency)].reset();
        flight.measures[static_cast<std::size_t>(FallMeasure::inclination_amplitude)].reset();
    }
    const auto commonest = std::ranges::max_element(regimes);
    flight.regime = static_cast<Regime>(commonest - regimes.begin());
    flight.regime_share = static_cast<double>(*commonest) / falls;
    const ImmersedBody immersed = make_immersed_body(of_body, alone.bodies.front(), alone.fluid);
    flight.visits = flow_visits(flown.motion, 0, immersed, surroundings_of(alone));
    return flight;
}

}  // namespace samara
