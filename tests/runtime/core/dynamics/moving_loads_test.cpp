// Loads of a rotating body: each term is as in docs/explanation/moving-loads.md, and does its work.

#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <vector>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "core/dynamics/moving_load_terms.hpp"
#include "samara/core/dynamics/loads.hpp"
#include "support/known_bodies.hpp"
#include "support/reference_step.hpp"

namespace samara {
namespace {

using namespace test;

Matrix3d random_symmetric(std::mt19937& generator, double scale) {
    Matrix3d factor;
    for (int i = 0; i < 3; ++i) factor.row(i) = scale * random_vector(generator);
    return factor + factor.transpose();
}

using Member = Matrix3d DynamicCoefficients::*;

/// What a coefficient alone adds: `keep` copies it from the lopsided body's to ones that are zero.
template <class Keep>
Vector6d added_by(const Keep& keep, const Vector6d& motion) {
    static const ImmersedBody full = test::lopsided_body();
    static const ImmersedBody without = bare(full, false);
    ImmersedBody with = without;
    keep(with.dynamic, full.dynamic);
    prepare(with);
    return loads_at(with, motion) - loads_at(without, motion);
}

struct Term {
    const char* name;
    std::function<void(DynamicCoefficients&, const DynamicCoefficients&)> keep;
    Vector6d (*formula)(const Motion&);
    bool workless;
};

std::function<void(DynamicCoefficients&, const DynamicCoefficients&)> keeping(Member member) {
    return [member](DynamicCoefficients& to, const DynamicCoefficients& from) { to.*member = from.*member; };
}

const std::vector<Term>& terms() {
    using Coefficients = DynamicCoefficients;
    static const std::vector<Term> all = {
        {"transport", keeping(&Coefficients::transport), transport, true},
        {"rotational transport",
         [](Coefficients& to, const Coefficients& from) {
             to.rotational_transport = from.rotational_transport;
         },
         rotational_transport, true},
        {"drag in motion", keeping(&Coefficients::drag_in_motion), drag_in_motion, false},
        {"drag in spin", keeping(&Coefficients::drag_in_spin), drag_in_spin, false},
        {"rotational drag", keeping(&Coefficients::rotational_drag), rotational_drag, false},
        {"rotational drag in spin", keeping(&Coefficients::rotational_drag_in_spin), rotational_drag_in_spin,
         false},
    };
    return all;
}

TEST(MovingLoads, EachTermIsItsFormula) {
    const ImmersedBody body = test::lopsided_body();
    for (const Term& term : terms()) {
        SCOPED_TRACE(term.name);
        std::mt19937 generator(1);
        for (int i = 0; i < 300; ++i) {
            const Vector6d motion = random_motion(generator, i);
            const Vector6d expected = term.formula(Motion(body, motion));
            const Vector6d added = added_by(term.keep, motion);
            // Without the moment of creeping rotation, which is subtracted again.
            const double rounding = 1e-12 * creeping_turn(Motion(body, motion)).norm();
            EXPECT_LT((added - expected).head<3>().norm(), 1e-12 * expected.head<3>().norm() + rounding);
            EXPECT_LT((added - expected).tail<3>().norm(), 1e-12 * expected.tail<3>().norm() + 1e-300);
        }
    }
}

TEST(MovingLoads, TransportAndWakeDoNoWorkAndTheDragsTakeEnergyAway) {
    const ImmersedBody body = test::lopsided_body();
    for (const Term& term : terms()) {
        SCOPED_TRACE(term.name);
        std::mt19937 generator(2);
        for (int i = 0; i < 300; ++i) {
            const Vector6d motion = random_motion(generator, i);
            const Vector6d added = added_by(term.keep, motion);
            const double power = motion.dot(added);
            if (term.workless) {
                const double scale = motion.head<3>().norm() * added.head<3>().norm() +
                                     motion.tail<3>().norm() * added.tail<3>().norm();
                const double creeping = motion.dot(creeping_turn(Motion(body, motion)));
                EXPECT_LT(std::abs(power), 1e-14 * scale + 1e-15 * std::abs(creeping));
            } else {
                EXPECT_LT(power, 0.0);
            }
        }
    }
}

/// The lopsided body with its surface in so many patches.
ImmersedBody patched_body(int patches) {
    SceneBody given = test::scene_body(1200.0);
    given.patches = patches;
    return make_immersed_body(test::lopsided_shape(), given, Fluid{});
}

/// The lopsided body with the numbers that only loads of the surface have.
ImmersedBody body_of_surface_numbers() {
    ImmersedBody body = test::lopsided_body();
    body.dynamic.laminar_rotational_drag = 1.3;
    body.dynamic.spin_lift_onset = 1.7;
    prepare(body);
    return body;
}

TEST(MovingLoads, TogetherAreTheirTermsAndTheStaticTableOfEachPatch) {
    for (const ImmersedBody& body : {test::lopsided_body(), patched_body(5), body_of_surface_numbers()}) {
        std::mt19937 generator(3);
        for (int i = 0; i < 500; ++i) {
            const Vector6d motion = random_motion(generator, i);
            const Motion m(body, motion);
            Vector6d expected = static_table(m) + creeping_drag(m) + creeping_turn(m);
            for (const Term& term : terms()) expected += term.formula(m);
            const Vector6d loads = loads_at(body, motion);
            EXPECT_LT((loads - expected).head<3>().norm(), 1e-11 * expected.head<3>().norm());
            EXPECT_LT((loads - expected).tail<3>().norm(), 1e-11 * expected.tail<3>().norm());
        }
    }
}

TEST(MovingLoads, OfPatchesTakeEnergyFromAWingThatSpinsOnTheSpotAsOnePatchDoesNot) {
    const ImmersedBody whole = bare(patched_body(1), true);
    const ImmersedBody patched = bare(patched_body(8), true);
    const Vector6d spin = motion_of(Vector3d(0.0, 20.0, 0.0), Vector3d::Zero());
    const double creeping = spin.dot(creeping_turn(Motion(whole, spin)));
    EXPECT_NEAR(spin.dot(loads_at(whole, spin)) / creeping, 1.0, 1e-12);
    EXPECT_GT(spin.dot(loads_at(patched, spin)) / creeping, 10.0);
}

TEST(MovingLoads, TransportOfTheWholeAddedMassTakesThePotentialFlowsOwnAway) {
    ImmersedBody body = bare(test::lopsided_body(), false);
    body.dynamic.transport = body.added_mass / body.fluid_density;
    body.dynamic.rotational_transport = 1.0;
    prepare(body);
    std::mt19937 generator(4);
    for (int i = 0; i < 300; ++i) {
        const Vector6d motion = random_motion(generator, i);
        const Motion m(body, motion);
        const Vector3d angular = body.added_inertia * m.omega + body.added_coupling * m.v;
        const Vector3d linear = body.added_coupling.transpose() * m.omega + body.added_mass * m.v;
        const Vector6d own = motion_of(angular.cross(m.omega) + linear.cross(m.v), linear.cross(m.omega));
        const Vector6d left = own + loads_at(body, motion) - creeping_turn(m);
        const double moment = angular.norm() * m.omega.norm() + linear.norm() * m.v.norm();
        EXPECT_LT(left.head<3>().norm(), 1e-14 * moment);
        EXPECT_LT(left.tail<3>().norm(), 1e-14 * linear.norm() * m.omega.norm());
    }
}

TEST(MovingLoads, LeaveASteadyTranslationAsItIsTabulatedTimesTheUnsteadyFactorWhateverTheOtherCoefficients) {
    std::mt19937 generator(6);
    const ImmersedBody lopsided = test::lopsided_body();
    for (int i = 0; i < 200; ++i) {
        ImmersedBody body = lopsided;
        body.dynamic.transport = random_symmetric(generator, 4e-5);
        body.dynamic.rotational_transport = random_vector(generator).x();
        body.dynamic.unsteady_factor = std::pow(2.0, i % 3 - 1);
        body.dynamic.drag_in_motion *= std::pow(10.0, i % 5 - 2);
        prepare(body);
        const double reynolds = std::pow(10.0, 3.0 + 2.0 * i / 199.0);
        const double speed = reynolds * body.viscosity / (body.fluid_density * body.length);
        const Vector3d velocity = speed * random_vector(generator).normalized();
        Vector6d load = loads_at(body, motion_of(Vector3d::Zero(), velocity));
        load.head<3>() += (body.added_mass * velocity).cross(velocity);
        const auto& [force, moment] = tabulated(body, velocity);
        const double pressure = 0.5 * body.fluid_density * speed * speed * body.reference_area;
        const double factor = body.dynamic.unsteady_factor;
        EXPECT_LT((load.tail<3>() - factor * force).norm(), 1e-12 * pressure);
        EXPECT_LT((load.head<3>() - factor * moment).norm(), 1e-12 * pressure * body.length);
    }
}

/// The lopsided body with parts left out, as a scene does that.
std::vector<ImmersedBody> lesser_bodies() {
    std::vector<ImmersedBody> bodies = {body_of_surface_numbers()};
    for (const bool added_mass : {true, false}) {
        for (const Dynamic dynamic : {Dynamic::of_body, Dynamic::by_default, Dynamic::none}) {
            for (const std::optional<double> reynolds : {std::optional<double>(), std::optional(1e4)}) {
                SceneBody given = test::scene_body(1200.0);
                given.added_mass = added_mass;
                given.dynamic = dynamic;
                given.table_reynolds_number = reynolds;
                for (const int patches : {1, 8}) {
                    given.patches = patches;
                    bodies.push_back(make_immersed_body(test::lopsided_shape(), given, Fluid{}));
                }
            }
        }
    }
    return bodies;
}

TEST(MovingLoads, LeaveASteadyTranslationAsItIsTabulatedWhateverIsLeftOut) {
    std::mt19937 generator(8);
    for (const ImmersedBody& body : lesser_bodies()) {
        for (int i = 0; i < 50; ++i) {
            const double reynolds = std::pow(10.0, 4.0 + i / 49.0);
            const double speed = reynolds * body.viscosity / (body.fluid_density * body.length);
            const Vector3d velocity = speed * random_vector(generator).normalized();
            Vector6d load = loads_at(body, motion_of(Vector3d::Zero(), velocity));
            load.head<3>() += (body.added_mass * velocity).cross(velocity);
            const auto& [force, moment] = tabulated(body, velocity);
            const double pressure = 0.5 * body.fluid_density * speed * speed * body.reference_area;
            EXPECT_LT((load.tail<3>() - force).norm(), 1e-12 * pressure);
            EXPECT_LT((load.head<3>() - moment).norm(), 1e-12 * pressure * body.length);
        }
    }
}

TEST(MovingLoads, NeverMakeEnergyWhateverIsLeftOut) {
    std::mt19937 generator(9);
    for (const ImmersedBody& body : lesser_bodies()) {
        for (int i = 0; i < 300; ++i) {
            const Matrix6d matrix = load_matrix(body, random_motion(generator, i));
            const Matrix6d symmetric = 0.5 * (matrix + matrix.transpose());
            const Vector6d eigenvalues = Eigen::SelfAdjointEigenSolver<Matrix6d>(symmetric).eigenvalues();
            EXPECT_GE(eigenvalues.minCoeff(), -1e-13 * eigenvalues.maxCoeff());
        }
    }
}

}  // namespace
}  // namespace samara
