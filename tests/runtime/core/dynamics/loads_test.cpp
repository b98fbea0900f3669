#include "samara/core/dynamics/loads.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "samara/core/surface/octahedral_map.hpp"
#include "support/known_bodies.hpp"
#include "support/reference_step.hpp"

namespace samara {
namespace {

Vector3d random_vector(std::mt19937& generator) {
    std::normal_distribution<double> normal;
    const double x = normal(generator);
    const double y = normal(generator);
    return {x, y, normal(generator)};
}

/// Force and moment about the centroid on a body in a steady translation, the Kirchhoff moment included.
Vector6d tow(const ImmersedBody& body, const Vector3d& velocity) {
    Vector6d motion = Vector6d::Zero();
    motion.tail<3>() = velocity;
    Vector6d load = -load_matrix(body, motion) * motion;
    load.head<3>() += (body.added_mass * velocity).cross(velocity);
    return load;
}

/// The loads' force on a body in a steady translation.
Vector3d steady_force(const ImmersedBody& body, const Vector3d& velocity) {
    return tow(body, velocity).tail<3>();
}

TEST(TableLoads, ASteadyTranslationReproducesTheTabulatedForceAndMomentExactly) {
    const ImmersedBody body = test::blunt_ellipsoid();
    const double length = body.length;
    std::mt19937 generator(1);
    for (int i = 0; i < 200; ++i) {
        // Nodes first, then directions and Reynolds numbers between them.
        const Vector3d direction =
            i < 81 ? octahedral_node(4, i / 9, i % 9) : random_vector(generator).normalized();
        const double reynolds = i < 81 ? 1e5 : std::pow(10.0, 3.0 + 2.0 * (i - 81) / 119.0);
        const double speed = reynolds * body.viscosity / (body.fluid_density * length);
        const LoadEntry entry = look_up(*body.tables, direction, reynolds);
        const double pressure = 0.5 * body.fluid_density * speed * speed * body.reference_area;
        const Vector6d load = tow(body, speed * direction);
        EXPECT_LT((load.tail<3>() - pressure * entry.force).norm(), 1e-12 * pressure);
        EXPECT_LT((load.head<3>() - pressure * length * entry.moment).norm(), 1e-12 * pressure * length);
    }
}

TEST(TableLoads, AreHeldAboveTheTableAndTendToStokesBelowIt) {
    const ImmersedBody body = test::blunt_ellipsoid();
    const Vector3d direction = Vector3d(1, 2, 3).normalized();
    const auto speed_at = [&](double reynolds) {
        return reynolds * body.viscosity / (body.fluid_density * body.length);
    };
    const Vector3d edge = tow(body, speed_at(1e5) * direction).tail<3>();
    const Vector3d beyond = tow(body, speed_at(1e6) * direction).tail<3>();
    EXPECT_LT((beyond - 100.0 * edge).norm(), 1e-10 * beyond.norm());

    const double slow = speed_at(1e-3);
    const double stokes = 3.0 * std::numbers::pi * body.viscosity * body.length * slow;
    EXPECT_NEAR(-tow(body, slow * direction).tail<3>().dot(direction) / stokes, 1.0, 1e-4);
}

TEST(Loads, NeverMakeEnergyInStillFluid) {
    const ImmersedBody table = test::blunt_ellipsoid();
    ImmersedBody coefficients = table;
    coefficients.loads = Loads::coefficients;
    coefficients.coefficients.lift_coefficient = 3.0;
    coefficients.coefficients.reference_area = 1e-3;
    coefficients.coefficients.center_of_pressure = Vector3d(0.01, 0.02, -0.01);
    prepare(coefficients);
    const std::array bodies = {table, test::lopsided_body(), coefficients};
    std::mt19937 generator(2);
    for (int i = 0; i < 2000; ++i) {
        Vector6d motion;
        const double rate = std::pow(10.0, i % 7 - 3);
        motion << rate * random_vector(generator), 0.2 * random_vector(generator);
        for (const ImmersedBody& body : bodies) {
            const Matrix6d matrix = load_matrix(body, motion);
            const Matrix6d symmetric = 0.5 * (matrix + matrix.transpose());
            const Vector6d eigenvalues = Eigen::SelfAdjointEigenSolver<Matrix6d>(symmetric).eigenvalues();
            EXPECT_GE(eigenvalues.minCoeff(), -1e-13 * eigenvalues.maxCoeff());
        }
    }
}

TEST(CoefficientLoads, HaveNoSingularityNorJumpAndDoNotSeeTheSignOfTheNormal) {
    ImmersedBody body = test::blunt_ellipsoid();
    body.loads = Loads::coefficients;
    body.coefficients.lift_coefficient = 1.0;
    body.coefficients.reference_area = 1e-3;
    body.coefficients.normal = Vector3d::UnitX();
    prepare(body);
    ImmersedBody flipped = body;
    flipped.coefficients.normal = -Vector3d::UnitX();
    prepare(flipped);

    const Vector3d along = steady_force(body, Vector3d::UnitX());
    EXPECT_LT(along.tail<2>().norm(), 1e-15);
    for (int i = 0; i <= 360; ++i) {
        const double angle = i * std::numbers::pi / 180.0;
        const Vector3d direction(std::cos(angle), std::sin(angle), 0.0);
        const Vector3d next(std::cos(angle + 1e-6), std::sin(angle + 1e-6), 0.0);
        const Vector3d force = steady_force(body, direction);
        EXPECT_EQ(force, steady_force(flipped, direction));
        // Drag rotates at the rate C_d = 1, lift changes by at most 2 C_l = 2.
        EXPECT_LT((steady_force(body, next) - force).norm(), 3.01e-6 * along.norm());
        // The lift is C_l sin 2 alpha of the incidence alpha of the plate: 90 degrees less the angle to its
        // normal.
        const Vector3d across(-direction.y(), direction.x(), 0.0);
        EXPECT_NEAR(force.dot(across) / along.norm(), std::sin(2.0 * angle), 1e-12);
    }
}

TEST(CoefficientLoads, TakeTheProjectedAreaWhereNoneIsGiven) {
    Body body = test::rubber_ellipsoid();
    SceneBody given = test::scene_body(1200.0);
    given.loads = Loads::coefficients;
    const ImmersedBody immersed = make_immersed_body(body, given, Fluid{});
    const double broadside = std::numbers::pi * 0.02 * 0.04;
    const double force = -steady_force(immersed, Vector3d::UnitX()).x();
    EXPECT_NEAR(force / (0.5 * 998.2 * broadside), 1.0, 0.01);
}

}  // namespace
}  // namespace samara
