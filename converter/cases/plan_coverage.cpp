#include "converter/cases/plan_coverage.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "converter/tables/direction_sampling.hpp"
#include "internal/body/case_records.hpp"
#include "samara/base/error.hpp"

namespace samara {
namespace {

bool has_direction(const std::vector<const PlannedCase*>& cases, const Vector3d& direction,
                   double tolerance) {
    return std::ranges::any_of(
        cases, [&](const PlannedCase* one) { return (one->direction - direction).norm() < tolerance; });
}

/// A case for each direction of the Reynolds number that has most of them: the table's, where it has none
/// that on the mesh before the last.
std::vector<const PlannedCase*> main_cases(const CasePlan& plan) {
    std::map<double, std::vector<const PlannedCase*>> sets;
    for (const PlannedCase& planned : plan.cases) {
        if (planned.purpose == CasePurpose::table) sets[planned.reynolds_number].push_back(&planned);
    }
    for (const PlannedCase& planned : plan.cases) {
        const auto set = sets.find(planned.reynolds_number);
        if (planned.purpose != CasePurpose::mesh || set == sets.end()) continue;
        if (!has_direction(set->second, planned.direction, same_direction)) set->second.push_back(&planned);
    }
    if (sets.empty()) throw Error("plans no case for the table");
    return std::max_element(sets.begin(), sets.end(),
                            [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); })
        ->second;
}

/// The first of the directions that the map needs and no case has.
std::optional<Vector3d> missing_direction(const std::vector<const PlannedCase*>& cases,
                                          const Symmetry& symmetry, int subdivisions) {
    for (const Vector3d& direction : required_directions(symmetry, subdivisions)) {
        if (!has_direction(cases, direction, direction_tolerance(symmetry))) return direction;
    }
    return std::nullopt;
}

}  // namespace

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
