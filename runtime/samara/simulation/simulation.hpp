#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "samara/body/body.hpp"
#include "samara/motion/motion.hpp"
#include "samara/scene/scene.hpp"

namespace samara {

/// A body of the scene with the body file it flies with.
struct CastBody {
    Body body;
    std::string hash;  ///< content hash of the body file
};

/// What happened on the way, for the report.
struct SimulationReport {
    std::uint64_t steps = 0;  ///< of the scene's step, over all bodies, copies and runs
    std::uint64_t implicit_steps = 0;
    int most_substeps = 1;
    double seconds = 0.0;                         ///< wall time of the stepping
    std::vector<double> highest_reynolds_number;  ///< one for each body of the scene
};

struct SimulationResult {
    Motion motion;
    SimulationReport report;
};

/// Flies every body of the scene with every copy in `runs` runs that differ by their noise alone. `cast[i]`
/// is the body of scene.bodies[i]. Frames lie at whole multiples of 1/frame_rate and are interpolated from
/// the steps, which they do not change. `progress` is called now and then with (done, total) copies x runs x
/// steps; where it returns false the flight stops with an Error that says so. Throws Error where a body lacks
/// what the scene asks of it.
SimulationResult simulate(const Scene& scene, const std::vector<CastBody>& cast, int runs,
                          const std::function<bool(double done, double total)>& progress);

}  // namespace samara
