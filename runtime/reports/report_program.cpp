#include "samara/reports/report_program.hpp"

#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "samara/analysis/advice/input_warnings.hpp"
#include "samara/analysis/verdicts/case_records.hpp"
#include "samara/commands/shared/arguments.hpp"
#include "samara/commands/shared/print.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/base/version.hpp"
#include "samara/core/body/body.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/body/table_errors.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/files/hdf5_reader.hpp"
#include "samara/core/physics/fluid.hpp"
#include "samara/pictures/body_pictures.hpp"
#include "samara/pictures/draw.hpp"
#include "samara/reports/report_blocks.hpp"

namespace samara {
namespace {

std::string in_words(const Vector3d& vector, const char* unit = "") {
    return fmt::format("({:.4g}, {:.4g}, {:.4g}){}", vector.x(), vector.y(), vector.z(), unit);
}

std::string size_of(const Body& body) {
    const Vector3d size = 1e3 * principal_extents(body);
    return fmt::format("{:.4g} x {:.4g} x {:.4g} mm along the principal axes", size.x(), size.y(), size.z());
}

/// Returns the speed of a Reynolds number in a fluid, and the density with which the body falls broadside at
/// it, by the tables.
std::string density_in(const Body& body, const char* name, double reynolds_number) {
    const Fluid fluid = *fluid_preset(name);
    const LoadTables& tables = *body.tables;
    const Vector3d broadside = principal_axes(body.moments).col(0);
    const double speed = reynolds_number * fluid.kinematic_viscosity() / tables.reference_length;
    const double area = 0.25 * std::numbers::pi * tables.reference_length * tables.reference_length;
    const double drag = std::abs(look_up(tables, broadside, reynolds_number).force.dot(broadside));
    const double excess = 0.5 * drag * fluid.density * speed * speed * area / (9.81 * body.moments.volume);
    return fmt::format("{:.3g} m/s in {}, as with a density of {} kg/m³", speed, name,
                       in_plain_digits(fluid.density + excess));
}

ReportPart part_of_body(const Body& body) {
    const LoadTables& tables = *body.tables;
    Rows rows = {
        {"shape", body.source},
        {"size", size_of(body)},
        {"surface",
         fmt::format("{} triangles of order {}", body.surface.triangle_count(), body.surface.order())},
        {"volume, area", fmt::format("{:.4g} m³, {:.4g} m²", body.moments.volume, body.moments.surface_area)},
        {"symmetry",
         fmt::format("{}, {} elements", name_of(body.symmetry.type), body.symmetry.elements.size())},
        {"reference length L", fmt::format("{:.5g} m", tables.reference_length)}};
    if (body.kirchhoff) {
        const Matrix6d& added = body.kirchhoff->matrix;
        rows.push_back(
            {"added mass",
             fmt::format("{}, estimated error {:.2g} %, {}",
                         in_words(Vector3d(1e3 * added.diagonal().tail<3>()), " g in a fluid of 1 kg/m³"),
                         100.0 * body.kirchhoff->error_estimate, body.kirchhoff->method)});
    }
    if (body.mass) {
        const MassProperties mass = mass_properties(body, *body.mass);
        rows.push_back({"default mass", fmt::format("{:.4g} g, {:.4g} kg/m³ on average", 1e3 * mass.mass,
                                                    mass.mass / body.moments.volume)});
    }
    std::vector<std::string> numbers;
    for (const double number : tables.reynolds_numbers) numbers.push_back(in_plain_digits(number));
    rows.push_back({"Reynolds numbers U L/ν", fmt::format("{}", fmt::join(numbers, ", "))});
    const double main = main_reynolds_number(tables, case_records(tables));
    for (const char* fluid : {"water", "air"}) {
        rows.push_back({fmt::format("at {:.6g}, broadside", main), density_in(body, fluid, main)});
    }
    return {"The body", {table_block({}, rows)}};
}

std::vector<nlohmann::json> error_blocks(const LoadTables& tables) {
    Rows rows;
    for (const ErrorShare& share : tables.error_sources) {
        rows.push_back({name_of(share.source), per_cent(share.force), per_cent(share.moment),
                        per_cent(share.turbulent_kinetic_energy), per_cent(share.dissipation_rate)});
    }
    if (rows.empty()) return {text_block("The file has no errors by source.")};
    const auto total = [&](double ErrorShare::*quantity) {
        return per_cent(total_error(tables.error_sources, quantity));
    };
    rows.push_back({"together", total(&ErrorShare::force), total(&ErrorShare::moment),
                    total(&ErrorShare::turbulent_kinetic_energy), total(&ErrorShare::dissipation_rate)});
    return {
        text_block("Relative standard errors, root mean squares over all directions and Reynolds numbers."),
        table_block({"source", "force", "moment", "k", "epsilon"}, rows)};
}

std::string tensor_in_words(const Matrix3d& tensor, const char* unit) {
    return in_words(Vector3d(tensor.diagonal())) + ' ' + unit;
}

ReportPart part_of_rotation(const Body& body) {
    if (!body.dynamic) {
        return {"Dynamic coefficients",
                {text_block("The file has no dynamic coefficients, as no falls were solved. Simulations use "
                            "the default coefficients (docs/studies/falls). Quality standard solves falls "
                            "and identifies the body's own.")}};
    }
    const auto& [values, errors, densities] = *body.dynamic;
    Rows rows;
    for (const NumberOfMotion& number : numbers_of_motion) {
        rows.push_back({number.title, fmt::format("{:.3g}", values.*number.member),
                        fmt::format("{:.2g}", errors.*number.member)});
    }
    for (const TensorOfMotion& tensor : tensors_of_motion) {
        rows.push_back({tensor.title, tensor_in_words(values.*tensor.member, tensor.unit),
                        tensor_in_words(errors.*tensor.member, tensor.unit)});
    }
    rows.push_back({"density of the falling body relative to the fluid", in_words(densities), "-"});
    return {"Dynamic coefficients",
            {text_block("From: " + values.origin),
             table_block({"coefficient (tensors: xx, yy, zz)", "value", "standard error"}, rows)}};
}

std::string or_dash(double number, const char* format) {
    return number > 0.0 ? fmt::format(fmt::runtime(format), number) : "-";
}

/// Returns the solver's CPU seconds, by mesh.
nlohmann::json table_of_cpu_seconds(const std::vector<CaseRecord>& records, double all) {
    std::map<double, std::pair<int, double>> meshes;
    for (const CaseRecord& one : records) {
        auto& [count, seconds] = meshes[one.cells];
        ++count;
        seconds += one.cpu_seconds;
    }
    Rows rows;
    for (const auto& [cells, spent] : meshes) {
        rows.push_back({or_dash(cells, "{:.0f}"), fmt::format("{}", spent.first),
                        fmt::format("{:.1f}", spent.second),
                        all > 0.0 ? fmt::format("{:.0f} %", 100.0 * spent.second / all) : "-"});
    }
    return table_block({"cells", "cases", "CPU s", "share"}, rows);
}

ReportPart part_of_cases(const LoadTables& tables) {
    const std::vector<CaseRecord> records = case_records(tables);
    ReportPart part{"The cases", {}};
    if (const auto left_out = left_out_cases(tables); !left_out.empty()) {
        Rows rows;
        for (const LeftOutCase& one : left_out) rows.push_back({one.name, one.reason});
        part.blocks.push_back(table_block({"left out", "why"}, rows));
    }
    Rows rows;
    for (const CaseRecord& one : records) {
        rows.push_back({one.name, one.purpose, in_words(one.direction), in_plain_digits(one.reynolds_number),
                        one.closure, or_dash(one.cells, "{:.0f}"), fmt::format("{:.3f}", one.drag),
                        one.k ? fmt::format("{:.3g}", *one.k) : "-", one.verdict,
                        or_dash(one.final_residual, "{:.1g}"), fmt::format("{:.1f}", one.cpu_seconds)});
    }
    if (rows.empty()) {
        part.blocks.push_back(text_block("The file has no record of how its cases were solved."));
        return part;
    }
    double seconds = 0.0;
    for (const CaseRecord& one : records) seconds += one.cpu_seconds;
    part.blocks.push_back(table_of_cpu_seconds(records, seconds));
    part.blocks.push_back(
        folded_block(fmt::format("{} solved cases, {:.0f} CPU seconds", records.size(), seconds),
                     table_block({"case", "for", "moving along", "Reynolds", "closure", "cells", "drag",
                                  "k/U²", "verdict", "residual of p", "CPU s"},
                                 rows)));
    return part;
}

std::string joined(const std::set<std::string>& words) {
    return words.empty() ? "unknown" : fmt::format("{}", fmt::join(words, ", "));
}

ReportPart part_of_provenance(const std::filesystem::path& path, const Body& body) {
    const Hdf5Reader file(path);
    std::set<std::string> programs;
    std::set<std::string> closures;
    std::set<std::string> remedies;
    for (const CaseRecord& one : case_records(*body.tables)) {
        if (!one.openfoam.empty()) programs.insert(one.openfoam);
        if (!one.closure.empty()) closures.insert(one.closure);
        if (!one.mesh_remedy.empty()) remedies.insert(one.mesh_remedy);
    }
    return {"Provenance",
            {table_block(
                {}, {{"file", path.filename().string()},
                     {"XXH3 128-bit hash", file_content_hash(path)},
                     {"digest of its content",
                      file.has_digest() ? "sound" : "none: 'samara check --add-digest' writes one"},
                     {"written by", fmt::format("samara {}", file.text_attribute("/", "samara_version"))},
                     {"quality", body.tables->quality},
                     {"solver", joined(programs)},
                     {"closures", joined(closures)},
                     {"meshes made", joined(remedies)}})}};
}

/// Returns the parts of a report that a body file gives: the body, its polars, map, convergence and errors by
/// source, the dynamic coefficients, the cases and where the file comes from. The body must have tables.
std::vector<ReportPart> body_parts(const std::filesystem::path& file, const Body& body) {
    std::vector<nlohmann::json> convergence = error_blocks(*body.tables);
    convergence.insert(
        convergence.begin(),
        picture_block("Drag and k against mesh, drag against Reynolds number, errors by source",
                      body_picture("convergence", body)));
    return {
        part_of_body(body),
        {"Polars",
         {picture_block("Drag, lift, moment and k against the direction of motion, with standard errors",
                        body_picture("polars", body)),
          text_block("Coefficients on ρU²A/2 with A = πL²/4, the moment's also on L. The direction of "
                     "motion rotates in the plane of two principal axes; 0° is along the shorter one. Dots "
                     "are solved cases.")}},
        {"All directions",
         {picture_block("Drag, moment, k and the force's standard error over the sphere of directions",
                        body_picture("sphere", body))}},
        {"Convergence and errors", convergence},
        part_of_rotation(body),
        part_of_cases(*body.tables),
        part_of_provenance(file, body)};
}

namespace fs = std::filesystem;

constexpr const char* footer =
    R"(The page is a single self-contained file. It begins with a verdict: what the bake is good
for, what not, and why. Then it shows the body, polars with error bars, maps over all
directions, convergence and errors by source, the dynamic coefficients, the cases, and the
provenance. With the folder of cases, NAME.cases beside NAME.body.h5, it adds how the flow
was solved (domain, blockage, averaging, observed order), meshes, y+, the convergence of the
cases, and falls by full CFD beside simulated ones. The page and a warning list what is
missing. It needs Python's matplotlib and Jinja.

JSON: output, body, verdict (grade: good, limited or bad; headline, good_for, not_for,
findings), parts (titles), cases (the folder, or null), missing (a list).

Examples: samara report leaf.body.h5 -o leaf.html
          samara report leaf.body.h5 -o leaf.html --cases kept/leaf.cases)";

struct ReportOptions {
    std::string input;
    std::string output;
    std::string cases;
};

Body read_bake(const std::string& file) {
    Body body = read_body_file(file);
    if (!body.tables) {
        throw Error(fmt::format("{}: has no tables to judge; make them with 'samara bake'", file));
    }
    return body;
}

fs::path folder_beside(const fs::path& file) {
    const std::string name = file.filename().string();
    constexpr std::string_view ending = ".body.h5";
    const std::string stem = name.ends_with(ending) ? name.substr(0, name.size() - ending.size()) : name;
    return file.parent_path() / fmt::format("{}.cases", stem);
}

/// Returns the folder of cases to read; none where there is none, or no reader for it.
std::optional<fs::path> cases_of(const ReportOptions& options, bool can_read,
                                 std::vector<std::string>& missing) {
    const bool named = !options.cases.empty();
    const fs::path folder = named ? fs::path(options.cases) : folder_beside(options.input);
    if (fs::exists(folder / "plan.json")) {
        if (can_read) return folder;
        missing.push_back(fmt::format(
            "{}: needs the baking tools; install the package samara-baking, or build with SAMARA_BAKING=ON",
            folder.string()));
        return std::nullopt;
    }
    if (named)
        throw Error(
            fmt::format("{}: is not a folder of cases (it has no plan.json); give --cases", folder.string()));
    missing.push_back(fmt::format(
        "{}: is missing, so the page lacks meshes, y+, histories and falls; give another folder with --cases",
        folder.string()));
    return std::nullopt;
}

nlohmann::json report(const ReportOptions& options, const CasesReader& read_cases, bool quiet) {
    if (fs::path(options.output).extension() != ".html") {
        throw Error(fmt::format("{}: the output is a page; name it NAME.html", options.output));
    }
    const Body body = read_bake(options.input);
    std::vector<std::string> missing;
    const auto folder = cases_of(options, static_cast<bool>(read_cases), missing);
    Progress progress("reporting", "parts");
    CasesReport cases;
    if (folder) {
        cases = read_cases(*folder, body, [&](double share) { progress.update(3.0 * share, 6.0); });
    }
    progress.update(3.0, 6.0);
    missing.insert(missing.end(), cases.missing.begin(), cases.missing.end());
    std::vector<ReportPart> parts = body_parts(options.input, body);
    // The parts about the cases stand before the provenance.
    parts.insert(parts.end() - 1, cases.parts.begin(), cases.parts.end());
    if (!missing.empty()) parts.push_back({"Missing parts", {{{"list", missing}}}});
    const BakeVerdict verdict = judge_bake(body, cases.findings);
    const std::string below = fmt::format(
        "A bake of quality {} at Reynolds number {}. {}", body.tables->quality,
        fmt::join(body.tables->reynolds_numbers, ", "), fs::path(options.input).filename().string());
    for (const std::string& line : missing) print_note("samara report: warning: {}\n", line);
    if (!quiet) print_result("{}: {}", options.output, as_text(verdict));
    nlohmann::json result = {
        {"output", options.output},         {"body", body.name}, {"verdict", as_json(verdict)},
        {"parts", nlohmann::json::array()}, {"cases", nullptr},  {"missing", missing}};
    nlohmann::json page = {
        {"name", body.name}, {"below", below}, {"verdict", as_json(verdict)}, {"version", version}};
    for (ReportPart& part : parts) {
        result["parts"].push_back(part.title);
        page["parts"].push_back({{"title", part.title}, {"blocks", std::move(part.blocks)}});
    }
    if (folder) result["cases"] = folder->string();
    progress.update(4.0, 6.0);
    draw_page(options.output, std::move(page));
    return result;
}

}  // namespace

int run_report(int argc, const char* const* argv, const CasesReader& read_cases) {
    Arguments arguments("samara report", "Judges the accuracy of a bake in one HTML page.");
    ReportOptions options;
    arguments.positional("BODY", options.input, "body file with tables (.body.h5), from 'samara bake'");
    arguments.required_output_option("-o,--output", options.output, "page to write, NAME.html");
    arguments.option("--cases", options.cases,
                     "folder of the bake's cases; by default NAME.cases beside the body file");
    arguments.footer(footer);
    return run_program(argc, argv, arguments, [&] { return report(options, read_cases, arguments.json()); });
}

}  // namespace samara
