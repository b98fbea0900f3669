#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "samara/core/simulation/loaded_body.hpp"
#include "samara/scene/scene.hpp"

namespace samara {

/// Where bodies are to come to.
struct Target {
    Vector3d middle = Vector3d::Zero();  ///< m, world
    double radius = 0.0;                 ///< m
    /// Of a ring, which is to be passed through from either side; without it bodies are to end in the ball.
    std::optional<Vector3d> normal = {};
};

/// How near the copies of a body come to a target with one seed: the nearest of them.
struct TargetMiss {
    std::uint64_t seed = 0;
    int copy = 0;           ///< counted from 0
    double distance = 0.0;  ///< m, of the centre of mass from the target's middle
    double time = 0.0;      ///< s: when
    bool reached = false;
};

/// Follows copies past a target, frame by frame.
class TargetWatch {
  public:
    TargetWatch(const Target& target, int copies);
    /// The centres of mass (m, world) of all copies at the next frame's time (s).
    void add(double time, const std::vector<Vector3d>& places);
    /// Of the copy that reached it nearest to its middle or, where none did, came nearest. Of a ring the
    /// place where a copy crosses its plane counts and, of one that does not, its nearest frame.
    [[nodiscard]] TargetMiss nearest() const;

  private:
    struct Passage {
        std::optional<TargetMiss> crossing;
        TargetMiss frame;
        Vector3d place = Vector3d::Zero();
    };
    Target target_;
    double time_ = 0.0;
    bool begun_ = false;
    std::vector<Passage> passages_;
};

/// Whether another seed may give a body another fall: it is drawn where it starts or leaves an emitter, what
/// turbulence does to it, gusts without a seed of their own, or any of these of a body that it may meet.
bool depends_on_seed(const Scene& scene, std::size_t body);

/// Flies a scene with `tries` seeds, its own and those after it, and returns how near each comes, the nearest
/// first, of equals the first seed: the same for any number of threads (0: all cores). Throws Error where a
/// flight does. `progress`: the share done.
std::vector<TargetMiss> search_target(const Scene& scene, const std::vector<LoadedBody>& loaded,
                                      std::size_t body, const Target& target, int tries, int threads,
                                      const std::function<void(double)>& progress = {});

}  // namespace samara
