#include "foam-cases/bake/bake_report.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "converter/falls/fall_identification.hpp"
#include "foam-cases/farm/case_records.hpp"
#include "foam-cases/scene/scene_plan_report.hpp"
#include "samara/analysis/advice/input_warnings.hpp"
#include "samara/analysis/advice/model_judgement.hpp"
#include "samara/commands/shared/print.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/formats/json_text.hpp"

namespace samara {
namespace {

nlohmann::json provenance_of(const SolvedCase& solved) {
    return parse_json_or_discard(solved.provenance);
}

double drag_coefficient(const SolvedCase& solved) {
    return -solved.sample.entry.force.dot(solved.sample.direction);
}

nlohmann::json case_as_json(const SolvedCase& solved) {
    return {
        {"name", solved.name},
        {"direction", as_json(solved.sample.direction)},
        {"reynolds_number", solved.reynolds_number},
        {"drag_coefficient", drag_coefficient(solved)},
        {"drag_coefficient_error", solved.sample.error.force.cwiseProduct(solved.sample.direction).norm()},
        {"force", as_json(solved.sample.entry.force)},
        {"moment", as_json(solved.sample.entry.moment)},
        {"turbulent_kinetic_energy", solved.sample.entry.turbulent_kinetic_energy},
        {"dissipation_rate", solved.sample.entry.dissipation_rate},
        {"cpu_seconds", number_in(provenance_of(solved), "cpu_seconds")}};
}

nlohmann::json base_json(const BakeRequest& request, const BakePreparation& preparation) {
    nlohmann::json json = {{"body", request.output.string()}};
    if (!preparation.plan) return json;
    const BakePlan& plan = *preparation.plan;
    json["cases_folder"] = case_folder_of(request).string();
    json["quality"] = plan.quality.name;
    json["terminal_speed"] = preparation.terminal_speed;
    json["reynolds_numbers"] = plan.reynolds_numbers();
    json["reference_length"] = plan.reference_length;
    json["subdivisions"] = plan.subdivisions;
    return json;
}

nlohmann::json mesh_json(const SolvedCase& solved) {
    const nlohmann::json provenance = provenance_of(solved);
    return provenance.contains("mesh") ? provenance["mesh"] : nlohmann::json();
}

// Returns the records of the meshes on which the cases were solved, coarsest first.
std::vector<nlohmann::json> meshes_of(const std::vector<SolvedCase>& cases) {
    std::vector<nlohmann::json> meshes;
    for (const SolvedCase& solved : cases) {
        const nlohmann::json mesh = mesh_json(solved);
        if (mesh.is_object() && std::ranges::find(meshes, mesh) == meshes.end()) meshes.push_back(mesh);
    }
    std::ranges::sort(meshes, {}, [](const nlohmann::json& mesh) { return number_in(mesh, "cells"); });
    return meshes;
}

std::string remedy_of(const nlohmann::json& mesh) {
    const std::string remedy = text_in(mesh, "remedy");
    return remedy.empty() || remedy == "as planned" ? "" : fmt::format(" (remedy: {})", remedy);
}

// The numbers of jobs at once of which a dry run states the time.
constexpr std::size_t told_jobs[] = {1, 8, 64, 512};

}  // namespace

nlohmann::json bake_as_json(const BakeRequest& request, const BakePreparation& preparation) {
    nlohmann::json json = base_json(request, preparation);
    json["dry_run"] = true;
    json["cases"] = nlohmann::json::array();
    if (!preparation.plan) return json;
    for (const BakeCase& entry : preparation.plan->cases) {
        json["cases"].push_back({{"name", entry.name},
                                 {"direction", as_json(entry.direction)},
                                 {"reynolds_number", entry.reynolds_number}});
    }
    json["falls"] = nlohmann::json::array();
    for (const FreeFall& fall : preparation.plan->falls) {
        json["falls"].push_back({{"name", fall.name},
                                 {"mesh", fall.mesh},
                                 {"duration", fall.duration * fall.time_unit()},
                                 {"reynolds_number", fall.reynolds_number}});
    }
    for (const double cells : preparation.plan->cells) json["estimated_cells"].push_back(std::round(cells));
    json["estimated_cpu_seconds"] = std::round(preparation.plan->cpu_seconds);
    json["solved"] = preparation.work.done;
    for (const std::size_t jobs : told_jobs) {
        json["estimated_seconds"].push_back(
            {{"jobs", jobs}, {"seconds", std::round(seconds_with(preparation.work, jobs))}});
    }
    json["longest_chain_seconds"] = std::round(longest_chain(preparation.work));
    json["estimated_bytes"] = std::round(bytes_to_solve(case_folder_of(request), *preparation.plan));
    return json;
}

nlohmann::json bake_as_json(const BakeRequest& request, const BakeResult& result) {
    nlohmann::json json = base_json(request, result.preparation);
    json["cases"] = nlohmann::json::array();
    json["cpu_seconds"] = result.cpu_seconds;
    json["cpu_account"] = account_as_json(result.account);
    json["seconds"] = {{"mesh", result.mesh_seconds},
                       {"kirchhoff", result.kirchhoff_seconds},
                       {"cases", result.case_seconds},
                       {"convert", result.conversion_seconds}};
    json["probes"] = result.probes;
    if (!result.conversion) return json;
    for (const SolvedCase& solved : result.conversion->cases) json["cases"].push_back(case_as_json(solved));
    const LoadTables& tables = *result.conversion->body.tables;
    json["tables"] = {{"map_size", tables.map_size()},
                      {"subdivisions", tables.subdivisions},
                      {"reynolds_numbers", tables.reynolds_numbers},
                      {"reference_length", tables.reference_length},
                      {"entries", tables.entries.size()}};
    json["meshes"] = meshes_of(result.conversion->cases);
    json["reused_cases"] = result.reused;
    if (request.goal) json["plan"] = scene_plan_as_json(*request.goal, *result.preparation.scene_plan);
    if (result.conversion->identification) {
        json["dynamic_coefficients"] = identification_as_json(*result.conversion->identification);
    }
    json["left_out"] = nlohmann::json::array();
    for (const LeftOutCase& failed : result.left_out) {
        json["left_out"].push_back({{"name", failed.name}, {"reason", failed.reason}});
    }
    return json;
}

namespace {

/// Whether the bake is like those of its quality whose falls were held against full CFD.
bool is_as_flown(const BakeRequest& request, const BakePlan& plan) {
    const BakeQuality& quality = plan.quality;
    return !request.baked && request.probes == 0 && quality.falls == bake_quality(quality.name).falls &&
           quality.loads_closure == usual_loads_closure(quality.name);
}

std::string cost_in_words(std::size_t cases, double cpu_seconds, const FarmWork& work, int jobs,
                          double bytes) {
    const std::string solved = work.done == 0 ? "" : fmt::format(" ({} of them already solved)", work.done);
    return fmt::format(
        "{} cases and falls{}, {:.0f} CPU seconds in total, {:.0f} s with {} jobs, {:.0f} MB on disk", cases,
        solved, cpu_seconds, seconds_with(work, static_cast<std::size_t>(jobs)), jobs, 1e-6 * bytes);
}

/// Returns how long the work takes with more and more jobs at once, in one line.
std::string schedule_of(const FarmWork& work) {
    std::vector<std::string> seconds;
    for (const std::size_t jobs : told_jobs) {
        seconds.push_back(fmt::format("{:.0f}", seconds_with(work, jobs)));
    }
    return fmt::format("with {} jobs at once {} s; the longest chain of cases takes {:.0f} s",
                       fmt::join(told_jobs, ", "), fmt::join(seconds, ", "), longest_chain(work));
}

/// Returns what the plan costs and, where that was measured, what it brings, in one line.
std::string cost_of(const BakeRequest& request, const BakePreparation& preparation, int jobs) {
    const BakePlan& plan = *preparation.plan;
    std::string text = cost_in_words(plan.cases.size() + plan.falls.size(), plan.cpu_seconds,
                                     preparation.work, jobs, bytes_to_solve(case_folder_of(request), plan));
    if (request.goal) text += "; further rounds may follow";
    if (const auto errors = errors_on_held_out_falls(plan.quality.name);
        errors && is_as_flown(request, plan)) {
        text += fmt::format(
            "; on held-out falls bakes of this quality were off by {:.0f} % of the descent and "
            "{:.0f} % of the worst metric",
            100.0 * errors->descent, 100.0 * errors->worst_metric);
    }
    return text;
}

}  // namespace

void note_cost(const BakeRequest& request, const BakePreparation& preparation, int jobs) {
    if (!preparation.plan) return;
    print_note("samara bake: {}: quality {}, {}\n", request.output.string(), preparation.plan->quality.name,
               cost_of(request, preparation, jobs));
}

void print_preparation(const BakeRequest& request, const BakePreparation& preparation, int jobs) {
    if (!preparation.plan) {
        print_result("{}: mesh and Kirchhoff tensor only; the scene uses no tables\n",
                     request.output.string());
        return;
    }
    const BakePlan& plan = *preparation.plan;
    const std::string speed = request.baked             ? "that of the tables"
                              : request.reynolds_number ? "as asked for"
                                                        : fmt::format("terminal speed about {:.3g} m/s",
                                                                      preparation.terminal_speed);
    print_result("{}: {} cases at Reynolds number {:.0f} ({}, L = {:.4g} m)\n", request.output.string(),
                 plan.cases.size(), plan.main_reynolds_number, speed, plan.reference_length);
    for (const BakeCase& entry : plan.cases) {
        print_result("  {}  direction of motion ({:7.4f} {:7.4f} {:7.4f})\n", entry.name, entry.direction.x(),
                     entry.direction.y(), entry.direction.z());
    }
    for (const FreeFall& fall : plan.falls) {
        print_result("  {}  a free fall of {:.3g} s on {}\n", fall.name, fall.duration * fall.time_unit(),
                     fall.mesh);
    }
    print_result("meshes of about {:.0f} cells\n{}\n{}\n", fmt::join(plan.cells, ", "),
                 schedule_of(preparation.work), cost_of(request, preparation, jobs));
}

void print_total(const nlohmann::json& bodies, const FarmWork& work, int jobs) {
    std::size_t cases = 0;
    double seconds = 0.0;
    double bytes = 0.0;
    for (const nlohmann::json& body : bodies) {
        if (body["cases"].empty()) continue;
        cases += body["cases"].size() + body["falls"].size();
        seconds += body["estimated_cpu_seconds"].get<double>();
        bytes += body["estimated_bytes"].get<double>();
    }
    print_result("all {} bodies, side by side: {}\nall {} bodies: {}\n", bodies.size(), schedule_of(work),
                 bodies.size(), cost_in_words(cases, seconds, work, jobs, bytes));
}

void print_result(const BakeRequest& request, const BakeResult& result) {
    if (result.probes > 0) {
        print_result("{}: {} cases, in {:.0f} s; they are kept in {}\n", request.output.string(),
                     result.probes, result.case_seconds, case_folder_of(request).string());
        return;
    }
    if (!result.conversion) {
        print_result("{}: mesh and Kirchhoff tensor; the scene uses no tables\n", request.output.string());
        return;
    }
    const BakePlan& plan = *result.preparation.plan;
    const auto& cases = result.conversion->cases;
    print_result("{}: quality {}, {} cases at Reynolds numbers {:.6g}", request.output.string(),
                 plan.quality.name, plan.cases.size(), fmt::join(plan.reynolds_numbers(), ", "));
    if (result.reused > 0) print_result(", {} of them reused", result.reused);
    print_result("\n{:<28} {:>26} {:>8} {:>10} {:>13} {:>7}\n", "case", "direction of motion", "drag",
                 "k/U^2", "epsilon L/U^3", "CPU s");
    for (const SolvedCase& solved : cases) {
        const Vector3d& direction = solved.sample.direction;
        print_result("{:<28} ({:7.4f} {:7.4f} {:7.4f}) {:8.3f} {:10.5f} {:13.5f} {:7.1f}\n", solved.name,
                     direction.x(), direction.y(), direction.z(), drag_coefficient(solved),
                     solved.sample.entry.turbulent_kinetic_energy, solved.sample.entry.dissipation_rate,
                     number_in(provenance_of(solved), "cpu_seconds"));
    }
    if (request.goal) {
        print_result("{}", scene_plan_as_text(*request.goal, *result.preparation.scene_plan));
    }
    for (const nlohmann::json& mesh : meshes_of(cases)) {
        print_result("{:.0f} cells, checkMesh: {}{}\n", number_in(mesh, "cells"), text_in(mesh, "verdict"),
                     remedy_of(mesh));
    }
    if (result.conversion->identification) {
        print_result("{}", identification_as_text(*result.conversion->identification));
    }
    if (const auto& models = result.conversion->body.recommended) {
        print_result("simulated by default with {} ({})\n", in_words(*models), models->origin);
    }
    print_result("{}", account_as_text(result.account));
    print_result(
        "surface {:.1f} s, Kirchhoff tensor {:.1f} s, cases {:.1f} s ({:.0f} CPU s in total), tables {:.1f} "
        "s; the cases are in {}\n",
        result.mesh_seconds, result.kirchhoff_seconds, result.case_seconds, result.cpu_seconds,
        result.conversion_seconds, case_folder_of(request).string());
}

void note_warnings(BodyNotes& notes, const BakeRequest& request, const BakePreparation& preparation) {
    const std::string& name = preparation.body.name;
    const std::string units = unit_warnings(preparation.body, request.mass, request.fluid, request.gravity,
                                            is_body_file_name(request.shape) ? ScaleRemedy::mesh_again
                                            : request.name.empty()           ? ScaleRemedy::option
                                                                             : ScaleRemedy::scene_key);
    notes.add(units, name, 0.0, units);
    if (preparation.plan && request.quality.falls > 0 && request.probes == 0 &&
        preparation.plan->quality.falls == 0) {
        notes.add(
            "dense", name, 0.0,
            "is so dense that it is still speeding up at the end of a fall: no falls are solved, and its "
            "dynamic coefficients are the defaults");
    }
    if (!preparation.plan) return;
    const double highest = std::ranges::max(preparation.plan->reynolds_numbers());
    notes.add("drag crisis", name, highest, drag_crisis_warning(highest));
    if (preparation.plan->main_reynolds_number >= laminar_reynolds_number) return;
    notes.add(
        "laminar", name, preparation.plan->main_reynolds_number,
        fmt::format(
            "at Reynolds number {:.3g}, below {:.0f}, the flow is assumed laminar: loads, but no turbulence",
            preparation.plan->main_reynolds_number, laminar_reynolds_number));
}

void warn_of_left_out_cases(const BakeRequest& request, const BakeResult& result) {
    if (result.left_out.empty()) return;
    std::vector<std::string> cases;
    for (const LeftOutCase& failed : result.left_out) {
        cases.push_back(fmt::format("{} ({})", failed.name, failed.reason));
    }
    print_note("samara bake: warning: of {} left out after retries: {}\n", case_folder_of(request).string(),
               fmt::join(cases, ", "));
}

void warn_of_unbalanced_falls(const BakeRequest& request, const BakeResult& result) {
    if (!result.conversion || !result.conversion->identification) return;
    for (const SimulatedFall& fall : result.conversion->identification->falls) {
        if (!is_unbalanced(fall.balance)) continue;
        print_note(
            "samara bake: warning: {}: {} does not conserve momentum (force off by {:.0f} %, moment by "
            "{:.0f} %) at half the step either, and its coefficients may be wrong; try --fall-step {:.3g}\n",
            request.output.string(), fall.name, 100.0 * fall.balance.force, 100.0 * fall.balance.moment,
            0.25 * request.quality.fall_step);
    }
}

}  // namespace samara
