#pragma once

#include <algorithm>
#include <numbers>
#include <random>
#include <vector>

#include "synthetic_motion.hpp"

namespace samara::test {

/// A flutter whose swings are independent of one another: each has a duration, an amplitude and a descent
/// speed of its own, drawn from the seed about 0.4 s, 40 degrees and 0.2 m/s, by a fifth either way.
class IrregularFlutter {
  public:
    IrregularFlutter(unsigned seed, double duration) : generator_(seed) {
        double time = 0.0;
        double height = 0.0;
        while (time <= duration) {
            const Swing swing{time, 0.4 * factor(), 40.0 * degree * factor(), 0.2 * factor(), height};
            swings_.push_back(swing);
            time += swing.duration;
            height -= swing.speed * swing.duration;
        }
    }
    [[nodiscard]] Pose pose(double time) const {
        const auto after = std::upper_bound(swings_.begin(), swings_.end(), time,
                                            [](double t, const Swing& swing) { return t < swing.begin; });
        const Swing& swing = *(after - 1);
        const double sign = (after - swings_.begin()) % 2 == 0 ? 1.0 : -1.0;
        const double rate = std::numbers::pi / swing.duration;
        const double phase = rate * (time - swing.begin);
        Pose pose;
        pose.orientation = Eigen::AngleAxisd(sign * swing.amplitude * std::sin(phase), Vector3d::UnitY());
        pose.angular_velocity = Vector3d(0.0, sign * swing.amplitude * rate * std::cos(phase), 0.0);
        pose.position = Vector3d(0.0, 0.0, swing.height - swing.speed * (time - swing.begin));
        pose.velocity = Vector3d(0.0, 0.0, -swing.speed);
        return pose;
    }

  private:
    struct Swing {
        double begin;
        double duration;
        double amplitude;
        double speed;
        double height;
    };
    double factor() { return 0.8 + 0.4 * static_cast<double>(generator_() % 10007U) / 10006.0; }

    std::mt19937 generator_;
    std::vector<Swing> swings_;
};

inline Motion irregular_flutter(unsigned seed, double duration, double frame_rate = 60.0) {
    const IrregularFlutter flutter(seed, duration);
    return motion_of([&](double time) { return flutter.pose(time); }, duration, frame_rate);
}

}  // namespace samara::test
