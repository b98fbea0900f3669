#include <functional>
#include <optional>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "irregular_flutter.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/internal/plot/landing_plot.hpp"
#include "samara/internal/plot/motion_plot.hpp"
#include "samara/internal/plot/phase_plot.hpp"
#include "samara/motion/motion_file.hpp"
#include "support/picture_faults.hpp"
#include "support/program_run.hpp"
#include "synthetic_motion.hpp"

namespace samara {
namespace {

using test::degree;
using test::faults_of;
using test::SvgPicture;
using test::TemporaryFolder;
using testing::IsEmpty;

struct NamedMotion {
    std::string name;
    std::function<Motion()> make;
};

void PrintTo(const NamedMotion& motion,  // NOLINT(readability-identifier-naming): googletest's name
             std::ostream* out) {
    *out << motion.name;
}

Pose sinking(double time, double speed) {
    Pose pose;
    pose.position.z() = -speed * time;
    pose.velocity.z() = -speed;
    return pose;
}

Pose moved(Pose pose, const Vector3d& by) {
    pose.position += by;
    return pose;
}

/// The motion seen as one `scale` times larger, as fast in its own lengths.
Motion scaled(Motion motion, double scale) {
    for (Vector3d& vertex : motion.bodies[0].surface.vertices) vertex *= scale;
    for (Pose& pose : motion.bodies[0].poses) {
        pose.position *= scale;
        pose.velocity *= scale;
    }
    return motion;
}

/// A flutter that ends on the ground after a second and lies there until `duration`.
Motion landing(double duration) {
    Motion motion = test::motion_of(
        [](double time) {
            Pose pose = test::flutter(std::min(time, 1.0), 2.0, 40.0 * degree, 0.3);
            if (time < 1.0) return pose;
            pose.velocity.setZero();
            pose.angular_velocity.setZero();
            return pose;
        },
        duration);
    motion.ground = -0.33;
    return motion;
}

Motion with_name(std::string name, Motion motion) {
    motion.bodies[0].name = std::move(name);
    return motion;
}

/// Copies that drift apart on their way down, each its own way.
Motion scattered(int runs, int copies, double spread) {
    Motion motion = test::motion_of([](double) { return Pose{}; }, 2.0);
    BodyMotion& body = motion.bodies[0];
    motion.runs = runs;
    body.copies = copies;
    body.poses.clear();
    for (int run = 0; run < runs; ++run) {
        for (const double time : motion.times) {
            for (int copy = 0; copy < copies; ++copy) {
                const double angle = 2.4 * (copy + copies * run);
                const Vector3d out(std::cos(angle), std::sin(3.0 * angle), 0.1 * std::sin(5.0 * angle));
                body.poses.push_back(
                    moved(test::flutter(time, 1.5, 30.0 * degree, 0.4), time * spread * out));
            }
        }
    }
    return motion;
}

Pose fluttering(double time) {
    return test::flutter(time, 1.1, 40.0 * degree, 0.2);
}

Motion fluttering_at(const Vector3d& place) {
    return test::motion_of([=](double t) { return moved(fluttering(t), place); }, 2.0);
}

Motion wide_without_gravity() {
    Motion motion = test::motion_of([](double t) { return test::tumble(20.0 * t, 1.0, 0.01); }, 2.0);
    motion.gravity.setZero();
    return motion;
}

const std::string long_name =
    "Aeronautically_{improbable} 'leaf' of \\Acer pseudoplatanus & \"friends\", größer als je zuvor gesehen, "
    "the "
    "third of its kind";

/// Motions that pictures of one fall find hard.
std::vector<NamedMotion> hard_motions() {
    const auto of = [](const std::function<Pose(double)>& pose, double duration) {
        return [=] { return test::motion_of(pose, duration); };
    };
    return {
        {"Flutter", of(fluttering, 4.0)},
        {"Tumble", of([](double t) { return test::tumble(t, 8.0, 0.4); }, 4.0)},
        {"Wander", of(test::wander, 4.0)},
        {"Rest", of([](double) { return Pose{}; }, 2.0)},
        {"OneFrame", of([](double) { return Pose{}; }, 0.0)},
        {"OneFrameOfAFall", of([](double) { return test::wander(0.3); }, 0.0)},
        {"TwoFrames", of(fluttering, 1.0 / 60.0)},
        {"StraightDown", of([](double t) { return sinking(t, 0.5); }, 6.0)},
        {"Slow", of([](double t) { return sinking(t, 1e-7); }, 2.0)},
        {"HardlyTurning", of(
                              [](double t) {
                                  Pose pose = sinking(t, 0.5);
                                  pose.angular_velocity.y() = -3.81e-5;
                                  return pose;
                              },
                              2.0)},
        {"Coarse", [] { return test::motion_of(fluttering, 4.0, 18.0); }},
        {"Long", [] { return test::motion_of(fluttering, 400.0, 20.0); }},
        {"FarAway",
         [] {
             return fluttering_at({-54321.0, 12345.6, -98765.4});
         }},
        {"High",
         [] {
             return fluttering_at({0.0, 0.0, 7531.2});
         }},
        {"Huge", [] { return scaled(test::motion_of(fluttering, 2.0), 1e7); }},
        {"Tiny", [] { return scaled(test::motion_of(fluttering, 2.0), 1e-6); }},
        {"Late", of([](double t) { return fluttering(std::max(0.0, t - 3.0)); }, 5.0)},
        {"Landing", [] { return landing(3.0); }},
        {"LandingLongAgo", [] { return landing(20.0); }},
        {"WideWithoutGravity", wide_without_gravity},
        {"LongName", [] { return with_name(long_name, test::motion_of(fluttering, 2.0)); }},
        {"OneOfMany", [] { return scattered(3, 50, 0.1); }},
    };
}

/// Motions that maps of landings find hard.
std::vector<NamedMotion> hard_landings() {
    const auto of = [](int runs, int copies, double spread, std::optional<double> ground) {
        return [=] {
            Motion motion = scattered(runs, copies, spread);
            motion.ground = ground;
            return motion;
        };
    };
    return {
        {"TwoInTheAir", of(1, 2, 0.2, {})},
        {"AllAtOnePlace", of(1, 3, 0.0, -0.7)},
        {"Landed", of(2, 50, 0.3, -0.7)},
        {"SomeLanded", of(2, 50, 0.8, -0.82)},
        {"Crowd", of(10, 100, 0.3, -0.7)},
        {"FarAway",
         [] {
             Motion motion = scattered(2, 20, 0.3);
             for (Pose& pose : motion.bodies[0].poses) pose.position += Vector3d(-54321.0, 98765.4, 0.0);
             return motion;
         }},
        {"Huge", [] { return scaled(scattered(2, 20, 0.3), 1e7); }},
        {"Tiny", [] { return scaled(scattered(2, 20, 0.3), 1e-6); }},
        {"LongName", [] { return with_name(std::string(120, 'W'), scattered(2, 20, 0.3)); }},
    };
}

/// The picture that `draw` makes of a motion.
SvgPicture picture_of(const std::function<void(const std::filesystem::path&)>& draw) {
    const TemporaryFolder folder;
    draw(folder / "picture.svg");
    return test::read_svg(folder / "picture.svg");
}

bool says(const SvgPicture& picture, const std::string& words) {
    return std::any_of(picture.texts.begin(), picture.texts.end(), [&](const test::SvgText& text) {
        return text.words.find(words) != std::string::npos;
    });
}

std::string name_of_parameter(const testing::TestParamInfo<NamedMotion>& info) {
    return info.param.name;
}

class HardMotion : public testing::TestWithParam<NamedMotion> {
  protected:
    const Motion motion_ = GetParam().make();
    const BodyMotion& body_ = motion_.bodies[0];
    const int run_ = motion_.runs - 1;
    const int copy_ = body_.copies - 1;
};

TEST_P(HardMotion, CanBeReadOffItsStrip) {
    const SvgPicture picture =
        picture_of([&](const auto& file) { plot_motion(file, motion_, body_, run_, copy_); });
    EXPECT_EQ(picture.panels.size(), 5U);  // two views, three series
    EXPECT_THAT(faults_of(picture), IsEmpty());
}

TEST_P(HardMotion, CanBeReadOffItsPhasePortrait) {
    const SvgPicture picture =
        picture_of([&](const auto& file) { plot_phase(file, motion_, body_, run_, copy_); });
    EXPECT_EQ(picture.panels.size(), 3U);
    std::vector<std::string> faults = faults_of(picture);
    // Rates of the few frames in which the axis lies across the plane, which is said.
    if (says(picture, "not shown: up to")) {
        std::erase_if(faults,
                      [](const std::string& fault) { return fault.find("is cut off") != std::string::npos; });
    }
    EXPECT_THAT(faults, IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Pictures, HardMotion, testing::ValuesIn(hard_motions()), name_of_parameter);

class HardLanding : public testing::TestWithParam<NamedMotion> {};

TEST_P(HardLanding, CanBeReadOffItsMap) {
    const Motion motion = GetParam().make();
    const SvgPicture picture =
        picture_of([&](const auto& file) { plot_landing(file, motion, motion.bodies[0]); });
    EXPECT_EQ(picture.panels.size(), 3U);
    std::vector<std::string> faults = faults_of(picture);
    // The paths lead into the map from outside: the first curve of the first panel.
    std::erase_if(faults,
                  [](const std::string& fault) { return fault.starts_with("'gnuplot_plot_1a' is cut off"); });
    EXPECT_THAT(faults, IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Pictures, HardLanding, testing::ValuesIn(hard_landings()), name_of_parameter);

TEST(Pictures, OfAFallToTheGroundAreMostlyOfTheFall) {
    // A second of fall, nineteen on the ground.
    const Motion motion = landing(20.0);
    const SvgPicture picture =
        picture_of([&](const auto& file) { plot_motion(file, motion, motion.bodies[0]); });
    double shown = 0.0;
    double width = 0.0;
    for (const test::SvgCurve& curve : picture.curves) {
        if (curve.panel != 2U || curve.marks.empty()) continue;
        for (const Eigen::Vector2d& mark : curve.marks) {
            shown = std::max(shown, mark.x() - picture.panels[2].min().x());
        }
        width = picture.panels[2].sizes().x();
    }
    EXPECT_GT(shown, 0.7 * width);
}

TEST(Pictures, AreTheSameWhateverTheUsersGnuplotIsSetTo) {
    const TemporaryFolder folder;
    write_motion_file(folder / "motion.h5", test::motion_of(fluttering, 1.0));
    const auto drawn = [&](const std::string& name) {
        const test::ProgramRun done = run_program_in(folder, {"samara", "plot", "motion.h5", "-o", name},
                                                     "HOME=" + folder.path().string());
        EXPECT_EQ(done.status, 0) << done.fault;
        return read_bytes(folder / name);
    };
    const std::string before = drawn("before.svg");
    (void)folder.file(".gnuplot", "set logscale y\nset key top left\nset title 'mine'\n");
    EXPECT_EQ(before, drawn("after.svg"));
}

TEST(Pictures, OfComparisonsCanBeReadOffForOneFallAndForMany) {
    const TemporaryFolder folder;
    const auto write = [&](const char* file, const Motion& motion) {
        write_motion_file(folder / (std::string(file) + ".h5"), motion);
    };
    write("one", test::irregular_flutter(1, 6.0));
    write("other", test::irregular_flutter(2, 5.0, 100.0));
    write("many", scattered(2, 12, 0.05));
    write("tumbling", test::motion_of([](double t) { return test::tumble(t, 8.0, 0.4); }, 4.0));
    write("steady", test::motion_of([](double t) { return sinking(t, 0.5); }, 4.0));
    write("short", test::motion_of([](double t) { return test::flutter(t, 1.1, 0.5, 0.2); }, 0.5));
    write("huge", scaled(test::irregular_flutter(3, 6.0), 1e7));
    write("a-file-with-such-a-long-name-that-it-would-reach-far-into-the-title-of-the-picture",
          with_name(std::string(100, 'M'), test::irregular_flutter(4, 6.0)));
    const std::pair<const char*, const char*> pairs[] = {
        {"one", "other"},
        {"one", "one"},
        {"many", "many"},
        {"one", "many"},
        {"many", "one"},
        {"tumbling", "one"},
        {"steady", "steady"},
        {"steady", "one"},
        {"short", "one"},
        {"huge", "one"},
        {"huge", "huge"},
        {"a-file-with-such-a-long-name-that-it-would-reach-far-into-the-title-of-the-picture", "one"}};
    for (const auto& [motion, reference] : pairs) {
        const test::ProgramRun done =
            run_program_in(folder, {"samara", "compare", std::string(motion) + ".h5",
                                    std::string(reference) + ".h5", "-o", "picture.svg"});
        ASSERT_EQ(done.status, 0) << done.fault;
        EXPECT_THAT(faults_of(test::read_svg(folder / "picture.svg")), IsEmpty())
            << motion << " against " << reference;
    }
}

TEST(Pictures, ThatAreDrawnWrongAreCaught) {
    const Motion motion = test::motion_of(fluttering, 4.0);
    const SvgPicture picture =
        picture_of([&](const auto& file) { plot_motion(file, motion, motion.bodies[0]); });
    ASSERT_THAT(faults_of(picture), IsEmpty());

    SvgPicture without_a_curve = picture;
    std::erase_if(without_a_curve.curves, [](const test::SvgCurve& curve) { return curve.panel == 3U; });
    EXPECT_EQ(faults_of(without_a_curve).size(), 1U);
    SvgPicture narrower = picture;
    for (test::SvgText& text : narrower.texts)
        text.box.translate(Eigen::Vector2d(0.2 * text.box.center().x(), 0.0));
    EXPECT_FALSE(faults_of(narrower).empty());
    SvgPicture taller = picture;
    for (test::SvgCurve& curve : taller.curves) {
        for (Eigen::Vector2d& mark : curve.marks) mark.y() -= 200.0;
    }
    EXPECT_FALSE(faults_of(taller).empty());
}

}  // namespace
}  // namespace samara
