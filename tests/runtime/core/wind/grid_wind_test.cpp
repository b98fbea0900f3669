#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "samara/core/wind/wind_field.hpp"

namespace samara {
namespace {

using Formula = std::function<Vector3d(const Vector3d& place, double time)>;

WindFile grid_of(const Formula& formula, double spacing = 0.25, std::array<std::size_t, 3> nodes = {9, 7, 8},
                 std::size_t frames = 6, double interval = 0.1) {
    auto grid = std::make_shared<WindGrid>();
    grid->origin = Vector3d(-1.0, -0.5, 0.25);
    grid->spacing = Vector3d(spacing, 1.5 * spacing, 0.8 * spacing);
    grid->nodes = nodes;
    grid->frames = frames;
    grid->interval = interval;
    for (std::size_t t = 0; t < frames; ++t) {
        for (std::size_t z = 0; z < nodes[2]; ++z) {
            for (std::size_t y = 0; y < nodes[1]; ++y) {
                for (std::size_t x = 0; x < nodes[0]; ++x) {
                    const Vector3d steps(static_cast<double>(x), static_cast<double>(y),
                                         static_cast<double>(z));
                    const Vector3d velocity = formula(grid->origin + steps.cwiseProduct(grid->spacing),
                                                      interval * static_cast<double>(t));
                    for (const double value : velocity) grid->velocities.push_back(static_cast<float>(value));
                }
            }
        }
    }
    return {.grid = grid};
}

Vector3d linear(const Vector3d& p, double t) {
    return {1.0 + 0.5 * p.x() - 2.0 * p.z() + t, p.y() - 0.25 * p.x() + 2.0 * t, 3.0 * p.z() + 0.75 * p.y()};
}

Vector3d swirl(const Vector3d& p, double t) {
    return {std::sin(2.0 * p.y() + t), std::cos(1.5 * p.z()) + p.x(), std::sin(p.x() - 2.0 * t)};
}

TEST(GridWind, IsExactForWhatIsLinearInPlaceAndTime) {
    const WindFile file = grid_of(linear);
    const double tolerance = 2e-6;  // of single precision
    for (const Vector3d& place :
         {Vector3d(-1.0, -0.5, 0.25), Vector3d(-0.3, 0.4, 0.9), Vector3d(0.99, 1.7, 1.6)}) {
        for (const double time : {0.0, 0.13, 0.5}) {
            const GridWind there = grid_wind(file, place, time);
            EXPECT_LT((there.velocity - linear(place, time)).norm(), tolerance);
            Matrix3d gradient;
            gradient << 0.5, 0.0, -2.0, -0.25, 1.0, 0.0, 0.0, 0.75, 3.0;
            EXPECT_LT((there.gradient - gradient).norm(), 30.0 * tolerance);
            EXPECT_LT((there.rate - Vector3d(1.0, 2.0, 0.0)).norm(), 30.0 * tolerance);
        }
    }
}

TEST(GridWind, ItsErrorFallsWithTheThirdPowerOfTheSpacing) {
    const Vector3d place(-0.31, 0.17, 0.71);
    double errors[2];
    double slopes[2];
    for (int fine = 0; fine < 2; ++fine) {
        const double spacing = fine == 0 ? 0.2 : 0.1;
        const std::size_t n = fine == 0 ? 12 : 23;
        double sum = 0.0;
        double slope_sum = 0.0;
        for (int i = 0; i < 40; ++i) {
            const Vector3d at = place + 0.01 * i * Vector3d(1.0, 0.7, 0.4);
            const GridWind there = grid_wind(grid_of(swirl, spacing, {n, n, n}, 1), at, 0.0);
            sum += (there.velocity - swirl(at, 0.0)).squaredNorm();
            Matrix3d gradient = Matrix3d::Zero();
            gradient(0, 1) = 2.0 * std::cos(2.0 * at.y());
            gradient(1, 0) = 1.0;
            gradient(1, 2) = -1.5 * std::sin(1.5 * at.z());
            gradient(2, 0) = std::cos(at.x());
            slope_sum += (there.gradient - gradient).squaredNorm();
        }
        errors[fine] = std::sqrt(sum);
        slopes[fine] = std::sqrt(slope_sum);
    }
    EXPECT_GT(errors[0] / errors[1], 6.0);
    EXPECT_GT(slopes[0] / slopes[1], 3.0);
}

TEST(GridWind, ItsGradientAndRateAreThoseOfItsVelocityAndContinuous) {
    const WindFile file = grid_of(swirl);
    constexpr double d = 1e-5;
    for (const Vector3d& place :
         {Vector3d(-0.6, 0.3, 0.8), Vector3d(-1.0 + 1e-7, 0.3, 0.8), Vector3d(-0.5, 0.25, 0.85)}) {
        for (const double time : {0.02, 0.1, 0.2999999}) {
            const GridWind there = grid_wind(file, place, time);
            for (int axis = 0; axis < 3; ++axis) {
                const Vector3d step = d * Vector3d::Unit(axis);
                const GridWind after = grid_wind(file, place + step, time);
                const Vector3d mean = 0.5 * (there.gradient.col(axis) + after.gradient.col(axis));
                EXPECT_LT(((after.velocity - there.velocity) / d - mean).norm(), 1e-3);
                EXPECT_LT((after.gradient - there.gradient).norm(), 1e-2);
            }
            const GridWind later = grid_wind(file, place, time + d);
            EXPECT_LT(((later.velocity - there.velocity) / d - there.rate).norm(), 1e-2);
            EXPECT_LT((later.rate - there.rate).norm(), 1e-2);
        }
    }
}

TEST(GridWind, BeyondTheEdgeItIsThatOfTheEdgeOrFallsToNothing) {
    WindFile file = grid_of(linear);
    const Vector3d edge(1.0, 0.5, 1.0);  // the last node along x
    const Vector3d beyond(3.0, 0.5, 1.0);
    EXPECT_EQ(grid_wind(file, beyond, 0.2).velocity, grid_wind(file, edge, 0.2).velocity);
    EXPECT_EQ(grid_wind(file, beyond, 0.2).gradient.col(0), Vector3d::Zero());
    EXPECT_NE(grid_wind(file, beyond, 0.2).gradient.col(2), Vector3d::Zero());
    file.outside = WindFile::Outside::still;
    EXPECT_EQ(grid_wind(file, edge + Vector3d(0.25, 0.0, 0.0), 0.2).velocity, Vector3d::Zero());
    EXPECT_EQ(grid_wind(file, beyond, 0.2).velocity, Vector3d::Zero());
    EXPECT_EQ(grid_wind(file, beyond, 0.2).gradient, Matrix3d::Zero());
    const Vector3d within(0.3, 0.5, 1.0);
    EXPECT_LT((grid_wind(file, within, 0.2).velocity - linear(within, 0.2)).norm(), 1e-5);
}

TEST(GridWind, BeforeAndAfterItsTimesItStaysOrBeginsAnew) {
    WindFile file = grid_of([](const Vector3d&, double t) {
        return Vector3d(std::cos(2.0 * 3.14159265358979 * t / 0.6), 0.0, 0.0);
    });
    file.start = 1.0;
    const Vector3d place(0.0, 0.0, 1.0);
    const auto at = [&](double time) { return grid_wind(file, place, time); };
    EXPECT_EQ(at(0.2).velocity, at(1.0).velocity);
    EXPECT_EQ(at(0.2).rate, Vector3d::Zero());
    EXPECT_EQ(at(9.0).velocity, at(1.5).velocity);
    file.repeats = true;
    for (const double time : {1.0, 1.07, 1.55, 1.59}) {
        EXPECT_NEAR(at(time).velocity.x(), at(time + 0.6).velocity.x(), 1e-12);
        EXPECT_NEAR(at(time).velocity.x(), at(time - 1.2).velocity.x(), 1e-12);
        EXPECT_NEAR(at(time).velocity.x(), std::cos(2.0 * 3.14159265358979 * (time - 1.0) / 0.6), 0.03);
    }
}

TEST(GridWind, IsMovedWithItsOrigin) {
    WindFile file = grid_of(swirl);
    const Vector3d place(-0.4, 0.2, 0.8);
    const Vector3d before = grid_wind(file, place, 0.2).velocity;
    file.position = Vector3d(10.0, -20.0, 5.0);
    EXPECT_LT((grid_wind(file, place + file.position, 0.2).velocity - before).norm(), 1e-6);
}

TEST(GridWind, OneNodeIsTheSameEverywhere) {
    const WindFile file =
        grid_of([](const Vector3d&, double) { return Vector3d(1.0, 2.0, 3.0); }, 1.0, {1, 1, 1}, 1);
    for (const double time : {-1.0, 0.0, 7.0}) {
        const GridWind there = grid_wind(file, Vector3d(time, 5.0, -3.0), time);
        EXPECT_EQ(there.velocity, Vector3d(1.0, 2.0, 3.0));
        EXPECT_EQ(there.gradient, Matrix3d::Zero());
        EXPECT_EQ(there.rate, Vector3d::Zero());
    }
}

}  // namespace
}  // namespace samara
