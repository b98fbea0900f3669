// Falls in single precision lose no number, however small, light or dense the body is.

#include <cmath>
#include <cstddef>
#include <cstdint>

#include <gtest/gtest.h>

#include "samara/core/integrator/batch.hpp"
#include "support/hard_bodies.hpp"
#include "support/known_bodies.hpp"
#include "support/stability_row.hpp"

namespace samara {
namespace {

/// Returns how many of 32 falls over 200 steps, with noise, end in a number that is not finite or in an
/// orientation that is not of unit length.
int lost_falls(const ImmersedBody& body, double h) {
    Batch batch(body, 32, Precision::single_precision);
    for (std::size_t i = 0; i < batch.size(); ++i) {
        batch.set_state(i, test::tumbling_state(0.1, 2.0 + 0.3 * static_cast<double>(i)));
        batch.set_noise(i, Noise(1, "body", 0, static_cast<std::uint32_t>(i)));
    }
    batch.advance(Surroundings{}, 0.0, h, 0, 200);
    int lost = 0;
    for (std::size_t i = 0; i < batch.size(); ++i) {
        const BodyState state = batch.state(i);
        const bool finite = state.position.allFinite() && state.velocity.allFinite();
        if (!finite || !(std::abs(state.orientation.norm() - 1.0) < 1e-5)) ++lost;
    }
    return lost;
}

TEST(SinglePrecision, LosesNoFallOfTinyLightOrDenseBodies) {
    for (const double h : {0.002, 1.0 / 24.0}) {
        int lost = 0;
        for (const Fluid& fluid : {test::water(), test::air()}) {
            for (const double size : {1e-6, 1e-5, 1e-4, 1e-3, 0.1, 1.0, 10.0}) {
                const Body shape = test::baked_ellipsoid(size * Vector3d(0.25, 0.5, 1.0));
                for (const double relative : {1e-3, 0.1, 1.001, 10.0, 1e3, 1e5, 1e9}) {
                    ImmersedBody body = test::immersed(shape, relative * fluid.density, fluid, Loads::table,
                                                       size * Vector3d(0.02, 0.01, -0.03));
                    body.turbulence = Turbulence::table;
                    prepare(body);
                    lost += lost_falls(body, h);
                }
            }
        }
        test::expect_row({"98 ellipsoids of 1 micrometre to 10 m, 0.001 to 1e9 times the fluid's density",
                          h < 0.01 ? "2 ms, single precision" : "1/24 s, single precision",
                          "falls of 3136 that lose a number or their unit length", 0,
                          static_cast<double>(lost)});
    }
}

}  // namespace
}  // namespace samara
