#pragma once

#include <string>
#include <vector>

#include "samara/core/simulation/loaded_body.hpp"
#include "samara/scene/scene.hpp"

namespace samara {

/// The longest steps that one body of a scene allows.
struct BodyStep {
    std::string name;
    double motion = 0.0;  ///< s: the longest step whose error in the motion is within the tolerance
    double rotation =
        0.0;  ///< s: the longest step for its rotation, where noise causes it; infinite without any
    double turbulence = 0.0;  ///< s: the longest step for its turbulence; infinite without any
    double error = 0.0;       ///< error of the motion at the
                              ///< scene's step, relative to the distance covered
};

/// The longest step that a scene allows.
struct StepAdvice {
    double step = 0.0;       ///< s: 40 ms over a power of two
    double error = 0.0;      ///< the largest of the bodies'
    double tolerance = 0.0;  ///< the tolerance that was asked for
    bool is_within = true;   ///< false where even the shortest step that was tried has a larger error
    std::string limit =
        {};  ///< the body and motion that allow no longer step: "the motion of 'leaf'"; empty where none does
    std::vector<BodyStep> bodies = {};  ///< in the scene's order
};

/// Simulates the first copies of each body, in the wind but without noise, ground and obstacles, at steps of
/// 40 ms over powers of two, and takes the longest by which none is off by more than the scene's
/// step_tolerance: by the root mean square, over windows in which it moves four lengths L (each begun anew
/// from the reference simulation, whose step is the finest), of the distances of centre of mass and tip from
/// the reference's, at the end of a step and within one, relative to the mean distance covered. Where there
/// is noise the windows begin at the poses of a simulation with it, and the error of the rms angular speed is
/// held to the same tolerance: noise rotates a body for as long as its step lets the rotation last.
/// Turbulence of the rate a allows the step sqrt(12 tolerance)/a: between two steps the sampled turbulence is
/// interpolated linearly, which makes the diffusion by it (a h)^2/12 too large
/// (docs/explanation/integrator.md#the-step). Deterministic; `threads`: 0 for all cores.
StepAdvice advise_step(const Scene& scene, const std::vector<LoadedBody>& loaded, int threads);

/// Returns the advice as a line of text: the step, its error, and its limit.
std::string as_text(const StepAdvice& advice);

}  // namespace samara
