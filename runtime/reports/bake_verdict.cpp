#include "samara/reports/bake_verdict.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "samara/analysis/advice/input_warnings.hpp"
#include "samara/analysis/verdicts/case_records.hpp"
#include "samara/core/body/body_check.hpp"
#include "samara/core/body/table_errors.hpp"
#include "samara/core/physics/fluid.hpp"
#include "samara/reports/report_blocks.hpp"

namespace samara {
namespace {

constexpr double well_known = 0.1;    // an error that needs no mention
constexpr double well_solved = 0.01;  // of the Kirchhoff tensor
constexpr const char* tested_openfoam = "1912";
constexpr double mostly_planned = 0.99;  // of the nodes that a bake was planned for

Grade grade_of(double error) {
    if (error <= well_known) return Grade::good;
    return error <= good_error ? Grade::limited : Grade::bad;
}

const ErrorShare& largest_source(const LoadTables& tables, double ErrorShare::*quantity) {
    return *std::ranges::max_element(tables.error_sources, {},
                                     [&](const ErrorShare& share) { return share.*quantity; });
}

/// Returns how to make a source's error smaller.
const char* remedy_of(ErrorSource source) {
    switch (source) {
        case ErrorSource::mesh:
            return "use a higher quality, with finer meshes";
        case ErrorSource::interpolation:
            return "use a higher quality, or bake the scene, which adds directions where it needs them";
        case ErrorSource::closure:
            return "try another closure with --loads";
        default:
            return "use a higher quality, which solves longer";
    }
}

bool holds(const LoadTables& tables, ErrorSource source) {
    return std::ranges::any_of(tables.error_sources,
                               [&](const ErrorShare& share) { return share.source == source; });
}

void judge_error(std::vector<Finding>& findings, const LoadTables& tables, const char* what,
                 double ErrorShare::*quantity, const char* consequence) {
    if (tables.error_sources.empty()) {
        findings.push_back(
            {Grade::bad, what, "its error is unknown: the file has no errors by source; bake again"});
        return;
    }
    const double error = total_error(tables.error_sources, quantity);
    const ErrorShare& worst = largest_source(tables, quantity);
    const Grade grade = grade_of(error);
    std::string text = fmt::format("relative standard error {}, root mean square over all directions{}",
                                   per_cent(error), consequence);
    if (grade != Grade::good) {
        text += fmt::format("; the largest part comes from the {} ({}): {}", name_of(worst.source),
                            per_cent(worst.*quantity), remedy_of(worst.source));
    }
    findings.push_back({grade, what, text});
}

void judge_sources(std::vector<Finding>& findings, const LoadTables& tables) {
    std::vector<std::string> missing;
    for (const ErrorSource source : {ErrorSource::mesh, ErrorSource::interpolation, ErrorSource::closure}) {
        if (!holds(tables, source)) missing.emplace_back(name_of(source));
    }
    if (missing.empty()) {
        findings.push_back({Grade::good, "error sources",
                            "the errors include tail, symmetry, mesh, closure and interpolation"});
        return;
    }
    const bool closure_alone = missing == std::vector<std::string>{"closure"};
    findings.push_back(
        {closure_alone ? Grade::limited : Grade::bad, "error sources",
         fmt::format(
             "the errors do not include: {}; {}", fmt::join(missing, ", "),
             closure_alone
                 ? "only quality high solves with other closures; docs/studies/closures lists typical values"
                 : "the true errors are larger; bake with a higher quality")});
}

void judge_quality(std::vector<Finding>& findings, const LoadTables& tables) {
    if (tables.quality != "smoke") return;
    findings.push_back({Grade::bad, "quality", "smoke only tests the programs; bake with preview or higher"});
}

void judge_cases(std::vector<Finding>& findings, const LoadTables& tables,
                 const std::vector<CaseRecord>& records) {
    if (const std::size_t left_out = left_out_cases(tables).size(); left_out > 0) {
        const double share = static_cast<double>(left_out) / static_cast<double>(left_out + records.size());
        findings.push_back(
            {share > well_known ? Grade::bad : Grade::limited, "left out",
             fmt::format("{} of {} cases could not be solved, and are interpolated from the others", left_out,
                         left_out + records.size())});
    }
    if (records.empty()) {
        findings.push_back({Grade::limited, "cases", "the file has no record of how they were solved"});
        return;
    }
    const auto count = [&](const auto& is) { return std::ranges::count_if(records, is); };
    const auto restless = count([](const CaseRecord& one) { return one.verdict == "restless"; });
    findings.push_back(
        restless == 0
            ? Finding{Grade::good, "cases",
                      fmt::format("all {} converged within their tolerances", records.size())}
            : Finding{Grade::limited, "cases",
                      fmt::format("{} of {} oscillate about a constant mean; their error includes this",
                                  restless, records.size())});
    const auto errory =
        count([](const CaseRecord& one) { return !one.mesh_verdict.empty() && one.mesh_verdict != "ok"; });
    if (errory > 0) {
        findings.push_back(
            {Grade::limited, "meshes",
             fmt::format("checkMesh finds errors in the meshes of {} of {} cases", errory, records.size())});
    } else if (std::ranges::any_of(records, [](const CaseRecord& one) { return one.cells > 0.0; })) {
        findings.push_back({Grade::good, "meshes", "checkMesh finds no errors"});
    }
}

void judge_solver(std::vector<Finding>& findings, const std::vector<CaseRecord>& records) {
    const auto other = std::ranges::find_if(records, [](const CaseRecord& one) {
        return !one.openfoam.empty() && one.openfoam.find(tested_openfoam) == std::string::npos;
    });
    if (other == records.end()) return;
    findings.push_back({Grade::limited, "solver",
                        fmt::format("solved with OpenFOAM '{}'; the cases are tested only with v{}",
                                    other->openfoam, tested_openfoam)});
}

double planned_share(const PlannedRegion& plan) {
    if (plan.planned.empty()) return 1.0;
    return static_cast<double>(std::ranges::count(plan.planned, 1)) /
           static_cast<double>(plan.planned.size());
}

void judge_region(std::vector<Finding>& findings, const LoadTables& tables) {
    const double share = planned_share(tables.plan);
    if (share > mostly_planned) {
        findings.push_back({Grade::good, "directions", "the bake covers all directions of motion"});
        return;
    }
    findings.push_back({Grade::limited, "directions",
                        fmt::format("baked for one scene: {} of all directions were solved, the others are "
                                    "extrapolated; --whole-grid bakes all",
                                    per_cent(share))});
}

void judge_motion(std::vector<Finding>& findings, const Body& body) {
    if (!body.dynamic) {
        findings.push_back({Grade::bad, "rotation",
                            "no falls were solved, and the default dynamic coefficients are used; quality "
                            "standard identifies them"});
        return;
    }
    findings.push_back(
        {Grade::good, "rotation",
         fmt::format("the dynamic coefficients are identified: {}", body.dynamic->values.origin)});
}

void judge_kirchhoff(std::vector<Finding>& findings, const Body& body) {
    if (!body.kirchhoff) {
        findings.push_back({Grade::bad, "added mass", "missing; 'samara kirchhoff' computes it"});
        return;
    }
    const double error = body.kirchhoff->error_estimate;
    findings.push_back({error <= well_solved ? Grade::good : Grade::limited, "added mass",
                        fmt::format("estimated error {}", per_cent(error))});
}

std::string speeds_in(const char* fluid, const LoadTables& tables) {
    const double to_speed = fluid_preset(fluid)->kinematic_viscosity() / tables.reference_length;
    const double low = tables.reynolds_numbers.front() * to_speed;
    const double high = tables.reynolds_numbers.back() * to_speed;
    return low == high ? fmt::format("{:.2g} m/s in {}", high, fluid)
                       : fmt::format("{:.2g} to {:.2g} m/s in {}", low, high, fluid);
}

void judge_reynolds_numbers(std::vector<Finding>& findings, const LoadTables& tables) {
    const auto& numbers = tables.reynolds_numbers;
    if (const std::string warning = drag_crisis_warning(numbers.back()); !warning.empty()) {
        findings.push_back({Grade::limited, "drag crisis", warning});
    }
    const std::string speeds = speeds_in("water", tables) + ", " + speeds_in("air", tables);
    if (numbers.size() == 1) {
        findings.push_back(
            {Grade::limited, "Reynolds number",
             fmt::format(
                 "only {:.6g} ({}): other speeds use the same coefficients; quality standard covers a range",
                 numbers.front(), speeds)});
        return;
    }
    findings.push_back({Grade::good, "Reynolds numbers",
                        fmt::format("{:.6g} to {:.6g} ({}); outside, the nearest coefficients are used",
                                    numbers.front(), numbers.back(), speeds)});
}

/// Returns whether the tables' error of a quantity is small enough.
bool is_good(const LoadTables& tables, double ErrorShare::*quantity) {
    return !tables.error_sources.empty() && holds(tables, ErrorSource::mesh) &&
           total_error(tables.error_sources, quantity) <= good_error;
}

std::string error_in_words(const LoadTables& tables, double ErrorShare::*quantity, double factor) {
    if (tables.error_sources.empty()) return "by an unknown error";
    return fmt::format("by {}", per_cent(factor * total_error(tables.error_sources, quantity)));
}

bool is_bad(const std::vector<Finding>& findings, const std::set<std::string>& names) {
    return std::ranges::any_of(findings, [&](const Finding& finding) {
        return finding.grade == Grade::bad && names.contains(finding.what);
    });
}

/// Uses that a bake may be good for.
struct Uses {
    bool pictures, speeds, swings;
};

void sort_uses(BakeVerdict& verdict, const Body& body, const Uses& uses) {
    const LoadTables& tables = *body.tables;
    const auto put = [&](bool good, const std::string& use) {
        (good ? verdict.good_for : verdict.not_for).push_back(use);
    };
    put(uses.pictures, "pictures and animations: falls of the right regime");
    put(uses.speeds, fmt::format("descent speeds, which the tables make uncertain {}",
                                 error_in_words(tables, &ErrorShare::force, 0.5)));
    put(uses.swings, "frequencies and amplitudes of oscillation" +
                         (!body.dynamic ? ": no fall of this body was solved by full CFD"
                          : is_bad(verdict.findings, {swings_of_falls})
                              ? ": those of the solved falls are not reproduced"
                              : fmt::format("; the moment is uncertain {}",
                                            error_in_words(tables, &ErrorShare::moment, 1.0))));
    if (tables.reynolds_numbers.back() < laminar_reynolds_number) {
        put(false, "scatter from the wake's turbulence: the flow is laminar and has none");
    } else {
        put(uses.pictures && is_good(tables, &ErrorShare::turbulent_kinetic_energy),
            fmt::format("scatter from the wake's turbulence, whose energy k is uncertain {}",
                        error_in_words(tables, &ErrorShare::turbulent_kinetic_energy, 1.0)));
    }
    if (planned_share(tables.plan) <= mostly_planned) {
        put(false, "scenes other than the one it was baked for");
    }
}

}  // namespace

const char* name_of(Grade grade) {
    constexpr const char* names[] = {"good", "limited", "bad"};
    return names[static_cast<std::size_t>(grade)];
}

BakeVerdict judge_bake(const Body& body, const std::vector<Finding>& further) {
    BakeVerdict verdict;
    const LoadTables& tables = *body.tables;
    std::vector<Finding>& findings = verdict.findings;
    if (const std::string error = error_of(body); !error.empty()) {
        findings.push_back({Grade::bad, "soundness", error});
    }
    judge_quality(findings, tables);
    judge_error(findings, tables, "force", &ErrorShare::force, ", of which the descent speed has half");
    judge_error(findings, tables, "moment", &ErrorShare::moment, "");
    judge_error(findings, tables, "k", &ErrorShare::turbulent_kinetic_energy, "");
    judge_sources(findings, tables);
    judge_motion(findings, body);
    judge_reynolds_numbers(findings, tables);
    judge_region(findings, tables);
    const std::vector<CaseRecord> records = case_records(tables);
    judge_cases(findings, tables, records);
    judge_solver(findings, records);
    judge_kirchhoff(findings, body);
    findings.insert(findings.end(), further.begin(), further.end());

    const bool can_be_used = !is_bad(findings, {"soundness", "quality", "added mass", "left out"});
    const bool further_bad = std::ranges::any_of(further, [](const Finding& finding) {
        return finding.grade == Grade::bad && finding.what != swings_of_falls;
    });
    const bool speeds = can_be_used && is_good(tables, &ErrorShare::force) && !further_bad;
    const bool swings = can_be_used && body.dynamic.has_value() && is_good(tables, &ErrorShare::moment) &&
                        !is_bad(further, {swings_of_falls});
    sort_uses(verdict, body, {can_be_used, speeds, swings});
    if (!can_be_used) {
        verdict.grade = Grade::bad;
        verdict.headline = is_bad(findings, {"soundness"}) ? "Do not use it: the file is invalid."
                           : tables.quality == "smoke" ? "Good only for testing the programs, not for falls."
                                                       : "Do not use it as it is.";
    } else if (speeds && swings) {
        verdict.headline = "Good for metrics of falls, and for pictures.";
    } else {
        verdict.grade = Grade::limited;
        verdict.headline = speeds ? "Good for pictures and descent speeds, not for oscillations."
                                  : "Good for pictures, not for metrics.";
    }
    return verdict;
}

nlohmann::json as_json(const BakeVerdict& verdict) {
    nlohmann::json json = {{"grade", name_of(verdict.grade)},
                           {"headline", verdict.headline},
                           {"good_for", verdict.good_for},
                           {"not_for", verdict.not_for},
                           {"findings", nlohmann::json::array()}};
    for (const Finding& finding : verdict.findings) {
        json["findings"].push_back(
            {{"grade", name_of(finding.grade)}, {"what", finding.what}, {"text", finding.text}});
    }
    return json;
}

std::string as_text(const BakeVerdict& verdict) {
    std::string text = verdict.headline + '\n';
    for (const std::string& use : verdict.good_for) text += fmt::format("  good for  {}\n", use);
    for (const std::string& use : verdict.not_for) text += fmt::format("  not for   {}\n", use);
    return text;
}

}  // namespace samara
