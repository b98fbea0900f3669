#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "samara/analysis/metrics/metric_catalogue.hpp"
#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/dynamics/surroundings.hpp"
#include "samara/motion/motion.hpp"
#include "samara/scene/scene_simulation.hpp"

namespace samara {

/// The flow relative to a body at one frame, at which its tables are looked up.
struct FlowVisit {
    Vector3d direction;      ///< unit vector, body axes: the centroid's velocity relative to flow and wind
    double reynolds_number;  ///< Reynolds number of the relative velocity
    double pressure;         ///< rho |v|^2 / 2 (Pa)
};

/// Returns the flow at one pose and time (s) of a body of `size` relative to the shape's; nothing where it
/// rests in the flow.
std::optional<FlowVisit> flow_visit(const Pose& pose, double time, const ImmersedBody& immersed,
                                    const Surroundings& surroundings, double size = 1.0);

/// Returns the flow at all runs and copies of a body of a motion with its poses, frame by frame, without
/// those in which it rests in the world or in the flow: held until its start, or lying on the ground.
std::vector<FlowVisit> flow_visits(const Motion& motion, std::size_t body, const ImmersedBody& immersed,
                                   const Surroundings& surroundings);

/// Metrics of one fall over its last two thirds.
struct SampledFall {
    bool measured = false;  ///< false where the fall is too short; then the other members have no meaning
    PerMetric<std::optional<double>> metrics;  ///< values of metric_value()
    Regime regime = Regime::steady;
    double speed = 0.0;     ///< m/s: magnitude of the mean velocity, less the current
    double distance = 0.0;  ///< m: rms distance from the release
};

/// Mean flow around a body on its path, over all falls and frames of the window.
struct FlowOnPath {
    double reynolds_number = 0.0;
    double turbulent_kinetic_energy = 0.0;  ///< m^2/s^2, by the body's tables; 0 without
    double dissipation_rate = 0.0;          ///< m^2/s^3, by the body's tables; 0 without
};

/// Falls of one body of a scene.
struct SampledFalls {
    std::vector<SampledFall> falls;
    FlowOnPath flow;
    std::vector<FlowVisit> visits;  ///< the flow at all frames
    double highest_reynolds_number = 0.0;

    /// Returns the mean of a metric over the falls that have it; nothing where fewer than half of them do.
    [[nodiscard]] std::optional<Estimate> mean(Metric metric) const;
    /// Returns the regimes of the falls that are measured.
    [[nodiscard]] RegimeCounts regimes() const;
};

/// Options of sample_falls().
struct FallSampling {
    int falls = 32;             ///< number of falls of one call
    double start_angle = 0.05;  ///< rad: starts are rotated at random by up to this, or by the scene's spread
    double most_steps = 5000;   ///< most steps of a fall: a longer scene is cut
    int threads = 0;
};

/// Returns the duration (s) of the falls that are sampled: the scene's, `most_steps` at most; 0 where the
/// body never starts.
double sampled_duration(const Scene& scene, const SceneBody& body, const FallSampling& sampling);

/// Returns the scene's body with substitutes for tables that are not baked yet: loads by coefficients in
/// place of tables, and in place of their turbulence a constant one whose rms fluctuation is a tenth of the
/// terminal speed, with the dissipation k^1.5 / L; no turbulence where the body has no terminal speed. The
/// body is unchanged where `body` has tables, or the scene does not ask for them. Throws Error like
/// make_immersed_body().
SceneBody guessed_before_bake(const Scene& scene, const SceneBody& scene_body, const Body& body);

/// Simulates `sampling.falls` falls of the body number `body`, alone in the scene, that differ by their noise
/// and their starts; guessed_before_bake() where it has no tables. Fall i of batch b is the same draw
/// whatever the models: so that what models change stands out from chance. The result does not depend on the
/// number of threads. No fall is measured, and there are no visits, where the body starts as the scene ends
/// or later. Throws Error where the body cannot be simulated so.
SampledFalls sample_falls(const Scene& scene, std::size_t body, const LoadedBody& loaded,
                          const FallSampling& sampling = {}, std::uint64_t batch = 0);

/// Returns the CPU time of a step (ns) of one of these falls among `sampling.falls`, on one thread, the
/// fastest of several stretches. For information: nothing is decided by it.
double nanoseconds_per_step(const Scene& scene, std::size_t body, const LoadedBody& loaded,
                            const FallSampling& sampling);

}  // namespace samara
