#include "samara/simulation/sampled_falls.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "samara/base/parallel_for.hpp"
#include "samara/dynamics/loads.hpp"
#include "samara/simulation/world_pose.hpp"

namespace samara {
namespace {

constexpr double least_frame_rate = 60.0;
constexpr double least_frames = 240.0;
constexpr int fewest_frames = 8;  // of a fall that says something

/// How far the farthest vertex can sink when the body is turned by an angle about the shape's origin (m).
double sinking(const Body& body, double angle) {
    double farthest = 0.0;
    for (const Vector3d& vertex : body.surface.vertices) farthest = std::max(farthest, vertex.norm());
    return 2.0 * std::sin(0.5 * angle) * farthest;
}

/// The scene with one body, whose copies are the falls.
Scene sampling_scene(const Scene& scene, std::size_t index, const Body& body, const ModelSet& models,
                     std::uint64_t batch, const FallSampling& sampling) {
    Scene one = scene;
    one.bodies = {scene.bodies[index]};
    SceneBody& only = one.bodies.front();
    set_models(models, only);
    only.count = sampling.falls;
    const double more = std::max(0.0, sampling.start_angle - only.spread_angle);
    only.spread_angle += more;
    // Nothing may start below the ground that would not without the advice's own turn.
    if (one.ground) only.position.z() += sinking(body, more);
    const double duration = sampled_duration(scene, only, sampling);
    // Nothing but a gust knows the time.
    only.start =
        scene.fluid.gust.amplitude.isZero(0.0) ? 0.0 : std::fmod(only.start, scene.fluid.gust.period);
    one.duration = only.start + duration;
    one.frame_rate = std::max({scene.frame_rate, least_frame_rate, least_frames / duration});
    one.seed = scene.seed + batch;
    one.text.clear();
    return one;
}

SampledFall sampled_fall(const Motion& motion, const BodyMotion& body, int copy, const Vector3d& current) {
    const TimeWindow fall = fall_of(motion, body, 0, copy);
    const double length = fall.end - fall.begin;
    SampledFall sample;
    if (length * motion.frame_rate < fewest_frames) return sample;
    const FallSeries record = fall_series(motion, body, 0, copy, {length / 3.0, length});
    const Measures& measures = record.measures;
    sample.measured = true;
    sample.figures = {measures.descent_speed, measures.inclination_amplitude, measures.frequency,
                      measures.rms_angular_speed, path_spread(record)};
    sample.regime = measures.regime;
    sample.speed = (measures.mean_velocity - current).norm();
    double sum = 0.0;
    for (const Vector3d& way : record.ways) sum += way.squaredNorm();
    sample.distance = std::sqrt(sum / static_cast<double>(record.ways.size()));
    return sample;
}

/// Means over the frames of the windows of all copies.
FlowMet flow_met(const Motion& motion, const BodyMotion& body, const Surroundings& surroundings,
                 const ImmersedBody& immersed, const std::optional<LoadTables>& tables) {
    FlowMet met;
    double frames = 0.0;
    for (int copy = 0; copy < body.copies; ++copy) {
        const TimeWindow window = default_window(motion, body, 0, copy);
        for (int frame = 0; frame < motion.frames(); ++frame) {
            const double time = motion.times[static_cast<std::size_t>(frame)];
            if (time < window.begin || time > window.end) continue;
            const Pose pose = in_flow(motion.pose(body, 0, frame, copy), surroundings, time);
            const Quaterniond to_body = pose.orientation.conjugate();
            const Vector3d velocity = to_body * pose.velocity +
                                      (to_body * pose.angular_velocity).cross(immersed.center_of_buoyancy);
            const double speed = velocity.norm();
            const double reynolds = reynolds_number(immersed, speed);
            frames += 1.0;
            met.reynolds_number += reynolds;
            if (!tables || !(speed > 0.0)) continue;
            const LoadEntry entry = look_up(*tables, velocity / speed, reynolds);
            met.turbulent_kinetic_energy += speed * speed * entry.turbulent_kinetic_energy;
            met.dissipation_rate += std::pow(speed, 3) / immersed.length * entry.dissipation_rate;
        }
    }
    frames = std::max(frames, 1.0);
    met.reynolds_number /= frames;
    met.turbulent_kinetic_energy /= frames;
    met.dissipation_rate /= frames;
    return met;
}

}  // namespace

double sampled_duration(const Scene& scene, const SceneBody& body, const FallSampling& sampling) {
    return std::clamp(scene.duration - body.start, 0.0, sampling.most_steps * scene.step);
}

SampledFalls sample_falls(const Scene& scene, std::size_t body, const CastBody& cast, const ModelSet& models,
                          std::uint64_t batch, const FallSampling& sampling) {
    const Scene one = sampling_scene(scene, body, cast.body, models, batch, sampling);
    const SimulationResult flown = simulate(
        one, {cast}, 1, [](double, double) { return true; }, sampling.threads);
    const Motion& motion = flown.motion;
    const BodyMotion& falling = motion.bodies.front();
    SampledFalls result;
    result.falls.resize(static_cast<std::size_t>(falling.copies));
    parallel_for(result.falls.size(), 4, sampling.threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            result.falls[i] = sampled_fall(motion, falling, static_cast<int>(i), scene.fluid.current);
        }
    });
    const ImmersedBody immersed = make_immersed_body(cast.body, one.bodies.front(), one.fluid);
    result.flow = flow_met(motion, falling, surroundings_of(one), immersed, cast.body.tables);
    result.highest_reynolds_number = flown.report.bodies.front().highest_reynolds_number;
    return result;
}

double nanoseconds_per_step(const Scene& scene, std::size_t body, const CastBody& cast,
                            const ModelSet& models, const FallSampling& sampling) {
    constexpr int stretches = 8;
    constexpr double steps_in_stretch = 128.0;
    const Scene one = sampling_scene(scene, body, cast.body, models, 0, sampling);
    const SceneBody& only = one.bodies.front();
    const ImmersedBody immersed = make_immersed_body(cast.body, only, one.fluid);
    BodyFlight flight(one, only, immersed, 1, 1);
    std::vector<Pose> poses(static_cast<std::size_t>(only.count));
    double least = INFINITY;
    for (int i = 1; i <= stretches; ++i) {
        const std::uint64_t before = flight.steps();
        const std::clock_t start = std::clock();
        flight.fly_to(only.start + i * steps_in_stretch * one.step, poses.data(), poses.size());
        const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
        least = std::min(least, seconds / static_cast<double>(flight.steps() - before));
    }
    return 1e9 * least;
}

}  // namespace samara
