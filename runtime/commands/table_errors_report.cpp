#include "samara/commands/table_errors_report.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "samara/analysis/verdicts/case_records.hpp"
#include "samara/reports/report_blocks.hpp"

namespace samara {
namespace {

constexpr double noted_error = 0.3;
constexpr double worth_a_note = 0.1;  // share of the poses outside of the bake's plan

bool used_tables(const std::optional<LoadTables>& tables, const TableErrorsOnPath& errors) {
    return tables && errors.forces + errors.turbulent_kinetic_energies > 0;
}

std::vector<std::string_view> source_names(const LoadTables& tables) {
    if (tables.error_sources.empty()) return {name_of(ErrorSource::tail), name_of(ErrorSource::symmetry)};
    std::vector<std::string_view> names;
    for (const ErrorShare& share : tables.error_sources) names.emplace_back(name_of(share.source));
    return names;
}

}  // namespace

std::string error_sources_in_words(const LoadTables& tables) {
    return fmt::format("{}", fmt::join(source_names(tables), ", "));
}

std::string table_errors_as_text(const std::optional<LoadTables>& tables, const TableErrorsOnPath& errors) {
    if (!used_tables(tables, errors)) return {};
    std::string text = "  standard error of the tables along the motion:";
    if (errors.forces > 0) text += fmt::format(" {} of the force", per_cent(errors.mean_force()));
    if (errors.forces > 0 && errors.turbulent_kinetic_energies > 0) text += ",";
    if (errors.turbulent_kinetic_energies > 0) {
        text += fmt::format(" {} of the wake's velocity fluctuation",
                            per_cent(0.5 * errors.mean_turbulent_kinetic_energy()));
    }
    text += fmt::format("\n  includes: {}\n", error_sources_in_words(*tables));
    if (const std::size_t left_out = left_out_cases(*tables).size(); left_out > 0) {
        text += fmt::format("  {} of the tables' cases could not be solved ('samara info' names them)\n",
                            left_out);
    }
    return text;
}

nlohmann::json table_errors_as_json(const std::optional<LoadTables>& tables,
                                    const TableErrorsOnPath& errors) {
    if (!used_tables(tables, errors)) return nullptr;
    nlohmann::json result = {{"force", nullptr}, {"turbulent_kinetic_energy", nullptr}};
    if (errors.forces > 0) result["force"] = errors.mean_force();
    if (errors.turbulent_kinetic_energies > 0) {
        result["turbulent_kinetic_energy"] = errors.mean_turbulent_kinetic_energy();
    }
    result["outside_of_plan"] = errors.share_strayed();
    result["sources"] = source_names(*tables);
    result["left_out"] = nlohmann::json::array();
    for (const LeftOutCase& one : left_out_cases(*tables)) result["left_out"].push_back(one.name);
    return result;
}

void note_table_errors(BodyNotes& notes, const std::string& body, const std::optional<LoadTables>& tables,
                       const TableErrorsOnPath& errors) {
    std::vector<std::string> quantities;
    double worst = 0.0;
    const auto note_quantity = [&](const char* quantity, double error) {
        if (error <= noted_error) return;
        quantities.push_back(fmt::format("{:.0f} % of {}", 100.0 * error, quantity));
        worst = std::max(worst, error);
    };
    note_quantity("the force", errors.mean_force());
    // The fluctuation goes with the root of k.
    note_quantity("the wake's velocity fluctuation", 0.5 * errors.mean_turbulent_kinetic_energy());
    if (!quantities.empty()) {
        notes.add("tables", body, worst,
                  fmt::format("the tables are uncertain by {} along the motion (standard error); {}",
                              fmt::join(quantities, " and "),
                              tables && tables->quality == "high"
                                  ? "they are of the highest quality: see docs/explanation/accuracy.md"
                                  : "bake with a higher quality"));
    }
    if (errors.share_strayed() > worth_a_note) {
        notes.add("strayed", body, errors.share_strayed(),
                  fmt::format("moved for {:.0f} % of the time in directions that the bake did not cover, "
                              "where its tables are extrapolated; bake this scene, or bake with --whole-grid",
                              100.0 * errors.share_strayed()));
    }
}

}  // namespace samara
