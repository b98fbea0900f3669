#include "converter/cases/plan_coverage.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "converter/tables/direction_sampling.hpp"
#include "samara/analysis/verdicts/case_records.hpp"
#include "samara/core/base/error.hpp"

namespace samara {
namespace {

bool has_direction(const std::vector<const PlannedCase*>& cases, const Vector3d& direction,
                   double tolerance) {
    return std::ranges::any_of(
        cases, [&](const PlannedCase* one) { return (one->direction - direction).norm() < tolerance; });
}

/// A case for each direction of the main Reynolds number: the table's, where it has none that on the mesh
/// before the last.
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

/// The first of the directions that the map needs and no case has.
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
    if (counts.empty()) throw Error("plans no case for the table");
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
