// Loads of a body that turns: each term is what docs/theory says ("Loads of a moving body"), and does its
// work.

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <random>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "internal/dynamics/batch.hpp"
#include "internal/dynamics/loads.hpp"
#include "internal/dynamics/reference_step.hpp"
#include "support/known_bodies.hpp"

namespace samara {
namespace {

Vector3d random_vector(std::mt19937& generator) {
    std::normal_distribution<double> normal;
    const double x = normal(generator);
    const double y = normal(generator);
    return {x, y, normal(generator)};
}

Matrix3d random_symmetric(std::mt19937& generator, double scale) {
    Matrix3d factor;
    for (int i = 0; i < 3; ++i) factor.row(i) = scale * random_vector(generator);
    return factor + factor.transpose();
}

/// Speeds about 0.2 m/s; turning rates of a thousandth to a thousand radians a second, as i goes on.
Vector6d random_motion(std::mt19937& generator, int i) {
    Vector6d motion;
    motion << std::pow(10.0, i % 7 - 3) * random_vector(generator), 0.2 * random_vector(generator);
    return motion;
}

Vector6d motion_of(const Vector3d& omega, const Vector3d& velocity) {
    Vector6d motion;
    motion << omega, velocity;
    return motion;
}

/// Moment about the centroid and force.
Vector6d loads_at(const ImmersedBody& body, const Vector6d& motion) {
    return -load_matrix(body, motion) * motion;
}

/// The body without dynamic coefficients; also without tables' loads where `table` is false, so that no load
/// but the creeping turn is left.
ImmersedBody bare(ImmersedBody body, bool table) {
    const double half_length = body.dynamic.half_length;
    body.dynamic = {};
    body.dynamic.half_length = half_length;
    if (!table) {
        body.loads = Loads::coefficients;
        body.coefficients.drag_coefficient = 0.0;
        body.coefficients.reference_area = 1e-3;
    }
    prepare(body);
    return body;
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

/// A motion and what the formulas need of it.
struct Motion {
    const ImmersedBody& body;
    Vector3d omega, v;
    double tip, combined;

    Motion(const ImmersedBody& given, const Vector6d& motion)
        : body(given),
          omega(motion.head<3>()),
          v(motion.tail<3>()),
          tip(given.dynamic.half_length * omega.norm()),
          combined(std::hypot(v.norm(), tip)) {}
};

Vector6d transport(const Motion& m) {
    const double rho = m.body.fluid_density;
    const Vector3d momentum = m.body.dynamic.transport * m.v;
    return rho * motion_of(m.v.cross(momentum), m.omega.cross(momentum));
}
Vector6d rotational_transport(const Motion& m) {
    const Vector3d momentum = m.body.added_coupling.transpose() * m.omega;
    const Vector3d angular = m.body.added_inertia * m.omega + m.body.added_coupling * m.v;
    return m.body.dynamic.rotational_transport *
           motion_of(m.v.cross(momentum) + m.omega.cross(angular), m.omega.cross(momentum));
}
Vector6d wake_by_velocity(const Motion& m) {
    const Vector3d wake = m.v.cross(m.body.dynamic.wake_by_velocity * m.v);
    return motion_of(m.body.fluid_density / m.combined * m.omega.cross(wake), Vector3d::Zero());
}
Vector6d wake_by_turning(const Motion& m) {
    const double reach = std::pow(m.body.dynamic.half_length, 2);
    const Vector3d wake = reach * m.omega.cross(m.body.dynamic.wake_by_turning * m.omega);
    return motion_of(m.body.fluid_density / m.combined * m.omega.cross(wake), Vector3d::Zero());
}
Vector6d entrained_inertia(const Motion& m) {
    const Vector3d angular = m.body.dynamic.entrained_inertia * m.omega;
    return motion_of(m.body.fluid_density * m.omega.cross(angular), Vector3d::Zero());
}
Vector6d drag_in_motion(const Motion& m) {
    const double tip = m.tip * m.tip;
    const double share = tip / (motion_onset * m.v.squaredNorm() + tip);
    return motion_of(Vector3d::Zero(),
                     -0.5 * m.body.fluid_density * m.combined * share * m.body.dynamic.drag_in_motion * m.v);
}
Vector6d drag_in_spin(const Motion& m) {
    return motion_of(Vector3d::Zero(), -0.5 * m.body.fluid_density * m.tip * m.tip / m.combined *
                                           m.body.dynamic.drag_in_spin * m.v);
}
Vector6d rotational_drag_in_spin(const Motion& m) {
    return motion_of(-0.5 * m.body.fluid_density * m.tip * m.tip / m.combined *
                         m.body.dynamic.rotational_drag_in_spin * m.omega,
                     Vector3d::Zero());
}
Vector6d rotational_drag(const Motion& m) {
    return motion_of(-0.5 * m.body.fluid_density * m.combined * m.body.dynamic.rotational_drag * m.omega,
                     Vector3d::Zero());
}
Vector6d creeping_turn(const Motion& m) {
    return motion_of(-std::numbers::pi * m.body.viscosity * std::pow(m.body.length, 3) * m.omega,
                     Vector3d::Zero());
}

/// Force and moment of a steady tow at a velocity, by the table.
std::pair<Vector3d, Vector3d> tabulated(const ImmersedBody& body, const Vector3d& velocity) {
    const double speed = velocity.norm();
    const LoadEntry entry = look_up(*body.tables, velocity / speed, reynolds_number(body, speed));
    const double pressure = 0.5 * body.fluid_density * speed * speed * body.reference_area;
    return {pressure * entry.force, pressure * body.length * entry.moment};
}

/// The static table's part, less what transport leaves of the Kirchhoff moment.
Vector6d static_table(const Motion& m) {
    const auto& [force, tow_moment] = tabulated(m.body, m.v);
    const Vector3d left = m.body.added_mass * m.v - m.body.fluid_density * m.body.dynamic.transport * m.v;
    const Vector3d moment = tow_moment - left.cross(m.v);
    const double share = m.v.squaredNorm() / (m.v.squaredNorm() + motion_onset * m.tip * m.tip);
    const Vector3d arm = share * force.cross(moment) / force.squaredNorm();
    const Vector3d along = share * moment.dot(force) / force.squaredNorm() * force;
    Vector6d static_part = motion_of(along, -along.dot(m.omega) / m.v.squaredNorm() * m.v);
    for (const SurfacePatch& patch : m.body.patches) {
        const Vector3d place = arm + patch.place;
        const Vector3d local = patch.share * tabulated(m.body, m.v + m.omega.cross(place)).first;
        static_part += motion_of(place.cross(local), local);
    }
    return static_part;
}
/// Stokes' resistance below the table.
Vector6d creeping_drag(const Motion& m) {
    const double lowest = m.body.tables->reynolds_numbers.front();
    const double share = std::max(0.0, 1.0 - reynolds_number(m.body, m.v.norm()) / lowest);
    return motion_of(Vector3d::Zero(),
                     -3.0 * std::numbers::pi * m.body.viscosity * m.body.length * share * m.v);
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
        {"wake by velocity", keeping(&Coefficients::wake_by_velocity), wake_by_velocity, true},
        {"wake by turning", keeping(&Coefficients::wake_by_turning), wake_by_turning, true},
        {"entrained inertia", keeping(&Coefficients::entrained_inertia), entrained_inertia, true},
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
            // Beside the creeping turn, which is taken away again.
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

/// The lopsided body whose surface meets the flow in so many patches.
ImmersedBody patched_body(int patches) {
    SceneBody given = test::scene_body(1200.0);
    given.patches = patches;
    return make_immersed_body(test::lopsided_shape(), given, Fluid{});
}

TEST(MovingLoads, TogetherAreTheirTermsAndTheStaticTableOfEachPatch) {
    for (const ImmersedBody& body : {test::lopsided_body(), patched_body(5)}) {
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
    body.dynamic.entrained_inertia.setZero();
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

TEST(MovingLoads, LeaveASteadyTowAsItIsTabulatedTimesTheUnsteadyFactorWhateverTheOtherCoefficients) {
    std::mt19937 generator(6);
    const ImmersedBody lopsided = test::lopsided_body();
    for (int i = 0; i < 200; ++i) {
        ImmersedBody body = lopsided;
        body.dynamic.transport = random_symmetric(generator, 4e-5);
        body.dynamic.rotational_transport = random_vector(generator).x();
        body.dynamic.wake_by_velocity = random_symmetric(generator, 1e-6);
        body.dynamic.wake_by_turning = random_symmetric(generator, 1e-6);
        body.dynamic.entrained_inertia = random_symmetric(generator, 1e-8);
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
    std::vector<ImmersedBody> bodies;
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

TEST(MovingLoads, LeaveASteadyTowAsItIsTabulatedWhateverIsLeftOut) {
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

TEST(MovingLoads, OfASpinningBallWithoutAddedMassDoNotBendItsPath) {
    SceneBody given = test::scene_body(1200.0);
    given.added_mass = false;
    Body ball = test::exact_sphere(0.02);
    ball.dynamic = test::lopsided_shape().dynamic;
    ball.tables = test::blunt_tables(ball, 2);
    for (LoadEntry& entry : ball.tables->entries) {
        entry.force.setZero();
        entry.moment.setZero();
    }
    const ImmersedBody body = make_immersed_body(ball, given, Fluid{});
    std::mt19937 generator(10);
    for (int i = 0; i < 50; ++i) {
        const Vector6d motion = motion_of(random_vector(generator), random_vector(generator));
        const Vector3d force = loads_at(body, motion).tail<3>();
        // What is left are the drags in motion, which act along C_m A v and C_s A v.
        const Motion m(body, motion);
        const Vector6d drags = drag_in_motion(m) + drag_in_spin(m);
        EXPECT_LT((force - drags.tail<3>() - creeping_drag(m).tail<3>()).norm(), 1e-12 * force.norm());
    }
}

TEST(MovingLoads, DragInMotionSetsInWithTheSquareOfTheTipSpeedAndIsHalfThereAtTheOnset) {
    ImmersedBody body = bare(test::lopsided_body(), false);
    body.dynamic.drag_in_motion = 1e-3 * Matrix3d::Identity();
    prepare(body);
    const Vector3d velocity(0.1, -0.2, 0.2);
    const double speed = velocity.norm();
    /// The drag over rho/2 H C_m A v.
    const auto share_at = [&](double square) {  // of (Q/|v|)^2
        const double tip = std::sqrt(square) * speed;
        const Vector3d omega = tip / body.dynamic.half_length * Vector3d(2.0, 1.0, 0.5).normalized();
        const double full = 0.5 * body.fluid_density * std::hypot(speed, tip) * 1e-3 * speed;
        return -loads_at(body, motion_of(omega, velocity)).tail<3>().dot(velocity) / speed / full;
    };
    EXPECT_NEAR(share_at(motion_onset), 0.5, 1e-12);
    EXPECT_NEAR(share_at(1e-6) / (1e-6 / motion_onset), 1.0, 1e-4);
    EXPECT_NEAR(share_at(1e-8) / (1e-8 / motion_onset), 1.0, 1e-6);
    EXPECT_NEAR(share_at(1e4), 1.0, 1e-5);
    EXPECT_EQ(share_at(0.0), 0.0);
}

TEST(MovingLoads, DragInMotionIsOfTheBodysOwnTurning) {
    ImmersedBody body = bare(test::lopsided_body(), false);
    body.dynamic.drag_in_motion = 1e-3 * Matrix3d::Identity();
    prepare(body);
    const Vector3d velocity(0.1, -0.2, 0.2);
    const Vector6d relative = motion_of(Vector3d(3.0, -1.0, 2.0), velocity);
    // The body turns by `own` in a fluid that turns too, so that its turning relative to the fluid is always
    // the same.
    const auto drag_at = [&](const Vector3d& own) {
        const Vector3d seen = own - relative.head<3>();
        const Vector6d motion = motion_of(own, velocity);
        const LoadMatrices loads = load_matrices(body, motion, seen);
        const Vector6d load = loads.relative.leftCols<3>() * seen - loads.whole * motion;
        return load.tail<3>().dot(velocity.normalized());
    };
    EXPECT_EQ(drag_at(Vector3d::Zero()), 0.0);
    const Vector3d at_onset(std::sqrt(motion_onset) * velocity.norm() / body.dynamic.half_length, 0.0, 0.0);
    EXPECT_NEAR(drag_at(at_onset) / drag_at(1e9 * at_onset), 0.5, 1e-12);
}

TEST(MovingLoads, ArePassiveInAFluidThatTurns) {
    const ImmersedBody body = test::lopsided_body();
    const Vector3d velocity(0.1, -0.2, 0.2);
    for (const Vector3d& own :
         {Vector3d(Vector3d::Zero()), Vector3d(3.0, -1.0, 2.0), Vector3d(1e3, 0.0, 0.0)}) {
        for (const Vector6d& slip :
             {Vector6d(Vector6d::Zero()), motion_of(Vector3d(1.0, 2.0, 3.0), Vector3d::Zero()),
              motion_of(Vector3d::Zero(), velocity)}) {
            const Vector6d motion = motion_of(own, slip.tail<3>());
            const LoadMatrices loads = load_matrices(body, motion, own - slip.head<3>());
            EXPECT_TRUE(loads.whole.allFinite());
            EXPECT_LT(loads.relative.norm(), 1e3);
            EXPECT_GE((slip.transpose() * loads.relative * slip).value(), 0.0);
            // Transport and wake do no work on the body, whatever the fluid does.
            const Matrix6d transports = loads.whole - loads.relative;
            EXPECT_LT((transports + transports.transpose()).norm(), 1e-12 * (loads.whole.norm() + 1e-12));
        }
    }
}

TEST(MovingLoads, KeepTheTablesMomentUntilTheBodyDoesLittleButTurn) {
    // A body whose moment is along its force, about which it turns: no arm, and so no change of the local
    // velocity.
    ImmersedBody body = bare(test::blunt_ellipsoid(), true);
    for (LoadEntry& entry : body.tables->entries) entry.moment = 0.1 * entry.force;
    body.dynamic.transport = body.added_mass / body.fluid_density;
    prepare(body);
    const Vector3d velocity(0.1, -0.2, 0.2);
    const auto tow = tabulated(body, velocity);
    const Vector3d force = tow.first;
    const Vector3d moment = tow.second;
    const auto share_at = [&](double square) {  // of (|v|/Q)^2
        const double rate = velocity.norm() / std::sqrt(square) / body.dynamic.half_length;
        const Motion m(body, motion_of(rate * force.normalized(), velocity));
        const Vector6d rest = transport(m) + creeping_turn(m);
        return (loads_at(body, motion_of(m.omega, m.v)) - rest).head<3>().dot(moment) / moment.squaredNorm();
    };
    EXPECT_NEAR(share_at(1e6), 1.0, 1e-6);
    EXPECT_NEAR(share_at(1.0), 1.0 / (1.0 + motion_onset), 1e-9);
    EXPECT_NEAR(share_at(motion_onset), 0.5, 1e-9);
    EXPECT_NEAR(share_at(1e-4 * motion_onset) / 1e-4, 1.0, 1e-3);
}

TEST(MovingLoads, TendToThoseOfTheTowAsTheBodyStopsTurning) {
    const ImmersedBody body = test::lopsided_body();
    const Vector3d velocity(0.1, -0.2, 0.2);
    const Vector6d tow = loads_at(body, motion_of(Vector3d::Zero(), velocity));
    double before = INFINITY;
    for (const double rate : {1e-1, 1e-3, 1e-6, 1e-9, 1e-200}) {
        const Vector6d loads = loads_at(body, motion_of(rate * Vector3d(0.3, -1.0, 0.5), velocity));
        const double difference = (loads - tow).norm() / tow.norm();
        EXPECT_LE(difference, std::max(before * 0.1, 1e-13)) << rate;
        before = difference;
    }
}

TEST(MovingLoads, OfABodyThatTurnsOnTheSpotAreFiniteAndThoseOfTheTurningAlone) {
    const ImmersedBody body = test::lopsided_body();
    const double rho = body.fluid_density;
    const DynamicCoefficients& dynamic = body.dynamic;
    for (const double rate : {1e-3, 1.0, 1e3}) {
        const Vector3d omega = rate * Vector3d(0.3, -1.0, 0.5);
        const Motion m(body, motion_of(omega, Vector3d::Zero()));
        const Vector6d expected = rotational_transport(m) + entrained_inertia(m) + wake_by_turning(m) +
                                  rotational_drag(m) + rotational_drag_in_spin(m) + creeping_turn(m);
        for (const double speed : {0.0, 1e-200, 1e-30}) {
            const Vector6d loads = loads_at(body, motion_of(omega, speed * Vector3d(0.5, 0.3, -0.4)));
            ASSERT_TRUE(loads.allFinite());
            EXPECT_LT((loads - expected).head<3>().norm(), 1e-12 * expected.head<3>().norm());
            EXPECT_LT((loads - expected).tail<3>().norm(), 1e-12 * expected.tail<3>().norm());
        }
        EXPECT_GT(wake_by_turning(m).norm(),
                  1e-2 * rho * omega.squaredNorm() * dynamic.half_length * dynamic.wake_by_turning.norm());
    }
}

TEST(MovingLoads, AreFiniteAndVanishAtRest) {
    for (const ImmersedBody& body : {test::blunt_ellipsoid(), test::lopsided_body()}) {
        const Matrix6d at_rest = load_matrix(body, Vector6d::Zero());
        EXPECT_TRUE(at_rest.allFinite());
        for (const double faint : {1e-300, 1e-160, 1e-80, 1e-20}) {
            EXPECT_TRUE(load_matrix(body, Vector6d::Constant(faint)).allFinite()) << faint;
        }
        EXPECT_LT((load_matrix(body, Vector6d::Constant(1e-12)) - at_rest).norm(), 1e-9);
    }
}

/// The same shape in other axes: x' = R x.
Body turned(Body body, const Matrix3d& r) {
    for (Vector3d& vertex : body.surface.vertices) vertex = r * vertex;
    body.moments.centroid = r * body.moments.centroid;
    const auto turn = [&r](Matrix3d& tensor) { tensor = (r * tensor * r.transpose()).eval(); };
    turn(body.moments.second_moments);
    Matrix6d both = Matrix6d::Zero();
    both << r, Matrix3d::Zero(), Matrix3d::Zero(), r;
    body.kirchhoff->matrix = (both * body.kirchhoff->matrix * both.transpose()).eval();
    body.tables->axes = (r * body.tables->axes).eval();
    for (LoadEntry& entry : body.tables->entries) {
        entry.force = r * entry.force;
        entry.moment = r * entry.moment;
    }
    for (const TensorOfMotion& tensor : tensors_of_motion) turn(body.dynamic->values.*tensor.member);
    return body;
}

TEST(MovingLoads, MoveABodyTheSameWayInWhateverAxesItIsGiven) {
    const Matrix3d r = Quaterniond(0.3, -0.5, 0.7, 0.4).normalized().toRotationMatrix();
    const Vector3d offset(0.001, 0.002, -0.003);
    const auto immersed = [](const Body& shape, const Vector3d& center) {
        SceneBody given = test::scene_body(0.0);
        given.mass = {.density = {}, .mass = 0.04, .center_of_mass = center, .inertia = {}};
        return make_immersed_body(shape, given, Fluid{});
    };
    const Body shape = test::lopsided_shape();
    const ImmersedBody one = immersed(shape, offset);
    const ImmersedBody other = immersed(turned(shape, r), r * offset);
    const BodyState start = test::tumbling_state(0.2, 8.0);
    BodyState state = start;
    BodyState in_other = start;
    in_other.orientation = start.orientation * Quaterniond(r).inverse();
    in_other.velocity << r * start.velocity.head<3>(), r * start.velocity.tail<3>();
    for (int i = 0; i < 100; ++i) {
        state = reference_step(one, Vector3d(0.0, 0.0, -9.81), 0.002, state).state;
        in_other = reference_step(other, Vector3d(0.0, 0.0, -9.81), 0.002, in_other).state;
    }
    EXPECT_GT((state.position - start.position).norm(), 0.01);
    EXPECT_LT((state.position - in_other.position).norm(), 1e-10);
    const Vector3d omega = r.transpose() * in_other.velocity.head<3>();
    EXPECT_LT((omega - state.velocity.head<3>()).norm(), 1e-7);

    std::mt19937 generator(7);
    for (int i = 0; i < 100; ++i) {
        const Vector6d motion = random_motion(generator, i);
        const Vector6d loads = loads_at(one, motion);
        const Vector6d turned_loads = loads_at(other, motion_of(r * motion.head<3>(), r * motion.tail<3>()));
        EXPECT_LT((r.transpose() * turned_loads.head<3>() - loads.head<3>()).norm(),
                  1e-11 * loads.head<3>().norm());
        EXPECT_LT((r.transpose() * turned_loads.tail<3>() - loads.tail<3>()).norm(),
                  1e-11 * loads.tail<3>().norm());
    }
}

TEST(MovingLoads, OfSinglePrecisionAreFiniteWhereABodyRestsTurnsOrMovesAlone) {
    const ImmersedBody body = test::lopsided_body();
    const std::vector<Vector6d> starts = {
        Vector6d::Zero(),
        motion_of(Vector3d(1.0, 2.0, -3.0), Vector3d::Zero()),
        motion_of(Vector3d::Zero(), Vector3d(0.1, 0.0, 0.2)),
        motion_of(Vector3d(1e-18, 2e-19, 0.0), Vector3d(0.0, 1e-18, 0.0)),
        motion_of(Vector3d(1e3, 0.0, -1e3), Vector3d(0.0, 1e-9, 0.0)),
        motion_of(Vector3d(1e-9, 0.0, -1e-9), Vector3d(0.0, 1e2, 0.0)),
    };
    FloatBatch batch(body, starts.size());
    for (std::size_t i = 0; i < starts.size(); ++i) {
        BodyState state;
        state.velocity = starts[i];
        batch.set_state(i, state);
    }
    Surroundings still;
    still.gravity.setZero();
    batch.advance(still, 0.0, 0.002, 0, 5);
    for (std::size_t i = 0; i < starts.size(); ++i) {
        const BodyState state = batch.state(i);
        EXPECT_TRUE(state.velocity.allFinite() && state.position.allFinite()) << i;
        EXPECT_TRUE(state.orientation.coeffs().allFinite()) << i;
    }
    EXPECT_EQ(batch.state(0).velocity, Vector6d::Zero());
}

}  // namespace
}  // namespace samara
