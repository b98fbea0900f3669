#include "samara/analysis/advice/input_warnings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/hard_bodies.hpp"
#include "support/known_bodies.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string warnings(double radius, double density, const Fluid& fluid = test::water(),
                     ScaleRemedy remedy = ScaleRemedy::option) {
    MassSpecification mass;
    mass.density = density;
    return unit_warnings(test::exact_sphere(radius), mass, fluid, 9.81, remedy);
}

TEST(UnitWarnings, ThereAreNoneOfBodiesThatFallInNature) {
    EXPECT_EQ(warnings(0.02, 1200.0), "");
    EXPECT_EQ(warnings(0.02, 15.0, test::air()), "") << "foam";
    EXPECT_EQ(warnings(0.5, 7850.0), "") << "a ball of steel of 1 m";
    EXPECT_EQ(warnings(0.0005, 2600.0), "") << "a grain of sand";
    EXPECT_EQ(warnings(0.01, 19300.0), "") << "gold";
}

TEST(UnitWarnings, MillimetresReadAsMetresNameTheScale) {
    EXPECT_THAT(warnings(20.0, 2700.0),
                AllOf(HasSubstr("40 m long and falls at a Reynolds number of about"),
                      HasSubstr("if its shape is in millimetres, give --scale 0.001")));
    EXPECT_THAT(warnings(20.0, 2700.0, test::water(), ScaleRemedy::scene_key), HasSubstr("scale = 0.001"));
    EXPECT_THAT(warnings(20.0, 2700.0, test::water(), ScaleRemedy::mesh_again),
                HasSubstr("mesh its shape again"));
    EXPECT_THAT(warnings(2.0, 7850.0), HasSubstr("Reynolds number")) << "4 m, by its Reynolds number alone";
    EXPECT_THAT(size_warnings(test::exact_sphere(20.0), ScaleRemedy::option),
                AllOf(HasSubstr("40 m long: "), Not(HasSubstr("Reynolds"))));
    EXPECT_THAT(warnings(2e-5, 2700.0), HasSubstr("scaled only once"));
    EXPECT_EQ(scale_remedy_in_scene("a.body.h5"), ScaleRemedy::mesh_again);
    EXPECT_EQ(scale_remedy_in_scene("a.stl"), ScaleRemedy::scene_key);
}

TEST(UnitWarnings, GramsInACubicCentimetreNameTheDensityInKilograms) {
    EXPECT_EQ(warnings(0.02, 2.7), "a density of 2.7 kg/m^3: if it is in g/cm^3, give 2700");
    EXPECT_THAT(warnings(0.02, 0.6, test::air()), HasSubstr("give 600"));
    EXPECT_THAT(warnings(20.0, 2.7), AllOf(HasSubstr("--scale 0.001; and a density of 2.7")));
    EXPECT_THAT(warnings(0.02, 2.7e6), HasSubstr("above that of any metal"));
}

TEST(UnitWarnings, OfAMassAreThoseOfTheMeanDensity) {
    const Body ball = test::exact_sphere(0.02);
    MassSpecification grams;
    grams.mass = 1200.0 * ball.moments.volume * 1000.0;
    EXPECT_THAT(unit_warnings(ball, grams, test::water(), 9.81, ScaleRemedy::option),
                HasSubstr("check that its mass is in kg"));
    EXPECT_EQ(unit_warnings(
                  ball, MassSpecification{.density = {}, .mass = 0.04, .center_of_mass = {}, .inertia = {}},
                  test::water(), 0.0, ScaleRemedy::option),
              "");
}

using testing::AllOf;
using testing::HasSubstr;

/// A body in water whose coefficients are of falls at twice and at eight times the water's density.
struct Asked {
    Body body = test::full_body();
    SceneBody scene_body;

    Asked() {
        body.dynamic->densities = {2.0, 8.0};
        scene_body.loads = Loads::table;
    }
    DensityWarning warning(double density) {
        scene_body.mass.density = density * test::water().density;
        return density_warning(scene_body, body, test::water());
    }
};

TEST(Beyond, IsARatioOnEitherSideAndOneWithinOrUnknown) {
    EXPECT_EQ(beyond({2.0, 8.0}, 2.0), 1.0);
    EXPECT_EQ(beyond({2.0, 8.0}, 5.0), 1.0);
    EXPECT_EQ(beyond({2.0, 8.0}, 1.0), 2.0);
    EXPECT_EQ(beyond({2.0, 8.0}, 12.0), 1.5);
    EXPECT_EQ(beyond({}, 12.0), 1.0);
}

TEST(DensityWarning, ThereIsNoneWithinTheDensitiesOfTheFallsNorCloseToThem) {
    Asked asked;
    for (const double density : {1.7, 2.0, 4.0, 8.0, 9.0})
        EXPECT_EQ(asked.warning(density).text, "") << density;
}

TEST(DensityWarning, NamesBothDensitiesAndTheRemedyOnEitherSide) {
    Asked asked;
    const DensityWarning above = asked.warning(16.0);
    EXPECT_NEAR(above.ratio, 2.0, 1e-12);
    EXPECT_THAT(above.text, AllOf(HasSubstr("16 times as dense as the fluid"),
                                  HasSubstr("identified at 2 to 8 times"), HasSubstr("--density-to")));
    EXPECT_NEAR(asked.warning(1.25).ratio, 1.6, 1e-12);
    asked.body.dynamic->densities = {2.0, 2.0};
    EXPECT_THAT(asked.warning(4.0).text, HasSubstr("identified at 2 times"));
}

TEST(DragCrisisWarning, BeginsWhereTheDragOfASphereFalls) {
    EXPECT_EQ(drag_crisis_warning(1.9e5), "");
    EXPECT_THAT(drag_crisis_warning(2e5), AllOf(HasSubstr("2e+05"), HasSubstr("drag crisis")));
}

TEST(DensityWarning, ThereIsNoneWhereTheCoefficientsAreNotFlownOrTheFallsNotKnown) {
    Asked asked;
    asked.scene_body.dynamic = Dynamic::by_default;
    EXPECT_EQ(asked.warning(16.0).text, "");
    asked.scene_body.dynamic = Dynamic::of_body;
    asked.scene_body.loads = Loads::none;
    EXPECT_EQ(asked.warning(16.0).text, "");
    asked.scene_body.loads = Loads::table;
    asked.body.dynamic->densities = {};
    EXPECT_EQ(asked.warning(16.0).text, "");
    asked.body.dynamic.reset();
    EXPECT_EQ(asked.warning(16.0).text, "");
    EXPECT_EQ(density_warning(SceneBody{}, test::full_body(), test::water()).text, "") << "of no weight";
}

}  // namespace

}  // namespace samara
