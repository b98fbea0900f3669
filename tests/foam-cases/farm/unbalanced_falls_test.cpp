#include "foam-cases/farm/unbalanced_falls.hpp"

#include <fstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "foam-cases/falls/fall_plan.hpp"
#include "samara/core/files/content_hash.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int steps = 40;
constexpr double step = 0.05;

/// The fall of a body of the fluid's density, which the fluid does not load: it moves on steadily.
FreeFall weightless_fall() {
    FreeFall fall;
    fall.reynolds_number = 1000.0;
    fall.volume = 0.3;
    fall.mass = 0.3;
    fall.principal_moments = {0.02, 0.02, 0.02};
    fall.gravity = {0.0, 0.0, -1.0};
    fall.velocity = {0.0, 0.0, -0.5};
    fall.duration = steps * step;
    fall.time_step = step;
    return fall;
}

/// A folder of cases with that fall, as if it were solved: with a force by the fluid that its motion does not
/// show.
class UnbalancedFalls : public testing::Test {
  protected:
    void pretend_solved(double force) const {
        fs::create_directories(own_ / "postProcessing/state/0");
        fs::create_directories(own_ / "postProcessing/forces/0");
        std::ofstream(own_ / "fall.json") << free_fall_json(plan_.falls.front());
        std::ofstream state(own_ / "postProcessing/state/0/sixDoFRigidBodyState.dat");
        std::ofstream forces(own_ / "postProcessing/forces/0/force.dat");
        std::ofstream moments(own_ / "postProcessing/forces/0/moment.dat");
        state << "# Motion State\n# Angle Units : radians\n# "
                 "Time\tcentreOfRotation\tcentreOfMass\trotation\tvelocity\tomega\n";
        for (std::ofstream* loads : {&forces, &moments})
            *loads << "# Force\n# CofR : (0 0 0)\n#\n# Time\t(total_x total_y total_z)\t(pressure_x "
                      "pressure_y pressure_z)\t(viscous_x viscous_y viscous_z)\n";
        for (int i = 1; i <= steps; ++i) {
            const double time = i * step;
            state << fmt::format("{0}\t(0 0 {1})\t(0 0 {1})\t(0 0 0)\t(0 0 -0.5)\t(0 0 0)\n", time,
                                 -0.5 * time);
            forces << fmt::format("{0}\t(0 0 {1})\t(0 0 {1})\t(0 0 0)\n", time, force);
            moments << fmt::format("{}\t(0 0 0)\t(0 0 0)\t(0 0 0)\n", time);
        }
        std::ofstream(own_ / "provenance.json") << "{}";
        std::ofstream(own_ / "attempts.json")
            << R"({"inputs": "x", "verdict": "done", "cpu_seconds": 1, "attempts": [{"what": "as planned", "started": true}]})";
    }
    [[nodiscard]] nlohmann::json record() const {
        return nlohmann::json::parse(read_bytes(own_ / "attempts.json"));
    }

    const test::TemporaryFolder folder_;
    const BakePlan plan_ = [] {
        BakePlan plan;
        plan.falls = {weightless_fall()};
        return plan;
    }();
    const fs::path own_ = folder_ / plan_.falls.front().name;
};

TEST_F(UnbalancedFalls, StartAgainWithTheNextAttempt) {
    pretend_solved(0.3);
    const std::vector<std::string> restarted = restart_unbalanced_falls(folder_.path(), plan_);
    ASSERT_EQ(restarted.size(), 1u);
    EXPECT_THAT(restarted.front(), HasSubstr("half the step"));
    EXPECT_EQ(record()["verdict"], nullptr);
    EXPECT_THAT(record()["attempts"][0]["end"], HasSubstr("momenta do not balance"));
    EXPECT_FALSE(fs::exists(own_ / "provenance.json"));
}

TEST_F(UnbalancedFalls, AreLeftAfterASecondAttemptAndSoAreOthers) {
    pretend_solved(0.0);
    EXPECT_THAT(restart_unbalanced_falls(folder_.path(), plan_), IsEmpty());
    pretend_solved(0.3);
    nlohmann::json twice = record();
    twice["attempts"].push_back({{"what", "half the step"}, {"started", true}});
    std::ofstream(own_ / "attempts.json") << twice.dump();
    EXPECT_THAT(restart_unbalanced_falls(folder_.path(), plan_), IsEmpty());
    EXPECT_TRUE(fs::exists(own_ / "provenance.json"));
    fs::remove_all(own_);
    EXPECT_THAT(restart_unbalanced_falls(folder_.path(), plan_), IsEmpty());  // it was left out
}

}  // namespace
}  // namespace samara
