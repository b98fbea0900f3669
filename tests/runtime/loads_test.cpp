#include "samara/dynamics/loads.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "samara/body/octahedral_map.hpp"
#include "support/known_bodies.hpp"

namespace samara {
namespace {

Vector3d random_vector(std::mt19937& generator) {
    std::normal_distribution<double> normal;
    const double x = normal(generator);
    const double y = normal(generator);
    return {x, y, normal(generator)};
}

/// Force and moment about the centroid on a body in a steady tow, the Kirchhoff moment included.
Vector6d tow(const ImmersedBody& body, const Vector3d& velocity) {
    Vector6d motion = Vector6d::Zero();
    motion.tail<3>() = velocity;
    Vector6d load = -load_matrix(body, motion) * motion;
    load.head<3>() += (body.added_mass * velocity).cross(velocity);
    return load;
}

/// The loads' force on a body in a tow.
Vector3d tow_force(const ImmersedBody& body, const Vector3d& velocity) {
    return tow(body, velocity).tail<3>();
}

TEST(TableLoads, ASteadyTowReproducesTheTabulatedForceAndMomentExactly) {
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
    ImmersedBody table = test::blunt_ellipsoid();
    ImmersedBody coefficients = table;
    coefficients.loads = Loads::coefficients;
    coefficients.coefficients.lift_coefficient = 3.0;
    coefficients.coefficients.reference_area = 1e-3;
    coefficients.coefficients.center_of_pressure = Vector3d(0.01, 0.02, -0.01);
    prepare(coefficients);
    std::mt19937 generator(2);
    for (int i = 0; i < 2000; ++i) {
        Vector6d motion;
        const double rate = std::pow(10.0, i % 7 - 3);
        motion << rate * random_vector(generator), 0.2 * random_vector(generator);
        for (const ImmersedBody* body : {&table, &coefficients}) {
            const Matrix6d matrix = load_matrix(*body, motion);
            const Matrix6d symmetric = 0.5 * (matrix + matrix.transpose());
            const Vector6d eigenvalues = Eigen::SelfAdjointEigenSolver<Matrix6d>(symmetric).eigenvalues();
            EXPECT_GE(eigenvalues.minCoeff(), -1e-13 * eigenvalues.maxCoeff());
        }
    }
}

/// A full tensor, positive semidefinite, of full rank or of the rank given.
Matrix3d random_semidefinite(std::mt19937& generator, double scale, int rank = 3) {
    Matrix3d tensor = Matrix3d::Zero();
    for (int i = 0; i < rank; ++i) {
        const Vector3d column = random_vector(generator);
        tensor += scale * column * column.transpose();
    }
    return tensor;
}

/// The blunt ellipsoid with these transport coefficients, and its drags in rotation scaled.
ImmersedBody with_transport(ImmersedBody body, double force_transport, double moment_transport,
                            double drag_factor) {
    body.dynamic.force_transport = force_transport;
    body.dynamic.moment_transport = moment_transport;
    body.dynamic.drag_in_motion *= drag_factor;
    body.dynamic.rotational_drag *= drag_factor;
    prepare(body);
    return body;
}

Vector6d random_motion(std::mt19937& generator, double rate) {
    Vector6d motion;
    motion << rate * random_vector(generator), 0.2 * random_vector(generator);
    return motion;
}

TEST(Transport, OfDifferentCoefficientsNeverMakesEnergyWhateverTheDrags) {
    std::mt19937 generator(3);
    std::uniform_real_distribution<double> coefficient(-3.0, 3.0);
    ImmersedBody body = test::blunt_ellipsoid();
    double most_work = 0.0;
    for (int i = 0; i < 3000; ++i) {
        const double scale = std::pow(10.0, i % 9 - 6);
        body.dynamic.drag_in_motion = random_semidefinite(generator, 1e-3 * scale, 1 + i % 3);
        body.dynamic.rotational_drag = random_semidefinite(generator, 1e-6 * scale, 1 + i / 3 % 3);
        const double force = coefficient(generator);
        const double moment = coefficient(generator);
        const ImmersedBody working = with_transport(body, force, moment, 1.0);
        const double mean = 0.5 * (force + moment);
        const ImmersedBody workless = with_transport(body, mean, mean, 1.0);
        const Vector6d motion = random_motion(generator, std::pow(10.0, i % 7 - 3));
        const Matrix6d matrix = load_matrix(working, motion);
        const Matrix6d symmetric = 0.5 * (matrix + matrix.transpose());
        const Vector6d eigenvalues = Eigen::SelfAdjointEigenSolver<Matrix6d>(symmetric).eigenvalues();
        EXPECT_GE(eigenvalues.minCoeff(), -1e-13 * eigenvalues.maxCoeff());
        const Matrix6d working_part = matrix - load_matrix(workless, motion);
        most_work =
            std::max(most_work, std::abs(motion.dot(working_part * motion)) / motion.dot(symmetric * motion));
    }
    EXPECT_GT(most_work, 0.05);  // it is there
}

TEST(Transport, DoesTheWorkOfTheDifferenceWhereDragIsPlentifulAndNoneWithoutDrag) {
    std::mt19937 generator(4);
    constexpr double force = 0.3;
    constexpr double moment = 0.8;
    constexpr double mean = 0.5 * (force + moment);
    ImmersedBody body = test::blunt_ellipsoid();
    body.dynamic.drag_in_motion = 1e-3 * Matrix3d::Identity() + random_semidefinite(generator, 1e-3);
    body.dynamic.rotational_drag = 1e-6 * Matrix3d::Identity() + random_semidefinite(generator, 1e-6);
    const ImmersedBody plentiful = with_transport(body, force, moment, 1e3);
    const ImmersedBody plentiful_workless = with_transport(body, mean, mean, 1e3);
    const ImmersedBody scarce = with_transport(body, force, moment, 0.0);
    const ImmersedBody scarce_workless = with_transport(body, mean, mean, 0.0);
    for (int i = 0; i < 300; ++i) {
        const Vector6d motion = random_motion(generator, 30.0);
        const Vector3d omega = motion.head<3>();
        const Vector3d v = motion.tail<3>();
        const Vector3d momentum = body.added_mass * v;
        const Matrix6d part = load_matrix(plentiful, motion) - load_matrix(plentiful_workless, motion);
        const double scale = omega.norm() * v.norm() * momentum.norm();
        EXPECT_NEAR(-motion.dot(part * motion), (moment - force) * omega.dot(v.cross(momentum)),
                    1e-9 * scale);
        // The mean itself does no work, so that without drag nothing is left.
        const Matrix6d none = load_matrix(scarce, motion) - load_matrix(scarce_workless, motion);
        EXPECT_NEAR(motion.dot(none * motion), 0.0, 1e-13 * scale);
    }
}

TEST(Transport, GivesTheForceAndTheMomentOfItsCoefficientsWhereDragIsPlentiful) {
    std::mt19937 generator(5);
    const ImmersedBody body = test::blunt_ellipsoid();
    const ImmersedBody with = with_transport(body, 0.3, 0.8, 1e4);
    const ImmersedBody without = with_transport(body, 0.55, 0.55, 1e4);
    for (int i = 0; i < 300; ++i) {
        const Vector6d motion = random_motion(generator, 30.0);
        const Vector3d omega = motion.head<3>();
        const Vector3d v = motion.tail<3>();
        const Vector3d momentum = body.added_mass * v;
        const Vector6d part = -(load_matrix(with, motion) - load_matrix(without, motion)) * motion;
        EXPECT_LT((part.tail<3>() - (0.3 - 0.55) * omega.cross(momentum)).norm(),
                  1e-7 * omega.norm() * momentum.norm());
        EXPECT_LT((part.head<3>() - (0.8 - 0.55) * v.cross(momentum)).norm(),
                  1e-7 * v.norm() * momentum.norm());
    }
}

TEST(Transport, OfDifferentCoefficientsLeavesTheSteadyTowAsItIsTabulated) {
    const ImmersedBody body = test::blunt_ellipsoid();
    std::mt19937 generator(6);
    for (int i = 0; i < 200; ++i) {
        const ImmersedBody other = with_transport(body, 0.1 * (i % 20), 1.3 - 0.1 * (i % 7), 1.0);
        const Vector3d direction = random_vector(generator).normalized();
        const double reynolds = std::pow(10.0, 3.0 + 2.0 * i / 199.0);
        const double speed = reynolds * body.viscosity / (body.fluid_density * body.length);
        const LoadEntry entry = look_up(*body.tables, direction, reynolds);
        const double pressure = 0.5 * body.fluid_density * speed * speed * body.reference_area;
        const Vector6d load = tow(other, speed * direction);
        EXPECT_LT((load.tail<3>() - pressure * entry.force).norm(), 1e-12 * pressure);
        EXPECT_LT((load.head<3>() - pressure * body.length * entry.moment).norm(),
                  1e-12 * pressure * body.length);
    }
}

TEST(Loads, AreFiniteAndVanishAtRest) {
    const ImmersedBody body = test::blunt_ellipsoid();
    const Matrix6d at_rest = load_matrix(body, Vector6d::Zero());
    EXPECT_TRUE(at_rest.allFinite());
    Vector6d faint = Vector6d::Constant(1e-300);
    EXPECT_TRUE(load_matrix(body, faint).allFinite());
    EXPECT_LT((load_matrix(body, Vector6d::Constant(1e-12)) - at_rest).norm(), 1e-9);
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

    const Vector3d along = tow_force(body, Vector3d::UnitX());
    EXPECT_LT(along.tail<2>().norm(), 1e-15);
    for (int i = 0; i <= 360; ++i) {
        const double angle = i * std::numbers::pi / 180.0;
        const Vector3d direction(std::cos(angle), std::sin(angle), 0.0);
        const Vector3d next(std::cos(angle + 1e-6), std::sin(angle + 1e-6), 0.0);
        const Vector3d force = tow_force(body, direction);
        EXPECT_EQ(force, tow_force(flipped, direction));
        // Drag turns at the rate C_d = 1, lift changes by at most 2 C_l = 2.
        EXPECT_LT((tow_force(body, next) - force).norm(), 3.01e-6 * along.norm());
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
    const double force = -tow_force(immersed, Vector3d::UnitX()).x();
    EXPECT_NEAR(force / (0.5 * 998.2 * broadside), 1.0, 0.01);
}

TEST(DynamicCoefficients, RotationalDragOfASphereIsZeroAndOfAnEllipsoidFollowsItsAxes) {
    const Body sphere = test::exact_sphere(0.1);
    const Matrix3d none = rotational_drag_tensor(sphere.surface, sphere.moments.centroid);
    EXPECT_LT(none.norm(), 3e-4 * std::pow(0.1, 4));  // flat triangles are not quite tangent to the sphere
    const Body ellipsoid = test::rubber_ellipsoid();
    const Matrix3d tensor = rotational_drag_tensor(ellipsoid.surface, ellipsoid.moments.centroid);
    EXPECT_GT(tensor(1, 1), tensor(0, 0));  // about y the long axis sweeps broadside
    EXPECT_GT(tensor(0, 0), 0.0);
    EXPECT_LT((tensor - Matrix3d(tensor.diagonal().asDiagonal())).norm(), 1e-9 * tensor.norm());
}

}  // namespace
}  // namespace samara
