#include "foam-cases/validate.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "foam-cases/bake.hpp"
#include "foam-cases/body_preparation.hpp"
#include "foam-cases/case_folder.hpp"
#include "foam-cases/cluster_jobs.hpp"
#include "foam-cases/fall_motion.hpp"
#include "foam-cases/folder_lock.hpp"
#include "foam-cases/terminal_speed.hpp"
#include "samara/base/content_hash.hpp"
#include "samara/base/error.hpp"
#include "samara/files/temporary_folder.hpp"
#include "samara/motion/motion_file.hpp"
#include "samara/simulation/simulation.hpp"
#include "samara/simulation/world_pose.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;

// The scene with its body as full CFD takes it: its loads are what is solved.
struct Falling {
    Scene scene;
    Body body;
    ImmersedBody immersed;
    BodyState start;
};

double speed_unit(const Falling& falling) {
    const double start = falling.start.velocity.tail<3>().norm();
    const double gravity = falling.scene.gravity.norm();
    const double buoyant_mass = falling.immersed.fluid_density * falling.immersed.volume;
    const bool floats = std::abs(falling.immersed.mass - buoyant_mass) <= 1e-6 * buoyant_mass || gravity == 0.0;
    if (floats && start == 0.0) {
        throw Error(fmt::format("{}: the body '{}' neither sinks nor rises nor moves at the start; there is nothing to "
                                "solve",
                                falling.scene.file.string(), falling.immersed.name));
    }
    if (floats) return start;
    return std::max(start, terminal_speed(falling.body, falling.scene.fluid, falling.immersed.mass, gravity));
}

Falling make_falling(const Scene& scene, const fs::path& earlier, const fs::path& temporary) {
    Falling falling;
    falling.scene = scene;
    SceneBody& scene_body = falling.scene.bodies.front();
    scene_body.loads = Loads::none;
    scene_body.turbulence = Turbulence::none;
    falling.body = prepare_body(scene_body.shape, scene_body.scale, temporary);
    falling.body.name = scene_body.name;
    falling.body.tables.reset();
    falling.body.dynamic.reset();
    add_kirchhoff_tensor(falling.body, earlier, temporary);
    falling.immersed = make_immersed_body(falling.body, scene_body, scene.fluid);
    const Noise unused(scene.seed, scene_body.name, 0, 0);
    falling.start =
        initial_state(scene_body, falling.immersed.center_of_mass, surroundings_of(falling.scene), unused);
    return falling;
}

BakePlan plan_of(const ValidationRequest& request, const Falling& falling) {
    const SceneBody& scene_body = falling.scene.bodies.front();
    FreeFall fall = plan_fall(falling.body, falling.immersed, falling.start, falling.scene.gravity,
                              speed_unit(falling), falling.scene.duration - scene_body.start);
    fall.time_step = request.time_step;
    return plan_single_fall(falling.body, request.cells, fall);
}

Motion motion_of(const Falling& falling, const FallRecord& record, const fs::path& body_file) {
    Simulation simulation(falling.scene, {CastBody{falling.body, file_content_hash(body_file)}}, 1, 1);
    Motion motion = simulation.motion();
    motion.bodies.front().models = fmt::format("full CFD: OpenFOAM pimpleFoam with six degrees of freedom, {}, mesh {}",
                                               record.fall.closure, record.fall.mesh);
    take_fall(record, falling.start, falling.scene.bodies.front().start, surroundings_of(falling.scene), motion);
    return motion;
}

}  // namespace

void require_one_fall(const Scene& scene) {
    const auto refuse = [&](const char* what) {
        return Error(fmt::format("{}: {}", scene.file.string(), what));
    };
    if (scene.bodies.size() != 1) {
        throw refuse("full CFD solves one body at a time; make a scene for each body");
    }
    const SceneBody& body = scene.bodies.front();
    if (body.count != 1) throw refuse("full CFD solves one copy of a body; drop 'count'");
    if (scene.ground) throw refuse("full CFD knows no ground; drop 'ground' and let the scene end before the landing");
    if (scene.fluid.gust.amplitude.norm() > 0.0) throw refuse("full CFD knows no gust; drop 'gust'");
    if (!(scene.duration > body.start)) throw refuse("the scene ends before its body starts");
}

BakePlan prepare_validation(const ValidationRequest& request) {
    require_one_fall(request.scene);
    const TemporaryFolder temporary;
    const fs::path folder = case_folder_of(request.output);
    return plan_of(request, make_falling(request.scene, folder / case_body_name, temporary.path()));
}

ValidationResult validate_scene(const ValidationRequest& request, const FarmOptions& farm,
                                const std::function<void(const BakePlan&)>& planned) {
    require_one_fall(request.scene);
    require_solvers(farm, 1);
    const TemporaryFolder temporary;
    const fs::path folder = case_folder_of(request.output);
    const fs::path templates = foam_cases_folder();
    const Falling falling = make_falling(request.scene, folder / case_body_name, temporary.path());
    ValidationResult result;
    result.plan = plan_of(request, falling);
    planned(result.plan);
    const FolderLock lock(folder);
    end_earlier_jobs(folder);
    write_case_folder(folder, falling.body, result.plan, templates);
    result.reused = count_solved(folder, result.plan) > 0;
    const std::vector<LeftOutCase> failed = solve_cases(folder, result.plan, farm, templates);
    if (!failed.empty()) throw Error(fmt::format("{}: {}", (folder / failed.front().name).string(), failed.front().reason));
    result.cpu_seconds = spent_cpu_seconds(folder, result.plan);
    const FallRecord record = read_fall_record(folder / result.plan.falls.front().name);
    result.balance = balance_of(record);
    result.motion = motion_of(falling, record, folder / case_body_name);
    write_motion_file(request.output, result.motion);
    return result;
}

}  // namespace samara
