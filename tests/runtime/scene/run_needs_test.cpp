#include "samara/scene/run_needs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "paths.hpp"
#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/files/content_hash.hpp"
#include "support/expect_error.hpp"
#include "support/known_bodies.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Scene scene_of(double frames, int copies) {
    Scene scene;
    scene.duration = 1.0;
    scene.frame_rate = frames - 1.0;
    scene.bodies.emplace_back().count = copies;
    return scene;
}

TEST(RunNeeds, GrowWithCopiesAndFramesAndRuns) {
    const RunNeeds one = needs_of(scene_of(61.0, 1), 1);
    EXPECT_LT(one.memory, 1e8);
    EXPECT_LT(one.disk, 1e5);
    EXPECT_NEAR(needs_of(scene_of(61.0, 1000), 1).disk, 61e3 * 104.0, 1e4);
    EXPECT_NEAR(needs_of(scene_of(61.0, 100), 10).disk, 61e3 * 104.0, 1e4);
    Scene crowd = scene_of(61.0, 10'000'000);
    crowd.bodies_collide = true;
    EXPECT_GT(needs_of(crowd, 1).memory, 10e6 * 500.0);
    EXPECT_TRUE(needs_of(crowd, 1).memory_for_copies);
    const RunNeeds film = needs_of(scene_of(5e7, 1), 1);
    EXPECT_GT(film.memory, 5e7 * 160.0);
    EXPECT_FALSE(film.memory_for_copies);
    EXPECT_NEAR(film.disk, 5e7 * 112.0, 1e6);
}

TEST(RunNeeds, OfMemoryDoNotGrowWithACrowdThatDoesNotCollide) {
    const double memory = needs_of(scene_of(61.0, 100'000), 1).memory;
    EXPECT_EQ(needs_of(scene_of(61.0, 10'000'000), 1).memory, memory);
    EXPECT_LT(memory, 5e8);
}

TEST(RunNeeds, CountWhatCopiesOfManySizesTouchWith) {
    Scene scene = scene_of(61.0, 1'000'000);
    scene.bodies_collide = true;
    SceneBody& body = scene.bodies[0];
    static_cast<BodyPhysics&>(body) = test::scene_body(1200.0);
    body.loads = Loads::none;
    body.turbulence = Turbulence::none;
    const std::vector<LoadedBody> loaded = {LoadedBody(test::rubber_ellipsoid(), "hash")};
    const double plain = needs_of(scene, 1, loaded).memory;
    EXPECT_EQ(plain, needs_of(scene, 1).memory);
    body.largest_size = 2.0;
    const auto made = loaded[0].prepared->get(*loaded[0].body, body, scene.fluid, "rubber");
    const double points =
        static_cast<double>(made->contact_points.corners.size() + made->contact_points.round.size());
    EXPECT_GE(needs_of(scene, 1, loaded).memory, plain + 1e6 * points * sizeof(Vector3d));
}

TEST(RunNeeds, OfNumbersBeyondAnyMachineAreRefusedWithTheNumberToLower) {
    const auto rejection = [](double frames, int copies, int runs) {
        Scene scene = scene_of(frames, copies);
        scene.bodies_collide = true;
        return test::error_of([&] { require_room(needs_of(scene, runs), "s.toml", "m.h5"); });
    };
    EXPECT_THAT(rejection(61.0, 10'000'000, 1'000'000),
                AllOf(HasSubstr("s.toml: its simulation needs"), HasSubstr("lower the count or --runs")));
    EXPECT_THAT(rejection(1e14, 1, 1), HasSubstr("lower the duration or frame_rate"));
    EXPECT_NO_THROW(require_room(needs_of(scene_of(61.0, 10), 1), "s.toml", "m.h5"));
}

class RunsOfSamara : public ::testing::Test {
  protected:
    RunsOfSamara() { write_body_file(folder_ / "rubber.body.h5", test::rubber_ellipsoid()); }

    /// Of `samara simulate` in the folder after a shell's command; what it says on standard error.
    [[nodiscard]] std::string rejection(const std::string& before, const std::string& scene_keys,
                                        const std::string& body_keys) const {
        (void)folder_.file("scene.toml",
                           "[scene]\n" + scene_keys +
                               "\n[[body]]\nname = \"rubber\"\nshape = \"rubber.body.h5\"\ndensity = "
                               "1200\nloads = \"none\"\n" +
                               body_keys + "\n");
        const int status = run_subprocess(
            {"/bin/sh", "-c",
             "cd '" + folder_.path().string() + "' && " + before +
                 " '" SAMARA_PROGRAMS "/samara' simulate scene.toml -o motion.h5 > output 2> errors"});
        EXPECT_EQ(status, 1);
        EXPECT_FALSE(std::filesystem::exists(folder_ / "motion.h5"));
        return read_bytes(folder_ / "errors");
    }

    const test::TemporaryFolder folder_;
};

TEST_F(RunsOfSamara, ThatTakeMoreMemoryThanTheShellAllowsAreRefusedBeforeTheyFly) {
    EXPECT_THAT(
        rejection("ulimit -v 2000000 &&", "duration = 0.01\nbodies_collide = true", "count = 10000000"),
        AllOf(HasSubstr("warning: takes about"), HasSubstr("scene.toml: its simulation needs"),
              HasSubstr("lower the count or --runs")));
    EXPECT_THAT(rejection("ulimit -v 2000000 &&", "duration = 5e5\nframe_rate = 100", ""),
                HasSubstr("lower the duration or frame_rate"));
}

TEST_F(RunsOfSamara, ThatTakeMoreDiskThanThereIsAreRefusedBeforeTheyFly) {
    EXPECT_THAT(rejection("", "duration = 1e6\nframe_rate = 60\nstep = 1e-3", "count = 100000"),
                testing::AnyOf(HasSubstr("write to another disk"), HasSubstr("of memory, but")));
}

}  // namespace
}  // namespace samara
