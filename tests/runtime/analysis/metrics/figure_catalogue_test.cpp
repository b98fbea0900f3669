#include "samara/analysis/metrics/figure_catalogue.hpp"

#include <set>
#include <string>

#include <gtest/gtest.h>

#include "samara/analysis/comparison/comparison.hpp"
#include "samara/analysis/metrics/regime_counts.hpp"

namespace samara {
namespace {

double share(Figure figure) {
    return catalogued(figure).allowed.share;
}

TEST(FigureCatalogue, AllowsErrorsInTheProportionsOneTwoThree) {
    EXPECT_EQ(share(Figure::descent_speed), 1.0);
    EXPECT_EQ(share(Figure::frequency), 2.0);
    for (const Figure figure :
         {Figure::inclination_amplitude, Figure::rms_angular_speed, Figure::path_spread}) {
        EXPECT_EQ(share(figure), 3.0);
    }
    // samara compare's defaults.
    EXPECT_EQ(usual_tolerances()[Figure::descent_speed], 0.1);
    EXPECT_EQ(usual_tolerances()[Figure::frequency], 0.2);
    EXPECT_EQ(usual_tolerances()[Figure::inclination_amplitude], 0.3);
}

TEST(FigureCatalogue, SaysOfEveryFigureThatIsJudgedHowFarOffItMayBe) {
    for (const Figure figure : compared_figures) EXPECT_GT(share(figure), 0.0);
    for (const Figure figure : advised_figures) EXPECT_GT(share(figure), 0.0);
    for (const Figure figure : baked_figures) EXPECT_GT(share(figure), 0.0);
    for (const Figure figure : fitted_figures) {
        EXPECT_GT(catalogued(figure).fitted_miss, 0.0);
        EXPECT_TRUE(catalogued(figure).measured);
    }
}

TEST(FigureCatalogue, HasAKeyOfItsOwnForEveryFigure) {
    std::set<std::string> keys;
    for (const CataloguedFigure& entry : figure_catalogue) keys.insert(entry.key);
    EXPECT_EQ(keys.size(), figure_count);
}

TEST(FigureCatalogue, TakesItsValuesFromTheMeasures) {
    Measures measures;
    measures.descent_speed = 1.0;
    measures.inclination_amplitude = 2.0;
    measures.mean_inclination = 3.0;
    measures.rms_angular_speed = 4.0;
    EXPECT_EQ(catalogued(Figure::descent_speed).measured(measures), 1.0);
    EXPECT_EQ(catalogued(Figure::inclination_amplitude).measured(measures), 2.0);
    EXPECT_EQ(catalogued(Figure::mean_inclination).measured(measures), 3.0);
    EXPECT_EQ(catalogued(Figure::rms_angular_speed).measured(measures), 4.0);
    EXPECT_FALSE(catalogued(Figure::frequency).measured(measures));
    measures.frequency = 5.0;
    EXPECT_EQ(catalogued(Figure::frequency).measured(measures), 5.0);
}

TEST(RegimeCounts, TheCommonestIsTheFirstOfEquals) {
    RegimeCounts regimes;
    EXPECT_EQ(regimes.share(Regime::steady), 0.0);
    for (const Regime regime : {Regime::chaotic, Regime::tumbling, Regime::chaotic, Regime::tumbling}) {
        regimes.add(regime);
    }
    EXPECT_EQ(regimes.commonest(), Regime::tumbling);
    EXPECT_EQ(regimes.share(Regime::chaotic), 0.5);
    EXPECT_EQ(regimes.total(), 4);
    regimes.add(Regime::chaotic);
    EXPECT_EQ(regimes.commonest(), Regime::chaotic);
}

}  // namespace
}  // namespace samara
