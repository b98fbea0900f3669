#include "converter/cases/case_folder_reduction.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "samara/core/base/error.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/formats/json_text.hpp"

namespace samara {
namespace {

/// What stands in a folder's failed.json; nothing where there is none. Throws Error where it is damaged.
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

/// The case whose solution this one needs beside its own; none where it needs none.
const PlannedCase* turbulence_of(const CasePlan& plan, const PlannedCase& planned) {
    const auto found = std::ranges::find(plan.cases, planned.turbulence_from, &PlannedCase::name);
    return found == plan.cases.end() ? nullptr : &*found;
}

/// failure_of the case, or of the one that it takes its turbulence from.
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
        fmt::format("{}: the case {} is not solved ({} of {} are not); run 'samara bake' again, which goes "
                    "on where it stopped",
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
    if (!missing.empty() && unsolved == UnsolvedCases::refuse) throw not_solved(folder, plan, missing);

    Shells shells;
    for (const PlannedCase* const planned : solved) {
        reduction.cases.push_back(reduce_case(folder, plan, *planned, shells));
        if (progress) progress(reduction.cases.size(), solved.size());
    }
    return reduction;
}

}  // namespace samara
