#include "converter/falls/fall_record.hpp"

#include <cmath>
#include <cstring>
#include <functional>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/expect_error.hpp"
#include "support/known_bodies.hpp"
#include "support/temporary_folder.hpp"
#include "synthetic_fall.hpp"

namespace samara {
namespace {

using testing::HasSubstr;

// The headings by OpenFOAM v1912.
constexpr const char* state_heading =
    "# Motion State      \n# Angle Units       : radians\n"
    "# Time              \tcentreOfRotation\tcentreOfMass\trotation\tvelocity\tomega\n";
constexpr const char* force_heading =
    "# Force             \n# CofR              : (0.000000000000e+00 0.000000000000e+00 "
    "0.000000000000e+00)\n#\n"
    "# Time              \t(total_x total_y total_z)\t(pressure_x pressure_y pressure_z)\t(viscous_x "
    "viscous_y viscous_z)\n";

// The principal axes of a body that was given to pimpleFoam v1912, and the angles that it wrote of them.
Matrix3d axes_given_to_openfoam() {
    Matrix3d axes;
    axes << -0.3337499770817988, 0.40521851895241373, -0.8511221444046158,  //
        0.5379595723725796, -0.6595551249202286, -0.5249633660401203,       //
        -0.7740868499662104, -0.6330758162254139, 0.0021353266532188053;
    return axes;
}
constexpr const char* angles_openfoam_wrote = "(1.566728776533e+00 -1.018119153679e+00 -2.259780427167e+00)";

class FallRecordFiles : public testing::Test {
  protected:
    void write(const char* function, const char* file, const std::string& text) {
        static_cast<void>(folder_.file(std::string("postProcessing/") + function + "/0/" + file, text));
    }
    void write_fall(const FreeFall& fall) {
        static_cast<void>(folder_.file("fall.json", free_fall_json(fall)));
    }
    [[nodiscard]] FallRecord record() const { return read_fall_record(folder_.path()); }

    static FreeFall fall() {
        FreeFall fall;
        fall.reynolds_number = 1e4;
        fall.volume = 0.4;
        fall.mass = 0.5;
        fall.duration = 1.0;
        fall.time_step = 0.5;
        return fall;
    }

    test::TemporaryFolder folder_;
};

TEST_F(FallRecordFiles, GivePlaceVelocityAndLoadsAboutTheCentreOfMass) {
    write_fall(fall());
    write("state", "sixDoFRigidBodyState.dat",
          state_heading + std::string("0.5\t(9 9 9)\t(1 2 3)\t(0 0 0)\t(0.1 0.2 0.3)\t(-1 -2 -3)\n"
                                      "1\t(9 9 9)\t(1 2 4)\t(0 0 0.1)\t(0.4 0.5 0.6)\t(4 5 6)\n"));
    write("forces", "force.dat",
          force_heading + std::string("0.5\t(0 0 2)\t(0 0 1)\t(0 0 1)\n1\t(1 0 0)\t(1 0 0)\t(0 0 0)\n"));
    write("forces", "moment.dat",
          force_heading + std::string("0.5\t(5 5 5)\t(5 5 5)\t(0 0 0)\n1\t(5 5 5)\t(5 5 5)\t(0 0 0)\n"));
    const FallRecord read = record();
    ASSERT_EQ(read.samples.size(), 2u);
    const FallSample& first = read.samples[0];
    EXPECT_EQ(first.time, 0.5);
    EXPECT_EQ(first.position, Vector3d(1, 2, 3));
    EXPECT_EQ(first.velocity, Vector3d(0.1, 0.2, 0.3));
    EXPECT_EQ(first.angular_velocity, Vector3d(-1, -2, -3));
    EXPECT_EQ(first.force, Vector3d(0, 0, 2));
    // (1, 2, 3) x (0, 0, 2) = (4, -2, 0)
    EXPECT_EQ(first.moment, Vector3d(1, 7, 5));
    // (1, 2, 4) x (1, 0, 0) = (0, 4, -2)
    EXPECT_EQ(read.samples[1].moment, Vector3d(5, 1, 7));
    EXPECT_NEAR(read.samples[1].rotation(1, 0), std::sin(0.1), 1e-15);
}

TEST_F(FallRecordFiles, TakeTheSolversAnglesForRotationsOfThePrincipalAxes) {
    FreeFall rotated = fall();
    rotated.principal_axes = axes_given_to_openfoam();
    rotated.time_step = 1.0;
    write_fall(rotated);
    write("state", "sixDoFRigidBodyState.dat",
          fmt::format("{}1\t(0 0 0)\t(0 0 0)\t{}\t(0 0 0)\t(0 0 0)\n", state_heading, angles_openfoam_wrote));
    for (const char* file : {"force.dat", "moment.dat"}) {
        write("forces", file, force_heading + std::string("1\t(0 0 0)\t(0 0 0)\t(0 0 0)\n"));
    }
    EXPECT_LT((record().samples[0].rotation - Matrix3d::Identity()).norm(), 1e-10);
}

TEST_F(FallRecordFiles, AreRejectedWhereOneIsMissingOrOfOtherTimes) {
    const auto error = [&] { return test::error_of([&] { static_cast<void>(record()); }); };
    EXPECT_THAT(error(), HasSubstr("fall.json: is missing"));
    write_fall(fall());
    EXPECT_THAT(error(), HasSubstr("postProcessing/state"));
    write("state", "sixDoFRigidBodyState.dat",
          state_heading + std::string("1\t(0 0 0)\t(0 0 0)\t(0 0 0)\t(0 0 0)\t(0 0 0)\n"));
    EXPECT_THAT(error(), HasSubstr("postProcessing/forces"));
    for (const char* file : {"force.dat", "moment.dat"}) {
        write("forces", file, force_heading + std::string("0.5\t(0 0 0)\t(0 0 0)\t(0 0 0)\n"));
    }
    EXPECT_THAT(error(), HasSubstr("have different times"));
}

TEST_F(FallRecordFiles, AreRejectedWhereAnyIsCutShortEmptiedOrBeyondReason) {
    write_fall(fall());
    const std::string state =
        "0.5 (0 0 0) (0 0 0) (0 0 0) (0 0 0) (0 0 0)\n1 (0 0 0) (0 0 0) (0 0 0) (0 0 0) (0 0 0)\n";
    const std::string loads = "0.5 (0 0 0) (0 0 0) (0 0 0)\n1 (0 0 0) (0 0 0) (0 0 0)\n";
    const auto write_all = [&](const std::string& states, const std::string& forces,
                               const std::string& moments) {
        write("state", "sixDoFRigidBodyState.dat", state_heading + states);
        write("forces", "force.dat", force_heading + forces);
        write("forces", "moment.dat", force_heading + moments);
    };
    const auto error_with = [&](const std::string& states, const std::string& forces,
                                const std::string& moments) {
        write_all(states, forces, moments);
        const std::string error = test::error_of([&] { static_cast<void>(record()); });
        EXPECT_EQ(error.find('\n'), std::string::npos) << error;
        return error;
    };
    const auto first_row = [](const std::string& text) { return text.substr(0, text.find('\n') + 1); };
    const auto second_row = [](const std::string& text) { return text.substr(text.find('\n') + 1); };
    write_all(state, loads, loads);
    EXPECT_EQ(record().samples.size(), 2u);
    EXPECT_THAT(error_with(first_row(state), loads, loads), HasSubstr("end at the time 0.5, not at 1"));
    EXPECT_THAT(error_with(state, first_row(loads), loads), HasSubstr("end at the time 0.5, not at 1"));
    EXPECT_THAT(error_with(state, loads, first_row(loads)), HasSubstr("end at the time 0.5, not at 1"));
    EXPECT_THAT(error_with(state, loads, second_row(loads)), HasSubstr("have different times"));
    EXPECT_THAT(error_with(second_row(state), second_row(loads), second_row(loads)),
                HasSubstr("it has no values between the times 0 and 1"));
    EXPECT_THAT(error_with(state, loads, ""), HasSubstr("moment.dat: holds no values"));
    for (const char* value : {"1e20", "nan", "1e400", "-inf"}) {
        // The first vector of a state, the centre of rotation, does not count.
        const auto damaged = [&](std::string text, const char* before) {
            return text.replace(text.find(before) + std::strlen(before), 1, value);
        };
        EXPECT_THAT(error_with(damaged(state, ") ("), loads, loads),
                    HasSubstr("at the time 0.5 has the magnitude"))
            << value;
        EXPECT_THAT(error_with(state, damaged(loads, "("), loads),
                    HasSubstr("at the time 0.5 has the magnitude"))
            << value;
        EXPECT_THAT(error_with(state, loads, damaged(loads, "(")),
                    HasSubstr("at the time 0.5 has the magnitude"))
            << value;
    }
}

// A rigid body under known loads, in steps of 0.005.
struct DrivenMotion {
    FreeFall fall;
    std::function<Vector3d(double)> force = [](double) { return Vector3d::Zero().eval(); };
    /// The angular acceleration by rotation and angular velocity.
    std::function<Vector3d(const Matrix3d&, const Vector3d&)> angular_acceleration;
    std::function<Vector3d(const Matrix3d&)> moment = [](const Matrix3d&) { return Vector3d::Zero().eval(); };
};

// Integrates with steps a hundred times as short.
FallRecord solved(const DrivenMotion& motion, const Vector3d& angular_velocity) {
    constexpr int substeps = 100;
    constexpr double step = 0.005;
    FallRecord record;
    record.fall = motion.fall;
    FallSample now;
    now.angular_velocity = angular_velocity;
    const Vector3d weight = (motion.fall.mass - motion.fall.volume) * motion.fall.gravity;
    for (int i = 1; i <= 600; ++i) {
        for (int j = 0; j < substeps; ++j) {
            const double h = step / substeps;
            const double middle = now.time + 0.5 * h;
            now.velocity += h / motion.fall.mass * (weight + motion.force(middle));
            const Vector3d guess = now.angular_velocity +
                                   0.5 * h * motion.angular_acceleration(now.rotation, now.angular_velocity);
            const auto rotated = [&](double duration) -> Matrix3d {
                return Eigen::AngleAxisd(guess.norm() * duration, guess.normalized()).toRotationMatrix() *
                       now.rotation;
            };
            now.angular_velocity += h * motion.angular_acceleration(rotated(0.5 * h), guess);
            now.rotation = rotated(h);
            now.time += h;
        }
        now.force = motion.force(now.time);
        now.moment = motion.moment(now.rotation);
        record.samples.push_back(now);
    }
    return record;
}

FreeFall uneven_body() {
    FreeFall fall;
    fall.reynolds_number = 1e4;
    fall.volume = 0.5;
    fall.mass = 0.6;
    fall.gravity = {0.5, -1.0, -3.0};
    fall.principal_axes = Eigen::AngleAxisd(0.7, Vector3d(1, -2, 1).normalized()).toRotationMatrix();
    fall.principal_moments = {0.02, 0.05, 0.08};
    return fall;
}

// Euler's equations with the gyroscopic term times `share`, under the moment.
auto eulers_equations(const FreeFall& fall, double share,
                      const std::function<Vector3d(const Matrix3d&)>& moment) {
    return [=](const Matrix3d& rotation, const Vector3d& angular_velocity) -> Vector3d {
        const Matrix3d inertia = rotation * fall.inertia() * rotation.transpose();
        return inertia.ldlt().solve(moment(rotation) -
                                    share * angular_velocity.cross(inertia * angular_velocity));
    };
}

const Vector3d tumble(1.5, 0.7, -2.0);

TEST(FallBalance, IsZeroForARigidBodyUnderTheLoads) {
    DrivenMotion motion;
    motion.fall = uneven_body();
    motion.force = [](double time) { return Vector3d(std::sin(time), 0.3, std::cos(2.0 * time)); };
    motion.angular_acceleration = eulers_equations(motion.fall, 1.0, motion.moment);
    const FallBalance balance = balance_of(solved(motion, tumble));
    EXPECT_LT(balance.force, 1e-4);
    EXPECT_LT(balance.moment, 1e-3);
}

TEST(FallBalance, HoldsTheMomentOfBuoyancyOnABodyHungOffItsCentroid) {
    DrivenMotion motion;
    motion.fall = uneven_body();
    motion.fall.center_of_mass = {0.02, 0.05, -0.1};
    // Buoyancy at the centroid: (-R c) x (-V g).
    const auto of_buoyancy = [fall = motion.fall](const Matrix3d& rotation) -> Vector3d {
        return (rotation * -fall.center_of_mass).cross(-fall.volume * fall.gravity);
    };
    motion.angular_acceleration = eulers_equations(motion.fall, 1.0, of_buoyancy);
    EXPECT_LT(balance_of(solved(motion, tumble)).moment, 1e-3);
}

TEST(FallBalance, ShowsADroppedGyroscopicTermWhole) {
    DrivenMotion motion;
    motion.fall = uneven_body();
    motion.angular_acceleration = eulers_equations(motion.fall, 0.0, motion.moment);
    const FallBalance balance = balance_of(solved(motion, tumble));
    EXPECT_LT(balance.force, 1e-4);
    EXPECT_NEAR(balance.moment, 1.0, 0.01);
}

TEST(FallBalance, ShowsAForceThatIsOffByAsMuch) {
    DrivenMotion motion;
    motion.fall = uneven_body();
    motion.force = [](double time) { return Vector3d(4.0 * std::sin(3.0 * time), 0.0, 0.0); };
    motion.angular_acceleration = eulers_equations(motion.fall, 1.0, motion.moment);
    FallRecord record = solved(motion, tumble);
    for (FallSample& sample : record.samples) sample.force *= 1.05;
    EXPECT_NEAR(balance_of(record).force, 0.05 / 1.05, 2e-3);
}

TEST(FallBalance, DoesNotTakeNoiseOnABodyThatDoesNotRotateForAnError) {
    DrivenMotion motion;
    motion.fall = uneven_body();
    motion.fall.principal_moments.setConstant(0.05);
    motion.force = [weight = Vector3d((0.6 - 0.5) * motion.fall.gravity)](double) {
        return Vector3d(-weight);
    };
    motion.angular_acceleration = eulers_equations(motion.fall, 1.0, motion.moment);
    FallRecord record = solved(motion, Vector3d(1e-9, 0, 0));
    for (std::size_t i = 0; i < record.samples.size(); ++i) {
        record.samples[i].moment.x() = (i % 2 == 0 ? 1e-5 : -1e-5) * record.samples[i].force.norm();
    }
    EXPECT_LT(balance_of(record).moment, 0.01);
}

TEST(FallBalance, IsZeroWithoutSamples) {
    FallRecord record;
    EXPECT_EQ(balance_of(record).force, 0.0);
    record.samples.resize(2);
    EXPECT_EQ(balance_of(record).moment, 0.0);
}

TEST(FallingBody, HasTheMassTheInertiaAndTheFluidOfTheFall) {
    const Body body = test::ellipsoid_with_tables();
    const FreeFall fall = test::oblique_fall(test::ellipsoid_with_tables(), 1.0);
    const ImmersedBody immersed = falling_body(body, fall);
    EXPECT_NEAR(immersed.mass, 1200.0 * body.moments.volume, 1e-12);
    EXPECT_LT((immersed.own_inertia - uniform_inertia(body.moments, 1200.0)).norm(),
              1e-9 * immersed.own_inertia.norm());
    EXPECT_EQ(immersed.fluid_density, 1000.0);
    EXPECT_NEAR(immersed.viscosity, 1e-3, 1e-15);
    // The centre of mass is at (0.01, -0.005, 0.008) L from the centroid in case axes, which are the body's
    // y, z, x.
    const Vector3d offset = fall.length * Vector3d(0.008, 0.01, -0.005);
    EXPECT_LT((immersed.center_of_buoyancy + offset).norm(), 1e-12);
    EXPECT_EQ(immersed.loads, Loads::table);
    EXPECT_EQ(immersed.turbulence, Turbulence::none);
}

TEST(FallingBody, RejectsAFallOfABodyOfAnotherSize) {
    FreeFall fall = test::oblique_fall(test::ellipsoid_with_tables(), 1.0);
    fall.length *= 1.0 + 1e-5;
    EXPECT_THAT(
        test::error_of([&] { static_cast<void>(falling_body(test::ellipsoid_with_tables(), fall)); }),
        testing::StartsWith("fall_00: the fall belongs to another body than exact: its length L is "));
}

TEST(FallingBody, FallsInSIUnitsAndTheBodysAxesAtTheStart) {
    const FreeFall fall = test::oblique_fall(test::ellipsoid_with_tables(), 1.0);
    const Vector3d gravity = gravity_of(fall);
    EXPECT_NEAR(gravity.norm(), 9.81, 1e-9);
    EXPECT_LT((gravity.normalized() - Vector3d(-0.64, 0.5, 0.58).normalized()).norm(), 1e-12);
}

TEST(FallingBody, HasTheStatesOfItsRecordAfterThatOfTheStart) {
    FallRecord record;
    record.fall = test::oblique_fall(test::ellipsoid_with_tables(), 1.0);
    record.fall.velocity = {0.1, -0.2, 0.3};
    record.fall.angular_velocity = {0.5, 0.7, -0.2};
    std::vector<BodyState> expected;
    for (int i = 1; i <= 5; ++i) {
        BodyState state = test::tumbling_state(0.1 * i, 2.0 - i);
        state.position = Vector3d(0.01 * i, 0.3, -0.02 * i * i);
        state.orientation = Quaterniond(1.0, 0.3 * i, -0.1, 0.2).normalized();
        expected.push_back(state);
        record.samples.push_back(test::sample_of(record.fall, 0.1 * i, state));
    }
    const std::vector<BodyState> states = states_of(record);
    ASSERT_EQ(states.size(), 6u);
    EXPECT_LT(states[0].position.norm(), 1e-15);
    EXPECT_NEAR(states[0].orientation.angularDistance(Quaterniond::Identity()), 0.0, 1e-7);
    // The case's axes are the body's y, z and x.
    EXPECT_LT((states[0].velocity.tail<3>() / record.fall.speed - Vector3d(0.3, 0.1, -0.2)).norm(), 1e-12);
    EXPECT_LT((states[0].velocity.head<3>() * record.fall.time_unit() - Vector3d(-0.2, 0.5, 0.7)).norm(),
              1e-12);
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_LT((states[i + 1].position - expected[i].position).norm(), 1e-14);
        EXPECT_LT(states[i + 1].orientation.angularDistance(expected[i].orientation), 1e-7);
        EXPECT_LT((states[i + 1].velocity - expected[i].velocity).norm(), 1e-12);
    }
}

TEST(FallingBody, MakesAMotionOfItsStatesAtEvenTimes) {
    const Body body = test::ellipsoid_with_tables();
    std::vector<BodyState> states(3);
    states[2].position = Vector3d(1, 2, 3);
    const Motion motion = motion_of(body, Vector3d(0, 0, -9.81), 0.25, states);
    EXPECT_EQ(motion.frame_rate, 4.0);
    EXPECT_EQ(motion.times, (std::vector<double>{0.0, 0.25, 0.5}));
    ASSERT_EQ(motion.bodies.size(), 1u);
    ASSERT_EQ(motion.bodies[0].poses.size(), 3u);
    EXPECT_NEAR(std::abs(motion.bodies[0].shortest_axis.x()), 1.0, 1e-12);
}

}  // namespace
}  // namespace samara
