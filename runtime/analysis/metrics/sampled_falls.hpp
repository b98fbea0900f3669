#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "samara/analysis/metrics/flow_visits.hpp"
#include "samara/analysis/metrics/metric_catalogue.hpp"
#include "samara/analysis/metrics/regime_counts.hpp"
#include "samara/scene/scene_simulation.hpp"

namespace samara {

/// One fall over the last two thirds of its way.
struct SampledFall {
    bool measured = false;  ///< false where the fall is too short; then the rest says nothing
    PerMetric<std::optional<double>> metrics;  ///< those of metric_value()
    Regime regime = Regime::steady;
    double speed = 0.0;     ///< m/s: magnitude of the mean velocity, less the current
    double distance = 0.0;  ///< m: rms distance from the release
};

/// What the flow around a body is like on its way, means over all falls and frames of the window.
struct FlowOnPath {
    double reynolds_number = 0.0;
    double turbulent_kinetic_energy = 0.0;  ///< m^2/s^2, by the body's tables; 0 without
    double dissipation_rate = 0.0;          ///< m^2/s^3, likewise
};

/// Falls of one body of a scene.
struct SampledFalls {
    std::vector<SampledFall> falls;
    FlowOnPath flow;
    std::vector<FlowVisit> visits;  ///< of all frames
    double highest_reynolds_number = 0.0;

    /// The mean of a figure over the falls that have it; nothing where fewer than half of them do.
    [[nodiscard]] std::optional<Estimate> mean(Metric metric) const;
    /// Of the falls that are measured.
    [[nodiscard]] RegimeCounts regimes() const;
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

/// The scene's body with what stands in for tables before there are any: loads by coefficients in place of
/// tables, and in place of their turbulence a constant one whose rms fluctuation is a tenth of the terminal
/// speed, with the dissipation k^1.5 / L; no turbulence where the body has no terminal speed. As it is where
/// `body` has tables, or nothing asks for them. Throws Error like make_immersed_body().
SceneBody guessed_before_bake(const Scene& scene, const SceneBody& scene_body, const Body& body);

/// `sampling.falls` falls of the body number `body`, alone in the scene, that differ by their noise and their
/// starts; guessed_before_bake() where it has no tables. Fall i of batch b is the same draw whatever the
/// models: so that what models change stands out from chance. The same for any number of threads. No fall is
/// measured, and there are no visits, where the body starts as the scene ends or later. Throws Error where
/// the body cannot fly so.
SampledFalls sample_falls(const Scene& scene, std::size_t body, const LoadedBody& loaded,
                          const FallSampling& sampling = {}, std::uint64_t batch = 0);

/// CPU time of a step (ns) of one of these falls among `sampling.falls`, on one thread, the fastest of
/// several stretches. For information: nothing is decided by it.
double nanoseconds_per_step(const Scene& scene, std::size_t body, const LoadedBody& loaded,
                            const FallSampling& sampling);

}  // namespace samara
