#pragma once

#include <optional>
#include <vector>

#include "samara/core/physics/pose.hpp"

namespace samara {

/// A ball that contains the centre of mass when the scene ends.
struct TargetGoal {
    Vector3d middle = Vector3d::Zero();  ///< m, world
    double radius = 0.0;                 ///< m
};

/// A disc that the centre of mass passes through, from either side.
struct RingGoal {
    Vector3d middle = Vector3d::Zero();   ///< m, world
    Vector3d normal = Vector3d::UnitZ();  ///< of length 1, world axes
    double radius = 0.0;                  ///< m
};

/// An axis of the body that points up when the scene ends.
struct UpGoal {
    Vector3d axis = Vector3d::UnitZ();  ///< of length 1, shape axes
    double within = 0.0;                ///< rad: the largest angle from the vertical
};

/// A time at which a copy first touches the ground or an obstacle.
struct LandingGoal {
    double time = 0.0;       ///< s
    double tolerance = 0.0;  ///< s, to either side
};

/// What a motion is searched for: all that are given have to hold, for the same copy.
struct SearchGoals {
    std::optional<TargetGoal> target = {};
    std::optional<RingGoal> ring = {};
    std::optional<UpGoal> up = {};
    std::optional<LandingGoal> landing = {};

    /// Returns whether any goal is given.
    [[nodiscard]] bool any() const noexcept { return target || ring || up || landing; }
};

/// How near a copy came to the goals. Numbers of goals that are not given are absent.
struct GoalMiss {
    int copy = 0;  ///< counted from 0
    /// The worst goal's difference divided by what it allows: up to 1 all goals hold.
    double score = 0.0;
    std::optional<double> target;  ///< m, from the target's middle at the end
    std::optional<double>
        ring;  ///< m, from the ring's middle: where the copy crosses its plane, else nearest
    std::optional<double> ring_time;  ///< s: when
    std::optional<double> up;         ///< rad, of the axis from the vertical at the end
    std::optional<double> landing;    ///< s; absent also where the copy did not land

    /// Returns whether all goals hold.
    [[nodiscard]] bool reached() const noexcept { return score <= 1.0; }
};

/// Follows copies past the goals, frame by frame.
class GoalWatch {
  public:
    GoalWatch(const SearchGoals& goals, int copies);
    /// Adds the poses of the centres of mass of all copies at the next frame's time (s).
    void add(double time, const std::vector<Pose>& poses);
    /// Notes that a copy touches the ground or an obstacle at a time (s); the first time counts.
    void land(int copy, double time);
    /// Returns the miss of the copy with the lowest score, of equals the first. Needs a frame.
    [[nodiscard]] GoalMiss nearest() const;

  private:
    struct Copy {
        Pose pose;                       ///< at the last frame
        std::optional<double> crossing;  ///< m, from the ring's middle
        double crossing_time = 0.0;      ///< s
        std::optional<double> approach;  ///< m: the least distance from the ring's middle at a frame
        double approach_time = 0.0;      ///< s
        std::optional<double> landing;   ///< s
    };
    void pass(Copy& copy, double time, const Vector3d& place) const;
    [[nodiscard]] GoalMiss miss_of(const Copy& copy) const;

    SearchGoals goals_;
    double time_ = 0.0;
    bool begun_ = false;
    std::vector<Copy> copies_;
};

}  // namespace samara
