#include "samara/scene/target_search.hpp"

#include <algorithm>
#include <tuple>

#include "samara/core/base/error.hpp"
#include "samara/core/base/parallel_for.hpp"
#include "samara/scene/scene_simulation.hpp"

namespace samara {
namespace {

bool is_nearer(const TargetMiss& a, const TargetMiss& b) {
    return std::tuple(!a.reached, a.distance) < std::tuple(!b.reached, b.distance);
}

TargetMiss miss_of(const Scene& scene, const std::vector<LoadedBody>& loaded, std::size_t body,
                   const Target& target) {
    SceneSimulation simulation(scene, loaded, 1, 1);
    const BodyMotion& watched = simulation.motion().bodies[body];
    const auto copies = static_cast<std::size_t>(watched.copies);
    TargetWatch watch(target, watched.copies);
    std::vector<Vector3d> places(copies);
    const auto display = [&](std::size_t index, std::size_t first, const std::vector<Pose>& poses) {
        if (index != body) return;
        for (std::size_t row = 0; row < poses.size() / copies; ++row) {
            for (std::size_t copy = 0; copy < copies; ++copy) {
                places[copy] = poses[row * copies + copy].position;
            }
            watch.add(simulation.motion().times[first + row], places);
        }
    };
    simulation.fly(display, [](double, double) { return true; });
    TargetMiss miss = watch.nearest();
    miss.seed = scene.seed;
    return miss;
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

TargetWatch::TargetWatch(const Target& target, int copies)
    : target_(target), passages_(static_cast<std::size_t>(copies)) {}

void TargetWatch::add(double time, const std::vector<Vector3d>& places) {
    for (std::size_t copy = 0; copy < places.size(); ++copy) {
        Passage& passage = passages_[copy];
        const double distance = (places[copy] - target_.middle).norm();
        TargetMiss now{.copy = static_cast<int>(copy), .distance = distance, .time = time};
        if (!target_.normal) {
            now.reached = distance <= target_.radius;  // where it is last counts
            passage.frame = now;
            continue;
        }
        if (!begun_ || distance < passage.frame.distance) passage.frame = now;
        if (begun_) {
            const double before = (passage.place - target_.middle).dot(*target_.normal);
            const double after = (places[copy] - target_.middle).dot(*target_.normal);
            if (before != after && before * after <= 0.0) {
                const double share = before / (before - after);
                const Vector3d place = passage.place + share * (places[copy] - passage.place);
                now.distance = (place - target_.middle).norm();
                now.time = time_ + share * (time - time_);
                now.reached = now.distance <= target_.radius;
                if (!passage.crossing || is_nearer(now, *passage.crossing)) passage.crossing = now;
            }
        }
        passage.place = places[copy];
    }
    time_ = time;
    begun_ = true;
}

TargetMiss TargetWatch::nearest() const {
    std::vector<TargetMiss> misses;
    for (const Passage& passage : passages_) {
        misses.push_back(passage.crossing.value_or(passage.frame));
    }
    return *std::min_element(misses.begin(), misses.end(), is_nearer);
}

std::vector<TargetMiss> search_target(const Scene& scene, const std::vector<LoadedBody>& loaded,
                                      std::size_t body, const Target& target, int tries, int threads,
                                      const std::function<void(double)>& progress) {
    std::vector<TargetMiss> misses(static_cast<std::size_t>(tries));
    std::vector<std::string> errors(misses.size());
    parallel_for(
        misses.size(), 1, threads,
        [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                Scene one = scene;
                one.seed = scene.seed + i;
                try {
                    misses[i] = miss_of(one, loaded, body, target);
                } catch (const std::exception& error) {
                    errors[i] = error.what();
                }
            }
        },
        progress);
    for (const std::string& error : errors) {
        if (!error.empty()) throw Error(error);
    }
    std::stable_sort(misses.begin(), misses.end(), is_nearer);
    return misses;
}

}  // namespace samara
