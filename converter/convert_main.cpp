#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "converter/cases/case_plan.hpp"
#include "converter/cases/case_reduction.hpp"
#include "converter/cases/load_fluctuations.hpp"
#include "converter/cases/samples_csv.hpp"
#include "converter/convert.hpp"
#include "converter/falls/fall_identification.hpp"
#include "samara/commands/shared/arguments.hpp"
#include "samara/commands/shared/print.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/replace_file.hpp"
#include "samara/formats/json_text.hpp"

namespace samara {
namespace {

using CaseProgress = std::function<void(std::size_t done, std::size_t total)>;

/// The coefficients of one solved case, relative to A = pi L^2/4, the moment's also to L.
struct Summary {
    double drag;
    double drag_error;
    double lift;
    double lift_error;
    double moment;
    double moment_error;
};

/// Returns the standard error of a vector's component along `unit`; its components' errors are taken as
/// independent.
double error_along(const Vector3d& error, const Vector3d& unit) {
    return error.cwiseProduct(unit).norm();
}

/// Returns the standard error of a vector's length; at zero length the largest of its components'.
double error_of_length(const Vector3d& error, const Vector3d& value) {
    return value.norm() > 0.0 ? error_along(error, value.normalized()) : error.maxCoeff();
}

Summary summary_of(const DirectionSample& sample) {
    const Vector3d& direction = sample.direction;
    const double drag = -sample.entry.force.dot(direction);
    const Vector3d lift = sample.entry.force + drag * direction;
    return {drag,
            error_along(sample.error.force, direction),
            lift.norm(),
            error_of_length(sample.error.force, lift),
            sample.entry.moment.norm(),
            error_of_length(sample.error.moment, sample.entry.moment)};
}

nlohmann::json case_as_json(const SolvedCase& solved) {
    const auto& [direction, entry, error] = solved.sample;
    const Summary summary = summary_of(solved.sample);
    return {{"name", solved.name},
            {"direction", as_json(direction)},
            {"reynolds_number", solved.reynolds_number},
            {"purpose", name_of(solved.purpose)},
            {"mesh", solved.mesh},
            {"closure", name_of(solved.closure)},
            {"drag_coefficient", summary.drag},
            {"drag_coefficient_error", summary.drag_error},
            {"force", as_json(entry.force)},
            {"force_error", as_json(error.force)},
            {"moment", as_json(entry.moment)},
            {"moment_error", as_json(error.moment)},
            {"turbulent_kinetic_energy", entry.turbulent_kinetic_energy},
            {"turbulent_kinetic_energy_error", error.turbulent_kinetic_energy},
            {"dissipation_rate", entry.dissipation_rate},
            {"dissipation_rate_error", error.dissipation_rate}};
}

nlohmann::json conversion_as_json(const Conversion& conversion, const std::string& output) {
    const LoadTables& tables = *conversion.body.tables;
    nlohmann::json axes = nlohmann::json::array();
    for (int row = 0; row < 3; ++row) axes.push_back(as_json(Vector3d(tables.axes.row(row))));
    nlohmann::json cases = nlohmann::json::array();
    for (const SolvedCase& solved : conversion.cases) cases.push_back(case_as_json(solved));
    nlohmann::json sources = nlohmann::json::object();
    for (const ErrorShare& share : tables.error_sources) {
        sources[name_of(share.source)] = {{"force", share.force},
                                          {"moment", share.moment},
                                          {"turbulent_kinetic_energy", share.turbulent_kinetic_energy},
                                          {"dissipation_rate", share.dissipation_rate}};
    }
    nlohmann::json left_out = nlohmann::json::array();
    for (const LeftOutCase& one : conversion.left_out) {
        left_out.push_back({{"name", one.name}, {"reason", one.reason}});
    }
    return {{"body", conversion.body.name},
            {"output", output},
            {"quality", tables.quality},
            {"reference_length", tables.reference_length},
            {"subdivisions", tables.subdivisions},
            {"axes", axes},
            {"reynolds_numbers", tables.reynolds_numbers},
            {"nodes", tables.entries.size()},
            {"cases", cases},
            {"error_sources", sources},
            {"left_out", left_out}};
}

/// Returns "0.4231 +- 0.002", with the digits that the error leaves significant.
std::string with_error(double value, double error) {
    const double smallest = error > 0.0 ? error : 1e-3 * std::abs(value);
    const int decimals =
        smallest > 0.0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(smallest))), 0, 9) : 3;
    return fmt::format("{:.{}f} +- {:.{}f}", value, decimals, error, decimals);
}

void print_errors(const Conversion& conversion) {
    const LoadTables& tables = *conversion.body.tables;
    print_result(
        "\n"
        "The errors above include iteration and symmetry. Standard errors of the tables by source, "
        "relative,\n"
        "root mean square:\n");
    for (const ErrorShare& share : tables.error_sources) {
        print_result("  {:<14} force {:.2g} %, moment {:.2g} %, k {:.2g} %, epsilon {:.2g} %\n",
                     name_of(share.source), 100.0 * share.force, 100.0 * share.moment,
                     100.0 * share.turbulent_kinetic_energy, 100.0 * share.dissipation_rate);
    }
    for (const LeftOutCase& one : conversion.left_out) {
        print_result("Left out and interpolated from the others: {}: {}\n", one.name, one.reason);
    }
}

void print_cases(const Conversion& conversion) {
    const LoadTables& tables = *conversion.body.tables;
    print_result("{}: L = {:.6g} m, quality {}, {} solved cases -> {} table nodes\n\n", conversion.body.name,
                 tables.reference_length, tables.quality, conversion.cases.size(), tables.entries.size());
    const auto row = [](const auto&... cells) {
        print_result("{:<26} {:<8} {:>9} {:>20} {:>20} {:>20} {:>24} {:>24}\n", cells...);
    };
    row("direction (table axes)", "for", "Re", "drag", "lift", "moment", "k/U^2", "epsilon L/U^3");
    for (const SolvedCase& solved : conversion.cases) {
        const auto& [direction, entry, error] = solved.sample;
        const Summary summary = summary_of(solved.sample);
        row(fmt::format("({:.4f}, {:.4f}, {:.4f})", direction.x(), direction.y(), direction.z()),
            name_of(solved.purpose), fmt::format("{:.5g}", solved.reynolds_number),
            with_error(summary.drag, summary.drag_error), with_error(summary.lift, summary.lift_error),
            with_error(summary.moment, summary.moment_error),
            with_error(entry.turbulent_kinetic_energy, error.turbulent_kinetic_energy),
            with_error(entry.dissipation_rate, error.dissipation_rate));
    }
    print_errors(conversion);
}

/// Writes the folder's solved cases as a CSV table.
nlohmann::json write_samples(const std::string& cases, const std::string& output, bool print,
                             const CaseProgress& progress) {
    const CasePlan plan = read_case_plan(cases);
    const FolderReduction reduction = reduce_folder(cases, plan, progress, UnsolvedCases::leave_out);
    replace_file_with(output, samples_csv(reduction.cases, plan.axes));
    nlohmann::json left_out = nlohmann::json::array();
    for (const LeftOutCase& left : reduction.left_out) {
        left_out.push_back({{"name", left.name}, {"reason", left.reason}});
        if (print) print_result("left out: {}: {}\n", left.name, left.reason);
    }
    if (print) print_result("{}: {} solved cases of {}\n", output, reduction.cases.size(), plan.cases.size());
    return {{"output", output}, {"cases", reduction.cases.size()}, {"left_out", left_out}};
}

/// Returns the cases in a folder that were solved in time, or the folder itself where it is a case.
std::vector<std::filesystem::path> cases_in_time(const std::filesystem::path& folder) {
    // The link of a single case to the mesh beside it leads out of its folder.
    const bool is_case = std::filesystem::exists(folder / "parameters");
    require_links_within(is_case ? folder / "postProcessing" : folder);
    if (is_case) return {folder};
    std::vector<std::filesystem::path> cases;
    std::error_code unreadable;
    for (const auto& entry : std::filesystem::directory_iterator(folder, unreadable)) {
        if (is_solved_in_time(entry.path())) cases.push_back(entry.path());
    }
    if (cases.empty()) {
        throw Error(
            fmt::format("{}: holds no unsteady case (rateOfChange in `parameters` other than steadyState) "
                        "that wrote its forces; solve one",
                        folder.string()));
    }
    std::ranges::sort(cases);
    return cases;
}

/// Writes the fluctuations of the loads of cases that were solved in time.
nlohmann::json write_fluctuations(const std::string& folder, const std::string& output,
                                  const std::optional<double>& begin, bool print,
                                  const CaseProgress& progress) {
    std::vector<LoadFluctuations> reduced;
    const std::vector<std::filesystem::path> cases = cases_in_time(folder);
    for (const std::filesystem::path& one : cases) {
        reduced.push_back(reduce_fluctuations(one, begin));
        progress(reduced.size(), cases.size());
    }
    replace_file_with(output, fluctuations_csv(reduced));
    std::filesystem::path spectra = output;
    spectra.replace_extension(".spectra.csv");
    replace_file_with(spectra, fluctuation_spectra_csv(reduced));
    nlohmann::json rows = nlohmann::json::array();
    if (print) {
        print_result("{:<24} {:<10} {:>22} {:>22} {:>22} {:>10}\n", "case", "component", "mean", "rms",
                     "correlation time (L/U)", "peak (U/L)");
    }
    for (const LoadFluctuations& one : reduced) {
        for (std::size_t i = 0; i < one.components.size(); ++i) {
            const SeriesFluctuation& of = one.components[i];
            rows.push_back({{"case", one.name},
                            {"component", load_components[i]},
                            {"mean", of.mean.value},
                            {"rms", of.rms.value},
                            {"rms_error", of.rms.error},
                            {"correlation_time", of.correlation_time.value},
                            {"correlation_time_error", of.correlation_time.error},
                            {"peak_frequency", or_null(of.peak_frequency)}});
            if (!print) continue;
            print_result("{:<24} {:<10} {:>22} {:>22} {:>22} {:>10}\n", one.name, load_components[i],
                         with_error(of.mean.value, of.mean.error), with_error(of.rms.value, of.rms.error),
                         with_error(of.correlation_time.value, of.correlation_time.error),
                         of.peak_frequency ? fmt::format("{:.3g}", *of.peak_frequency) : "-");
        }
    }
    if (print) print_result("\nspectra: {}\n", spectra.string());
    return {{"output", output}, {"spectra", spectra.string()}, {"fluctuations", rows}};
}

nlohmann::json write_tables(const std::string& cases, const std::string& output, bool print,
                            const CaseProgress& progress) {
    std::optional<Progress> identification;
    const auto identifying = [&](double share) {
        if (!identification) identification.emplace("identifying", "%");
        identification->update(100.0 * share, 100.0);
    };
    const Conversion conversion = convert_folder(cases, progress, identifying);
    write_body_file(output, conversion.body);
    if (print) print_cases(conversion);
    nlohmann::json json = conversion_as_json(conversion, output);
    if (conversion.identification) {
        json["dynamic_coefficients"] = identification_as_json(*conversion.identification);
        if (print) print_result("\n{}", identification_as_text(*conversion.identification));
    }
    return json;
}

int run(int argc, const char* const* argv) {
    std::string cases;
    std::string output;
    bool fluctuations = false;
    std::optional<double> begin;
    Arguments arguments("samara convert",
                        "Converts solved OpenFOAM cases to the load and turbulence tables of a body file");
    arguments.positional("CASES", cases,
                         "the folder NAME.cases from 'samara bake', or a folder of your own cases");
    arguments.required_output_option(
        "-o,--output", output, "the body file to write, NAME.body.h5; or NAME.csv for a table of the cases");
    arguments.flag("--fluctuations", fluctuations,
                   "write mean, rms, correlation time and spectrum of each component of force and moment of "
                   "unsteady cases to NAME.csv and NAME.spectra.csv");
    arguments.option("--from", begin,
                     "with --fluctuations: the start of the averaging window (L/U); by default the last two "
                     "thirds are used",
                     0.0, 1e9);
    arguments.footer(
        "Reads plan.json, body.body.h5 and every solved case, and writes the body with /tables: force and\n"
        "moment coefficients, k/U^2 and epsilon L/U^3 over all directions, with standard errors. NAME.csv: "
        "one\n"
        "row for each solved case, before symmetrisation and interpolation, in body axes.\n"
        "docs/explanation/bake.md describes the layout of a folder of your own cases.\n"
        "Example: samara convert rubber.cases -o rubber.body.h5");
    return run_program(argc, argv, arguments, [&] {
        const bool samples = output.ends_with(".csv");
        if (fluctuations && !samples) {
            throw Error(fmt::format("{}: the output of --fluctuations is a table; name it NAME.csv", output));
        }
        if (begin && !fluctuations) throw Error("--from: needs --fluctuations; give both");
        if (!samples && !is_body_file_name(output)) {
            throw Error(
                fmt::format("{}: the output is a body file or a table of cases; name it NAME.body.h5 "
                            "or NAME.csv",
                            output));
        }
        Progress bar("converting", "cases");
        const CaseProgress progress = [&](std::size_t done, std::size_t total) {
            bar.update(static_cast<double>(done), static_cast<double>(total));
        };
        if (fluctuations) return write_fluctuations(cases, output, begin, !arguments.json(), progress);
        return samples ? write_samples(cases, output, !arguments.json(), progress)
                       : write_tables(cases, output, !arguments.json(), progress);
    });
}

}  // namespace
}  // namespace samara

int main(int argc, char** argv) {
    return samara::run(argc, argv);
}
