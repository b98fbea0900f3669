#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "samara/motion/fall_figures.hpp"
#include "samara/simulation/model_set.hpp"
#include "samara/simulation/simulation.hpp"

namespace samara {

/// What models are told apart by.
inline constexpr std::array advised_figures = {Figure::descent_speed, Figure::inclination_amplitude,
                                               Figure::frequency, Figure::rms_angular_speed,
                                               Figure::path_spread};

/// One fall over the last two thirds of its way.
struct SampledFall {
    bool measured = false;  ///< false where the fall is too short; then the rest says nothing
    std::array<std::optional<double>, advised_figures.size()> figures;
    Regime regime = Regime::steady;
    double speed = 0.0;     ///< m/s: magnitude of the mean velocity, less the current
    double distance = 0.0;  ///< m: rms distance from the release
};

/// What the flow around a body is like on its way, means over all falls and frames of the window.
struct FlowMet {
    double reynolds_number = 0.0;
    double turbulent_kinetic_energy = 0.0;  ///< m^2/s^2, by the body's tables; 0 without
    double dissipation_rate = 0.0;          ///< m^2/s^3, likewise
};

/// Falls of one body of a scene with one set of models.
struct SampledFalls {
    std::vector<SampledFall> falls;
    FlowMet flow;
    double highest_reynolds_number = 0.0;
};

/// How falls are flown.
struct FallSampling {
    int falls = 32;             ///< in one call
    double start_angle = 0.05;  ///< rad: starts are turned by up to this, or by the scene's spread
    double most_steps = 5000;   ///< of a fall: a longer scene is cut
    int threads = 0;
};

/// The seconds of flight that are sampled: the scene's, `most_steps` at most; 0 where the body never starts.
double sampled_duration(const Scene& scene, const SceneBody& body, const FallSampling& sampling);

/// `sampling.falls` falls of the body number `body` that differ by their noise and their starts. Fall i of
/// batch b is the same draw whatever the models: so that what models change stands out from chance. The same
/// for any number of threads. Throws Error where the body cannot fly so.
SampledFalls sample_falls(const Scene& scene, std::size_t body, const CastBody& cast, const ModelSet& models,
                          std::uint64_t batch, const FallSampling& sampling);

/// CPU time of a step (ns) of one of these falls among `sampling.falls`, on one thread, the fastest of
/// several stretches. For information: nothing is decided by it.
double nanoseconds_per_step(const Scene& scene, std::size_t body, const CastBody& cast,
                            const ModelSet& models, const FallSampling& sampling);

}  // namespace samara
