// The program samara-identify: identifies dynamic coefficients from solved free falls, if wanted without some
// of their terms.

#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "converter/falls/fall_identification.hpp"
#include "converter/falls/motion_parameters.hpp"
#include "samara/commands/shared/arguments.hpp"
#include "samara/commands/shared/print.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/body/body_file.hpp"

namespace samara {
namespace {

struct IdentifyOptions {
    std::string body;
    std::string falls;
    std::string output;
    std::string without;
    int without_stretch = 0;
    std::string hold;
};

std::vector<FallRecord> records_of(const std::string& list) {
    std::vector<FallRecord> records;
    for (const std::string& folder : comma_separated(list)) records.push_back(read_fall_record(folder));
    return records;
}

nlohmann::json identify(const IdentifyOptions& options, bool leaves_stretch_out, bool quiet) {
    if (!options.output.empty() && !is_body_file_name(options.output)) {
        throw Error(fmt::format("{}: the output is a body file; name it NAME.body.h5", options.output));
    }
    Body body = read_body_file(options.body);
    if (!body.kirchhoff || !body.tables) {
        throw Error(fmt::format("{}: holds no Kirchhoff tensor or no tables; bake it first", options.body));
    }
    Progress progress("identifying", "%");
    LeftOutOfFalls left_out{.terms = comma_separated(options.without)};
    if (leaves_stretch_out) left_out.stretch = options.without_stretch;
    const std::vector<FallRecord> falls = records_of(options.falls);
    const Identification identification =
        identify_motion(body, falls, left_out, [&](double done) { progress.update(100.0 * done, 100.0); });
    body.dynamic = identification.coefficients;
    body.recommended = judge_models_by(body, falls).recommended();
    nlohmann::json json = identification_as_json(identification);
    json["held"] = nlohmann::json::array();
    if (!quiet) print_result("{}", identification_as_text(identification));
    for (const FallRecord& record : records_of(options.hold)) {
        const SimulatedFall fall = simulate_fall(body, record);
        json["held"].push_back(simulated_fall_as_json(fall));
        if (!quiet) print_result("{}", simulated_fall_as_text(fall));
    }
    if (!options.output.empty()) write_body_file(options.output, body);
    return json;
}

int run(int argc, const char* const* argv) {
    IdentifyOptions options;
    Arguments arguments("samara identify",
                        "Identifies a body's dynamic coefficients from free falls by full CFD");
    arguments.positional("BODY", options.body, "a baked body file (.body.h5)");
    arguments.positional("FALLS", options.falls,
                         "folders of solved falls, separated by commas, such as NAME.cases/fall_00 of samara "
                         "bake or samara validate");
    arguments.output_option("-o,--output", options.output,
                            "body file to write, with the coefficients (.body.h5)");
    arguments.option("--without", options.without,
                     fmt::format("terms to leave out, separated by commas: {}",
                                 fmt::join(MotionParameters::names(), ", ")));
    arguments.option(
        "--without-stretch", options.without_stretch,
        fmt::format("leave out one of the {} segments of each fall, to estimate the statistical error",
                    identification_stretches),
        0, identification_stretches - 1);
    arguments.option("--hold", options.hold,
                     "folders of other falls to compare the result with, separated by commas");
    arguments.footer(
        "samara bake identifies them at the qualities standard and high; this program repeats that with "
        "other\n"
        "falls, or without some of the terms (docs/studies/falls).\n");
    return run_program(argc, argv, arguments, [&] {
        return identify(options, arguments.given("--without-stretch"), arguments.json());
    });
}

}  // namespace
}  // namespace samara

int main(int argc, char** argv) {
    return samara::run(argc, argv);
}
