#include "samara/core/dynamics/immersed_body.hpp"

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samara/core/dynamics/dynamic_coefficients.hpp"
#include "support/expect_error.hpp"
#include "support/known_bodies.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// All that make_immersed_body takes, sound.
struct Given {
    Body body = test::rubber_ellipsoid();
    SceneBody scene_body = test::scene_body(1200.0);
    Fluid fluid;

    Given() {
        body.tables = test::blunt_tables(body, 2);
        scene_body.name = "ball";
    }
    [[nodiscard]] ImmersedBody made() const {
        return make_immersed_body(body, scene_body, fluid, scene_body.name);
    }
};

struct Nonsense {
    std::string member;  ///< as the message names it
    std::function<void(Given&)> spoil;
};

/// The mass of a body that is given by its total.
MassSpecification& by_mass(Given& given) {
    given.scene_body.mass = {.density = {}, .mass = 0.1, .center_of_mass = {}, .inertia = {}};
    return given.scene_body.mass;
}

void expect_rejected(const std::vector<Nonsense>& cases) {
    for (const auto& [member, spoil] : cases) {
        Given given;
        spoil(given);
        const std::string error = test::error_of([&] { (void)given.made(); });
        EXPECT_THAT(error, AllOf(StartsWith("body 'ball': "), HasSubstr(member)));
        EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    }
}

TEST(ImmersedBody, IsMadeOfSoundNumbers) {
    EXPECT_NO_THROW((void)Given().made());
}

TEST(ImmersedBody, RefusesAFluidThatIsNone) {
    for (const double value : {not_a_number, infinity, 0.0, -1.0}) {
        expect_rejected({{"fluid.density", [&](Given& g) { g.fluid.density = value; }},
                         {"fluid.viscosity", [&](Given& g) { g.fluid.viscosity = value; }}});
    }
}

TEST(ImmersedBody, RefusesAMassThatIsNone) {
    for (const double value : {not_a_number, infinity, 0.0, -1.0}) {
        expect_rejected({{"density", [&](Given& g) { g.scene_body.mass.density = value; }},
                         {"mass", [&](Given& g) { by_mass(g).mass = value; }}});
    }
    const Vector3d off(0.0, not_a_number, 0.0);
    Matrix3d lopsided = Matrix3d::Identity();
    lopsided(0, 1) = 0.5;
    expect_rejected({
        {"density, mass or area_density", [&](Given& g) { g.scene_body.mass = {}; }},
        {"center_of_mass", [&](Given& g) { by_mass(g).center_of_mass = off; }},
        {"inertia", [&](Given& g) { by_mass(g).inertia = Matrix3d::Constant(infinity); }},
        {"inertia", [&](Given& g) { by_mass(g).inertia = lopsided; }},
        {"moments of inertia", [&](Given& g) { by_mass(g).inertia = -Matrix3d::Identity(); }},
    });
}

TEST(ImmersedBody, WeighsWhatItsFileSaysWhereNothingElseIsAsked) {
    Given given;
    const ImmersedBody asked = given.made();
    given.body.mass = given.scene_body.mass;
    given.scene_body.mass = {};
    EXPECT_EQ(given.made().inertia, asked.inertia);
    given.body.mass->density = 2400.0;
    EXPECT_DOUBLE_EQ(given.made().mass, 2.0 * asked.mass);
    given.scene_body.mass.density = 1200.0;
    EXPECT_EQ(given.made().mass, asked.mass);
}

TEST(ImmersedBody, RefusesAShapeThatIsNone) {
    for (const double value : {not_a_number, infinity, 0.0, -1.0}) {
        expect_rejected({{"moments.volume", [&](Given& g) { g.body.moments.volume = value; }},
                         {"moments.surface_area", [&](Given& g) { g.body.moments.surface_area = value; }}});
    }
    expect_rejected({
        {"moments.centroid", [](Given& g) { g.body.moments.centroid.z() = infinity; }},
        {"moments.second_moments", [](Given& g) { g.body.moments.second_moments(0, 2) = not_a_number; }},
        {"surface.vertices", [](Given& g) { g.body.surface.vertices[3].y() = not_a_number; }},
        {"surface.corners", [](Given& g) { g.body.surface.corners[3][1] = -1; }},
        {"surface", [](Given& g) { g.body.surface = {}; }},
        {"kirchhoff.matrix", [](Given& g) { g.body.kirchhoff->matrix(4, 1) = not_a_number; }},
        {"not positive definite", [](Given& g) { g.body.kirchhoff->matrix *= -1e3; }},
    });
}

TEST(ImmersedBody, RefusesTablesThatAreNone) {
    const auto spoiled = [](const std::function<void(LoadTables&)>& spoil) {
        return [spoil](Given& g) { spoil(*g.body.tables); };
    };
    expect_rejected({
        {"tables.entries[7]", spoiled([](LoadTables& t) { t.entries[7].force.y() = not_a_number; })},
        {"tables.entries[0]", spoiled([](LoadTables& t) { t.entries[0].moment.x() = infinity; })},
        {"tables.entries[9]",
         spoiled([](LoadTables& t) { t.entries[9].turbulent_kinetic_energy = infinity; })},
        {"tables.entries[9]", spoiled([](LoadTables& t) { t.entries[9].dissipation_rate = not_a_number; })},
        {"tables.entries must be 50", spoiled([](LoadTables& t) { t.entries.pop_back(); })},
        {"tables.subdivisions", spoiled([](LoadTables& t) { t.subdivisions = 0; })},
        {"tables.axes", spoiled([](LoadTables& t) { t.axes(1, 1) = not_a_number; })},
        {"tables.reference_length", spoiled([](LoadTables& t) { t.reference_length = 0.0; })},
        {"ascending", spoiled([](LoadTables& t) {
             t.reynolds_numbers = {1e5, 1e3};
         })},
        {"ascending", spoiled([](LoadTables& t) {
             t.reynolds_numbers = {1e3, 1e3};
         })},
        {"tables.reynolds_numbers", spoiled([](LoadTables& t) { t.reynolds_numbers[0] = 0.0; })},
        {"tables.reynolds_numbers", spoiled([](LoadTables& t) { t.reynolds_numbers[1] = not_a_number; })},
        {"tables.reynolds_numbers", spoiled([](LoadTables& t) { t.reynolds_numbers.clear(); })},
    });
    // Tables that nothing asks for are not looked at.
    Given given;
    given.body.tables->entries[7].force.y() = not_a_number;
    given.scene_body.loads = Loads::none;
    EXPECT_NO_THROW((void)given.made());
}

TEST(ImmersedBody, WithoutAddedMassHasItsOwnInertiaAloneAndNeedsNoTensor) {
    Given given;
    given.scene_body.added_mass = false;
    const ImmersedBody with_tensor = given.made();
    given.body.kirchhoff.reset();
    const ImmersedBody body = given.made();
    Matrix6d own = Matrix6d::Zero();
    own.topLeftCorner<3, 3>() = body.own_inertia;
    own.bottomRightCorner<3, 3>() = body.mass * Matrix3d::Identity();
    EXPECT_EQ(body.inertia, own);
    EXPECT_EQ(with_tensor.inertia, own);
    EXPECT_TRUE(body.dynamic.transport.isZero(0.0));
    EXPECT_TRUE(with_tensor.dynamic.transport.isZero(0.0));
    EXPECT_EQ(with_tensor.dynamic.rotational_transport, 0.0);
    given.scene_body.added_mass = true;
    EXPECT_THAT(test::error_of([&] { (void)given.made(); }), HasSubstr("no Kirchhoff tensor"));
}

TEST(ImmersedBody, TakesTheDynamicCoefficientsThatTheSceneAsksFor) {
    Given given;
    given.body = test::lopsided_shape();
    const DynamicCoefficients& own = given.body.dynamic->values;
    EXPECT_EQ(given.made().dynamic.drag_in_motion, own.drag_in_motion);
    given.scene_body.dynamic = Dynamic::by_default;
    const DynamicCoefficients standard = default_dynamic_coefficients(given.body);
    EXPECT_EQ(given.made().dynamic.drag_in_motion, standard.drag_in_motion);
    EXPECT_EQ(given.made().dynamic.origin, "dynamic coefficients by default");
    for (const Loads loads : {Loads::table, Loads::coefficients}) {
        given.scene_body.loads = loads;
        given.scene_body.dynamic = Dynamic::none;
        const DynamicCoefficients none = given.made().dynamic;
        for (const TensorOfMotion& tensor : tensors_of_motion) {
            EXPECT_TRUE((none.*tensor.member).isZero(0.0)) << tensor.name;
        }
        EXPECT_EQ(none.rotational_transport, 0.0);
        EXPECT_EQ(none.unsteady_factor, 1.0);
        EXPECT_EQ(none.half_length, standard.half_length);
    }
}

TEST(ImmersedBody, ReadsItsTablesAtOneReynoldsNumberWhereTheSceneSaysSo) {
    Given given;
    given.scene_body.table_reynolds_number = 1e4;
    EXPECT_EQ(given.made().tables->reynolds_numbers, std::vector<double>{1e4});
    expect_rejected({{"table_reynolds_number", [](Given& g) { g.scene_body.table_reynolds_number = -1.0; }}});
}

TEST(ImmersedBody, RefusesCoefficientsThatAreNone) {
    const auto spoiled = [](const std::function<void(SceneBody&)>& spoil) {
        return [spoil](Given& g) {
            g.scene_body.loads = Loads::coefficients;
            spoil(g.scene_body);
        };
    };
    const Vector3d nowhere(0.0, 0.0, infinity);
    expect_rejected({
        {"drag_coefficient", spoiled([](SceneBody& b) { b.coefficients.drag_coefficient = not_a_number; })},
        {"drag_coefficient", spoiled([](SceneBody& b) { b.coefficients.drag_coefficient = -0.1; })},
        {"lift_coefficient", spoiled([](SceneBody& b) { b.coefficients.lift_coefficient = infinity; })},
        {"reference_area", spoiled([](SceneBody& b) { b.coefficients.reference_area = 0.0; })},
        {"normal", spoiled([](SceneBody& b) { b.coefficients.normal = Vector3d::Zero(); })},
        {"center_of_pressure", spoiled([&](SceneBody& b) { b.coefficients.center_of_pressure = nowhere; })},
    });
    expect_rejected({
        {"dynamic.half_length", [](Given& g) { g.body.dynamic = IdentifiedCoefficients{}; }},
    });
}

TEST(ImmersedBody, RefusesLoadsOfASurfaceThatItsBodyDoesNotHold) {
    Given given;
    given.scene_body.loads = Loads::surface;
    given.scene_body.turbulence = Turbulence::none;
    EXPECT_THAT(test::error_of([&] { (void)given.made(); }),
                AllOf(StartsWith("body 'ball': loads = \"surface\""), HasSubstr("samara kirchhoff")));
    given.body.surface_loads = test::made_up_surface_loads(given.body.surface, given.body.moments);
    EXPECT_NO_THROW((void)given.made());
    given.scene_body.turbulence = Turbulence::table;
    EXPECT_NO_THROW((void)given.made());
}

TEST(ImmersedBody, OfSurfaceLoadsSharesItsCoefficientsWithAllBodies) {
    Given given;
    given.scene_body.loads = Loads::surface;
    given.scene_body.turbulence = Turbulence::none;
    given.body.surface_loads = test::made_up_surface_loads(given.body.surface, given.body.moments);
    given.body.dynamic = IdentifiedCoefficients{};  // of the tables' falls: not meant
    const ImmersedBody made = given.made();
    const Matrix3d added_mass = given.body.kirchhoff->matrix.bottomRightCorner<3, 3>();
    const SurfaceMotion shared;
    EXPECT_LT((made.dynamic.transport - shared.transport * added_mass -
               shared.spin_lift * added_mass.trace() / 3.0 * Matrix3d::Identity())
                  .norm(),
              1e-12 * added_mass.norm());
    EXPECT_EQ(made.dynamic.spin_lift_onset, shared.spin_lift_onset);
    EXPECT_TRUE(made.tables->stokes_throughout);
    given.scene_body.added_mass = false;
    EXPECT_TRUE(given.made().dynamic.transport.isZero(0.0));
}

TEST(ImmersedBody, RefusesTurbulenceThatIsNone) {
    const auto constant = [](double energy, double rate) {
        return [energy, rate](Given& g) {
            g.scene_body.turbulence = Turbulence::constant;
            g.scene_body.turbulent_kinetic_energy = energy;
            g.scene_body.dissipation_rate = rate;
        };
    };
    expect_rejected({{"turbulent_kinetic_energy", constant(not_a_number, 1.0)},
                     {"turbulent_kinetic_energy", constant(-1.0, 1.0)},
                     {"dissipation_rate", constant(1.0, infinity)},
                     {"dissipation_rate", constant(1.0, -1.0)},
                     {"dissipation_rate", constant(1.0, 0.0)}});
    Given still;
    constant(0.0, 0.0)(still);
    EXPECT_NO_THROW((void)still.made());
}

TEST(PreparedBodies, ThatDifferInNameAndStartAloneAreOne) {
    const Body body = test::rubber_ellipsoid();
    SceneBody kind = test::scene_body(1200.0);
    kind.loads = Loads::none;
    PreparedBodies prepared;
    const auto first = prepared.get(body, kind, Fluid{}, "body");
    kind.name = "another";
    kind.position = Vector3d(1.0, 2.0, 3.0);
    kind.start = 0.5;
    EXPECT_EQ(prepared.get(body, kind, Fluid{}, "body"), first);
    kind.mass.density = 1300.0;
    EXPECT_NE(prepared.get(body, kind, Fluid{}, "body"), first);
    kind.mass.density = 1200.0;
    EXPECT_NE(prepared.get(body, kind, Fluid{.density = 1.2, .viscosity = 1.8e-5}, "body"), first);
}

TEST(PreparedBodies, HaveContactPointsWhereTheyMayTouchSomething) {
    const Body body = test::rubber_ellipsoid();
    SceneBody kind = test::scene_body(1200.0);
    kind.loads = Loads::none;
    PreparedBodies prepared;
    EXPECT_TRUE(prepared.get(body, kind, Fluid{}, "body", false)->contact_points.round.empty());
    const auto touching = prepared.get(body, kind, Fluid{}, "body", true);
    EXPECT_FALSE(touching->contact_points.round.empty());
    EXPECT_EQ(prepared.get(body, kind, Fluid{}, "body", true), touching);
}

TEST(PreparedBodies, KeepAsManyAsTheyAreToldTo) {
    const Body body = test::rubber_ellipsoid();
    SceneBody kind = test::scene_body(1.0);
    kind.loads = Loads::none;
    PreparedBodies few(2);
    PreparedBodies many(30);
    std::vector<std::shared_ptr<const ImmersedBody>> of_few;
    std::vector<std::shared_ptr<const ImmersedBody>> of_many;
    for (int i = 1; i <= 20; ++i) {
        kind.mass.density = 1000.0 + i;
        of_few.push_back(few.get(body, kind, Fluid{}, "body"));
        of_many.push_back(many.get(body, kind, Fluid{}, "body"));
    }
    kind.mass.density = 1001.0;
    EXPECT_NE(few.get(body, kind, Fluid{}, "body"), of_few.front());
    EXPECT_EQ(many.get(body, kind, Fluid{}, "body"), of_many.front());
}

}  // namespace
}  // namespace samara
