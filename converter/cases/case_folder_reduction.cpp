#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "converter/cases/case_reduction.hpp"
#include "converter/tables/direction_sampling.hpp"
#include "samara/analysis/verdicts/case_records.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/formats/json_text.hpp"

namespace samara {
namespace {

/// Returns the reason in a folder's failed.json; nothing where there is none. Throws Error where it is
/// damaged.
std::optional<std::string> failure_reason(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / "failed.json";
    if (!std::filesystem::exists(file)) return std::nullopt;
    try {
        return parse_json_or_discard(read_bytes(file)).at("reason").get<std::string>();
    } catch (const nlohmann::json::exception& reason) {
        throw Error(fmt::format("{}: has no text 'reason' ({}); remove it and run 'samara bake' again",
                                file.string(), reason.what()));
    }
}

/// Returns the case whose turbulence this one takes; none where it has its own.
const PlannedCase* turbulence_of(const CasePlan& plan, const PlannedCase& planned) {
    const auto found = std::ranges::find(plan.cases, planned.turbulence_from, &PlannedCase::name);
    return found == plan.cases.end() ? nullptr : &*found;
}

/// Returns failure_of() the case, or of the one that it takes its turbulence from.
std::optional<std::string> failure_of_either(const std::filesystem::path& folder, const CasePlan& plan,
                                             const PlannedCase& planned) {
    if (std::optional<std::string> reason = failure_of(folder, planned.name, planned.mesh)) return reason;
    const PlannedCase* const other = turbulence_of(plan, planned);
    const auto reason = other == nullptr ? std::nullopt : failure_of(folder, other->name, other->mesh);
    if (!reason) return std::nullopt;
    return fmt::format("its turbulence's case {}: {}", other->name, *reason);
}

bool is_solved_with_turbulence(const std::filesystem::path& folder, const CasePlan& plan,
                               const PlannedCase& planned) {
    const PlannedCase* const other = turbulence_of(plan, planned);
    return is_solved(folder / planned.name) && (other == nullptr || is_solved(folder / other->name));
}

Error not_solved(const std::filesystem::path& folder, const CasePlan& plan,
                 const std::vector<std::string>& names) {
    return Error(
        fmt::format("{}: the case {} is not solved ({} of {} are not); run 'samara bake' again, which "
                    "continues where it stopped",
                    folder.string(), names.front(), names.size(), plan.cases.size()));
}

}  // namespace

std::optional<std::string> failure_of(const std::filesystem::path& folder, const std::string& name,
                                      const std::string& mesh) {
    if (is_solved(folder / name)) return std::nullopt;
    if (std::optional<std::string> reason = failure_reason(folder / name)) return reason;
    const std::optional<std::string> reason = failure_reason(folder / mesh);
    if (!reason) return std::nullopt;
    return fmt::format("its mesh {} could not be made: {}", mesh, *reason);
}

FolderReduction reduce_folder(const std::filesystem::path& folder, const CasePlan& plan,
                              const std::function<void(std::size_t, std::size_t)>& progress,
                              UnsolvedCases unsolved) {
    FolderReduction reduction;
    std::vector<const PlannedCase*> solved;
    std::vector<std::string> missing;
    for (const PlannedCase& planned : plan.cases) {
        if (planned.purpose == CasePurpose::start || planned.purpose == CasePurpose::turbulence) continue;
        if (const std::optional<std::string> reason = failure_of_either(folder, plan, planned)) {
            reduction.left_out.push_back({planned.name, *reason});
        } else if (plan.solved_by_user || is_solved_with_turbulence(folder, plan, planned)) {
            solved.push_back(&planned);
        } else {
            missing.push_back(planned.name);
            reduction.left_out.push_back({planned.name, "is not solved yet"});
        }
    }
    if (!missing.empty() && unsolved == UnsolvedCases::reject) throw not_solved(folder, plan, missing);

    MeshZones zones;
    for (const PlannedCase* const planned : solved) {
        reduction.cases.push_back(reduce_case(folder, plan, *planned, zones));
        if (progress) progress(reduction.cases.size(), solved.size());
    }
    return reduction;
}

namespace {

bool has_direction(const std::vector<const PlannedCase*>& cases, const Vector3d& direction,
                   double tolerance) {
    return std::ranges::any_of(
        cases, [&](const PlannedCase* one) { return (one->direction - direction).norm() < tolerance; });
}

/// Returns a case for each direction of the main Reynolds number: the table's, or where there is none that on
/// the mesh before the last.
std::vector<const PlannedCase*> main_cases(const CasePlan& plan) {
    const double main = main_reynolds_number(plan);
    std::vector<const PlannedCase*> cases;
    for (const CasePurpose purpose : {CasePurpose::table, CasePurpose::mesh}) {
        for (const PlannedCase& planned : plan.cases) {
            if (planned.purpose != purpose || planned.reynolds_number != main) continue;
            if (purpose == CasePurpose::mesh && has_direction(cases, planned.direction, same_direction))
                continue;
            cases.push_back(&planned);
        }
    }
    return cases;
}

/// Returns the first direction that the map needs and no case has.
std::optional<Vector3d> missing_direction(const std::vector<const PlannedCase*>& cases,
                                          const Symmetry& symmetry, int subdivisions) {
    for (const Vector3d& direction : required_directions(symmetry, subdivisions)) {
        if (!has_direction(cases, direction, direction_tolerance(symmetry))) return direction;
    }
    return std::nullopt;
}

}  // namespace

double main_reynolds_number(const CasePlan& plan) {
    std::map<double, int> counts;
    for (const PlannedCase& planned : plan.cases) {
        if (planned.purpose == CasePurpose::table) ++counts[planned.reynolds_number];
    }
    if (counts.empty()) throw Error("plans no case for the tables");
    for (const PlannedCase& planned : plan.cases) {
        const auto found = counts.find(planned.reynolds_number);
        if (planned.purpose == CasePurpose::mesh && found != counts.end()) ++found->second;
    }
    return std::ranges::max_element(counts, {}, [](const auto& pair) { return pair.second; })->first;
}

void require_enough_directions(const CasePlan& plan, const Symmetry& symmetry,
                               const FolderReduction& reduction) {
    const std::vector<const PlannedCase*> main = main_cases(plan);
    const auto missing = plan.covers_scene ? std::nullopt : missing_direction(main, symmetry, 1);
    if (missing) {
        throw Error(
            fmt::format("Reynolds number {:.6g}: no case in the direction ({:.6g}, {:.6g}, {:.6g}), "
                        "which the table needs",
                        main.front()->reynolds_number, missing->x(), missing->y(), missing->z()));
    }
    std::set<std::string> left_out;
    for (const LeftOutCase& one : reduction.left_out) left_out.insert(one.name);
    const auto lost = std::count_if(main.begin(), main.end(),
                                    [&](const PlannedCase* one) { return left_out.contains(one->name); });
    if (5 * lost > static_cast<std::ptrdiff_t>(main.size())) {
        const LeftOutCase& first =
            *std::find_if(reduction.left_out.begin(), reduction.left_out.end(), [&](const LeftOutCase& one) {
                return std::any_of(main.begin(), main.end(),
                                   [&](const PlannedCase* planned) { return planned->name == one.name; });
            });
        throw Error(
            fmt::format("{} of the {} directions at Reynolds number {:.6g} could not be solved, more "
                        "than one in five; the first is {}: {}",
                        lost, main.size(), main.front()->reynolds_number, first.name, first.reason));
    }
}

}  // namespace samara
