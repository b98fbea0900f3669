#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samara/analysis/metrics/tilt.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/motion/motion_file.hpp"
#include "support/program_run.hpp"
#include "synthetic_motion.hpp"

namespace samara {
namespace {

using test::degree;
using test::ProgramRun;
using testing::HasSubstr;

/// Numbers of the paths' drawing commands, and the texts, of an SVG picture.
struct Svg {
    std::string text;
    [[nodiscard]] int count(const std::string& what) const {
        const std::regex pattern(what);
        return static_cast<int>(
            std::distance(std::sregex_iterator(text.begin(), text.end(), pattern), std::sregex_iterator()));
    }
};

/// The files "flutter.h5", "tumble.h5" and "many.h5": 3 runs of 20 copies that land on a ring of 0.3 m.
class PlotKinds : public testing::Test {
  protected:
    PlotKinds() {
        write_motion_file(
            folder_ / "flutter.h5",
            test::motion_of([](double t) { return test::flutter(t, 1.0, 40.0 * degree, 0.2); }, 4.0));
        write_motion_file(folder_ / "tumble.h5",
                          test::motion_of([](double t) { return test::tumble(t, 6.0, 0.3); }, 4.0));
        write_motion_file(folder_ / "many.h5", ring());
    }

    /// Bodies that move outwards at 0.3 m/s and sink at 0.5 m/s to the ground, 0.5 m below; 15 of them rise.
    static Motion ring() {
        Motion motion = test::motion_of([](double) { return Pose{}; }, 2.0);
        BodyMotion& body = motion.bodies[0];
        motion.runs = 3;
        motion.ground = -0.51;
        body.copies = 20;
        body.poses.clear();
        for (int run = 0; run < 3; ++run) {
            for (const double time : motion.times) {
                for (int copy = 0; copy < 20; ++copy) {
                    const double angle = 2.0 * std::numbers::pi * copy / 20.0;
                    const double falls = copy % 4 == 3 ? -0.1 : 1.0;
                    const double moving = std::min(time, 1.0);
                    Pose pose;
                    pose.velocity = Vector3d(0.3 * std::cos(angle), 0.3 * std::sin(angle), -0.5 * falls);
                    pose.position = moving * pose.velocity;
                    if (time >= 1.0) pose.velocity.setZero();
                    body.poses.push_back(pose);
                }
            }
        }
        return motion;
    }

    [[nodiscard]] ProgramRun plot(std::vector<std::string> words) const {
        words.insert(words.begin(), {"samara", "plot"});
        return run_program_in(folder_, words);
    }
    [[nodiscard]] Svg svg(const std::string& name) const { return {read_bytes(folder_ / name)}; }

    test::TemporaryFolder folder_;
};

TEST_F(PlotKinds, AStripShowsTwoViewsToScaleAndSeriesWithTheirUnits) {
    const ProgramRun done = plot({"flutter.h5", "-o", "strip.svg", "--json"});
    ASSERT_EQ(done.status, 0) << done.error;
    EXPECT_EQ(done.json()["kind"], "strip");
    const Svg picture = svg("strip.svg");
    for (const char* text : {"From the front", "From the side", "x (m)", "y (m)", "z (m)", "time (s)",
                             "Descent speed (m/s)", "Inclination (°)", "Angular velocity (rad/s)"}) {
        EXPECT_THAT(picture.text, HasSubstr(text));
    }
    EXPECT_GE(picture.count("<path[^>]*fill: #"), 100);
    EXPECT_EQ(done.json()["strip"], nlohmann::json({0.0, 4.0}));
}

TEST_F(PlotKinds, APhasePortraitHasBothAxesNamedAndIsOneCurveForAFlutter) {
    const ProgramRun done = plot({"flutter.h5", "-o", "phase.svg", "--kind", "phase", "--json"});
    ASSERT_EQ(done.status, 0) << done.error;
    const nlohmann::json json = done.json();
    EXPECT_EQ(json["kind"], "phase");
    EXPECT_EQ(json["lines"], 1);
    EXPECT_NEAR(json["highest_rate"].get<double>(), 40.0 * degree * 2.0 * std::numbers::pi, 0.01);
    const Svg picture = svg("phase.svg");
    for (const char* text : {"tilt in the plane of the swing (°)", "Rate of the tilt (rad/s)", "time (s)",
                             "Tilt (°)", "Rate (rad/s)", "4.00 s", "fluttering"}) {
        EXPECT_THAT(picture.text, HasSubstr(text));
    }
    // Coloured by time: a line of its own colour for each frame.
    EXPECT_GE(picture.count("stroke: #"), 200);
}

TEST_F(PlotKinds, APhasePortraitSaysWhereItsCornersAreItsFrames) {
    const auto portrait = [&](const char* motion) {
        const ProgramRun done = plot({motion, "-o", "phase.svg", "--kind", "phase", "--json"});
        EXPECT_EQ(done.status, 0) << done.error;
        return done.json()["frames_in_swing"].get<double>();
    };
    EXPECT_NEAR(portrait("flutter.h5"), 30.0, 0.1);
    EXPECT_THAT(svg("phase.svg").text, testing::Not(HasSubstr("raise frame_rate")));
    write_motion_file(
        folder_ / "coarse.h5",
        test::motion_of([](double t) { return test::flutter(t, 1.0, 40.0 * degree, 0.2); }, 4.0, 18.0));
    EXPECT_NEAR(portrait("coarse.h5"), 9.0, 0.1);
    EXPECT_THAT(svg("phase.svg").text, HasSubstr("9 frames a swing: raise frame_rate"));
}

TEST_F(PlotKinds, ThePhasePortraitOfATumblingBodyBreaksAtEachTurnover) {
    const nlohmann::json json = plot({"tumble.h5", "-o", "phase.svg", "--kind", "phase", "--json"}).json();
    EXPECT_EQ(json["lines"], 9);  // 4 s at 6 rad/s: upright at 90 degrees and every half turn
    EXPECT_NEAR(json["highest_rate"].get<double>(), 6.0, 1e-6);
}

TEST_F(PlotKinds, ALandingMapShowsThePlacesTheMeanAndTheSpread) {
    const ProgramRun done = plot({"many.h5", "-o", "landing.svg", "--kind", "landing", "--json"});
    ASSERT_EQ(done.status, 0) << done.error;
    const nlohmann::json json = done.json();
    EXPECT_EQ(json["samples"], 60);
    EXPECT_EQ(json["landed"], 45);
    EXPECT_NEAR(json["spread"].get<double>(), 0.3, 0.01);
    EXPECT_NEAR(json["mean"][0].get<double>(), 0.0, 0.01);
    const Svg picture = svg("landing.svg");
    for (const char* text : {"45 of 60 landed", "x (m)", "y (m), from above", "distance from the mean (m)",
                             "time of landing (s)", "Landed by, of all (%)", "3 runs", "20 copies"}) {
        EXPECT_THAT(picture.text, HasSubstr(text));
    }
    const std::size_t places = picture.text.find("<g id=\"places\">");
    const Svg map{picture.text.substr(places, picture.text.find("<g id=\"line2d", places) - places)};
    EXPECT_EQ(map.count("<use "), 45);
}

TEST_F(PlotKinds, WithoutAGroundTheLandingMapIsOfTheLastFrame) {
    Motion motion = ring();
    motion.ground.reset();
    write_motion_file(folder_ / "air.h5", motion);
    const ProgramRun done = plot({"air.h5", "-o", "landing.svg", "--kind", "landing", "--json"});
    ASSERT_EQ(done.status, 0) << done.error;
    EXPECT_EQ(done.json()["landed"], 0);
    EXPECT_NEAR(done.json()["spread"].get<double>(), 0.3, 1e-9);
    EXPECT_THAT(svg("landing.svg").text, HasSubstr("60 in the air"));
    EXPECT_THAT(svg("landing.svg").text, HasSubstr("distance descended (m)"));
}

TEST_F(PlotKinds, WhatCannotBeDrawnIsRefusedInOneLine) {
    const auto rejected = [&](const std::vector<std::string>& words, const char* text) {
        const ProgramRun done = plot(words);
        EXPECT_EQ(done.status, 1);
        EXPECT_TRUE(test::is_one_line(done.error)) << done.error;
        EXPECT_THAT(done.error, HasSubstr(text));
        EXPECT_FALSE(std::filesystem::exists(folder_ / "no.svg"));
    };
    rejected({"flutter.h5", "-o", "no.svg", "--kind", "landing"}, "needs more than one fall");
    rejected({"many.h5", "-o", "no.svg", "--kind", "landing", "--copy", "1"}, "shows all runs and copies");
    rejected({"flutter.h5", "-o", "no.svg", "--kind", "pie"}, "--kind");
    Motion cube = test::motion_of([](double t) { return test::tumble(t, 6.0, 0.3); }, 4.0);
    cube.bodies[0].surface = test::box({2.0, 2.0, 2.0}, 1);
    write_motion_file(folder_ / "cube.h5", cube);
    rejected({"cube.h5", "-o", "no.svg", "--kind", "phase"}, "has no shortest axis");
}

TEST(Tilt, IsTheInclinationWithASignAndItsDerivativeForASwingInAPlane) {
    const Motion motion =
        test::motion_of([](double t) { return test::flutter(t, 1.0, 40.0 * degree, 0.2); }, 2.0);
    const Tilt tilt = tilt_of(motion, motion.bodies[0], 0, 0);
    ASSERT_EQ(tilt.times.size(), motion.times.size());
    for (std::size_t i = 0; i < tilt.times.size(); ++i) {
        const double phase = 2.0 * std::numbers::pi * tilt.times[i];
        EXPECT_NEAR(tilt.angle[i], 40.0 * degree * std::cos(phase), 1e-12);
        EXPECT_NEAR(tilt.rate[i], -40.0 * degree * 2.0 * std::numbers::pi * std::sin(phase), 1e-12);
        EXPECT_EQ(tilt.continues[i], i > 0);
    }
}

TEST(Tilt, ItsRateIsTheDerivativeOfTheAngleInAnyMotion) {
    const Motion motion = test::motion_of(test::wander, 2.0, 2000.0);
    const Tilt tilt = tilt_of(motion, motion.bodies[0], 0, 0);
    for (std::size_t i = 1; i + 1 < tilt.times.size(); ++i) {
        if (!tilt.continues[i] || !tilt.continues[i + 1]) continue;
        const double difference = (tilt.angle[i + 1] - tilt.angle[i - 1]) * 1000.0;
        EXPECT_NEAR(tilt.rate[i], difference, 1e-2 + 1e-2 * std::abs(difference)) << tilt.times[i];
    }
}

}  // namespace
}  // namespace samara
