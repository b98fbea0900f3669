#include "converter/convert.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "converter/cases/case_reduction.hpp"
#include "converter/tables/direction_sampling.hpp"
#include "converter/tables/table_filling.hpp"
#include "samara/analysis/verdicts/case_records.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/formats/json_text.hpp"

namespace samara {
namespace {

void require_plan_of_body(const std::filesystem::path& folder, const CasePlan& plan, const Body& body) {
    const double length = reference_length(body.moments.surface_area);
    const bool same = std::abs(plan.reference_length - length) < 1e-6 * length &&
                      (plan.axes - body.symmetry.axes).norm() < 1e-6;
    if (!same) {
        throw Error(
            fmt::format("{}: plan.json and body.body.h5 belong to different bodies; make the cases again "
                        "with 'samara bake'",
                        folder.string()));
    }
}

/// Transforms cases that were solved in other directions to the equivalent ones that the table requires by
/// the body's symmetry, unless a case of that flow and purpose exists already.
void bring_to_required(const Symmetry& symmetry, CasePlan& plan, std::vector<SolvedCase>& cases) {
    for (PlannedCase& planned : plan.cases) {
        const Matrix3d element = element_to_required(symmetry, planned.direction);
        const Vector3d image = element * planned.direction;
        if ((image - planned.direction).norm() < same_direction) continue;
        const bool is_there = std::ranges::any_of(plan.cases, [&](const PlannedCase& other) {
            return other.purpose == planned.purpose && other.reynolds_number == planned.reynolds_number &&
                   other.mesh == planned.mesh && other.closure == planned.closure &&
                   (other.direction - image).norm() < same_direction;
        });
        if (is_there) continue;
        planned.direction = image;
        const auto solved = std::ranges::find(cases, planned.name, &SolvedCase::name);
        if (solved == cases.end()) continue;
        DirectionSample& sample = solved->sample;
        sample = {image, transformed(sample.entry, element), transformed_error(sample.error, element)};
    }
}

std::string provenance_of(const std::vector<SolvedCase>& cases) {
    nlohmann::json list = nlohmann::json::array();
    for (const SolvedCase& solved : cases) {
        nlohmann::json entry = parse_json(solved.provenance);
        const Vector3d& direction = solved.sample.direction;
        entry["name"] = solved.name;
        entry["purpose"] = name_of(solved.purpose);
        entry["direction"] = {direction.x(), direction.y(), direction.z()};
        entry["reynolds_number"] = solved.reynolds_number;
        list.push_back(std::move(entry));
    }
    return list.dump();
}

/// Returns the mean that k and epsilon of the cases are. Throws Error where they differ.
TurbulenceMean common_mean(const std::vector<SolvedCase>& cases) {
    const SolvedCase* first = nullptr;
    for (const SolvedCase& solved : cases) {
        if (!solved.turbulence_mean) continue;
        if (first == nullptr) first = &solved;
        if (solved.turbulence_mean == first->turbulence_mean) continue;
        throw Error(fmt::format(
            "k and epsilon of {} are of the mean '{}', those of {} of '{}': tables hold one of them",
            first->name, name_of(*first->turbulence_mean), solved.name, name_of(*solved.turbulence_mean)));
    }
    return first == nullptr ? TurbulenceMean::near_wake : *first->turbulence_mean;
}

LoadTables make_tables(const CasePlan& plan, const Symmetry& symmetry, Conversion& conversion) {
    LoadTables tables;
    tables.reference_length = plan.reference_length;
    tables.subdivisions = plan.subdivisions;
    tables.axes = plan.axes;
    tables.quality = plan.quality;
    tables.turbulence_mean = common_mean(conversion.cases);
    conversion.sampling_errors = fill_tables(tables, symmetry, conversion.cases, main_reynolds_number(plan),
                                             conversion.body.surface_loads);
    tables.provenance = provenance_of(conversion.cases);
    return tables;
}

// Reads the solved falls; failed ones are left out.
std::vector<FallRecord> solved_falls(const std::filesystem::path& folder, const CasePlan& plan,
                                     std::vector<LeftOutCase>& left_out) {
    std::vector<FallRecord> records;
    for (const PlannedFall& fall : plan.falls) {
        if (is_solved(folder / fall.name)) {
            records.push_back(read_fall_record(folder / fall.name));
        } else if (const auto reason = failure_of(folder, fall.name, fall.mesh)) {
            left_out.push_back({fall.name, *reason});
        } else {
            throw Error(fmt::format(
                "{}: the fall {} is not solved; run 'samara bake' again, which continues where it stopped",
                folder.string(), fall.name));
        }
    }
    return records;
}

}  // namespace

Conversion convert_folder(const std::filesystem::path& folder,
                          const std::function<void(std::size_t, std::size_t)>& progress,
                          const std::function<void(double)>& identifying) {
    CasePlan plan = read_case_plan(folder);
    Conversion conversion;
    conversion.body = read_body_file(folder / "body.body.h5");
    require_plan_of_body(folder, plan, conversion.body);
    conversion.body.recommended.reset();  // what was judged by other tables
    FolderReduction reduction = reduce_folder(folder, plan, progress);
    bring_to_required(conversion.body.symmetry, plan, reduction.cases);
    try {
        require_enough_directions(plan, conversion.body.symmetry, reduction);
        conversion.cases = std::move(reduction.cases);
        conversion.body.tables = make_tables(plan, conversion.body.symmetry, conversion);
    } catch (const Error& error) {
        throw Error(fmt::format(
            "{}: {}; {}", (folder / "plan.json").string(), error.what(),
            plan.solved_by_user ? "solve what is missing and add it to 'cases'" : "run 'samara bake' again"));
    }
    conversion.left_out = std::move(reduction.left_out);
    const std::vector<FallRecord> falls = solved_falls(folder, plan, conversion.left_out);
    conversion.body.tables->left_out = left_out_text(conversion.left_out);
    if (falls.empty()) return conversion;
    conversion.identification = identify_motion(conversion.body, falls, {}, identifying);
    conversion.body.dynamic = conversion.identification->coefficients;
    conversion.body.recommended = judge_models_by(conversion.body, falls).recommended();
    return conversion;
}

}  // namespace samara
