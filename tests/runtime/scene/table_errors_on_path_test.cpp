#include "samara/scene/table_errors_on_path.hpp"

#include <gtest/gtest.h>

#include "samara/scene/scene_simulation.hpp"
#include "support/known_bodies.hpp"

namespace samara {
namespace {

/// The rubber ellipsoid with errors of 20 % of every force and 50 % of k.
Body uncertain_ellipsoid() {
    Body body = test::rubber_ellipsoid();
    LoadTables tables = test::blunt_tables(body, 4);
    for (std::size_t i = 0; i < tables.entries.size(); ++i) {
        tables.errors[i].force = 0.2 * tables.entries[i].force.cwiseAbs();
        tables.errors[i].turbulent_kinetic_energy = 0.5 * tables.entries[i].turbulent_kinetic_energy;
    }
    body.tables = tables;
    return body;
}

SceneBody turbulent_scene_body() {
    SceneBody given = test::scene_body(1200.0);
    given.name = "rubber";
    given.turbulence = Turbulence::table;
    return given;
}

ImmersedBody immersed(const SceneBody& given) {
    return make_immersed_body(uncertain_ellipsoid(), given, Fluid{});
}

Pose moving(const Vector3d& velocity) {
    Pose pose;
    pose.velocity = velocity;
    return pose;
}

TEST(TableErrorsOnPath, AreThoseOfTheTableOverItsValues) {
    const ImmersedBody body = immersed(turbulent_scene_body());
    const TableErrorsOnPath errors = table_errors_on_path(body, moving(Vector3d(0.1, 0.0, 0.0)));
    EXPECT_EQ(errors.forces, 1U);
    EXPECT_NEAR(errors.force, 0.2, 1e-12);
    EXPECT_EQ(errors.turbulent_kinetic_energies, 1U);
    EXPECT_NEAR(errors.turbulent_kinetic_energy, 0.5, 1e-12);
}

TEST(TableErrorsOnPath, AreLookedUpInBodyAxes) {
    Body body = uncertain_ellipsoid();
    LoadTables& tables = *body.tables;
    // Errors along x alone, so that they show in the direction in which x leads.
    for (LoadEntryError& error : tables.errors) error.force = Vector3d(error.force.x(), 0.0, 0.0);
    const ImmersedBody immersed_body = make_immersed_body(body, turbulent_scene_body(), Fluid{});
    Pose pose = moving(Vector3d(0.0, 0.0, 0.1));
    EXPECT_NEAR(table_errors_on_path(immersed_body, pose).force, 0.0, 1e-12);
    pose.orientation = Quaterniond::FromTwoVectors(Vector3d::UnitX(), Vector3d::UnitZ());
    EXPECT_NEAR(table_errors_on_path(immersed_body, pose).force, 0.2, 1e-12);
}

TEST(TableErrorsOnPath, AreNoneAtRestNorWithoutTables) {
    EXPECT_EQ(table_errors_on_path(immersed(turbulent_scene_body()), moving(Vector3d::Zero())).forces, 0U);
    SceneBody without = turbulent_scene_body();
    without.loads = Loads::none;
    const TableErrorsOnPath errors = table_errors_on_path(immersed(without), moving(Vector3d::UnitX()));
    EXPECT_EQ(errors.forces, 0U);
    EXPECT_EQ(errors.mean_force(), 0.0);
    EXPECT_EQ(errors.turbulent_kinetic_energies, 1U);
    EXPECT_EQ(table_errors_on_path(test::ideal_ellipsoid(), moving(Vector3d::UnitX())).forces, 0U);
}

TEST(TableErrorsOnPath, AlongAFlightAreTheSameForAnyNumberOfThreads) {
    Scene scene;
    scene.duration = 0.5;
    scene.bodies.push_back(turbulent_scene_body());
    scene.bodies[0].count = 600;
    scene.bodies[0].spread_angle = 0.5;
    const auto flown = [&](int threads) {
        const auto go_on = [](double, double) { return true; };
        return simulate(scene, {{uncertain_ellipsoid(), "hash"}}, 1, go_on, threads)
            .report.bodies[0]
            .table_errors;
    };
    const TableErrorsOnPath one = flown(1);
    const TableErrorsOnPath two = flown(2);
    EXPECT_EQ(one.force, two.force);
    EXPECT_EQ(one.turbulent_kinetic_energy, two.turbulent_kinetic_energy);
    EXPECT_EQ(one.forces, two.forces);
    EXPECT_GT(one.forces, 600U * 10U);
    EXPECT_NEAR(one.mean_force(), 0.2, 0.01);
    EXPECT_NEAR(one.mean_turbulent_kinetic_energy(), 0.5, 1e-9);
}

}  // namespace
}  // namespace samara
