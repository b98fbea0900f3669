// The wake that forms behind a body (docs/explanation/moving-loads.md#a-wake-that-forms): until it has, the
// flow is potential; once the fluid has long met the body from one side, the loads are those of a steady
// translation; in a swing the steady translation's own moment is not there.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

#include "core/dynamics/moving_load_terms.hpp"
#include "samara/core/dynamics/loads.hpp"
#include "samara/core/integrator/step.hpp"
#include "support/known_bodies.hpp"
#include "support/random_bodies.hpp"
#include "support/reference_step.hpp"

namespace samara {
namespace {

const Vector3d offset(0.002, 0.001, -0.004);

Vector6d acceleration_of(const ImmersedBody& body, const BodyState& state) {
    return EquationsOfMotion(body, Vector3d::Zero(), state.sampled_turbulence)
        .rate(motion_vector(state))
        .head<6>();
}

/// A translation oblique to its axes, with such a share of transport and so steady a heading.
BodyState towed(const Vector3d& velocity, double formed, double steady) {
    BodyState state;
    state.orientation = Quaterniond(Eigen::AngleAxisd(0.7, Vector3d(1.0, -2.0, 0.5).normalized()));
    state.velocity.tail<3>() = state.orientation.conjugate() * velocity;
    state.wake = {formed, steady * state.velocity.tail<3>().normalized()};
    return state;
}

/// Moves on as it was thrown, without rotation.
ImmersedBody heavy_ellipsoid() {
    Body shape = test::rubber_ellipsoid();
    shape.tables = test::blunt_tables(shape, 4);
    return make_immersed_body(shape, test::scene_body(1e9), Fluid{});
}

TEST(WakeFormation, NoneLeavesTheMomentOfPotentialFlowAndTheSteadyForce) {
    const ImmersedBody body = test::lopsided_body();
    const BodyState state = towed({0.1, 0.05, -0.2}, 0.0, 0.0);
    const Vector3d w = state.velocity.tail<3>();
    Vector6d expected;
    expected << (body.added_mass * w).cross(w), test::loads_at(body, state.velocity).tail<3>();
    EXPECT_LT((body.inertia * acceleration_of(body, state) - expected).norm(), 1e-12 * expected.norm());
}

TEST(WakeFormation, ThatHasFormedInASwingLeavesWhatTransportDoes) {
    const ImmersedBody body = test::lopsided_body();
    const BodyState state = towed({0.1, 0.05, -0.2}, 1.0, 0.0);
    const Vector3d w = state.velocity.tail<3>();
    const Matrix3d left = body.added_mass - body.fluid_density * body.dynamic.transport;
    Vector6d expected;
    expected << (left * w).cross(w), test::loads_at(body, state.velocity).tail<3>();
    EXPECT_LT((body.inertia * acceleration_of(body, state) - expected).norm(), 1e-12 * expected.norm());
}

TEST(WakeFormation, ThatIsWholeGivesTheSteadyLoads) {
    for (const ImmersedBody& body : {test::lopsided_body(offset), test::blunt_ellipsoid(offset)}) {
        const BodyState state = towed({0.1, 0.05, -0.2}, 1.0, 1.0);
        const Vector6d of_centroid = body.to_centroid * state.velocity;
        const Vector3d w = of_centroid.tail<3>();
        Vector6d expected = test::loads_at(body, of_centroid);
        expected.head<3>() += (body.added_mass * w).cross(w);
        expected = body.to_centroid.transpose() * expected;
        EXPECT_LT((body.inertia * acceleration_of(body, state) - expected).norm(), 1e-12 * expected.norm());
    }
}

TEST(WakeFormation, GoesOnAsAnExponentialOfTheWayOverTheExtentAlongIt) {
    const ImmersedBody body = heavy_ellipsoid();
    const double speed = 0.5;
    for (const auto& [direction, extent] : {std::pair{Vector3d(1.0, 0.0, 0.0), 0.02},
                                            {Vector3d(0.0, 1.0, 0.0), 0.04},
                                            {Vector3d(0.0, 0.0, 1.0), 0.08}}) {
        for (const double extents : {0.3, 1.0, 3.0}) {
            BodyState state;
            state.velocity.tail<3>() = speed * direction;
            constexpr int steps = 400;
            const double time = extents * extent / speed;
            for (int i = 0; i < steps; ++i)
                state = implicit_step(body, Vector3d::Zero(), time / steps, state);
            EXPECT_NEAR(state.wake.formed, 1.0 - std::exp(-extents / wake_formation_lengths), 1e-4) << extent;
            const double settled = 1.0 - std::exp(-extents / usual_settling_length);
            EXPECT_LT((state.wake.heading - settled * direction).norm(), 1e-4) << extent;
        }
    }
}

TEST(WakeFormation, BringsTheSteadyMomentFromRestAfterTheLengthOfTranslations) {
    // The median of docs/studies/falls, "The start".
    constexpr double length_of_translations = 2.3;
    const WakeShares shares = shares_of(
        {1.0, (1.0 - std::exp(-length_of_translations / usual_settling_length)) * Vector3d::UnitX()});
    EXPECT_NEAR(shares.moment, 1.0 - std::exp(-1.0), 0.01);
}

TEST(WakeFormation, OfASwingHasLittleOfTheSteadyMoment) {
    // The ellipsoid is rocked to and fro on its path: 40 degrees to either side, eight extents a swing.
    ImmersedBody body = heavy_ellipsoid();
    body.dynamic.settling_length = settling_length_of_falls;
    prepare(body);
    const double rate = 2.0 * std::numbers::pi * 0.5 / (8.0 * 0.04);
    const double largest = 40.0 / 180.0 * std::numbers::pi;
    const double h = 0.001;
    BodyState state;
    state.wake = {1.0, Vector3d::UnitY()};
    for (int i = 0; i < 20000; ++i) {
        const double time = i * h;
        const Quaterniond turned(Eigen::AngleAxisd(largest * std::sin(rate * time), Vector3d::UnitZ()));
        state.orientation = turned;
        state.velocity << Vector3d(0.0, 0.0, largest * rate * std::cos(rate * time)),
            turned.conjugate() * Vector3d(0.0, 0.5, 0.0);
        state.wake = implicit_step(body, Vector3d::Zero(), h, state).wake;
    }
    // The mean of the cosine of an angle that goes as a sine.
    EXPECT_NEAR(shares_of(state.wake).moment, std::pow(std::cyl_bessel_j(0.0, largest), 8), 0.05);
    EXPECT_DOUBLE_EQ(state.wake.formed, 1.0);
}

TEST(WakeFormation, IsNotLostByTheSpinOfADiscInItsPlane) {
    Body shape = test::rubber_ellipsoid();
    shape.moments.second_moments = shape.moments.volume * Vector3d(4e-4, 4e-4, 1e-5).asDiagonal();
    shape.tables = test::blunt_tables(shape, 4);
    const ImmersedBody body = make_immersed_body(shape, test::scene_body(1e9), Fluid{});
    BodyState state = towed({0.5, 0.0, 0.0}, 1.0, 1.0);
    state.velocity.head<3>() = Vector3d(0.0, 0.0, 30.0);
    for (int i = 0; i < 500; ++i) state = implicit_step(body, Vector3d::Zero(), 0.001, state);
    EXPECT_GT(shares_of(state.wake).moment, 0.98);

    const ImmersedBody ellipsoid = heavy_ellipsoid();
    state = towed({0.5, 0.0, 0.0}, 1.0, 1.0);
    state.velocity.head<3>() = Vector3d(0.0, 0.0, 30.0);
    for (int i = 0; i < 500; ++i) state = implicit_step(ellipsoid, Vector3d::Zero(), 0.001, state);
    EXPECT_LT(shares_of(state.wake).moment, 0.5);
}

TEST(WakeFormation, IsAlwaysAShare) {
    test::RandomBodies random(5);
    for (int i = 0; i < 2000; ++i) {
        const ImmersedBody body = random.body();
        BodyState state = random.state();
        const double h = random.magnitude(1e-6, 1.0);
        for (int step = 0; step < 5; ++step) {
            state = implicit_step(body, Vector3d::Zero(), h, state);
            ASSERT_LE(state.wake.heading.norm(), 1.0 + 1e-12) << "body " << i;
            ASSERT_GE(state.wake.formed, 0.0) << "body " << i;
            ASSERT_LE(state.wake.formed, 1.0) << "body " << i;
        }
    }
}

TEST(WakeFormation, IsOfTheWayThroughAStream) {
    const ImmersedBody body = test::lopsided_body(offset);
    const Vector3d stream(0.12, -0.21, 0.17);
    BodyState still = test::tumbling_state(0.2, 5.0);
    BodyState carried = still;
    carried.velocity.tail<3>() += carried.orientation.conjugate() * stream;
    carried.sampled_turbulence.velocity = stream;
    for (int i = 0; i < 100; ++i) {
        still = implicit_step(body, Vector3d(0.0, 0.0, -9.81), 0.002, still);
        carried = implicit_step(body, Vector3d(0.0, 0.0, -9.81), 0.002, carried);
    }
    EXPECT_GT(still.wake.heading.norm(), 0.2);
    EXPECT_LT((still.wake.heading - carried.wake.heading).norm(), 1e-10);
    EXPECT_NEAR(still.wake.formed, carried.wake.formed, 1e-10);
}

TEST(WakeFormation, IsNotAskedForByLoadsThatKnowNone) {
    Body shape = test::rubber_ellipsoid();
    SceneBody given = test::scene_body(1200.0);
    given.loads = Loads::coefficients;
    const ImmersedBody body = make_immersed_body(shape, given, Fluid{});
    const Vector3d velocity(0.1, 0.05, -0.2);
    EXPECT_EQ(acceleration_of(body, towed(velocity, 0.0, 0.0)),
              acceleration_of(body, towed(velocity, 1.0, 1.0)));
}

}  // namespace
}  // namespace samara
