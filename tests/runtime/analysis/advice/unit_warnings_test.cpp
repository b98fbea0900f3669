#include "samara/analysis/advice/unit_warnings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/hard_bodies.hpp"
#include "support/known_bodies.hpp"

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
                      HasSubstr("is its shape in millimetres? then give --scale 0.001")));
    EXPECT_THAT(warnings(20.0, 2700.0, test::water(), ScaleRemedy::scene_key), HasSubstr("scale = 0.001"));
    EXPECT_THAT(warnings(20.0, 2700.0, test::water(), ScaleRemedy::mesh_again),
                HasSubstr("mesh its shape again"));
    EXPECT_THAT(warnings(2.0, 7850.0), HasSubstr("Reynolds number")) << "4 m, by its Reynolds number alone";
    EXPECT_THAT(size_warnings(test::exact_sphere(20.0), ScaleRemedy::option),
                AllOf(HasSubstr("40 m long: "), Not(HasSubstr("Reynolds"))));
    EXPECT_THAT(warnings(2e-5, 2700.0), HasSubstr("scaled twice"));
    EXPECT_EQ(scale_remedy_in_scene("a.body.h5"), ScaleRemedy::mesh_again);
    EXPECT_EQ(scale_remedy_in_scene("a.stl"), ScaleRemedy::scene_key);
}

TEST(UnitWarnings, GramsInACubicCentimetreNameTheDensityInKilograms) {
    EXPECT_EQ(warnings(0.02, 2.7), "a density of 2.7 kg/m^3: is that in g/cm^3? then it is 2700 kg/m^3");
    EXPECT_THAT(warnings(0.02, 0.6, test::air()), HasSubstr("then it is 600 kg/m^3"));
    EXPECT_THAT(warnings(20.0, 2.7), AllOf(HasSubstr("--scale 0.001; and a density of 2.7")));
    EXPECT_THAT(warnings(0.02, 2.7e6), HasSubstr("above that of any metal"));
}

TEST(UnitWarnings, OfAMassAreThoseOfTheMeanDensity) {
    const Body ball = test::exact_sphere(0.02);
    MassSpecification grams;
    grams.mass = 1200.0 * ball.moments.volume * 1000.0;
    EXPECT_THAT(unit_warnings(ball, grams, test::water(), 9.81, ScaleRemedy::option),
                HasSubstr("is its mass in grams"));
    EXPECT_EQ(unit_warnings(
                  ball, MassSpecification{.density = {}, .mass = 0.04, .center_of_mass = {}, .inertia = {}},
                  test::water(), 0.0, ScaleRemedy::option),
              "");
}

}  // namespace
}  // namespace samara
