#include "foam-cases/bake.hpp"

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <optional>

#include <fmt/format.h>

#include "converter/case_folder_reduction.hpp"
#include "converter/samples_csv.hpp"
#include "foam-cases/body_preparation.hpp"
#include "foam-cases/case_farm.hpp"
#include "foam-cases/case_folder.hpp"
#include "foam-cases/cluster_jobs.hpp"
#include "foam-cases/fall_plan.hpp"
#include "foam-cases/folder_lock.hpp"
#include "foam-cases/terminal_speed.hpp"
#include "samara/base/error.hpp"
#include "samara/body/body_file.hpp"
#include "samara/command/progress.hpp"
#include "samara/files/replace_file.hpp"
#include "samara/files/temporary_folder.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;
using Planned = std::function<void(const BakePreparation&)>;

// Seconds since the last call.
class Stopwatch {
  public:
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        const std::chrono::duration<double> passed = now - last_;
        last_ = now;
        return passed.count();
    }

  private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

double mass_of(const MassSpecification& mass, const Body& body) {
    if (mass.mass) return *mass.mass;
    if (mass.density) return *mass.density * body.moments.volume;
    throw Error(fmt::format("{}: has neither a density nor a mass; give one", body.name));
}

BakePreparation plan_of(const BakeRequest& request, const Body& body) {
    BakePreparation preparation;
    if (!request.tables) return preparation;
    preparation.terminal_speed =
        terminal_speed(body, request.fluid, mass_of(request.mass, body), request.gravity);
    const double reynolds_number = terminal_reynolds_number(body, request.fluid, preparation.terminal_speed);
    preparation.plan = request.probes > 0
                           ? plan_probes(body, request.quality, reynolds_number, request.probes)
                           : plan_bake(body, request.quality, reynolds_number, request.inflow);
    preparation.plan->ranks = request.ranks;
    if (request.probes == 0 && request.quality.falls > 0) {
        add_falls(body, request.fluid, request.mass, request.gravity, preparation.terminal_speed,
                  *preparation.plan);
    }
    return preparation;
}

Body named_body(const BakeRequest& request, const fs::path& folder) {
    Body body = prepare_body(request.shape, request.scale, folder);
    body.tables.reset();
    body.dynamic.reset();
    if (!request.name.empty()) body.name = request.name;
    return body;
}

void solve_and_convert(const BakeRequest& request, const Body& body, const FarmOptions& farm,
                       BakeResult& result) {
    const fs::path folder = case_folder_of(request.output);
    const fs::path templates = foam_cases_folder();
    const FolderLock lock(folder);
    require_cases_of(CaseKind::bake, folder);
    Stopwatch watch;
    const BakePlan& plan = *result.preparation.plan;
    end_earlier_jobs(folder);
    write_case_folder(folder, body, plan, templates);
    result.reused = count_solved(folder, plan);
    result.left_out = solve_cases(folder, plan, farm, templates);
    result.cpu_seconds = spent_cpu_seconds(folder, plan);
    result.case_seconds = watch.lap();

    Progress progress("converting", "cases");
    const auto tell = [&](std::size_t done, std::size_t total) {
        progress.update(static_cast<double>(done), static_cast<double>(total));
    };
    if (request.probes > 0) {
        const FolderReduction reduction = reduce_folder(folder, read_case_plan(folder), tell);
        result.probes = reduction.cases.size();
        replace_file_with(request.output, samples_csv(reduction.cases, plan.axes));
    } else {
        std::optional<Progress> identification;
        const auto identifying = [&](double share) {
            if (!identification) identification.emplace("identifying", "%");
            identification->update(100.0 * share, 100.0);
        };
        result.conversion = convert_folder(folder, tell, identifying);
        write_body_file(request.output, result.conversion->body);
    }
    result.conversion_seconds = watch.lap();
}

}  // namespace

fs::path case_folder_of(const fs::path& output) {
    const std::string name = is_body_file_name(output) ? body_name_of(output) : output.stem().string();
    return output.parent_path() / (name + ".cases");
}

BakePreparation prepare_bake(const BakeRequest& request) {
    const TemporaryFolder folder;
    Body body = named_body(request, folder.path());
    if (request.tables && request.probes == 0 && request.quality.falls > 0) {
        add_kirchhoff_tensor(body, case_folder_of(request.output) / case_body_name, folder.path());
    }
    return plan_of(request, body);
}

BakeResult bake_body(const BakeRequest& request, const FarmOptions& farm, const Planned& planned) {
    const TemporaryFolder temporary;
    const fs::path folder = case_folder_of(request.output);
    BakeResult result;
    Stopwatch watch;
    if (request.tables) require_solvers(farm, request.ranks);
    Body body = named_body(request, temporary.path());
    result.mesh_seconds = watch.lap();
    add_kirchhoff_tensor(body, folder / case_body_name, temporary.path());
    result.kirchhoff_seconds = watch.lap();
    result.preparation = plan_of(request, body);
    planned(result.preparation);
    if (request.tables) {
        solve_and_convert(request, body, farm, result);
    } else {
        write_body_file(request.output, body);
    }
    return result;
}

}  // namespace samara
