#include "samara/analysis/comparison/reference_uncertainty.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "irregular_flutter.hpp"
#include "samara/motion/motion_file.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "synthetic_motion.hpp"

namespace samara {
namespace {

using test::degree;
using ::testing::Each;
using ::testing::Field;
using ::testing::HasSubstr;

class ReferenceUncertainty : public testing::Test {
  protected:
    [[nodiscard]] std::vector<MetricUncertainty> beside(const Motion& reference, const Motion& other) const {
        write_motion_file(folder_ / "reference.h5", reference);
        write_motion_file(folder_ / "other.h5", other);
        return uncertainty_beside(folder_ / "reference.h5", folder_ / "other.h5", "mesh");
    }

    test::TemporaryFolder folder_;
};

Motion flutter(double frequency, double amplitude, double speed) {
    return test::motion_of([=](double t) { return test::flutter(t, frequency, amplitude, speed); }, 6.0,
                           240.0);
}

double of(const std::vector<MetricUncertainty>& uncertainties, const char* metric) {
    BodyMotion body;
    body.uncertainties = uncertainties;
    return uncertainty_of(body, metric);
}

TEST_F(ReferenceUncertainty, IsTheWholeDifferenceToTheOtherSolution) {
    const auto known = beside(flutter(1.25, 32.0 * degree, 0.22), flutter(1.375, 40.0 * degree, 0.198));
    EXPECT_NEAR(of(known, "descent_speed"), 0.1, 2e-3);
    EXPECT_NEAR(of(known, "frequency"), 0.1, 2e-3);
    EXPECT_NEAR(of(known, "inclination_amplitude"), 0.25, 5e-3);
    EXPECT_EQ(of(known, "regime"), 0.0);
    EXPECT_THAT(known, Each(Field(&MetricUncertainty::cause, "mesh")));
    EXPECT_TRUE(std::ranges::is_sorted(known, {}, &MetricUncertainty::metric));
}

TEST_F(ReferenceUncertainty, IsNoLessThanWhatChanceHides) {
    const Motion motion = test::irregular_flutter(5, 8.0);
    const auto known = beside(motion, motion);
    EXPECT_THAT(known, Each(Field(&MetricUncertainty::relative, 0.0)));
    EXPECT_GT(of(known, "descent_speed"), 0.0);
    EXPECT_GT(of(known, "frequency"), 1e-3);
}

TEST_F(ReferenceUncertainty, OfTheRegimeAndOfAMetricThatOneOfTwoLacksIsWhole) {
    const Motion fluttering = flutter(1.25, 32.0 * degree, 0.22);
    const Motion steady =
        test::motion_of([](double t) { return test::flutter(t, 1.0, 0.0, 0.22); }, 6.0, 240.0);
    const auto known = beside(fluttering, steady);
    EXPECT_EQ(of(known, "regime"), 1.0);
    EXPECT_EQ(of(known, "frequency"), 1.0);
}

TEST_F(ReferenceUncertainty, IsOfOneSceneAlone) {
    const Motion reference = flutter(1.25, 32.0 * degree, 0.22);
    Motion other = reference;
    other.scene_text += "# another";
    EXPECT_THAT(test::error_of([&] { (void)beside(reference, other); }),
                HasSubstr("is not from the same scene as"));
    other = reference;
    other.bodies.push_back(other.bodies.front());
    other.bodies.back().name = "second";
    EXPECT_THAT(test::error_of([&] { (void)beside(reference, other); }), HasSubstr("holds several bodies"));
}

TEST(UncertaintyOf, AMetricHoldsItsChanceOnce) {
    BodyMotion body;
    body.uncertainties = {{"closure", "frequency", 0.003, 0.04}, {"mesh", "frequency", 0.01, 0.05}};
    EXPECT_DOUBLE_EQ(uncertainty_of(body, "frequency"), 0.05);
    body.uncertainties.front().relative = 0.06;
    EXPECT_DOUBLE_EQ(uncertainty_of(body, "frequency"), 0.07);
}

TEST(UncertaintyOf, AMetricIsTheSumOverTheCauses) {
    BodyMotion body;
    EXPECT_EQ(uncertainty_of(body, "frequency"), 0.0);
    body.uncertainties = {
        {"closure", "frequency", 0.04}, {"mesh", "descent_speed", 1.0}, {"mesh", "frequency", 0.03}};
    EXPECT_DOUBLE_EQ(uncertainty_of(body, "frequency"), 0.07);
}

}  // namespace
}  // namespace samara
