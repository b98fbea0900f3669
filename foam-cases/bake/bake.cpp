#include "foam-cases/bake/bake.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "converter/cases/case_reduction.hpp"
#include "converter/cases/samples_csv.hpp"
#include "converter/tables/replaced_turbulence.hpp"
#include "foam-cases/falls/fall_plan.hpp"
#include "foam-cases/farm/case_farm.hpp"
#include "foam-cases/farm/case_folder.hpp"
#include "foam-cases/farm/guarded_process.hpp"
#include "foam-cases/farm/unbalanced_falls.hpp"
#include "foam-cases/scene/scene_plan_report.hpp"
#include "samara/commands/shared/load_body.hpp"
#include "samara/commands/shared/print.hpp"
#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/files/folders.hpp"
#include "samara/core/files/replace_file.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;
using Planned = std::function<void(const BakePreparation&)>;

// Measures seconds since the last call, by wall clock and of CPU time.
class Stopwatch {
  public:
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        const std::chrono::duration<double> passed = now - last_;
        last_ = now;
        return passed.count();
    }

    double cpu_lap() {
        const double now = cpu_seconds_so_far();
        return now - std::exchange(last_cpu_, now);
    }

  private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
    double last_cpu_ = cpu_seconds_so_far();
};

/// Writes the output; the body gets the mass for which it was baked.
void write_result(const BakeRequest& request, Body& body) {
    if (request.baked) {
        const LoadTables turbulence = std::move(*body.tables);
        body = *request.baked;
        body.tables = with_replaced_turbulence(std::move(*body.tables), turbulence);
    } else {
        body.mass = mass_asked_or_own(request.mass, body);
    }
    write_body_file(request.output, body);
}

bool plans_falls(const BakeRequest& request) {
    return request.tables && request.probes == 0 && request.quality.falls > 0;
}

/// Returns the mass for the tables and falls, and where given the second one for every other fall.
std::vector<MassSpecification> masses_of(const BakeRequest& request) {
    std::vector<MassSpecification> masses = {request.mass};
    if (request.other_density > 0.0) masses.emplace_back().density = request.other_density;
    return masses;
}

BakePreparation plan_of(const BakeRequest& request, const Body& body) {
    BakePreparation preparation;
    preparation.body = body;
    if (!request.tables) return preparation;
    const std::vector<MassSpecification> masses = masses_of(request);
    double reynolds_number = request.reynolds_number.value_or(0.0);
    Fluid fluid = request.fluid;
    if (request.baked) {
        const LoadTables& tables = *request.baked->tables;
        reynolds_number = main_reynolds_number(tables, case_records(tables));
    } else if (!request.reynolds_number || plans_falls(request)) {
        for (const MassSpecification& mass : masses) {
            const double speed = bake_speed(body, fluid, mass_of(mass, body), request.gravity);
            preparation.terminal_speed = std::max(preparation.terminal_speed, speed);
        }
        const double circulation = preparation.terminal_speed * reference_length(body.moments.surface_area);
        if (request.reynolds_number) {
            fluid.viscosity = fluid.density * circulation / reynolds_number;
        } else {
            reynolds_number = rounded_reynolds_number(circulation / fluid.kinematic_viscosity());
        }
    }
    if (request.goal) {
        preparation.simulation =
            simulate_for_bake(request.goal->scene, request.goal->body, body, request.goal->falls);
        preparation.scene_plan =
            first_plan(*request.goal, body, request.quality, request.inflow, preparation.simulation);
        preparation.plan = preparation.scene_plan->cases;
    } else if (request.probes > 0) {
        preparation.plan = plan_probes(body, request.quality, reynolds_number, request.probes);
    } else {
        preparation.plan = plan_bake(body, request.quality, reynolds_number, request.inflow);
    }
    preparation.plan->ranks = request.ranks;
    if (plans_falls(request)) {
        add_falls(body, fluid, masses, request.gravity, *preparation.plan);
    }
    if (preparation.scene_plan) preparation.scene_plan->cases = *preparation.plan;
    preparation.work = farm_work(case_folder_of(request), body, *preparation.plan, foam_cases_folder());
    return preparation;
}

Body named_body(const BakeRequest& request, const fs::path& folder) {
    Body body = prepare_body(request.shape, request.reading, folder);
    body.tables.reset();
    body.dynamic.reset();
    if (!request.name.empty()) body.name = request.name;
    return body;
}

/// Solves the folder of cases of one bake, perhaps in rounds.
class CaseSolving {
  public:
    CaseSolving(const BakeRequest& request, const Body& body, FarmOptions farm, BakeResult& result)
        : folder_(case_folder_of(request)),
          foam_cases_(foam_cases_folder()),
          body_(body),
          farm_(std::move(farm)),
          result_(result),
          lock_(folder_) {
        require_cases_of(CaseType::bake, folder_);
        end_earlier_jobs(folder_);
    }

    /// Solves the cases of a plan that are not solved yet.
    void solve(const BakePlan& plan, Unplanned unplanned) {
        write_case_folder(folder_, body_, plan, foam_cases_, unplanned);
        const std::size_t solved_before = count_solved(folder_, plan);
        const double spent_before = cpu_seconds_of(cpu_account(folder_, plan));
        watch_.cpu_lap();
        result_.reused += solved_before - std::min(solved_before, solved_);
        const std::vector<LeftOutCase> left_out = solve_until_balanced(folder_, plan, farm_, foam_cases_);
        solved_ = plan.cases.size() + plan.falls.size() - left_out.size();
        result_.left_out = left_out;
        records_ = cpu_account(folder_, plan);
        result_.cpu_seconds = cpu_seconds_of(records_);
        // Cases on a cluster do not run as child processes.
        const double of_cases = farm_.cluster.empty() ? result_.cpu_seconds - spent_before : 0.0;
        farming_.seconds += std::max(0.0, watch_.cpu_lap() - of_cases);
        result_.case_seconds += watch_.lap();
    }

    [[nodiscard]] Conversion converted() {
        watch_.lap();
        watch_.cpu_lap();
        Progress progress("converting", "cases");
        std::optional<Progress> identification;
        Conversion conversion = convert_folder(
            folder_,
            [&](std::size_t done, std::size_t total) {
                progress.update(static_cast<double>(done), static_cast<double>(total));
            },
            [&](double share) {
                if (!identification) identification.emplace("identifying", "%");
                identification->update(100.0 * share, 100.0);
            });
        result_.conversion_seconds += watch_.lap();
        reduction_.seconds += watch_.cpu_lap();
        return conversion;
    }

    [[nodiscard]] FolderReduction reduced() {
        Progress progress("converting", "cases");
        return reduce_folder(folder_, read_case_plan(folder_), [&](std::size_t done, std::size_t total) {
            progress.update(static_cast<double>(done), static_cast<double>(total));
        });
    }

    /// Removes the cases that no round planned.
    void remove_unplanned(const BakePlan& plan) {
        write_case_folder(folder_, body_, plan, foam_cases_, Unplanned::removed);
    }

    void name_work(std::string work) { farm_.work = std::move(work); }

    /// Adds the work that was done here to the result's account.
    void close_account() const {
        result_.account.insert(result_.account.end(), records_.begin(), records_.end());
        result_.account.insert(result_.account.end(), {farming_, reduction_});
    }

  private:
    fs::path folder_;
    fs::path foam_cases_;
    const Body& body_;
    FarmOptions farm_;
    BakeResult& result_;
    FolderLock lock_;
    Stopwatch watch_;
    std::size_t solved_ = 0;
    CpuAccount records_;
    CpuPart farming_ = {.what = "running them, checks"};
    CpuPart reduction_ = {.what = "tables"};
};

void bake_for_scene(const BakeRequest& request, CaseSolving& solving, BakeResult& result) {
    ScenePlan plan = *result.preparation.scene_plan;
    Conversion conversion;
    while (plan.stopped_because.empty()) {
        solving.name_work(fmt::format("baking, round {}", plan.rounds.size() + 1));
        solving.solve(plan.cases, Unplanned::kept);
        conversion = solving.converted();
        judge_round(*request.goal, conversion, result.cpu_seconds, plan);
        print_note("{}\n", round_as_line(*request.goal, plan));
    }
    solving.remove_unplanned(plan.cases);
    if (!request.goal->whole_grid) conversion.body.tables->plan = plan.region;
    conversion.body.tables->plan.report = scene_plan_as_json(*request.goal, plan).dump();
    result.conversion = std::move(conversion);
    result.preparation.plan = plan.cases;
    result.preparation.scene_plan = std::move(plan);
    write_result(request, result.conversion->body);
}

void solve_and_convert(const BakeRequest& request, const Body& body, const FarmOptions& farm,
                       BakeResult& result) {
    CaseSolving solving(request, body, farm, result);
    if (request.goal) {
        bake_for_scene(request, solving, result);
        solving.close_account();
        return;
    }
    const BakePlan plan = *result.preparation.plan;
    solving.solve(plan, Unplanned::removed);
    if (request.probes > 0) {
        const FolderReduction reduction = solving.reduced();
        solving.close_account();
        result.probes = reduction.cases.size();
        replace_file_with(request.output, samples_csv(reduction.cases, plan.axes));
        return;
    }
    result.conversion = solving.converted();
    solving.close_account();
    write_result(request, result.conversion->body);
}

}  // namespace

fs::path case_folder_of(const fs::path& output) {
    const std::string name = is_body_file_name(output) ? body_name_of(output) : output.stem().string();
    return output.parent_path() / (name + ".cases");
}

fs::path case_folder_of(const BakeRequest& request) {
    fs::path folder = case_folder_of(request.output);
    if (request.baked) folder.replace_extension(".turbulence.cases");
    return folder;
}

BakePreparation prepare_bake(const BakeRequest& request) {
    const TemporaryFolder folder;
    Body body = named_body(request, folder.path());
    add_kirchhoff_tensor(body, request.shape, case_folder_of(request) / case_body_name, folder.path());
    return plan_of(request, body);
}

BakeResult bake_body(const BakeRequest& request, const FarmOptions& farm, const Planned& planned) {
    const TemporaryFolder temporary;
    const fs::path folder = case_folder_of(request);
    BakeResult result;
    Stopwatch watch;
    if (request.tables) require_solvers(farm, request.ranks);
    Body body = named_body(request, temporary.path());
    result.mesh_seconds = watch.lap();
    result.account.push_back({"surface", 0, watch.cpu_lap()});
    add_kirchhoff_tensor(body, request.shape, folder / case_body_name, temporary.path());
    result.kirchhoff_seconds = watch.lap();
    result.account.push_back({"Kirchhoff tensor", 0, watch.cpu_lap()});
    result.preparation = plan_of(request, body);
    planned(result.preparation);
    if (request.tables) {
        solve_and_convert(request, body, farm, result);
    } else {
        write_result(request, body);
    }
    return result;
}

namespace {

namespace fs = std::filesystem;

fs::path require_program(const std::string& name) {
    if (auto program = find_program(name)) return *program;
    throw Error(fmt::format(
        "the program {} is neither installed beside this program nor on PATH; install samara again", name));
}

// Returns the error that a program of samara printed in its last line, without the program's name.
std::string error_in(const fs::path& log, const std::string& program) {
    std::istringstream lines(read_bytes(log));
    std::string last;
    for (std::string line; std::getline(lines, line);) {
        if (!line.empty()) last = line;
    }
    const std::string prefix = program + ": ";
    if (last.empty()) return fmt::format("{} failed without a message; run it alone to see why", program);
    return last.starts_with(prefix) ? last.substr(prefix.size()) : last;
}

void run_stage(const std::vector<std::string>& words, const fs::path& log, const std::string& program) {
    if (run_subprocess(words, log) != 0) throw Error(error_in(log, program));
}

}  // namespace

Body prepare_body(const fs::path& shape, const ShapeReading& reading, const fs::path& folder) {
    if (is_body_file_name(shape)) return load_body(shape, reading);
    if (!fs::is_regular_file(shape))
        throw Error(fmt::format("{}: does not exist; check the name", shape.string()));
    const fs::path meshed = folder / "shape.body.h5";
    const std::string name = shape.string().starts_with('-') ? "./" + shape.string() : shape.string();
    std::vector<std::string> words = {require_program("samara-mesh").string(), name, "-o", meshed.string()};
    for (const std::string& word : words_of(reading)) words.push_back(word);
    run_stage(words, folder / "log.mesh", "samara mesh");
    Body body = naming(shape.string(), meshed.string(), [&] { return read_body_file(meshed); });
    body.name = body_name_of(shape);
    return body;
}

void add_kirchhoff_tensor(Body& body, const fs::path& shape, const fs::path& earlier,
                          const fs::path& folder) {
    if (body.kirchhoff && body.surface_loads) return;
    if (fs::is_regular_file(fs::symlink_status(earlier))) {
        const Body known = read_body_file(earlier);
        if (known.kirchhoff && known.surface_loads &&
            surface_hash(known.surface) == surface_hash(body.surface)) {
            body.kirchhoff = known.kirchhoff;
            body.surface_loads = known.surface_loads;
            return;
        }
    }
    const fs::path file = folder / "kirchhoff.body.h5";
    write_body_file(file, body);
    naming(shape.string(), file.string(), [&] {
        run_stage({require_program("samara").string(), "kirchhoff", file.string(), "-o", file.string()},
                  folder / "log.kirchhoff", "samara kirchhoff");
    });
    const Body solved = read_body_file(file);
    body.kirchhoff = solved.kirchhoff;
    body.surface_loads = solved.surface_loads;
    if (!body.kirchhoff)
        throw Error(
            fmt::format("{}: has no Kirchhoff tensor; compute it with 'samara kirchhoff'", body.name));
}

namespace {

/// Returns the physics that a scene's body is simulated with where it is not baked: a body file that
/// recommends the loads of its surface needs no tables.
BodyPhysics as_simulated(const SceneBody& scene_body) {
    BodyPhysics physics = scene_body;
    if (!scene_body.open.loads || !is_body_file_name(scene_body.shape)) return physics;
    const Body body = read_body_file(scene_body.shape);
    if (body.recommended) choose_open_models(body, scene_body.open, physics);
    return physics;
}

}  // namespace

std::vector<BakeRequest> requests_for_scene(const Scene& scene, const std::filesystem::path& folder,
                                            const SceneBakeOptions& options) {
    std::vector<BakeRequest> requests;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        const SceneBody& body = scene.bodies[i];
        BakeRequest request;
        request.name = body.name;
        request.shape = body.shape;
        request.reading = reading_of(body);
        request.output = folder / (body.name + ".body.h5");
        request.fluid = scene.fluid;
        request.mass = body.mass;
        request.gravity = scene.gravity.norm();
        request.quality = options.quality;
        request.inflow = options.inflow;
        const BodyPhysics physics = as_simulated(body);
        request.tables = uses_body_tables(physics.loads, physics.turbulence);
        if (request.tables) {
            request.goal = SceneGoal{.scene = scene,
                                     .body = i,
                                     .tolerance = options.tolerance,
                                     .budget = options.budget,
                                     .most_rounds = options.most_rounds,
                                     .whole_grid = options.whole_grid};
        }
        requests.push_back(std::move(request));
    }
    return requests;
}

}  // namespace samara
