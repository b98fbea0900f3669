#include "samara/scene/search_goals.hpp"

#include <algorithm>
#include <cmath>

namespace samara {
namespace {

constexpr double unmet = 2.0;  // in the score, of what never happens: above 1 also where it nearly does

}  // namespace

GoalWatch::GoalWatch(const SearchGoals& goals, int copies)
    : goals_(goals), copies_(static_cast<std::size_t>(copies)) {}

void GoalWatch::pass(Copy& copy, double time, const Vector3d& place) const {
    const RingGoal& ring = *goals_.ring;
    const double distance = (place - ring.middle).norm();
    if (!copy.approach || distance < *copy.approach) {
        copy.approach = distance;
        copy.approach_time = time;
    }
    if (!begun_) return;
    const double before = (copy.pose.position - ring.middle).dot(ring.normal);
    const double after = (place - ring.middle).dot(ring.normal);
    if (before == after || before * after > 0.0) return;
    const double share = before / (before - after);
    const double off = (copy.pose.position + share * (place - copy.pose.position) - ring.middle).norm();
    if (copy.crossing && off >= *copy.crossing) return;
    copy.crossing = off;
    copy.crossing_time = time_ + share * (time - time_);
}

void GoalWatch::add(double time, const std::vector<Pose>& poses) {
    for (std::size_t i = 0; i < poses.size(); ++i) {
        if (goals_.ring) pass(copies_[i], time, poses[i].position);
        copies_[i].pose = poses[i];
    }
    time_ = time;
    begun_ = true;
}

void GoalWatch::land(int copy, double time) {
    std::optional<double>& landing = copies_[static_cast<std::size_t>(copy)].landing;
    if (!landing) landing = time;
}

GoalMiss GoalWatch::miss_of(const Copy& copy) const {
    GoalMiss miss;
    if (goals_.target) {
        miss.target = (copy.pose.position - goals_.target->middle).norm();
        miss.score = *miss.target / goals_.target->radius;
    }
    if (goals_.ring) {
        miss.ring = copy.crossing ? *copy.crossing : *copy.approach;
        miss.ring_time = copy.crossing ? copy.crossing_time : copy.approach_time;
        // A path that never crosses the plane does not pass, however near it comes.
        miss.score = std::max(miss.score, (copy.crossing ? 0.0 : unmet) + *miss.ring / goals_.ring->radius);
    }
    if (goals_.up) {
        const Vector3d axis = copy.pose.orientation * goals_.up->axis;
        miss.up = std::atan2(std::hypot(axis.x(), axis.y()), axis.z());
        miss.score = std::max(miss.score, *miss.up / goals_.up->within);
    }
    if (goals_.landing) {
        miss.landing = copy.landing;
        const double off = std::abs(copy.landing.value_or(time_) - goals_.landing->time);
        miss.score = std::max(miss.score, (copy.landing ? 0.0 : unmet) + off / goals_.landing->tolerance);
    }
    return miss;
}

GoalMiss GoalWatch::nearest() const {
    GoalMiss nearest = miss_of(copies_.front());
    for (std::size_t i = 1; i < copies_.size(); ++i) {
        GoalMiss miss = miss_of(copies_[i]);
        miss.copy = static_cast<int>(i);
        if (miss.score < nearest.score) nearest = miss;
    }
    return nearest;
}

}  // namespace samara
