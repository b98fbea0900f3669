#include "samara/reports/report_program.hpp"

#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "samara/commands/shared/arguments.hpp"
#include "samara/commands/shared/print.hpp"
#include "samara/commands/shared/progress.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/base/version.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/pictures/draw.hpp"
#include "samara/reports/body_parts.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;

constexpr const char* footer =
    R"(One page that needs nothing else: on top what the bake is good for, what not, and why;
then the body, polars with error bars, maps over all directions, convergence and errors
by source, the coefficients of a turning body, the cases, and where all comes from. Of
the folder of cases, NAME.cases beside NAME.body.h5, it adds the meshes, y+, how the
cases settled, and the solved falls beside the runtime's; what of it is missing, the
page and a note say. Python's matplotlib and Jinja make it.

JSON: output, body, verdict (grade: good, limited or bad; headline, good_for, not_for,
findings), parts (titles), cases (the folder, or null), missing (what is not told).

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
        throw Error(
            fmt::format("{}: has no tables, and a report is of a bake; make them with 'samara bake'", file));
    }
    return body;
}

fs::path folder_beside(const fs::path& file) {
    const std::string name = file.filename().string();
    constexpr std::string_view ending = ".body.h5";
    const std::string stem = name.ends_with(ending) ? name.substr(0, name.size() - ending.size()) : name;
    return file.parent_path() / fmt::format("{}.cases", stem);
}

/// The folder to read; none where there is none, or nobody to read it.
std::optional<fs::path> cases_of(const ReportOptions& options, bool can_read,
                                 std::vector<std::string>& missing) {
    const bool named = !options.cases.empty();
    const fs::path folder = named ? fs::path(options.cases) : folder_beside(options.input);
    if (fs::exists(folder / "plan.json")) {
        if (can_read) return folder;
        missing.push_back(fmt::format(
            "{}: is read by the baking tools (build with SAMARA_BAKING=ON), which are not installed",
            folder.string()));
        return std::nullopt;
    }
    if (named) throw Error(fmt::format("{}: is no folder of cases: it has no plan.json", folder.string()));
    missing.push_back(fmt::format(
        "{}: is not there: without it no meshes, y+, histories and falls; --cases names another folder",
        folder.string()));
    return std::nullopt;
}

nlohmann::json report(const ReportOptions& options, const CasesReader& read_cases, bool quiet) {
    if (fs::path(options.output).extension() != ".html") {
        throw Error(fmt::format("{}: a report is a page; end the name in .html", options.output));
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
    // What the cases tell stands before where all comes from.
    parts.insert(parts.end() - 1, cases.parts.begin(), cases.parts.end());
    if (!missing.empty()) parts.push_back({"What is missing here", {{{"list", missing}}}});
    const BakeVerdict verdict = judge_bake(body, cases.findings);
    const std::string below = fmt::format(
        "A bake of quality {} at Reynolds number {}. {}", body.tables->quality,
        fmt::join(body.tables->reynolds_numbers, ", "), fs::path(options.input).filename().string());
    for (const std::string& line : missing) print_note("samara report: note: {}\n", line);
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
    Arguments arguments("samara report", "Judges a bake, and shows why, in one page.");
    ReportOptions options;
    arguments.positional("BODY", options.input, "body file with tables (.body.h5), from 'samara bake'");
    arguments.required_output_option("-o,--output", options.output, "page to write, NAME.html");
    arguments.option("--cases", options.cases,
                     "the folder of the bake's cases; NAME.cases beside the body file");
    arguments.footer(footer);
    return run_program(argc, argv, arguments, [&] { return report(options, read_cases, arguments.json()); });
}

}  // namespace samara
