#include "converter/tables/symmetric_loads.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "load_laws.hpp"
#include "symmetry_groups.hpp"

namespace samara {
namespace {

DirectionSample sample_with(const Vector3d& direction, const Vector3d& force, const Vector3d& moment) {
    DirectionSample sample{direction.normalized(), {}, {}};
    sample.entry.force = force;
    sample.entry.moment = moment;
    return sample;
}

TEST(TransformedLoads, AMirrorKeepsTheMomentAcrossItAndTurnsThatWithinIt) {
    const LoadEntry mirrored =
        transformed({Vector3d(1, 2, 3), Vector3d(4, 5, 6), 0.1, 0.2}, Vector3d(-1, 1, 1).asDiagonal());
    EXPECT_EQ(mirrored.force, Vector3d(-1, 2, 3));
    EXPECT_EQ(mirrored.moment, Vector3d(4, -5, -6));
    EXPECT_EQ(mirrored.turbulent_kinetic_energy, 0.1);
    EXPECT_EQ(mirrored.dissipation_rate, 0.2);
}

TEST(TransformedLoads, AMomentOfAForceTurnsAndMirrorsWithItsArm) {
    const Vector3d arm(0.3, -0.7, 0.2);
    const Vector3d force(1.0, 0.4, -2.0);
    for (const Matrix3d& element : test::cube_symmetry().elements) {
        const LoadEntry image = transformed({force, arm.cross(force), 0.0, 0.0}, element);
        EXPECT_LT((image.moment - (element * arm).cross(image.force)).norm(), 1e-14);
    }
}

TEST(TransformedLoads, ErrorsAddUpAsIndependentComponents) {
    const Matrix3d turn = Eigen::AngleAxisd(std::acos(0.6), Vector3d::UnitZ()).toRotationMatrix();
    const LoadEntryError error =
        transformed_error({Vector3d(0.5, 1.0, 0.3), Vector3d(0.1, 0.0, 0.0), 0.01, 0.02}, turn);
    EXPECT_NEAR(error.force.x(), std::hypot(0.6 * 0.5, 0.8 * 1.0), 1e-15);
    EXPECT_NEAR(error.force.y(), std::hypot(0.8 * 0.5, 0.6 * 1.0), 1e-15);
    EXPECT_NEAR(error.force.z(), 0.3, 1e-15);
    EXPECT_NEAR(error.moment.y(), 0.08, 1e-15);
    EXPECT_EQ(error.dissipation_rate, 0.02);
}

TEST(SymmetricPart, OfABoxAlongItsAxisIsDragAlone) {
    std::vector<DirectionSample> samples = {
        sample_with(Vector3d::UnitX(), Vector3d(-1.0, 0.03, -0.04), Vector3d(0.01, 0.02, 0.02))};
    samples[0].error.force = Vector3d(0.1, 0.2, 0.3);
    keep_symmetric_part(test::box_symmetry(), samples);
    EXPECT_EQ(samples[0].entry.force, Vector3d(-1.0, 0.0, 0.0));
    EXPECT_EQ(samples[0].entry.moment, Vector3d(0.0, 0.0, 0.0));
    const double asymmetry = 0.05 / std::sqrt(2.0);  // two forbidden components
    EXPECT_NEAR(samples[0].error.force.x(), std::hypot(0.1, asymmetry), 1e-15);
    EXPECT_NEAR(samples[0].error.force.z(), std::hypot(0.3, asymmetry), 1e-15);
    EXPECT_NEAR(samples[0].error.moment.y(), 0.03 / std::sqrt(3.0), 1e-15);
}

TEST(SymmetricPart, OfABoxInAMirrorPlaneIsForceInThePlaneAndMomentAcrossIt) {
    std::vector<DirectionSample> samples = {
        sample_with(Vector3d(1, 2, 0), Vector3d(-1.0, -2.0, 0.5), Vector3d(0.1, 0.2, 0.7))};
    keep_symmetric_part(test::box_symmetry(), samples);
    EXPECT_EQ(samples[0].entry.force, Vector3d(-1.0, -2.0, 0.0));
    EXPECT_EQ(samples[0].entry.moment, Vector3d(0.0, 0.0, 0.7));
}

TEST(SymmetricPart, LeavesALoadThatHasTheSymmetryAsItIs) {
    const test::BoxLaw law;
    for (const Vector3d& d : {Vector3d(1, 0, 0), Vector3d(3, 4, 0), Vector3d(1, 2, 2)}) {
        std::vector<DirectionSample> samples = {{d.normalized(), law(d.normalized()), {}}};
        keep_symmetric_part(test::box_symmetry(), samples);
        EXPECT_LT(test::difference(samples[0].entry, law(d.normalized())), 1e-15);
        EXPECT_EQ(samples[0].error.force.norm(), 0.0);
    }
}

TEST(SymmetricPart, DirectionsWithoutSymmetryTakeTheErrorOfTheOthers) {
    std::vector<DirectionSample> samples = {
        sample_with(Vector3d(1, 2, 3), Vector3d(-1, -2, -3), Vector3d(0.1, 0.2, 0.3)),
        sample_with(Vector3d(1, 2, 0), Vector3d(-1, -2, 0.4), Vector3d::Zero()),
        sample_with(Vector3d(0, 2, 1), Vector3d(0.2, -2, -1), Vector3d::Zero())};
    keep_symmetric_part(test::box_symmetry(), samples);
    EXPECT_EQ(samples[0].entry.force, Vector3d(-1, -2, -3));
    EXPECT_EQ(samples[0].entry.moment, Vector3d(0.1, 0.2, 0.3));
    EXPECT_NEAR(samples[0].error.force.y(), std::sqrt((0.16 + 0.04) / 2.0), 1e-15);
    EXPECT_NEAR(samples[1].error.force.y(), 0.4, 1e-15);
    EXPECT_NEAR(samples[2].error.force.y(), 0.2, 1e-15);
}

TEST(SymmetricPart, OfABodyOfRevolutionLiesInThePlaneOfItsAxis) {
    Symmetry cone;
    cone.type = Symmetry::Type::axial;
    cone.axes = test::some_rotation();
    cone.axis = cone.axes.col(1);
    std::vector<DirectionSample> samples = {
        sample_with(Vector3d(1, 1, 0), Vector3d(-1, -2, 0.5), Vector3d(0.1, 0.2, 0.7)),
        sample_with(Vector3d(0, -1, 0), Vector3d(0.3, 2, 0.4), Vector3d(0.1, 0.2, 0.7))};
    keep_symmetric_part(cone, samples);
    EXPECT_LT((samples[0].entry.force - Vector3d(-1, -2, 0)).norm(), 1e-15);
    EXPECT_LT((samples[0].entry.moment - Vector3d(0, 0, 0.7)).norm(), 1e-15);
    EXPECT_EQ(samples[1].entry.force, Vector3d(0, 2, 0));
    EXPECT_EQ(samples[1].entry.moment, Vector3d(0, 0, 0));
    EXPECT_NEAR(samples[1].error.force.y(), 0.5 / std::sqrt(2.0), 1e-15);
}

TEST(SymmetricPart, OfACylinderBroadsideIsDragAlone) {
    Symmetry cylinder;
    cylinder.type = Symmetry::Type::axial;
    cylinder.elements.emplace_back(Vector3d(1, 1, -1).asDiagonal());
    std::vector<DirectionSample> samples = {
        sample_with(Vector3d::UnitX(), Vector3d(-1, 0.1, 0.2), Vector3d(0.1, 0.2, 0.7))};
    keep_symmetric_part(cylinder, samples);
    EXPECT_EQ(samples[0].entry.force, Vector3d(-1, 0, 0));
    EXPECT_EQ(samples[0].entry.moment, Vector3d(0, 0, 0));
}

TEST(SymmetricPart, OfASphereIsDragAloneWithItsSideForceAsError) {
    Symmetry sphere;
    sphere.type = Symmetry::Type::spherical;
    std::vector<DirectionSample> samples = {
        sample_with(Vector3d::UnitX(), Vector3d(-0.4, 0.03, 0.04), Vector3d(0.0, 0.003, 0.0))};
    keep_symmetric_part(sphere, samples);
    EXPECT_EQ(samples[0].entry.force, Vector3d(-0.4, 0, 0));
    EXPECT_EQ(samples[0].entry.moment, Vector3d(0, 0, 0));
    EXPECT_NEAR(samples[0].error.force.x(), 0.05 / std::sqrt(2.0), 1e-15);
}

}  // namespace
}  // namespace samara
