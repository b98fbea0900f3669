// samara bodies: the ready-baked bodies that come with it.

#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "samara/commands/body_report.hpp"
#include "samara/commands/commands.hpp"
#include "samara/commands/shared/arguments.hpp"
#include "samara/commands/shared/print.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/body/body.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/body/table_errors.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/files/hdf5_reader.hpp"
#include "samara/core/files/replace_file.hpp"
#include "samara/formats/json_text.hpp"
#include "samara/scene/ready_bodies.hpp"

namespace samara {
namespace {

constexpr const char* footer =
    R"(A scene uses one with shape = "samara:NAME"; its tables are valid near the Reynolds
numbers listed, in any fluid. Force: the tables' standard error relative to the
force, root mean square over all directions.

The bodies are in share/samara/bodies beside the program's folder; SAMARA_BODIES names
another folder of body files.

JSON: folder, not_baked (names), bodies: a list with name, file, hash, samara_version,
source, shape (its source file), extents (m, shortest first), fluid, density (kg/m^3),
reynolds_numbers, quality, force_error (a fraction), from_falls (whether its dynamic
coefficients were identified from free falls), purpose; null if not available.
With NAME only that body; with -o also output.

Examples: samara bodies
          samara bodies leaf -o leaf.body.h5)";

/// Returns the shape file's name at the begin of a body's source.
std::string shape_of(const Body& body) {
    return body.source.substr(0, body.source.find(' '));
}

template <typename Value>
nlohmann::json given(const Value& value, bool is_given) {
    return is_given ? nlohmann::json(value) : nlohmann::json(nullptr);
}

nlohmann::json report(const ReadyBody& ready) {
    const Body body = read_body_file(ready.file);
    nlohmann::json json = {
        {"name", ready.name},
        {"file", ready.file.string()},
        {"hash", file_content_hash(ready.file)},
        {"samara_version", Hdf5Reader(ready.file).text_attribute("/", "samara_version")},
        {"source", body.source},
        {"shape", shape_of(body)},
        {"extents", as_json(principal_extents(body))},
        {"fluid", given(ready.fluid, !ready.fluid.empty())},
        {"density", given(ready.density.value_or(0.0), ready.density.has_value())},
        {"reynolds_numbers", nullptr},
        {"quality", nullptr},
        {"force_error", nullptr},
        {"from_falls", body.dynamic.has_value()},
        {"purpose", given(ready.purpose, !ready.purpose.empty())},
    };
    if (body.tables) {
        json["reynolds_numbers"] = body.tables->reynolds_numbers;
        json["quality"] = body.tables->quality;
        json["force_error"] = given(total_error(body.tables->error_sources, &ErrorShare::force),
                                    !body.tables->error_sources.empty());
    }
    return json;
}

std::string text_or_dash(const nlohmann::json& value) {
    return value.is_null() ? "-" : value.get<std::string>();
}

std::string numbers_in_words(const nlohmann::json& numbers) {
    if (numbers.is_null()) return "-";
    std::vector<std::string> words;
    for (const nlohmann::json& number : numbers) words.push_back(fmt::format("{:.3g}", number.get<double>()));
    return fmt::format("{}", fmt::join(words, " "));
}

std::string size_in_words(const nlohmann::json& extents) {
    return fmt::format("{:.3g} x {:.3g} x {:.3g}", 1e3 * extents[0].get<double>(),
                       1e3 * extents[1].get<double>(), 1e3 * extents[2].get<double>());
}

void print_list(const nlohmann::json& result) {
    constexpr const char* row = "{:<11}{:<15}{:<20}{:<7}{:<37}{:<10}{:>6}  {}\n";
    print_result(fmt::runtime(row), "name", "shape", "size (mm)", "fluid", "Reynolds numbers", "quality",
                 "force", "for");
    for (const nlohmann::json& body : result["bodies"]) {
        const std::string error = body["force_error"].is_null()
                                      ? "-"
                                      : fmt::format("{:.0f} %", 100.0 * body["force_error"].get<double>());
        print_result(fmt::runtime(row), body["name"].get<std::string>(), body["shape"].get<std::string>(),
                     size_in_words(body["extents"]), text_or_dash(body["fluid"]),
                     numbers_in_words(body["reynolds_numbers"]), text_or_dash(body["quality"]), error,
                     text_or_dash(body["purpose"]));
    }
    if (result["bodies"].empty()) {
        print_result("{}: holds no bodies\n", result["folder"].get<std::string>());
        return;
    }
    const nlohmann::json& missing = result["not_baked"];
    if (!missing.empty()) {
        print_result("Not baked yet: {}\n", fmt::join(missing.get<std::vector<std::string>>(), ", "));
    }
}

nlohmann::json list(bool quiet) {
    const std::filesystem::path folder = ready_bodies_folder();
    nlohmann::json result = {{"folder", folder.string()},
                             {"not_baked", nlohmann::json::array()},
                             {"bodies", nlohmann::json::array()}};
    for (const ReadyBody& body : ready_bodies(folder)) {
        if (body.exists) {
            result["bodies"].push_back(report(body));
        } else {
            result["not_baked"].push_back(body.name);
        }
    }
    if (!quiet) print_list(result);
    return result;
}

nlohmann::json one(const std::string& name, const std::string& output, bool quiet) {
    const std::filesystem::path file = ready_body_file(name);
    nlohmann::json result;
    for (const ReadyBody& body : ready_bodies(file.parent_path())) {
        if (body.name == name) result = report(body);
    }
    if (output.empty()) {
        if (!quiet) print_body(read_body_file(file));
        return result;
    }
    replace_file_with(output, read_bytes(file));
    result["output"] = output;
    if (!quiet) print_result("{}: a copy of {}\n", output, file.string());
    return result;
}

}  // namespace

int bodies_command(int argc, const char* const* argv) {
    std::string name;
    std::string output;
    Arguments arguments("samara bodies", "Lists the ready-baked bodies that are installed with samara.");
    arguments.optional_positional("NAME", name, "show the content of this body's file");
    arguments.output_option("-o,--output", output, "NAME.body.h5: copy the body's file to this path");
    arguments.footer(footer);
    return run_program(argc, argv, arguments, [&] {
        if (arguments.given("--output")) {
            if (name.empty()) throw Error("-o copies one body; name it, as in 'samara bodies leaf -o ...'");
            if (!is_body_file_name(output)) {
                throw Error(fmt::format("{}: the output is a body file; name it NAME.body.h5", output));
            }
        }
        return name.empty() ? list(arguments.json()) : one(name, output, arguments.json());
    });
}

}  // namespace samara
