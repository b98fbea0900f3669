#pragma once

#include <string>
#include <vector>

#include "samara/core/simulation/loaded_body.hpp"
#include "samara/scene/scene.hpp"

namespace samara {

/// What one body of a scene asks of the step.
struct BodyStep {
    std::string name;
    double motion = 0.0;      ///< s: the longest step whose error in the motion is within the tolerance
    double rotation = 0.0;    ///< s: the same of its turning, where noise turns it; infinite without any
    double turbulence = 0.0;  ///< s: the longest that its turbulence allows; infinite without any
    double error = 0.0;       ///< of the motion at the scene's step, over the way
};

/// How long the steps of a scene may be.
struct StepAdvice {
    double step = 0.0;       ///< s: 40 ms over a power of two
    double error = 0.0;      ///< the largest of the bodies'
    double tolerance = 0.0;  ///< what it was to stay within
    bool is_within = true;   ///< false: even the shortest step that was tried is off by more
    std::string limit = {};  ///< what allows no longer one: "the motion of 'leaf'"; empty: nothing does
    std::vector<BodyStep> bodies = {};  ///< in the scene's order
};

/// Flies the first copies of each body, in the wind but without noise, ground and obstacles, at steps of 40
/// ms over powers of two, and takes the longest by which none is off by more than the scene's step_tolerance:
/// by the root mean square, over windows in which it comes four lengths L far (each begun anew from the
/// finest flight), of the distance of place and tip from those of the finest flight, at the end of a step and
/// within one, over the mean way. Where there is noise the windows begin where a flight with it brings the
/// bodies, and their rms angular speed may be off by no more either: noise turns a body as far as its step
/// lets the turning last. Turbulence of the rate a allows the step sqrt(12 tolerance)/a: between two steps
/// the sampled turbulence goes evenly, which makes the diffusion by it (a h)^2/12 too large
/// (docs/theory.md#the-step). Deterministic; `threads`: 0 for all cores.
StepAdvice advise_step(const Scene& scene, const std::vector<LoadedBody>& loaded, int threads);

/// In a line: the step, its error, and what limits it.
std::string as_text(const StepAdvice& advice);

}  // namespace samara
