// The wind that a body meets beside surfaces.
#include "samara/core/dynamics/body_wind.hpp"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "support/known_bodies.hpp"
#include "support/obstacles.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

constexpr double height = 0.1;
constexpr double roughness = 1e-3;

/// A wind of 3 m/s along x.
Surroundings windy(std::optional<WindSurfaceLayer> layer = WindSurfaceLayer{}) {
    Wind wind;
    wind.velocity = Vector3d(3.0, 0.0, 0.0);
    wind.surface_layer = layer;
    Surroundings surroundings;
    surroundings.wind = std::make_shared<const WindField>(wind, Vector3d::Zero());
    return surroundings;
}

double speed_at(const Surroundings& surroundings, const Vector3d& place, double time = 0.0) {
    return wind_velocity(test::blunt_ellipsoid(), surroundings, place, time).x();
}

Surroundings with_obstacle(const Obstacle& obstacle) {
    Surroundings surroundings = windy();
    surroundings.obstacles = std::make_shared<const ObstacleSet>(std::vector<Obstacle>{obstacle});
    return surroundings;
}

double logarithmic(double distance) {
    return 3.0 * std::log(1.0 + distance / roughness) / std::log(1.0 + height / roughness);
}

TEST(BodyWind, FallsOffTowardsTheGroundByTheLogarithmicLaw) {
    Surroundings surroundings = windy();
    surroundings.ground = -2.0;
    for (const double distance : {0.001, 0.005, 0.03, 0.099}) {
        EXPECT_NEAR(speed_at(surroundings, {7.0, 1.0, -2.0 + distance}), logarithmic(distance), 1e-12);
    }
    EXPECT_EQ(speed_at(surroundings, {0.0, 0.0, -2.0}), 0.0);
    EXPECT_EQ(speed_at(surroundings, {0.0, 0.0, -3.0}), 0.0);
}

TEST(BodyWind, IsWholeToTheLastBitAboveTheLayerAndWithoutOne) {
    Surroundings surroundings = windy();
    surroundings.ground = 0.0;
    EXPECT_EQ(speed_at(surroundings, {0.0, 0.0, height}), 3.0);
    surroundings = windy(WindSurfaceLayer{.height = 0.0});
    surroundings.ground = 0.0;
    EXPECT_EQ(speed_at(surroundings, {0.0, 0.0, 1e-4}), 3.0);
    EXPECT_EQ(speed_at(windy(), {0.0, 0.0, 1e-4}), 3.0);
}

TEST(BodyWind, FallsOffOnBothSidesOfASheetAndBesideItsEdge) {
    const Surroundings surroundings = with_obstacle(test::obstacle(test::sheet(2.0, 2.0), {}, 0.5));
    EXPECT_NEAR(speed_at(surroundings, {0.2, 0.1, 0.01}), logarithmic(0.01), 1e-12);
    EXPECT_NEAR(speed_at(surroundings, {0.2, 0.1, -0.01}), logarithmic(0.01), 1e-12);
    EXPECT_NEAR(speed_at(surroundings, {1.03, 0.0, 0.04}), logarithmic(0.05), 1e-12);
    EXPECT_EQ(speed_at(surroundings, {1.2, 0.0, 0.0}), 3.0);
}

TEST(BodyWind, StandsInsideASolid) {
    const Surroundings surroundings = with_obstacle(test::obstacle(test::box({2.0, 2.0, 2.0}, 1), {}, 0.5));
    EXPECT_EQ(speed_at(surroundings, {0.0, 0.0, 0.95}), 0.0);
    EXPECT_NEAR(speed_at(surroundings, {0.0, 0.0, 1.02}), logarithmic(0.02), 1e-12);
}

TEST(BodyWind, IsThatOfTheNearerOfGroundAndObstacleWhereThisIsThen) {
    Obstacle slab = test::obstacle(test::sheet(2.0, 2.0), {}, 0.5);
    slab.keys = {{}, {}};
    slab.keys[1].time = 1.0;
    slab.keys[1].position = Vector3d(0.0, 0.0, 1.0);
    Surroundings surroundings = with_obstacle(slab);
    surroundings.ground = 0.95;
    EXPECT_NEAR(speed_at(surroundings, {0.0, 0.0, 1.02}, 0.0), logarithmic(0.07), 1e-12);
    EXPECT_NEAR(speed_at(surroundings, {0.0, 0.0, 1.02}, 1.0), logarithmic(0.02), 1e-12);
}

}  // namespace
}  // namespace samara
