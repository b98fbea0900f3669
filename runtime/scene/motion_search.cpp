#include "samara/scene/motion_search.hpp"

#include <algorithm>
#include <limits>

#include "samara/core/base/error.hpp"
#include "samara/core/base/parallel_for.hpp"
#include "samara/core/simulation/body_group.hpp"
#include "samara/scene/scene_simulation.hpp"

namespace samara {
namespace {

GoalMiss miss_of(const Scene& scene, const std::vector<LoadedBody>& loaded, const MotionSearch& search) {
    Simulation simulation = simulation_of(scene, loaded, 1, 1);
    const BodyGroup& group = *simulation.groups()[search.body];
    simulation.watch_contacts(search.goals.landing.has_value());
    const int copies = scene.bodies[search.body].count;
    GoalWatch watch(search.goals, copies);
    std::vector<Pose> poses(static_cast<std::size_t>(copies));
    for (const double time : frame_times(scene)) {
        simulation.advance_to(time);
        simulation.poses(group.first(), poses.size(), poses.data());
        watch.add(time, poses);
        for (int copy = 0; search.goals.landing && copy < copies; ++copy) {
            const ContactRecord contact =
                simulation.take_contacts(group.first() + static_cast<std::size_t>(copy));
            if (contact.strongest > 0.0 && contact.body < 0) watch.land(copy, contact.time);
        }
    }
    return watch.nearest();
}

bool is_drawn(const SceneBody& body) {
    const bool is_still = body.turbulence == Turbulence::none ||
                          (body.turbulence == Turbulence::constant && body.turbulent_kinetic_energy == 0.0);
    return body.emitter != nullptr || (body.count > 1 && body.spreads()) || !is_still;
}

}  // namespace

bool depends_on_seed(const Scene& scene, std::size_t body) {
    const auto& gusts = scene.wind.gusts;
    if (gusts && !gusts->seed && gusts->rms > 0.0) return true;
    if (!scene.bodies_collide) return is_drawn(scene.bodies[body]);
    return std::any_of(scene.bodies.begin(), scene.bodies.end(), is_drawn);
}

Scene scene_of_try(const Scene& scene, std::size_t body, const SearchTry& one) {
    Scene result = scene;
    result.seed = one.seed;
    one.launch.apply(result.bodies[body]);
    return result;
}

std::vector<SearchTry> search_motion(const Scene& scene, const std::vector<LoadedBody>& loaded,
                                     const MotionSearch& search,
                                     const std::function<void(double)>& progress) {
    std::vector<SearchTry> tries(static_cast<std::size_t>(search.tries));
    parallel_for(
        tries.size(), 1, search.threads,
        [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                SearchTry& one = tries[i];
                one.seed = scene.seed + i;
                one.launch = drawn_launch(search.launch, scene.bodies[search.body], one.seed);
                try {
                    one.miss = miss_of(scene_of_try(scene, search.body, one), loaded, search);
                } catch (const std::exception& error) {
                    one.error = error.what();
                    one.miss.score = std::numeric_limits<double>::infinity();
                }
            }
        },
        progress);
    std::stable_sort(tries.begin(), tries.end(),
                     [](const SearchTry& a, const SearchTry& b) { return a.miss.score < b.miss.score; });
    if (!tries.front().error.empty()) throw Error(tries.front().error);
    return tries;
}

}  // namespace samara
