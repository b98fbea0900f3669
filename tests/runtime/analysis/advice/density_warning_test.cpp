#include "samara/analysis/advice/density_warning.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/hard_bodies.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

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
