#include "converter/convert.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "converter/case_folder_reduction.hpp"
#include "converter/table_filling.hpp"
#include "samara/base/error.hpp"
#include "samara/body/body_file.hpp"

namespace samara {
namespace {

void require_plan_of_body(const std::filesystem::path& folder, const CasePlan& plan, const Body& body) {
    const double length = reference_length(body.moments.surface_area);
    const bool same = std::abs(plan.reference_length - length) < 1e-6 * length &&
                      (plan.axes - body.symmetry.axes).norm() < 1e-6;
    if (!same) {
        throw Error(
            fmt::format("{}: plan.json and body.body.h5 are of different bodies; make the cases again "
                        "with 'samara bake'",
                        folder.string()));
    }
}

std::vector<double> reynolds_numbers(const CasePlan& plan) {
    std::set<double> numbers;
    for (const PlannedCase& planned : plan.cases) numbers.insert(planned.reynolds_number);
    return {numbers.begin(), numbers.end()};
}

/// Symmetrises the cases of one Reynolds number in place, and fills a map with them.
FilledMap fill_reynolds_number(const std::filesystem::path& folder, const CasePlan& plan,
                               const Symmetry& symmetry, double reynolds_number,
                               std::vector<SolvedCase>& cases) {
    std::vector<SolvedCase*> members;
    std::vector<DirectionSample> samples;
    for (SolvedCase& solved : cases) {
        if (solved.reynolds_number != reynolds_number) continue;
        members.push_back(&solved);
        samples.push_back(solved.sample);
    }
    keep_symmetric_part(symmetry, samples);
    for (std::size_t i = 0; i < members.size(); ++i) members[i]->sample = samples[i];
    try {
        return fill_map(symmetry, plan.subdivisions, samples);
    } catch (const Error& fault) {
        throw Error(fmt::format("{}: Reynolds number {:.6g}: {}; run 'samara bake' again",
                                (folder / "plan.json").string(), reynolds_number, fault.what()));
    }
}

std::string provenance_of(const std::vector<SolvedCase>& cases) {
    nlohmann::json list = nlohmann::json::array();
    for (const SolvedCase& solved : cases) {
        nlohmann::json entry = nlohmann::json::parse(solved.provenance);
        const Vector3d& direction = solved.sample.direction;
        entry["name"] = solved.name;
        entry["direction"] = {direction.x(), direction.y(), direction.z()};
        entry["reynolds_number"] = solved.reynolds_number;
        list.push_back(std::move(entry));
    }
    return list.dump();
}

LoadTables make_tables(const std::filesystem::path& folder, const CasePlan& plan, const Symmetry& symmetry,
                       std::vector<SolvedCase>& cases) {
    LoadTables tables;
    tables.reference_length = plan.reference_length;
    tables.subdivisions = plan.subdivisions;
    tables.axes = plan.axes;
    tables.quality = plan.quality;
    tables.reynolds_numbers = reynolds_numbers(plan);
    tables.provenance = provenance_of(cases);
    for (const double reynolds_number : tables.reynolds_numbers) {
        const FilledMap map = fill_reynolds_number(folder, plan, symmetry, reynolds_number, cases);
        for (std::size_t node = 0; node < map.entries.size(); ++node) {
            tables.entries.push_back(transformed(map.entries[node], plan.axes));
            tables.errors.push_back(transformed_error(map.errors[node], plan.axes));
        }
    }
    return tables;
}

}  // namespace

Conversion convert_folder(const std::filesystem::path& folder,
                          const std::function<void(std::size_t, std::size_t)>& progress) {
    const CasePlan plan = read_case_plan(folder);
    Conversion conversion;
    conversion.body = read_body_file(folder / "body.body.h5");
    require_plan_of_body(folder, plan, conversion.body);
    conversion.cases = reduce_folder(folder, plan, progress).cases;
    conversion.body.tables = make_tables(folder, plan, conversion.body.symmetry, conversion.cases);
    return conversion;
}

Body convert_cases(const std::filesystem::path& folder) {
    return convert_folder(folder).body;
}

}  // namespace samara
