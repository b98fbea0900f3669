#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "samara/motion/motion.hpp"
#include "samara/scene/scene.hpp"

namespace samara {

/// How one fall came out.
struct PeerFall {
    std::vector<Pose> poses;  ///< of every frame; empty where a number ran away
    int steps = 0;
    double seconds = 0.0;  ///< CPU time of the steps alone
};

/// A body that falls by another model of the fluid than samara's.
class PeerBody {
  public:
    PeerBody() = default;
    virtual ~PeerBody() = default;
    PeerBody(const PeerBody&) = delete;
    PeerBody& operator=(const PeerBody&) = delete;

    /// Falls from the scene's start, by the scene's step over `cuts`, through the reference's frames.
    [[nodiscard]] virtual PeerFall fall(const std::vector<double>& coefficients, int cuts) const = 0;
    /// The model in words.
    [[nodiscard]] virtual std::string words() const = 0;
};

/// One of a model's numbers, and where a search looks for it.
struct PeerCoefficient {
    const char* name;
    double usual;  ///< the model's own default, or as published
    double lowest;
    double highest;
};

/// Another model of a falling body.
struct PeerModel {
    const char* name;
    std::vector<PeerCoefficient> coefficients;
    /// The first body of a scene; its shape is meshed by samara-mesh. `reference`: a motion of the same
    /// scene, whose frames are taken. Throws Error where the model knows no such body.
    std::function<std::shared_ptr<const PeerBody>(const Scene& scene, const Motion& reference)> body;
};

/// The equations of Kirchhoff with drag linear in the velocity, as S. Weissmann and U. Pinkall take it for
/// bodies under water (ACM Trans. Graph. 31(4), 2012; how they scale it was not verified in the source).
PeerModel linear_drag_model();

/// The paper's equations without its noise: eq. 2 to 4 with the signs put right (docs/explanation/model.md),
/// and the loads of eq. 5 as they are printed, whose coefficients are the user's.
PeerModel printed_model();

/// The planar equations of a falling plate by A. Andersen, U. Pesavento and Z. J. Wang (J. Fluid Mech. 541,
/// 91, 2005, eq. 4.1 to 4.9).
PeerModel falling_plate_model();

/// CPU seconds of this thread.
double cpu_time();

/// Poses at the times, interpolated between steps of `step` s that `advance` makes; it says whether all its
/// numbers are still numbers. `pose`: after the last step.
PeerFall flown_through(const std::vector<double>& times, double step, const std::function<bool()>& advance,
                       const std::function<Pose()>& pose);

}  // namespace samara
