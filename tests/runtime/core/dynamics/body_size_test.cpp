#include "samara/core/dynamics/body_size.hpp"

#include <gtest/gtest.h>

#include "samara/core/integrator/batch.hpp"
#include "support/known_bodies.hpp"

namespace samara {
namespace {

constexpr int steps = 400;

ImmersedBody noisy_ellipsoid() {
    ImmersedBody body = test::blunt_ellipsoid(Vector3d(0.001, 0.002, 0.003));
    body.turbulence = Turbulence::constant;
    body.turbulent_kinetic_energy = 1e-3;
    body.dissipation_rate = 1e-3;
    prepare(body);
    return body;
}

BodyState flown(const ImmersedBody& body, double size, const Surroundings& surroundings, double step) {
    Batch batch(body, 1);
    batch.set_sizes({size}, false);
    batch.set_state(0, in_world_units(test::tumbling_state(0.3, 5.0), size));
    batch.advance(surroundings, 0.0, step, 0, steps);
    return batch.state(0);
}

TEST(BodySize, TwiceTheSizeAtFourTimesTheTimeInAnEighthOfTheGravityIsTheSameMotionToTheLastBit) {
    // Equal Reynolds numbers in the same fluid: U L; equal Froude numbers: U^2 / (g L).
    const ImmersedBody body = test::blunt_ellipsoid(Vector3d(0.001, 0.002, 0.003));
    const Surroundings one{.gravity = {0.0, 0.0, -9.6}};
    const Surroundings eighth{.gravity = {0.0, 0.0, -1.2}};
    const BodyState small = flown(body, 1.0, one, 0.002);
    const BodyState large = flown(body, 2.0, eighth, 0.008);
    EXPECT_EQ(large.position, 2.0 * small.position);
    EXPECT_EQ(large.orientation.coeffs(), small.orientation.coeffs());
    EXPECT_EQ((large.velocity.head<3>()), (0.25 * small.velocity.head<3>()));
    EXPECT_EQ((large.velocity.tail<3>()), (0.5 * small.velocity.tail<3>()));
}

TEST(BodySize, AnUnevenSizeObeysTheSameSimilarityToRounding) {
    const ImmersedBody body = test::blunt_ellipsoid();
    const double size = 1.37;
    const Surroundings one{.gravity = {0.0, 0.0, -9.81}};
    const Surroundings other{.gravity = one.gravity / (size * size * size)};
    const BodyState small = flown(body, 1.0, one, 0.002);
    const BodyState large = flown(body, size, other, 0.002 * size * size);
    EXPECT_LT((large.position / size - small.position).norm(), 1e-9 * small.position.norm());
    EXPECT_LT((large.velocity.tail<3>() * size - small.velocity.tail<3>()).norm(), 1e-8);
}

TEST(BodySize, WithoutLoadsEverySizeFallsAlike) {
    ImmersedBody body = test::ideal_ellipsoid();
    const Surroundings surroundings{.gravity = {0.0, 0.0, -9.81}};
    Batch batch(body, 2);
    batch.set_sizes({1.0, 3.0}, false);
    batch.advance(surroundings, 0.0, 0.002, 0, 500);
    const double acceleration = 9.81 * (body.mass - body.fluid_density * body.volume) / body.inertia(5, 5);
    EXPECT_NEAR(batch.state(0).position.z(), -0.5 * acceleration, 1e-9);
    EXPECT_NEAR(batch.state(1).position.z(), -0.5 * acceleration, 1e-9);
}

TEST(BodySize, ABodyMovesAlikeAloneAndAmongOtherSizes) {
    const ImmersedBody body = noisy_ellipsoid();
    const Surroundings surroundings{.gravity = {0.0, 0.0, -9.81}};
    std::vector<double> sizes;
    for (int i = 0; i < 21; ++i) sizes.push_back(0.5 + 0.1 * i);
    Batch crowd(body, sizes.size());
    crowd.set_sizes(sizes, false);
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        crowd.set_state(i, test::tumbling_state(0.3, 5.0));
        crowd.set_noise(i, Noise(1, "leaf", 0, static_cast<std::uint32_t>(i)));
    }
    crowd.advance(surroundings, 0.0, 0.002, 0, 200);
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        Batch alone(body, 1);
        alone.set_sizes({sizes[i]}, false);
        alone.set_state(0, test::tumbling_state(0.3, 5.0));
        alone.set_noise(0, Noise(1, "leaf", 0, static_cast<std::uint32_t>(i)));
        alone.advance(surroundings, 0.0, 0.002, 0, 77);
        alone.advance(surroundings, 0.0, 0.002, 77, 123);
        EXPECT_EQ(alone.state(0).position, crowd.state(i).position);
        EXPECT_EQ(alone.state(0).velocity, crowd.state(i).velocity);
    }
}

TEST(BodySize, SizesOfOneGiveTheBytesOfABatchWithoutSizes) {
    const ImmersedBody body = noisy_ellipsoid();
    const Surroundings surroundings{.gravity = {0.0, 0.0, -9.81}};
    Batch plain(body, 5);
    Batch sized(body, 5);
    sized.set_sizes({1.0, 1.0, 1.0, 1.0, 1.0}, false);
    for (std::size_t i = 0; i < 5; ++i) {
        plain.set_state(i, test::tumbling_state(0.3, 5.0));
        sized.set_state(i, test::tumbling_state(0.3, 5.0));
    }
    plain.advance(surroundings, 0.0, 0.002, 0, 300);
    sized.advance(surroundings, 0.0, 0.002, 0, 300);
    for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(plain.state(i).velocity, sized.state(i).velocity);
}

}  // namespace
}  // namespace samara
