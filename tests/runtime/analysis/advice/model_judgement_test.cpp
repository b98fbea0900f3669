#include "samara/analysis/advice/model_judgement.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/expect_error.hpp"
#include "support/known_bodies.hpp"

namespace samara {
namespace {

using testing::HasSubstr;

Measures falling(double descent, Regime regime = Regime::fluttering) {
    Measures fall;
    fall.descent_speed = descent;
    fall.frequency = 2.0;
    fall.inclination_amplitude = 0.5;
    fall.rms_angular_speed = 3.0;
    fall.regime = regime;
    return fall;
}

TEST(ModelJudgement, TheMissOfAFallIsTheRootMeanSquareOfItsMetrics) {
    EXPECT_EQ(miss_of(falling(1.0), falling(1.0)), 0.0);
    EXPECT_NEAR(miss_of(falling(1.0), falling(1.2)), std::log(1.2) / std::sqrt(5.0), 1e-12);
    EXPECT_NEAR(miss_of(falling(1.0), falling(1.2)), miss_of(falling(1.2), falling(1.0)), 1e-12);
    EXPECT_NEAR(miss_of(falling(1.0), falling(1.0, Regime::tumbling)), std::sqrt(0.2), 1e-12);
    EXPECT_NEAR(miss_of(falling(1.0), falling(99.0)), std::sqrt(0.2), 1e-12);  // no miss counts more than 1
    Measures still = falling(1.0);
    still.frequency.reset();
    EXPECT_NEAR(miss_of(falling(1.0), still), std::sqrt(0.2), 1e-12);
    EXPECT_NEAR(miss_of(still, falling(1.0)), std::sqrt(0.2), 1e-12);
    EXPECT_EQ(miss_of(still, still), 0.0);
}

TEST(ModelJudgement, FallsThatAutorotateMissByDescentSpinAndConing) {
    Measures fall = falling(1.0, Regime::autorotating);
    fall.autorotation = Autorotation{.spin_rate = 30.0, .coning_angle = 0.2};
    Measures other = fall;
    other.frequency.reset();
    other.inclination_amplitude = 0.001;
    EXPECT_EQ(miss_of(fall, other), 0.0);
    other.autorotation->spin_rate = 40.0;
    EXPECT_NEAR(miss_of(fall, other), std::log(4.0 / 3.0) / 2.0, 1e-12);
    EXPECT_NEAR(miss_of(fall, falling(1.0)), std::sqrt(0.2), 1e-12);
}

TEST(ModelJudgement, RecommendsTheModelsThatAreNearestToTheFalls) {
    Body body = test::rubber_ellipsoid();
    body.tables = test::blunt_tables(body, 2);
    body.surface_loads = SurfaceLoads();
    const auto judged_by = [&](double of_table, double of_two_patches) {
        return judge_models(body, {falling(1.0), falling(2.0)},
                            [&](const RecommendedModels& models, std::size_t i) {
                                const double best = models.loads == Loads::table ? of_table
                                                    : models.patches == 2        ? of_two_patches
                                                                                 : 3.0;
                                return falling(best * (i == 0 ? 1.0 : 2.0));
                            });
    };
    const RecommendedModels of_surface = judged_by(1.5, 1.1).recommended();
    EXPECT_EQ(of_surface.loads, Loads::surface);
    EXPECT_EQ(of_surface.patches, 2);
    EXPECT_EQ(of_surface.turbulence, Turbulence::table);
    EXPECT_THAT(of_surface.origin, HasSubstr("2 falls"));
    EXPECT_EQ(judged_by(1.1, 1.5).recommended().loads, Loads::table);
    // Where none is better by a third the first stays, which is the simplest.
    EXPECT_EQ(judged_by(1.100, 1.080).recommended().loads, Loads::table);
    EXPECT_THAT(as_text(judged_by(1.5, 1.1)), HasSubstr("loads surface, 2 patches, turbulence table"));
}

TEST(ModelJudgement, NeedsTablesOrSurfaceLoads) {
    EXPECT_THAT(test::error_of([] {
                    static_cast<void>(judge_models(test::rubber_ellipsoid(), {falling(1.0)},
                                                   [](const auto&, std::size_t) { return falling(1.0); }));
                }),
                HasSubstr("holds neither tables nor surface loads"));
}

}  // namespace
}  // namespace samara
