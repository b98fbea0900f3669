#include "foam-cases/falls/validate.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "foam-cases/bake/bake.hpp"
#include "foam-cases/farm/case_farm.hpp"
#include "foam-cases/farm/case_folder.hpp"
#include "foam-cases/farm/case_records.hpp"
#include "foam-cases/farm/guarded_process.hpp"
#include "samara/analysis/comparison/reference_uncertainty.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/files/folders.hpp"
#include "samara/core/simulation/world_pose.hpp"
#include "samara/formats/json_text.hpp"
#include "samara/motion/motion_file.hpp"
#include "samara/scene/scene_simulation.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;

// The scene with its body as full CFD takes it: its loads are what is solved.
struct Falling {
    Scene scene;
    Body body;
    ImmersedBody immersed;
    std::vector<BodyState> starts;    // of the copies
    std::vector<double> start_times;  // s
};

// The unit of velocity, one for all copies, so that their cases differ only in the start.
double speed_unit(const Falling& falling) {
    double speed = 0.0;
    for (const BodyState& start : falling.starts) {
        speed = std::max(speed, fall_speed(falling.body, falling.immersed, start, falling.scene.fluid,
                                           falling.scene.gravity.norm()));
    }
    if (speed > 0.0) return speed;
    throw Error(
        fmt::format("{}: the body '{}' is as dense as the fluid and starts at rest, so it does not fall; "
                    "give it another density or a velocity",
                    falling.scene.file.string(), falling.immersed.name));
}

Falling make_falling(const Scene& scene, const fs::path& earlier, const fs::path& temporary) {
    Falling falling;
    falling.scene = scene;
    SceneBody& scene_body = falling.scene.bodies.front();
    scene_body.loads = Loads::none;
    scene_body.turbulence = Turbulence::none;
    scene_body.added_mass = true;  // full CFD has it, whatever the scene's model leaves out
    scene_body.table_reynolds_number.reset();
    falling.body = prepare_body(scene_body.shape, reading_of(scene_body), temporary);
    falling.body.name = scene_body.name;
    falling.body.tables.reset();
    falling.body.dynamic.reset();
    add_kirchhoff_tensor(falling.body, scene_body.shape, earlier, temporary);
    falling.immersed = make_immersed_body(falling.body, scene_body, scene.fluid, scene_body.name);
    const double step = scene.step;
    for (int copy = 0; copy < scene_body.count; ++copy) {
        const Noise noise(scene.seed, scene_body.name, 0, static_cast<std::uint32_t>(copy));
        const CopyStart start = start_of_copy(scene_body, step, noise);
        falling.start_times.push_back(scene_body.start + static_cast<double>(start.first_step) * step);
        falling.starts.push_back(initial_state(start, falling.immersed.center_of_mass,
                                               surroundings_of(falling.scene), falling.start_times.back()));
    }
    return falling;
}

BakePlan plan_of(const ValidationRequest& request, const Falling& falling) {
    const FallModel model = fall_model_of(request.closure);
    const double speed = speed_unit(falling);
    std::vector<FreeFall> falls;
    for (std::size_t copy = 0; copy < falling.starts.size(); ++copy) {
        const double duration = falling.scene.duration - falling.start_times[copy];
        FreeFall fall = plan_fall(falling.body, falling.immersed, falling.starts[copy], falling.scene.gravity,
                                  speed, duration, model);
        fall.time_step *= request.step;
        if (request.fields > 0.0) fall.field_interval = 1.0 / (request.fields * fall.time_unit());
        falls.push_back(fall);
    }
    return plan_falls(falling.body, request.cells, std::move(falls), model);
}

FallSolution read_solution(const fs::path& fall_folder) {
    const fs::path file = fall_folder / "provenance.json";
    try {
        const auto json = parse_json_or_discard(read_bytes(file));
        FallSolution solution;
        for (const auto& attempt : json.at("attempts")) solution.attempts.push_back(attempt.at("what"));
        solution.time_step = json.at("time_step");
        solution.largest_courant_number = json.at("largest_courant_number");
        if (json.at("mesh").is_object()) solution.cells = json.at("mesh").at("cells");
        return solution;
    } catch (const nlohmann::json::exception& reason) {
        throw Error(fmt::format("{}: an entry is missing or of the wrong type ({}); remove it and run again",
                                file.string(), reason.what()));
    }
}

Motion motion_of(const Falling& falling, const std::vector<SolvedFall>& falls, const fs::path& body_file) {
    SceneSimulation simulation(falling.scene, {LoadedBody{falling.body, file_content_hash(body_file)}}, 1, 1);
    Motion motion = simulation.motion();
    motion.bodies.front().models =
        fmt::format("full CFD: OpenFOAM pimpleFoam with six degrees of freedom, {}, mesh {}",
                    name_of(falls.front().record.fall.closure), falls.front().record.fall.mesh);
    take_falls(falls, surroundings_of(falling.scene), motion);
    return motion;
}

}  // namespace

FallBalance ValidationResult::worst_balance() const {
    FallBalance worst = balances.front();
    for (const FallBalance& balance : balances) {
        worst.force = std::max(worst.force, balance.force);
        worst.moment = std::max(worst.moment, balance.moment);
    }
    return worst;
}

double ValidationResult::largest_courant_number() const {
    return std::ranges::max(solutions, {}, &FallSolution::largest_courant_number).largest_courant_number;
}

void require_falls_of_one_body(const Scene& scene) {
    const auto reject = [&](const char* what) {
        return Error(fmt::format("{}: {}", scene.file.string(), what));
    };
    if (scene.bodies.size() != 1) {
        throw reject("full CFD solves one body at a time; write one scene for each body");
    }
    const SceneBody& body = scene.bodies.front();
    if (body.spreads_size())
        throw reject("full CFD does not support scaled copies; remove 'size' from 'spread'");
    if (scene.ground)
        throw reject(
            "full CFD does not support a ground; remove 'ground' and let the scene end before the landing");
    if (!scene.obstacles.empty()) throw reject("full CFD does not support obstacles; remove [[obstacle]]");
    if (!scene.wind.is_calm())
        throw reject("full CFD does not support wind; remove [wind], or give a uniform one as 'current'");
    if (scene.fluid.gust.amplitude.norm() > 0.0)
        throw reject("full CFD does not support gusts; remove 'gust'");
    if (!(scene.duration > body.start + body.spread_start))
        throw reject("the scene ends before its body starts; give a longer duration, or an earlier start");
}

Motion with_uncertainties(const fs::path& file, const OtherSolutions& beside) {
    Motion motion = read_motion_file(file);
    std::vector<MetricUncertainty>& uncertainties = motion.bodies.front().uncertainties;
    for (const auto& [cause, others] : beside) {
        std::erase_if(uncertainties,
                      [&cause = cause](const MetricUncertainty& one) { return one.cause == cause; });
        const fs::path& reference = others.size() > 1 ? others.back() : file;
        std::ranges::copy(uncertainty_beside(reference, others.front(), cause),
                          std::back_inserter(uncertainties));
    }
    return motion;
}

BakePlan prepare_validation(const ValidationRequest& request) {
    require_falls_of_one_body(request.scene);
    const TemporaryFolder temporary;
    const fs::path folder = case_folder_of(request.output);
    return plan_of(request, make_falling(request.scene, folder / case_body_name, temporary.path()));
}

ValidationResult validate_scene(const ValidationRequest& request, const FarmOptions& farm,
                                const std::function<void(const BakePlan&)>& planned) {
    require_falls_of_one_body(request.scene);
    require_solvers(farm, 1);
    const TemporaryFolder temporary;
    const fs::path folder = case_folder_of(request.output);
    const fs::path foam_cases = foam_cases_folder();
    const Falling falling = make_falling(request.scene, folder / case_body_name, temporary.path());
    ValidationResult result;
    result.plan = plan_of(request, falling);
    planned(result.plan);
    const FolderLock lock(folder);
    require_cases_of(CaseType::fall, folder);
    end_earlier_jobs(folder);
    write_case_folder(folder, falling.body, result.plan, foam_cases);
    result.reused = count_solved(folder, result.plan);
    const std::vector<LeftOutCase> left_out = solve_cases(folder, result.plan, farm, foam_cases);
    if (!left_out.empty()) {
        throw Error(fmt::format("{}/{}: {}; {} of {} falls are solved and kept", folder.string(),
                                left_out.front().name, left_out.front().reason,
                                count_solved(folder, result.plan), result.plan.falls.size()));
    }
    result.cpu_seconds = cpu_seconds_of(cpu_account(folder, result.plan));
    std::vector<SolvedFall> solved;
    for (std::size_t copy = 0; copy < falling.starts.size(); ++copy) {
        const fs::path fall_folder = folder / result.plan.falls[copy].name;
        solved.push_back({read_fall_record(fall_folder), falling.starts[copy], falling.start_times[copy]});
        result.solutions.push_back(read_solution(fall_folder));
        result.balances.push_back(balance_of(solved.back().record));
    }
    result.motion = motion_of(falling, solved, folder / case_body_name);
    write_motion_file(request.output, result.motion);
    if (request.beside.empty()) return result;
    result.motion = with_uncertainties(request.output, request.beside);
    write_motion_file(request.output, result.motion);
    return result;
}

namespace {

struct TimedPose {
    double time;  // s, since the body's start
    Pose pose;    // in the flow's frame
};

std::vector<TimedPose> flow_poses(const FallRecord& record, const BodyState& start) {
    const FreeFall& fall = record.fall;
    const Matrix3d to_flow = start.orientation.toRotationMatrix() * fall.axes;
    std::vector<TimedPose> poses = {{0.0, flow_pose(start)}};
    for (const FallSample& sample : record.samples) {
        Pose pose;
        pose.position = start.position + to_flow * (sample.position - fall.center_of_mass) * fall.length;
        pose.orientation = Quaterniond(to_flow * sample.rotation * fall.axes.transpose());
        keep_sign_continuous(pose.orientation, poses.back().pose.orientation);
        pose.velocity = to_flow * sample.velocity * fall.speed;
        pose.angular_velocity = to_flow * sample.angular_velocity / fall.time_unit();
        poses.push_back({sample.time * fall.time_unit(), pose});
    }
    return poses;
}

// Returns the poses at the motion's times, until half a step after the fall's last step.
std::vector<Pose> poses_at(const std::vector<double>& times, const SolvedFall& fall,
                           const Surroundings& surroundings) {
    const std::vector<TimedPose> steps = flow_poses(fall.record, fall.start);
    const double half_step = 0.5 * fall.record.fall.time_step * fall.record.fall.time_unit();
    std::vector<Pose> poses;
    std::size_t after = 1;
    for (const double frame_time : times) {
        const double time = frame_time - fall.start_time;
        if (time < 0.0) {
            poses.push_back(held(flow_pose(fall.start), surroundings, fall.start_time));
            continue;
        }
        if (time > steps.back().time + half_step) break;
        while (after + 1 < steps.size() && steps[after].time < time) ++after;
        const TimedPose& from = steps[after - 1];
        const TimedPose& to = steps[after];
        const Pose pose = pose_between(from.pose, to.pose, from.time, to.time - from.time, time);
        poses.push_back(in_world(pose, surroundings, frame_time));
    }
    if (poses.size() < 2) {
        throw Error(fmt::format(
            "{}: the fall ends before its second frame; give a longer duration or a higher frame_rate",
            fall.record.fall.name));
    }
    return poses;
}

}  // namespace

void take_falls(const std::vector<SolvedFall>& falls, const Surroundings& surroundings, Motion& motion) {
    std::vector<std::vector<Pose>> copies;
    for (const SolvedFall& fall : falls) {
        copies.push_back(poses_at(motion.times, fall, surroundings));
        motion.times.resize(copies.back().size());
    }
    for (std::size_t frame = 0; frame < motion.times.size(); ++frame) {
        for (const std::vector<Pose>& copy : copies) motion.bodies.front().poses.push_back(copy[frame]);
    }
}

}  // namespace samara
