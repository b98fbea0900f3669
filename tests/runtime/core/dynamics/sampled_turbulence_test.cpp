// What the sampled turbulence does to a body, by statements that need no theory of its forces: Galilean
// invariance, and the gust that is the same stream.
#include <vector>

#include <gtest/gtest.h>

#include "samara/core/integrator/batch.hpp"
#include "samara/core/integrator/step.hpp"
#include "support/compared_states.hpp"
#include "support/hard_bodies.hpp"
#include "support/known_bodies.hpp"
#include "support/random_bodies.hpp"
#include "support/reference_step.hpp"

namespace samara {
namespace {

using test::distance;

const Vector3d gravity(0.0, 0.0, -9.81);
const Vector3d offset(0.002, 0.001, -0.004);

/// Bodies with and without each of the models that a scene can choose.
std::vector<test::NamedBody> bodies_of_every_model() {
    std::vector<test::NamedBody> bodies = {{"tables", test::blunt_ellipsoid(offset)},
                                           {"every term of the loads", test::lopsided_body(offset)},
                                           {"mass in the centroid", test::lopsided_body()}};
    const auto scene = [&](const char* name, const auto& change) {
        SceneBody given = test::scene_body(1200.0);
        change(given);
        Body shape = test::rubber_ellipsoid();
        shape.tables = test::blunt_tables(shape, 4);
        bodies.push_back({name, make_immersed_body(shape, given, Fluid{})});
    };
    scene("no loads", [](SceneBody& body) { body.loads = Loads::none; });
    scene("coefficients", [](SceneBody& body) {
        body.loads = Loads::coefficients;
        body.coefficients.lift_coefficient = 0.8;
        body.coefficients.center_of_pressure = Vector3d(0.001, 0.002, 0.0);
    });
    scene("no added mass", [](SceneBody& body) { body.added_mass = false; });
    scene("no dynamic coefficients", [](SceneBody& body) { body.dynamic = Dynamic::none; });
    return bodies;
}

/// The same motion seen from a frame in which the fluid moves with `stream`.
BodyState seen_from(const BodyState& state, const Vector3d& stream, double time) {
    BodyState result = state;
    result.position += time * stream;
    result.velocity.tail<3>() += state.orientation.conjugate() * stream;
    result.sampled_turbulence.velocity += stream;
    return result;
}

TEST(SampledTurbulence, ABodyAtRestInAFrozenStreamFeelsWhatSteadyTranslationFeels) {
    const Vector3d stream(0.12, -0.21, 0.17);
    for (const test::NamedBody& one : bodies_of_every_model()) {
        SCOPED_TRACE(one.name);
        const ImmersedBody& body = one.body;
        BodyState towed = test::tumbling_state(0.0, 0.0);
        towed.velocity.tail<3>() = towed.orientation.conjugate() * -stream;
        const BodyState at_rest = seen_from(towed, stream, 0.0);
        ASSERT_EQ(at_rest.velocity.norm(), 0.0);
        const auto rate_of = [&](const BodyState& state) -> Vector6d {
            return EquationsOfMotion(body, gravity, state.sampled_turbulence)
                .rate(motion_vector(state))
                .head<6>();
        };
        const Vector6d of_tow = rate_of(towed);
        EXPECT_LT((rate_of(at_rest) - of_tow).norm(), 1e-12 * (1.0 + of_tow.norm()));
        const double h = 1e-3;
        const Vector6d moved = implicit_step(body, gravity, h, towed).velocity - towed.velocity;
        const Vector6d held = implicit_step(body, gravity, h, at_rest).velocity - at_rest.velocity;
        EXPECT_LT((moved.head<3>() - held.head<3>()).norm(), 1e-12 * (1.0 + moved.norm()));
    }
}

TEST(SampledTurbulence, AFlightInAFrozenStreamIsTheFlightInStillFluidSeenFromElsewhere) {
    const Vector3d stream(0.3, -0.2, 0.1);
    for (const test::NamedBody& one : bodies_of_every_model()) {
        const ImmersedBody& body = one.body;
        for (const bool reference : {false, true}) {
            SCOPED_TRACE(one.name + (reference ? ", reference" : ""));
            const auto step = [&](const BodyState& state, double h) {
                return reference ? reference_step(body, gravity, h, state).state
                                 : implicit_step(body, gravity, h, state);
            };
            const BodyState start = test::tumbling_state(0.2, 5.0);
            BodyState still = start;
            BodyState streaming = seen_from(start, stream, 0.0);
            const double h = 0.002;
            for (int i = 0; i < 100; ++i) {
                still = step(still, h);
                streaming = step(streaming, h);
            }
            EXPECT_GT(distance(still, start), 0.01);
            // Gauss's stages are those of one frame: its own error remains, of the fourth order.
            EXPECT_LT(distance(streaming, seen_from(still, stream, 100 * h)), reference ? 1e-7 : 1e-11);
        }
    }
}

TEST(SampledTurbulence, HoldsForBodiesAsNoShapeWouldGiveThem) {
    test::RandomBodies random(5);
    for (int i = 0; i < 300; ++i) {
        const ImmersedBody body = random.body();
        const BodyState still = random.state();
        const double speed = still.velocity.tail<3>().norm();
        const Vector3d stream = speed * Vector3d(0.3, -0.2, 0.4);
        const double h = 1e-3 * body.length / (speed + body.length * still.velocity.head<3>().norm());
        const BodyState a = implicit_step(body, Vector3d::Zero(), h, still);
        const BodyState b = implicit_step(body, Vector3d::Zero(), h, seen_from(still, stream, 0.0));
        const BodyState expected = seen_from(a, stream, h);
        EXPECT_LT((b.velocity - expected.velocity).tail<3>().norm(), 1e-9 * speed) << "body " << i;
        EXPECT_LT((b.velocity - expected.velocity).head<3>().norm(),
                  1e-9 * (speed / body.length + still.velocity.head<3>().norm()))
            << "body " << i;
    }
}

/// A gust's velocity as the sampled turbulence.
SampledTurbulence seen_in(const Surroundings& surroundings, double time) {
    return {flow_velocity(surroundings, time), Vector3d::Zero()};
}

TEST(SampledTurbulence, APrescribedStreamMovesABodyAsTheSameGustDoes) {
    Surroundings gusty;
    gusty.gust = {.amplitude = Vector3d(0.2, 0.1, -0.15), .period = 0.4};
    const double h = 0.002;
    for (const auto& [name, body] : bodies_of_every_model()) {
        SCOPED_TRACE(name);
        const BodyState start = test::tumbling_state(0.2, 5.0);
        BodyState in_gust = start;  // in the frame that moves with the gust
        BodyState seeing = start;
        Vector3d carried = Vector3d::Zero();
        const Noise noise(1, "", 0, 0);
        for (std::uint64_t i = 0; i < 300; ++i) {
            const double time = step_time(0.0, h, i);
            const Vector3d weight = apparent_gravity(gusty, time, time + h);
            in_gust = implicit_step(body, weight, h, in_gust);
            const SampledTurbulence next = seen_in(gusty, time + h);
            carried += 0.5 * h * (seeing.sampled_turbulence.velocity + next.velocity);
            seeing = implicit_step(body, gravity, h, seeing, next);
        }
        BodyState expected = seen_from(in_gust, seeing.sampled_turbulence.velocity, 0.0);
        expected.position += carried;
        // But for the guess from which a step's middle is found, which knows the stream and not the gust.
        EXPECT_LT(distance(seeing, expected), 1e-6);
        // The gust has an effect: without its acceleration the body moves elsewhere.
        BodyState unmoved = start;
        for (int i = 0; i < 300; ++i) unmoved = implicit_step(body, gravity, h, unmoved);
        EXPECT_GT(distance(unmoved, seeing), 1e-3);
    }
}

TEST(SampledTurbulence, ABodyOfTheFluidsDensityFollowsAStreamThatAccelerates) {
    for (const Loads loads : {Loads::none, Loads::table}) {
        const Body sphere = test::baked_sphere(0.01);
        const Fluid water = test::water();
        // Kelvin, Basset: (m + M) v' = (m_f + M) u', a bubble three times as fast as the water.
        for (const auto& [density, share] :
             {std::pair{water.density, 1.0}, std::pair{1e-6 * water.density, 3.0}}) {
            const ImmersedBody body = test::immersed(sphere, density, water, loads);
            const Vector3d change(1e-4, -2e-4, 1e-4);
            const BodyState after =
                implicit_step(body, Vector3d::Zero(), 1e-6, {}, {change, Vector3d::Zero()});
            EXPECT_LT((after.velocity.tail<3>() - share * change).norm(), 1e-3 * change.norm());
            EXPECT_LT(after.velocity.head<3>().norm(), 1e-9);
        }
    }
}

TEST(SampledTurbulence, ThatOnlyTurnsDoesNotPushABodyAside) {
    // Transport and wake rotate with the body's axes, like the Kirchhoff terms that they belong to: an eddy's
    // rotation affects neither, and a body without drag in spin feels nothing of it.
    ImmersedBody body = test::lopsided_body(offset);
    body.dynamic.drag_in_motion.setZero();
    body.dynamic.rotational_drag.setZero();
    body.dynamic.rotational_drag_in_spin.setZero();
    body.dynamic.drag_in_spin.setZero();
    body.roll_drag.setZero();
    body.viscosity = 1e-300;
    for (LoadEntry& entry : body.tables->entries) entry.force = entry.moment = Vector3d::Zero();
    prepare(body);
    BodyState still = test::tumbling_state(0.2, 5.0);
    BodyState eddying = still;
    eddying.sampled_turbulence.angular_velocity = Vector3d(3.0, -2.0, 1.0);
    const Vector6d a =
        EquationsOfMotion(body, gravity, still.sampled_turbulence).rate(motion_vector(still)).head<6>();
    const Vector6d b =
        EquationsOfMotion(body, gravity, eddying.sampled_turbulence).rate(motion_vector(eddying)).head<6>();
    EXPECT_LT((a - b).norm(), 1e-12 * a.norm());
    const BodyState c = implicit_step(body, gravity, 1e-3, still);
    const BodyState d = implicit_step(body, gravity, 1e-3, eddying);
    EXPECT_LT((c.velocity - d.velocity).norm(), 1e-12 * c.velocity.norm());
}

TEST(SampledTurbulence, SubstepsDivideTheStream) {
    // A body that spins fast is stepped in parts; the sampled turbulence of the parts goes evenly from that
    // of the step before to the new one, so that many short steps in the same stream come to the same.
    ImmersedBody body = test::lopsided_body(offset);
    body.turbulence = Turbulence::constant;
    body.turbulent_kinetic_energy = 0.01;
    body.dissipation_rate = 0.1;
    prepare(body);
    BodyState start = test::tumbling_state(0.2, 60.0);
    start.sampled_turbulence.velocity = Vector3d(0.1, 0.2, -0.1);
    const double h = 0.02;
    const StepResult whole = advance(body, {}, 0.0, h, start, Noise(3, "", 0, 0), 0);
    ASSERT_GT(whole.substeps, 2);
    BodyState parts = start;
    for (int i = 0; i < whole.substeps; ++i) {
        const double share = static_cast<double>(i + 1) / whole.substeps;
        SampledTurbulence next = whole.state.sampled_turbulence;
        next.velocity =
            start.sampled_turbulence.velocity + share * (next.velocity - start.sampled_turbulence.velocity);
        parts = implicit_step(body, gravity, h / whole.substeps, parts, next);
    }
    EXPECT_LT(distance(parts, whole.state), 1e-12);
}

TEST(SampledTurbulence, DoesNotChangeTheNumberOfSubstepsOfABodyCarriedAlong) {
    ImmersedBody body = test::blunt_ellipsoid();
    body.turbulence = Turbulence::constant;  // of nothing: the sampled turbulence is gone at the step's end
    prepare(body);
    BodyState carried = test::tumbling_state(0.0, 1.0);
    carried = seen_from(carried, Vector3d(200.0, 0.0, 0.0), 0.0);
    EXPECT_EQ(advance(body, {}, 0.0, 1e-3, carried, Noise(1, "", 0, 0), 0).substeps, 1);
    carried.sampled_turbulence.velocity.setZero();
    EXPECT_GT(advance(body, {}, 0.0, 1e-3, carried, Noise(1, "", 0, 0), 0).substeps, 1);
}

}  // namespace
}  // namespace samara
