#include "samara/analysis/metrics/sampled_falls.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "samara/analysis/metrics/fall_metrics.hpp"
#include "samara/core/base/parallel_for.hpp"
#include "samara/core/dynamics/body_size.hpp"
#include "samara/core/dynamics/loads.hpp"
#include "samara/core/simulation/world_pose.hpp"
#include "samara/scene/scene_simulation.hpp"
#include "samara/scene/terminal_speed.hpp"

namespace samara {
namespace {

constexpr double least_frame_rate = 60.0;
constexpr double least_frames = 240.0;
constexpr double frames_per_length = 20.0;  // enough to resolve a body's rotation
constexpr double fewest_frames = 8.0;       // at the least rate, of a fall that says something
// rms fluctuation over the terminal speed, near the upper end of what the tables of the ready bodies have
// over the speed (0.02 to 0.11 in nine of ten directions): a plan is to see too many directions rather than
// too few.
constexpr double guessed_intensity = 0.1;

/// Returns how far (m) the farthest vertex can sink when the body is rotated by an angle about the shape's
/// origin.
double sinking(const Body& body, double angle) {
    double farthest = 0.0;
    for (const Vector3d& vertex : body.surface.vertices) farthest = std::max(farthest, vertex.norm());
    return 2.0 * std::sin(0.5 * angle) * farthest;
}

double terminal_speed_of(const Scene& scene, const SceneBody& scene_body, const Body& body) {
    const double mass = make_immersed_body(body, scene_body, scene.fluid, scene_body.name).mass;
    return terminal_speed(body, scene.fluid, mass, scene.gravity.norm());
}

double least_frame_rate_of(const Scene& scene, double duration) {
    return std::max({scene.frame_rate, least_frame_rate, least_frames / duration});
}

/// Returns a frame rate that resolves the body's rotation, but not more than one frame a step.
double frame_rate_of(const Scene& scene, double duration, double speed, const Body& body) {
    const double by_distance = frames_per_length * speed / reference_length(body.moments.surface_area);
    return std::max(least_frame_rate_of(scene, duration), std::min(by_distance, 1.0 / scene.step));
}

/// Returns the scene with one body, whose copies are the falls.
Scene sampling_scene(const Scene& scene, std::size_t index, const Body& body, std::uint64_t batch,
                     const FallSampling& sampling) {
    Scene one = scene;
    one.bodies = {guessed_before_bake(scene, scene.bodies[index], body)};
    SceneBody& only = one.bodies.front();
    only.count = sampling.falls;
    const double more = std::max(0.0, sampling.start_angle - only.spread_angle);
    only.spread_angle += more;
    one.obstacles.clear();       // a fall is measured before it touches one
    one.bodies_collide = false;  // the copies are falls of their own
    // Nothing may start below the ground that would not without this further rotation.
    if (one.ground) only.position.z() += sinking(body, more);
    const double duration = sampled_duration(scene, only, sampling);
    // Nothing but a gust and a wind knows the time.
    if (!scene.wind.is_field()) {
        only.start =
            scene.fluid.gust.amplitude.isZero(0.0) ? 0.0 : std::fmod(only.start, scene.fluid.gust.period);
    }
    one.duration = only.start + duration;
    one.frame_rate = frame_rate_of(scene, duration, terminal_speed_of(scene, only, body), body);
    one.seed = scene.seed + batch;
    one.text.clear();
    return one;
}

/// Measures a fall. `shortest`: s, least duration of a fall that is measured.
SampledFall sampled_fall(const Motion& motion, const BodyMotion& body, int copy, const Vector3d& current,
                         double shortest) {
    const TimeWindow fall = fall_of(motion, body, 0, copy);
    const double length = fall.end - fall.begin;
    SampledFall sample;
    if (length < shortest) return sample;
    const FallSeries record = fall_series(motion, body, 0, copy, {length / 3.0, length});
    const Measures& measures = record.measures;
    sample.measured = true;
    for (const CataloguedMetric& entry : metric_catalogue) {
        sample.metrics[entry.metric] = metric_value(entry.metric, record);
    }
    sample.regime = measures.regime;
    sample.speed = (measures.mean_velocity - current).norm();
    double sum = 0.0;
    for (const Vector3d& displacement : record.displacements) sum += displacement.squaredNorm();
    sample.distance = std::sqrt(sum / static_cast<double>(record.displacements.size()));
    return sample;
}

/// Returns means over the frames of the windows of all copies.
FlowOnPath flow_on_path(const Motion& motion, const BodyMotion& body, const Surroundings& surroundings,
                        const ImmersedBody& immersed, const std::optional<LoadTables>& tables) {
    FlowOnPath flow;
    double frames = 0.0;
    for (int copy = 0; copy < body.copies; ++copy) {
        const TimeWindow window = default_window(motion, body, 0, copy);
        for (int frame = 0; frame < motion.frames(); ++frame) {
            const double time = motion.times[static_cast<std::size_t>(frame)];
            if (time < window.begin || time > window.end) continue;
            const double size = body.size(0, copy);
            const auto visit =
                flow_visit(motion.pose(body, 0, frame, copy), time, immersed, surroundings, size);
            frames += 1.0;
            if (!visit) continue;
            flow.reynolds_number += visit->reynolds_number;
            if (!tables) continue;
            const LoadEntry entry = look_up(*tables, visit->direction, visit->reynolds_number);
            const double square = 2.0 * visit->pressure / immersed.fluid_density;
            flow.turbulent_kinetic_energy += square * entry.turbulent_kinetic_energy;
            flow.dissipation_rate +=
                std::pow(square, 1.5) / (size * immersed.length) * entry.dissipation_rate;
        }
    }
    frames = std::max(frames, 1.0);
    flow.reynolds_number /= frames;
    flow.turbulent_kinetic_energy /= frames;
    flow.dissipation_rate /= frames;
    return flow;
}

}  // namespace

std::optional<FlowVisit> flow_visit(const Pose& pose, double time, const ImmersedBody& immersed,
                                    const Surroundings& surroundings, double size) {
    const Pose sampled =
        in_own_units(in_wind(in_flow(pose, surroundings, time), immersed, surroundings, time), size);
    const Vector3d velocity = centroid_velocity(sampled, immersed);
    const double speed = velocity.norm();
    if (!(speed > 0.0)) return std::nullopt;
    return FlowVisit{velocity / speed, reynolds_number(immersed, speed),
                     0.5 * immersed.fluid_density * speed * speed / (size * size)};
}

std::vector<FlowVisit> flow_visits(const Motion& motion, std::size_t body, const ImmersedBody& immersed,
                                   const Surroundings& surroundings) {
    const BodyMotion& of_body = motion.bodies[body];
    std::vector<FlowVisit> visits;
    visits.reserve(of_body.poses.size());
    for (int run = 0; run < motion.runs; ++run) {
        for (int frame = 0; frame < motion.frames(); ++frame) {
            for (int copy = 0; copy < of_body.copies; ++copy) {
                const Pose& pose = motion.pose(of_body, run, frame, copy);
                if (pose.velocity.isZero(0.0) && pose.angular_velocity.isZero(0.0)) continue;
                const double time = motion.times[static_cast<std::size_t>(frame)];
                if (const auto visit =
                        flow_visit(pose, time, immersed, surroundings, of_body.size(run, copy)))
                    visits.push_back(*visit);
            }
        }
    }
    return visits;
}

double sampled_duration(const Scene& scene, const SceneBody& body, const FallSampling& sampling) {
    return std::clamp(scene.duration - body.start, 0.0, sampling.most_steps * scene.step);
}

SceneBody guessed_before_bake(const Scene& scene, const SceneBody& scene_body, const Body& body) {
    SceneBody guessed = scene_body;
    const bool shaken = guessed.turbulence == Turbulence::table;
    if (body.tables || !uses_body_tables(guessed.loads, guessed.turbulence)) return guessed;
    if (guessed.loads == Loads::table) guessed.loads = Loads::coefficients;
    guessed.table_reynolds_number.reset();
    if (!shaken) return guessed;
    guessed.turbulence = Turbulence::none;
    const double speed = terminal_speed_of(scene, guessed, body);
    if (!(speed > 0.0)) return guessed;
    const double energy = 1.5 * guessed_intensity * guessed_intensity * speed * speed;
    guessed.turbulence = Turbulence::constant;
    guessed.turbulent_kinetic_energy = energy;
    guessed.dissipation_rate = std::pow(energy, 1.5) / reference_length(body.moments.surface_area);
    return guessed;
}

std::optional<Estimate> SampledFalls::mean(Metric metric) const {
    std::vector<Estimate> values;
    for (const SampledFall& fall : falls) {
        if (fall.metrics[metric]) values.push_back({*fall.metrics[metric], {}, {}});
    }
    if (2 * values.size() < falls.size()) return std::nullopt;
    return mean_of(values, catalogued(metric).mean);
}

RegimeCounts SampledFalls::regimes() const {
    RegimeCounts regimes;
    for (const SampledFall& fall : falls) {
        if (fall.measured) regimes.add(fall.regime);
    }
    return regimes;
}

SampledFalls sample_falls(const Scene& scene, std::size_t body, const LoadedBody& loaded,
                          const FallSampling& sampling, std::uint64_t batch) {
    if (!(sampled_duration(scene, scene.bodies[body], sampling) > 0.0)) {
        SampledFalls none;
        none.falls.resize(static_cast<std::size_t>(sampling.falls));
        return none;
    }
    const Scene one = sampling_scene(scene, body, *loaded.body, batch, sampling);
    const SimulationResult result_of_scene = simulate(
        one, {loaded}, 1, [](double, double) { return true; }, sampling.threads);
    const Motion& motion = result_of_scene.motion;
    const BodyMotion& falling = motion.bodies.front();
    const double shortest =
        fewest_frames / least_frame_rate_of(scene, one.duration - one.bodies.front().start);
    const Surroundings surroundings = surroundings_of(one);
    SampledFalls result;
    result.falls.resize(static_cast<std::size_t>(falling.copies));
    parallel_for(result.falls.size(), 4, sampling.threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            result.falls[i] =
                sampled_fall(motion, falling, static_cast<int>(i), surroundings.current, shortest);
        }
    });
    const ImmersedBody immersed =
        make_immersed_body(*loaded.body, one.bodies.front(), one.fluid, falling.name);
    result.flow = flow_on_path(motion, falling, surroundings, immersed, loaded.body->tables);
    result.visits = flow_visits(motion, 0, immersed, surroundings);
    result.highest_reynolds_number = result_of_scene.report.bodies.front().highest_reynolds_number;
    return result;
}

double nanoseconds_per_step(const Scene& scene, std::size_t body, const LoadedBody& loaded,
                            const FallSampling& sampling) {
    constexpr double stretches = 8.0;
    constexpr double steps_in_stretch = 128.0;
    Scene one = sampling_scene(scene, body, *loaded.body, 0, sampling);
    one.frame_rate = 1.0 / (steps_in_stretch * one.step);  // a stretch from frame to frame
    one.duration = one.bodies.front().start + stretches / one.frame_rate;
    double least = INFINITY;
    double before = 0.0;
    std::clock_t start = std::clock();
    const auto time_stretch = [&](double done, double /*total*/) {
        const std::clock_t now = std::clock();
        if (done > before) {
            least = std::min(least, static_cast<double>(now - start) / CLOCKS_PER_SEC / (done - before));
        }
        before = done;
        start = now;
        return true;
    };
    (void)simulate(one, {loaded}, 1, time_stretch, 1);
    return 1e9 * least;
}

}  // namespace samara
