#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "samara/core/simulation/loaded_body.hpp"
#include "samara/scene/scene.hpp"

namespace samara {

/// A ball or a ring that bodies are to reach.
struct Target {
    Vector3d middle = Vector3d::Zero();  ///< m, world
    double radius = 0.0;                 ///< m
    /// Normal of a ring, which is to be passed through from either side; without it the target is a ball that
    /// bodies are to enter.
    std::optional<Vector3d> normal = {};
};

/// The nearest approach of a body's copies to a target with one seed.
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
    /// Adds the centres of mass (m, world) of all copies at the next frame's time (s).
    void add(double time, const std::vector<Vector3d>& places);
    /// Returns the result of the copy that reached the target nearest to its middle or, where none did, came
    /// nearest. For a ring the place counts where a copy crosses its plane and, where it does not, its
    /// nearest frame.
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

/// Returns whether another seed may give a body another fall: where its start, its emission, its turbulence
/// or gusts without a seed of their own are random, or any of these of a body that it may touch.
bool depends_on_seed(const Scene& scene, std::size_t body);

/// Simulates a scene with `tries` seeds, its own and those after it, and returns how near each comes, the
/// nearest first, of equals the first seed. The result does not depend on `threads` (0: all cores). Throws
/// Error where a simulation does. `progress` is called with the share done.
std::vector<TargetMiss> search_target(const Scene& scene, const std::vector<LoadedBody>& loaded,
                                      std::size_t body, const Target& target, int tries, int threads,
                                      const std::function<void(double)>& progress = {});

}  // namespace samara
