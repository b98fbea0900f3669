// The ready-baked bodies fall as they fell: a change of the equations, the step or the tables that moves a
// fall is seen here within seconds. How near the falls are to full CFD, docs/studies/falls says.

#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "paths.hpp"
#include "samara/analysis/metrics/ensemble.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/scene/ready_bodies.hpp"
#include "samara/scene/scene_file.hpp"
#include "samara/scene/scene_simulation.hpp"

namespace samara {
namespace {

struct ShippedFall {
    const char* scene;  ///< of docs/
    const char* body;
    Regime regime;
    double descent;                           ///< m/s
    std::optional<double> frequency;          ///< Hz
    std::optional<double> rms_angular_speed;  ///< rad/s
};

/// Without noise, as the bodies of runtime/bodies fell when this was written.
constexpr ShippedFall falls[] = {
    {"studies/falls/ellipsoid-tilted", "ellipsoid", Regime::fluttering, 0.2129, 0.7065, 2.852},
    {"studies/falls/ellipsoid-heavy", "ellipsoid", Regime::fluttering, 0.4698, 2.077, 7.023},
    {"studies/falls/sphere", "sphere", Regime::steady, 0.5496, {}, {}},
    {"studies/falls/cube", "cube", Regime::chaotic, 0.2547, 0.562, 4.184},
    {"studies/falls/disc-light", "disc", Regime::fluttering, 0.201, 0.5824, 2.549},
    {"studies/falls/disc-heavy", "disc", Regime::tumbling, 0.7003, 1.977, 12.59},
    {"studies/falls/sheet", "sheet", Regime::chaotic, 0.6914, 1.907, 11.26},
    {"studies/falls/samara", "samara", Regime::autorotating, 1.207, {}, 117.8},
    {"scenes/samara", "samara", Regime::autorotating, 0.976, {}, 118.2},
};

BodyMeasures flown(const ShippedFall& fall) {
    Scene scene = read_scene_file(std::string(SAMARA_SOURCE_DIRECTORY "/docs/") + fall.scene + ".toml");
    const Body body = read_body_file(ready_body_file(fall.body));
    SceneBody& scene_body = scene.bodies.front();
    choose_open_models(body, scene_body.open, scene_body);
    scene_body.turbulence = Turbulence::none;
    const Motion motion = simulate(scene, {{body, "hash"}}, 1, [](double, double) { return true; }).motion;
    return measure_all(motion, motion.bodies.front());
}

TEST(ShippedBodies, FallAsTheyFell) {
    constexpr double tolerance = 0.01;
    for (const ShippedFall& fall : falls) {
        SCOPED_TRACE(fall.scene);
        const BodyMeasures measures = flown(fall);
        EXPECT_EQ(measures.regimes.commonest(), fall.regime);
        EXPECT_NEAR(measures.value(Metric::descent_speed) / fall.descent, 1.0, tolerance);
        if (fall.frequency) {
            EXPECT_NEAR(measures.value(Metric::frequency) / *fall.frequency, 1.0, tolerance);
        }
        if (fall.rms_angular_speed) {
            EXPECT_NEAR(measures.value(Metric::rms_angular_speed) / *fall.rms_angular_speed, 1.0, tolerance);
        }
    }
}

/// Mean and standard error over copies.
struct Mean {
    double value, error;
};
Mean mean_of(const std::vector<double>& numbers) {
    const auto count = static_cast<double>(numbers.size());
    const double mean = std::accumulate(numbers.begin(), numbers.end(), 0.0) / count;
    double square = 0.0;
    for (const double number : numbers) square += (number - mean) * (number - mean);
    return {mean, std::sqrt(square / (count * (count - 1.0)))};
}

TEST(ShippedBodies, ACrowdFallsInSinglePrecisionAsInDouble) {
    Scene scene = read_scene_text(R"([scene]
duration = 3
[fluid]
preset = "air"
[[body]]
name = "leaf"
shape = "samara:leaf"
count = 1000
spread = { angle = 3.14 })",
                                  "crowd.toml", ".");
    const Body body = read_body_file(ready_body_file("leaf"));
    choose_open_models(body, scene.bodies[0].open, scene.bodies[0]);
    std::vector<Mean> descents;
    std::vector<Mean> drifts;
    for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
        scene.precision = precision;
        Simulation simulation = simulation_of(scene, {{body, "hash"}}, 1, 1);
        simulation.advance_to(1.0);
        std::vector<double> begins;
        for (std::size_t i = 0; i < simulation.size(); ++i) begins.push_back(simulation.pose(i).position.z());
        simulation.advance_to(scene.duration);
        std::vector<double> speeds;
        std::vector<double> drift;
        for (std::size_t i = 0; i < simulation.size(); ++i) {
            const Vector3d place = simulation.pose(i).position;
            speeds.push_back((begins[i] - place.z()) / 2.0);
            drift.push_back(place.head<2>().norm());
        }
        descents.push_back(mean_of(speeds));
        drifts.push_back(mean_of(drift));
    }
    EXPECT_NEAR(descents[1].value, descents[0].value, 2.0 * std::hypot(descents[0].error, descents[1].error));
    EXPECT_NEAR(drifts[1].value, drifts[0].value, 2.0 * std::hypot(drifts[0].error, drifts[1].error));
}

}  // namespace
}  // namespace samara
