// Bodies that fall by the loads of their surface, without CFD and without a coefficient of their own, beside
// falls by full CFD. docs/explanation/loads-without-a-bake.md has all errors; here they must fall alike.

#include <string>

#include <gtest/gtest.h>

#include "paths.hpp"
#include "samara/analysis/metrics/ensemble.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/motion/motion_file.hpp"
#include "samara/scene/ready_bodies.hpp"
#include "samara/scene/scene_file.hpp"
#include "samara/scene/scene_simulation.hpp"

namespace samara {
namespace {

struct SurfaceFall {
    const char* scene;  ///< of docs/studies/falls
    const char* body;
    Regime regime;
    double tolerance;  ///< of the descent
};

constexpr SurfaceFall falls[] = {
    {"ellipsoid-tilted", "ellipsoid", Regime::fluttering, 0.25},
    {"sheet", "sheet", Regime::tumbling, 0.25},
    {"samara", "samara", Regime::autorotating, 0.25},
};

TEST(SurfaceLoads, MakeBodiesFlutterTumbleAndAutorotateAsInFullCfd) {
    const std::string folder = SAMARA_SOURCE_DIRECTORY "/docs/studies/falls/";
    for (const SurfaceFall& fall : falls) {
        SCOPED_TRACE(fall.scene);
        Scene scene = read_scene_file(folder + fall.scene + ".toml");
        scene.bodies.front().loads = Loads::surface;
        scene.bodies.front().turbulence = Turbulence::none;
        const Body body = read_body_file(ready_body_file(fall.body));
        const Motion motion =
            simulate(scene, {{body, "hash"}}, 1, [](double, double) { return true; }).motion;
        const BodyMeasures flown = measure_all(motion, motion.bodies.front());
        const Motion reference = read_motion_file(folder + fall.scene + ".h5");
        const BodyMeasures solved = measure_all(reference, reference.bodies.front());
        EXPECT_EQ(flown.regimes.commonest(), fall.regime);
        EXPECT_EQ(solved.regimes.commonest(), fall.regime);
        EXPECT_NEAR(flown.value(Metric::descent_speed) / solved.value(Metric::descent_speed), 1.0,
                    fall.tolerance);
    }
}

}  // namespace
}  // namespace samara
