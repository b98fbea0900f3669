#include "samara/analysis/metrics/metric_catalogue.hpp"

#include <set>
#include <string>

#include <gtest/gtest.h>

#include "samara/analysis/comparison/comparison.hpp"

namespace samara {
namespace {

double share(Metric metric) {
    return catalogued(metric).allowed.share;
}

TEST(MetricCatalogue, AllowsErrorsInTheProportionsOneTwoThree) {
    EXPECT_EQ(share(Metric::descent_speed), 1.0);
    EXPECT_EQ(share(Metric::frequency), 2.0);
    for (const Metric metric :
         {Metric::inclination_amplitude, Metric::rms_angular_speed, Metric::path_spread}) {
        EXPECT_EQ(share(metric), 3.0);
    }
    // samara compare's defaults.
    EXPECT_EQ(usual_tolerances()[Metric::descent_speed], 0.1);
    EXPECT_EQ(usual_tolerances()[Metric::frequency], 0.2);
    EXPECT_EQ(usual_tolerances()[Metric::inclination_amplitude], 0.3);
}

TEST(MetricCatalogue, SaysOfEveryMetricThatIsJudgedHowFarOffItMayBe) {
    for (const Metric metric : compared_metrics) EXPECT_GT(share(metric), 0.0);
    for (const Metric metric : advised_metrics) EXPECT_GT(share(metric), 0.0);
    for (const Metric metric : baked_metrics) EXPECT_GT(share(metric), 0.0);
    for (const Metric metric : fitted_metrics) {
        EXPECT_GT(catalogued(metric).fitted_miss, 0.0);
        EXPECT_TRUE(catalogued(metric).measured);
    }
}

TEST(MetricCatalogue, HasAKeyOfItsOwnForEveryMetric) {
    std::set<std::string> keys;
    for (const CataloguedMetric& entry : metric_catalogue) keys.insert(entry.key);
    EXPECT_EQ(keys.size(), metric_count);
}

TEST(MetricCatalogue, TakesItsValuesFromTheMeasures) {
    Measures measures;
    measures.descent_speed = 1.0;
    measures.inclination_amplitude = 2.0;
    measures.mean_inclination = 3.0;
    measures.rms_angular_speed = 4.0;
    EXPECT_EQ(catalogued(Metric::descent_speed).measured(measures), 1.0);
    EXPECT_EQ(catalogued(Metric::inclination_amplitude).measured(measures), 2.0);
    EXPECT_EQ(catalogued(Metric::mean_inclination).measured(measures), 3.0);
    EXPECT_EQ(catalogued(Metric::rms_angular_speed).measured(measures), 4.0);
    EXPECT_FALSE(catalogued(Metric::frequency).measured(measures));
    measures.frequency = 5.0;
    EXPECT_EQ(catalogued(Metric::frequency).measured(measures), 5.0);
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
