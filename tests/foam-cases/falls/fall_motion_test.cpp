#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "foam-cases/falls/validate.hpp"
#include "support/expect_error.hpp"

namespace samara {
namespace {

using testing::HasSubstr;

// A body in a fall that is uniform in case axes: with constant `velocity` and `angular_velocity`.
class TakeFalls : public testing::Test {
  protected:
    TakeFalls() {
        record_.fall.length = 0.05;
        record_.fall.speed = 0.2;
        record_.fall.time_step = 0.5;
        record_.fall.axes << 0, 0, 1, 1, 0, 0, 0, 1, 0;
        record_.fall.center_of_mass = {0.1, -0.2, 0.3};
        start_.position = {1, 2, 3};
        start_.orientation = Quaterniond(Eigen::AngleAxisd(0.8, Vector3d(1, 2, -1).normalized()));
        start_.velocity << record_.fall.axes * angular_velocity_ / record_.fall.time_unit(),
            record_.fall.axes * velocity_ * record_.fall.speed;
        for (int i = 1; i <= 8; ++i) add_sample(0.5 * i);
        motion_.bodies.resize(1);
    }

    void add_sample(double time) {
        FallSample sample;
        sample.time = time;
        sample.position = record_.fall.center_of_mass + velocity_ * time;
        sample.rotation = Eigen::AngleAxisd(angular_velocity_.norm() * time, angular_velocity_.normalized())
                              .toRotationMatrix();
        sample.velocity = velocity_;
        sample.angular_velocity = angular_velocity_;
        record_.samples.push_back(sample);
    }
    void frames(int count, double rate) {
        for (int i = 0; i < count; ++i) motion_.times.push_back(i / rate);
    }
    void take(double start_time = 0.0) {
        take_falls({{record_, start_, start_time}}, surroundings_, motion_);
        ASSERT_EQ(motion_.bodies.front().poses.size(), motion_.times.size());
    }
    const Pose& pose(std::size_t frame) { return motion_.bodies.front().poses.at(frame); }
    /// World axes.
    [[nodiscard]] Vector3d start_velocity() const { return start_.orientation * start_.velocity.tail<3>(); }

    const Vector3d velocity_ = {0.3, 0.1, -0.9};
    const Vector3d angular_velocity_ = {0.2, 0.5, -0.4};
    FallRecord record_;
    BodyState start_;
    Surroundings surroundings_;
    Motion motion_;
};

TEST_F(TakeFalls, GivesTheMotionInWorldAxes) {
    frames(5, 4.0);
    take();
    const Vector3d angular_velocity = start_.orientation * start_.velocity.head<3>();
    for (std::size_t i = 0; i < 5; ++i) {
        const double time = motion_.times[i];
        EXPECT_LT((pose(i).position - start_.position - start_velocity() * time).norm(), 1e-12);
        EXPECT_LT((pose(i).velocity - start_velocity()).norm(), 1e-12);
        EXPECT_LT((pose(i).angular_velocity - angular_velocity).norm(), 1e-9);
        const Quaterniond expected =
            Quaterniond(Eigen::AngleAxisd(angular_velocity.norm() * time, angular_velocity.normalized())) *
            start_.orientation;
        EXPECT_LT(pose(i).orientation.angularDistance(expected), 1e-7);
    }
}

TEST_F(TakeFalls, HoldsTheBodyUntilItsStart) {
    frames(5, 4.0);
    surroundings_.current = {1, 0, 0};
    take(0.6);
    for (std::size_t i = 0; i < 3; ++i) {
        // It starts where the frame of the flow is by then.
        EXPECT_LT((pose(i).position - start_.position - Vector3d(0.6, 0, 0)).norm(), 1e-12);
        EXPECT_EQ(pose(i).velocity, Vector3d::Zero());
        EXPECT_EQ(pose(i).angular_velocity, Vector3d::Zero());
    }
    const Vector3d velocity = start_velocity() + surroundings_.current;
    EXPECT_LT((pose(4).position - start_.position - Vector3d(0.6, 0, 0) - velocity * 0.4).norm(), 1e-12);
    EXPECT_LT((pose(4).velocity - velocity).norm(), 1e-12);
}

TEST_F(TakeFalls, DropsFramesAfterTheLastStepButForOneWithinHalfAStep) {
    // The steps end at 4 L/U = 1 s, and are 0.125 s long.
    frames(100, 20.0);
    take();
    EXPECT_NEAR(motion_.times.back(), 1.05, 1e-12);
    EXPECT_LT((pose(21).position - pose(20).position).norm(), 1e-12);
}

TEST_F(TakeFalls, GivesEachFallToACopyAndEndsWithTheShortest) {
    FallRecord shorter = record_;
    shorter.samples.resize(6);
    frames(8, 10.0);
    motion_.bodies.front().copies = 2;
    take_falls({{record_, start_}, {shorter, start_, 0.1}}, surroundings_, motion_);
    ASSERT_EQ(motion_.times.size(), 8u);
    ASSERT_EQ(motion_.bodies.front().poses.size(), 16u);
    for (int frame = 1; frame < 8; ++frame) {
        const Pose& first = motion_.pose(motion_.bodies.front(), 0, frame, 0);
        const Pose& second = motion_.pose(motion_.bodies.front(), 0, frame, 1);
        EXPECT_LT((first.position - start_.position - start_velocity() * 0.1 * frame).norm(), 1e-12);
        EXPECT_LT((second.position - start_.position - start_velocity() * 0.1 * (frame - 1)).norm(), 1e-12);
    }
}

TEST_F(TakeFalls, IsRejectedWhereTheFallEndsBeforeItsSecondFrame) {
    frames(2, 0.5);
    EXPECT_THAT(test::error_of([&] {
                    take_falls({{record_, start_}}, surroundings_, motion_);
                }),
                HasSubstr("ends before its second frame"));
}

}  // namespace
}  // namespace samara
