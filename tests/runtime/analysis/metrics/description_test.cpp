#include "samara/analysis/metrics/description.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "synthetic_motion.hpp"

namespace samara {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(MotionDescription, NamesBodiesRunsAndMeasures) {
    Motion motion = test::motion_of([](double t) { return test::flutter(t, 1.0, 0.5, 0.2); }, 0.5, 20.0);
    motion.bodies[0].name = "z first";
    BodyMotion second = motion.bodies[0];
    second.name = "a second";
    second.copies = 2;
    second.poses.clear();
    for (int i = 0; i < 2 * motion.frames(); ++i) second.poses.push_back(test::tumble(0.01 * i, 5.0, 0.3));
    motion.bodies.push_back(second);
    std::vector<BodyMeasures> measures;
    for (const BodyMotion& body : motion.bodies) measures.push_back(measure_all(motion, body));
    const nlohmann::json json = describe_motion(motion, measures);
    EXPECT_EQ(json["kind"], "motion");
    EXPECT_EQ(json["runs"], 1);
    EXPECT_EQ(json["seed"], motion.seed);
    EXPECT_EQ(json["bodies"][1]["copies"], 2);
    EXPECT_EQ(json["bodies"][0]["name"], "z first");
    EXPECT_TRUE(json["bodies"][0]["descent_speed"].is_number());
    const std::string text = describe_motion_text(motion, measures);
    EXPECT_THAT(text, AllOf(HasSubstr("body z first"), HasSubstr("2 copies"), HasSubstr("m/s")));
    EXPECT_EQ(text.back(), '\n');
}

}  // namespace
}  // namespace samara
