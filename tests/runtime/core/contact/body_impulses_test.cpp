#include "samara/core/contact/body_impulses.hpp"

#include <random>

#include <gtest/gtest.h>

#include "support/ground_bodies.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

// Where it spins besides, the share of each corner in the weight is not determined, nor is friction's moment.
TEST(BodyImpulses, GiveABlockThatSlidesTheSameVelocityFromAnyGuess) {
    const ImmersedBody block = test::uniform_body(test::box({0.04, 0.03, 0.01}, 2), 700.0,
                                                  {.density = 1.2, .viscosity = 1.8e-5}, Loads::none);
    std::mt19937 random(1);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution(low, high)(random);
    };
    ContactSet near(Matrix3d::Identity());
    near.add_ground(block.contact_points, 0.005, 0.01);
    const Approach approach{.margin = 0.01, .touching = 1e-7, .time_step = 0.002};
    for (int i = 0; i < 200; ++i) {
        Vector6d velocity;
        velocity << Vector3d::Zero(), between(-0.2, 0.2), between(-0.2, 0.2), -0.02;
        FoundImpulses found;
        const Vector6d after = after_impulses(block, near, approach, velocity, &found);
        ASSERT_GT(found.count, 0U);
        for (const double factor : {0.0, 0.5, 1.0, 4.0}) {
            FoundImpulses guess = found;
            guess.scale(factor);
            const Vector6d off = after_impulses(block, near, approach, velocity, &guess) - after;
            const double radius = block.contact_points.bounding_radius;
            EXPECT_LT(off.tail<3>().norm() + radius * off.head<3>().norm(), 1e-3 * velocity.norm())
                << "velocity " << i << ", guess " << factor;
        }
    }
}

}  // namespace
}  // namespace samara
