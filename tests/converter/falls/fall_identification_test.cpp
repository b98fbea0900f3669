#include "converter/falls/fall_identification.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "converter/falls/motion_parameters.hpp"
#include "samara/core/body/body_file.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "synthetic_fall.hpp"

namespace samara {
namespace {

using testing::HasSubstr;
using testing::Not;

// Returns coefficients with numbers (motion_parameters.hpp) alternately above and below the first of each
// pair by `share` of the second.
DynamicCoefficients coefficients_off_by(const Body& body, double share) {
    const std::pair<double, double> terms[] = {{0.0, 0.5}, {0.3, 0.25}, {0.3, 0.25}, {0.0, 0.25}};
    const MotionParameters parameters(body);
    Eigen::VectorXd numbers(static_cast<Eigen::Index>(parameters.all().size()));
    for (Eigen::Index i = 0; i + 1 < numbers.size(); ++i) {
        const auto& [middle, difference] = terms[i / 3];
        numbers[i] = middle + (i % 2 == 0 ? share : -share) * difference;
    }
    numbers[numbers.size() - 1] = 1.0 + 0.1 * share;
    return parameters.coefficients(numbers);
}

// A fall of a body that flutters steadily, for which the expectation is wrong.
DynamicCoefficients true_coefficients(const Body& body) {
    return coefficients_off_by(body, 1.0);
}

FallRecord with_noise(FallRecord record, double deviation) {
    std::mt19937_64 generator(1);
    std::normal_distribution<double> normal(0.0, deviation);
    const auto noise = [&] { return Vector3d(normal(generator), normal(generator), normal(generator)); };
    for (FallSample& sample : record.samples) {
        sample.velocity += noise();
        sample.angular_velocity += noise();
    }
    return record;
}

double relative_difference(const Matrix3d& found, const Matrix3d& expected) {
    return (found - expected).norm() / expected.norm();
}

// The share of the expectation's error that may remain after one fall.
constexpr double remaining = 0.15;

constexpr double noise = 0.05;  // over U, and U/L

// One fall of known coefficients, and what is identified from it.
class FallIdentification : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        body_ = test::ellipsoid_with_tables();
        true_ = true_coefficients(body_);
        record_ = test::record_of(body_, test::oblique_fall(body_, 30.0), true_);
        found_ = identify_motion(body_, {record_});
    }

    static inline Body body_;
    static inline DynamicCoefficients true_;
    static inline FallRecord record_;
    static inline Identification found_;
};

TEST_F(FallIdentification, FindsTheCoefficientsThatAFallWasSimulatedWith) {
    const DynamicCoefficients& found = found_.coefficients.values;
    EXPECT_LT(relative_difference(found.transport, true_.transport), 0.03);
    EXPECT_EQ(found.half_length, true_.half_length);
}

// Rotational drag and that in spin are hard to tell from each other in one fall; what they do together is
// not.
TEST_F(FallIdentification, FindsTheRotationalDragOfTheRotationOfTheFall) {
    const DynamicCoefficients& found = found_.coefficients.values;
    const double speed = found_.falls.front().solved.mean_velocity.norm();
    const double tip_speed = true_.half_length * found_.falls.front().solved.rms_angular_speed;
    const double spin = tip_speed * tip_speed / (speed * speed + tip_speed * tip_speed);
    const auto drag = [&](const DynamicCoefficients& of) -> Matrix3d {
        return of.rotational_drag + spin * of.rotational_drag_in_spin;
    };
    EXPECT_LT((drag(found) - drag(true_)).norm(), 0.1 * drag(true_).norm());
}

// But for the pull of the expectation, which all stretches of the fall feel alike.
TEST_F(FallIdentification, StatesErrorsThatHoldTheTruth) {
    const DynamicCoefficients& found = found_.coefficients.values;
    const DynamicCoefficients middle = coefficients_off_by(body_, 0.0);
    constexpr double pull = remaining / 10.0;
    const DynamicCoefficients& errors = found_.coefficients.standard_errors;
    for (const TensorOfMotion& tensor : tensors_of_motion) {
        const Vector3d difference = (found.*tensor.member - true_.*tensor.member).diagonal();
        const Vector3d error = (errors.*tensor.member).diagonal();
        const Vector3d wrong = (true_.*tensor.member - middle.*tensor.member).diagonal();
        for (int i = 0; i < 3; ++i) {
            EXPECT_LE(std::abs(difference[i]), 3.0 * error[i] + pull * std::abs(wrong[i]))
                << tensor.name << i;
        }
    }
    for (const NumberOfMotion& number : numbers_of_motion) {
        EXPECT_NEAR(found.*number.member, true_.*number.member, 3.0 * (errors.*number.member)) << number.name;
    }
}

// Otherwise the test above would hold for any coefficients.
TEST_F(FallIdentification, StatesSmallErrorsOfWhatAFallSays) {
    const IdentifiedCoefficients& found = found_.coefficients;
    EXPECT_LT(found.standard_errors.transport.norm(), 0.1 * found.values.transport.norm());
}

TEST_F(FallIdentification, PredictsTheFallItIsFrom) {
    EXPECT_LT(found_.prediction_error, 0.01);
    EXPECT_GT(found_.segments, 50);
    ASSERT_EQ(found_.falls.size(), 1u);
    const auto& [name, solved, simulated, balance] = found_.falls.front();
    EXPECT_EQ(name, "fall_00");
    const double density = record_.fall.mass / record_.fall.volume;
    EXPECT_DOUBLE_EQ(found_.coefficients.densities.lowest, density);
    EXPECT_DOUBLE_EQ(found_.coefficients.densities.highest, density);
    EXPECT_NEAR(simulated.descent_speed, solved.descent_speed, 0.02 * solved.descent_speed);
    EXPECT_NEAR(simulated.mean_inclination, solved.mean_inclination, 0.02 * solved.mean_inclination);
    EXPECT_NEAR(simulated.inclination_amplitude, solved.inclination_amplitude,
                0.02 * solved.inclination_amplitude);
    EXPECT_NEAR(simulated.rms_angular_speed, solved.rms_angular_speed, 0.02 * solved.rms_angular_speed);
    ASSERT_TRUE(solved.frequency && simulated.frequency);
    EXPECT_NEAR(*simulated.frequency, *solved.frequency, 0.02 * *solved.frequency);
    EXPECT_EQ(simulated.regime, solved.regime);
}

TEST_F(FallIdentification, PredictsWorseWithTheDefaults) {
    const FallRecord by_default = test::record_of(
        body_, record_.fall, MotionParameters(body_).coefficients(MotionParameters(body_).expected()));
    double largest = 0.0;
    for (std::size_t i = 0; i < 300; ++i) {
        largest = std::max(largest, (by_default.samples[i].velocity - record_.samples[i].velocity).norm());
    }
    EXPECT_GT(largest, 0.1);
}

TEST_F(FallIdentification, GivesCoefficientsThatABodyFileTakes) {
    EXPECT_EQ(error_of(found_.coefficients.values), "");
    EXPECT_THAT(found_.coefficients.values.origin, HasSubstr("fall_00"));
    Body body = body_;
    body.dynamic = found_.coefficients;
    const test::TemporaryFolder folder;
    write_body_file(folder.path() / "body.body.h5", body);
    const Body read = read_body_file(folder.path() / "body.body.h5");
    ASSERT_TRUE(read.dynamic);
    for (const TensorOfMotion& tensor : tensors_of_motion) {
        EXPECT_EQ(read.dynamic->values.*tensor.member, found_.coefficients.values.*tensor.member)
            << tensor.name;
        EXPECT_EQ(read.dynamic->standard_errors.*tensor.member,
                  found_.coefficients.standard_errors.*tensor.member)
            << tensor.name;
    }
    EXPECT_EQ(read.dynamic->values.origin, found_.coefficients.values.origin);
}

TEST_F(FallIdentification, IsLessCertainOfANoisyFall) {
    const Identification noisy = identify_motion(body_, {with_noise(record_, noise)});
    EXPECT_GT(noisy.prediction_error, noise);
    // It determines the states at the start of simulations, and the wake along them.
    EXPECT_LT(noisy.prediction_error, 3.0 * noise);
    EXPECT_GT(noisy.coefficients.standard_errors.rotational_drag.norm(),
              1.2 * found_.coefficients.standard_errors.rotational_drag.norm());
    EXPECT_LT(relative_difference(noisy.coefficients.values.transport, true_.transport), 0.1);
}

TEST_F(FallIdentification, HasTheSameBitsEachTime) {
    const Identification again = identify_motion(body_, {record_});
    for (const TensorOfMotion& tensor : tensors_of_motion) {
        EXPECT_EQ(again.coefficients.values.*tensor.member, found_.coefficients.values.*tensor.member)
            << tensor.name;
    }
    EXPECT_EQ(again.prediction_error, found_.prediction_error);
}

TEST_F(FallIdentification, SaysHowFarItIs) {
    std::vector<double> shares;
    FallRecord shorter = record_;
    shorter.samples.resize(1000);
    static_cast<void>(identify_motion(body_, {shorter}, {}, [&](double share) { shares.push_back(share); }));
    ASSERT_GT(shares.size(), 2u);
    EXPECT_TRUE(std::ranges::is_sorted(shares));
    EXPECT_EQ(shares.front(), 0.0);
    EXPECT_EQ(shares.back(), 1.0);
}

std::string error_with(const Body& body, const FallRecord& record) {
    return test::error_of([&] { static_cast<void>(identify_motion(body, {record})); });
}

// A case's start has the momenta of body and fluid in the body alone, which is faster than it will be.
TEST_F(FallIdentification, FliesAFallFromTheSpeedItHasAfterTheFirstInstant) {
    FreeFall fall = test::oblique_fall(body_, 2.0);
    fall.velocity = {1.0, -3.0, 2.0};
    fall.angular_velocity = {0.5, 4.0, -2.0};
    Body body = body_;
    body.dynamic = {.values = true_, .standard_errors = {}, .densities = {}};
    const auto& [name, solved, simulated, balance] = simulate_fall(body, test::record_of(body, fall, true_));
    EXPECT_LT((simulated.mean_velocity - solved.mean_velocity).norm(), 0.01 * solved.mean_velocity.norm());
    EXPECT_NEAR(simulated.rms_angular_speed, solved.rms_angular_speed, 0.01 * solved.rms_angular_speed);
}

TEST_F(FallIdentification, ShowsAFallAndItsSimulationWithGravityDownwards) {
    Body body = body_;
    body.dynamic = {.values = true_, .standard_errors = {}, .densities = {}};
    const FallMotions motions = fall_motions(body, record_);
    const SimulatedFall metrics = simulate_fall(body, record_);
    EXPECT_EQ(motions.solved.times, motions.simulated.times);
    for (const Motion* motion : {&motions.solved, &motions.simulated}) {
        EXPECT_LT((motion->gravity.normalized() + Vector3d::UnitZ()).norm(), 1e-12);
        EXPECT_EQ(motion->bodies[0].surface.corners, body.surface.corners);
        EXPECT_LT(motion->bodies[0].poses.back().position.z(), 0.0);
    }
    const Measures measures = measure(motions.simulated, motions.simulated.bodies[0]);
    EXPECT_NEAR(measures.descent_speed, metrics.simulated.descent_speed,
                1e-9 * metrics.simulated.descent_speed);
    EXPECT_NEAR(measures.inclination_amplitude, metrics.simulated.inclination_amplitude, 1e-9);
}

TEST_F(FallIdentification, LeavesOutTheTermsThatItIsToldTo) {
    const Identification without =
        identify_motion(body_, {record_}, {.terms = {"rotational drag", "drag in spin"}});
    EXPECT_EQ(without.coefficients.values.drag_in_spin, Matrix3d::Zero());
    EXPECT_EQ(without.coefficients.values.rotational_drag, Matrix3d::Zero());
    EXPECT_EQ(without.coefficients.standard_errors.rotational_drag, Matrix3d::Zero());
    EXPECT_GT(without.prediction_error, 3.0 * found_.prediction_error);
    EXPECT_THAT(
        test::error_of([&] { static_cast<void>(identify_motion(body_, {record_}, {.terms = {"wake"}})); }),
        HasSubstr("there is no term 'wake'; the terms are transport, "));
}

TEST_F(FallIdentification, LeavesOutAStretchOfTheFallAndFindsTheSame) {
    const Identification without = identify_motion(body_, {record_}, {.stretch = 2});
    const double share = static_cast<double>(without.segments) / found_.segments;
    EXPECT_NEAR(share, 1.0 - 1.0 / identification_stretches, 0.02);
    const Matrix3d difference = without.coefficients.values.transport - true_.transport;
    EXPECT_LT(difference.norm(), 0.01 * true_.transport.norm());
}

// Fitted only to its segments the body falls 8 % too slowly here, with oscillations a tenth too small.
TEST_F(FallIdentification, KeepsTheMetricsOfTheWholeFallWhereTheModelCannotFollowIt) {
    const Identification without = identify_motion(body_, {record_}, {.terms = {"rotational drag"}});
    EXPECT_GT(without.prediction_error, 5.0 * found_.prediction_error);
    const auto& [name, solved, simulated, balance] = without.falls.front();
    // The descent speed is within fitted_miss, the others within half of it.
    EXPECT_NEAR(simulated.descent_speed, solved.descent_speed, 0.05 * solved.descent_speed);
    EXPECT_NEAR(simulated.inclination_amplitude, solved.inclination_amplitude,
                0.125 * solved.inclination_amplitude);
    EXPECT_NEAR(simulated.rms_angular_speed, solved.rms_angular_speed, 0.125 * solved.rms_angular_speed);
}

TEST_F(FallIdentification, RejectsToIdentifyFromNothing) {
    EXPECT_EQ(test::error_of([&] { static_cast<void>(identify_motion(body_, {})); }),
              "exact: has no falls to identify coefficients from; give folders of solved falls");
}

TEST_F(FallIdentification, RejectsAFallThatIsTooShort) {
    FallRecord record = record_;
    record.fall.name = "fall_07";
    record.samples.resize(899);
    EXPECT_EQ(error_with(body_, record),
              "fall_07: the fall is too short to identify coefficients: it lasts 8.99 L/U and must last 9; "
              "solve a longer one");
    record.samples.clear();
    EXPECT_EQ(error_with(body_, record),
              "fall_07: the fall is too short to identify coefficients: it lasts 0 L/U and must last 9; "
              "solve a longer one");
    record.samples.assign(record_.samples.begin(), record_.samples.begin() + 900);
    EXPECT_EQ(identify_motion(body_, {record}).segments, 12);
}

TEST_F(FallIdentification, RejectsAFallOfAnotherBody) {
    FallRecord record = record_;
    record.fall.name = "fall_07";
    record.fall.length *= 1.01;
    const std::string error = error_with(body_, record);
    EXPECT_THAT(error, HasSubstr("fall_07: the fall belongs to another body"));
    EXPECT_THAT(error, Not(HasSubstr("\n")));
}

TEST_F(FallIdentification, RejectsAFallWhoseStepsAreUneven) {
    FallRecord record = record_;
    record.fall.name = "fall_07";
    record.samples.erase(record.samples.begin() + 500);
    EXPECT_EQ(error_with(body_, record),
              "fall_07: the fall's steps are not equal: 0.01 L/U at first, but different at 5.02; solve the "
              "fall again");
}

}  // namespace
}  // namespace samara
