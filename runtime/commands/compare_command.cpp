#include <filesystem>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "samara/analysis/comparison/comparison_report.hpp"
#include "samara/commands/commands.hpp"
#include "samara/commands/option_values.hpp"
#include "samara/commands/shared/arguments.hpp"
#include "samara/commands/shared/print.hpp"
#include "samara/core/base/error.hpp"
#include "samara/pictures/draw.hpp"
#include "samara/pictures/motion_pictures.hpp"

namespace samara {
namespace {

constexpr const char* footer =
    R"(Falls are chaotic, so the command compares statistics over a window, each with its
standard error, the path of the first swing and, of three falls or more, where they
land. The errors of one fall are estimated from its swings, those of several runs and
copies from their scatter. Each verdict tests the difference from the reference, less
the reference's own uncertainty (mesh, closure), against a tolerance relative to the
reference. 'agrees?' and 'differs?': the verdict is uncertain within two standard errors
and the reference's uncertainty. The exit status is 0 for either verdict; --json reports
it as "agrees".

Example: samara compare motion.h5 reference.h5 -o comparison.png)";

struct Request {
    std::string motion;
    std::string reference;
    std::string output;
    std::string body;
    std::string window;
    std::optional<int> run;
    std::optional<int> copy;
    std::optional<int> reference_run;
    std::optional<int> reference_copy;
    ComparisonSettings settings;
};

std::optional<TimeWindow> window_of_words(const std::string& words) {
    if (words.empty()) return std::nullopt;
    TimeWindow window;
    int end = 0;
    const int found = std::sscanf(words.c_str(), "%lf,%lf%n", &window.begin, &window.end, &end);
    if (found == 2 && static_cast<std::size_t>(end) == words.size()) return window;
    throw Error(fmt::format("--window takes BEGIN,END in seconds after the release, such as 1,4; it was '{}'",
                            words));
}

std::string names_in(const Motion& motion) {
    std::string names;
    for (const BodyMotion& body : motion.bodies) names += (names.empty() ? "" : ", ") + body.name;
    return names;
}

/// Returns the name of the body that both files hold, or nothing where each holds one body.
std::string common_body(const Request& request, const Motion& motion, const Motion& reference) {
    if (!request.body.empty() || (motion.bodies.size() == 1 && reference.bodies.size() == 1)) {
        return request.body;
    }
    std::string common;
    for (const BodyMotion& body : reference.bodies) {
        for (const BodyMotion& other : motion.bodies) {
            if (body.name != other.name) continue;
            if (!common.empty()) {
                throw Error(
                    fmt::format("{} and {} hold several bodies of the same name ({}, {}); choose one "
                                "with --body",
                                request.motion, request.reference, common, body.name));
            }
            common = body.name;
        }
    }
    if (!common.empty()) return common;
    throw Error(fmt::format("{} and {} hold no body of the same name: {} against {}", request.motion,
                            request.reference, names_in(motion), names_in(reference)));
}

FallChoice choice_of(const std::string& input, const MotionReader& file, const std::string& body,
                     const std::optional<int>& run, const std::optional<int>& copy) {
    const BodyMotion& found = find_body(input, file.motion(), body);
    if (run) require_run(input, file.motion(), *run);
    if (copy) require_copy(input, found, *copy);
    return {input, &file, static_cast<std::size_t>(&found - file.motion().bodies.data()), run, copy};
}

nlohmann::json run(const Request& request, const Arguments& arguments) {
    ComparisonSettings settings = request.settings;
    settings.window = window_of_words(request.window);
    if (!request.output.empty()) require_picture_format(request.output);
    const MotionReader motion(request.motion);
    const MotionReader reference(request.reference);
    const std::string body = common_body(request, motion.motion(), reference.motion());
    const FallChoice compared = choice_of(request.motion, motion, body, request.run, request.copy);
    const FallChoice held_against =
        choice_of(request.reference, reference, body, request.reference_run, request.reference_copy);
    Progress progress("measuring", "falls");
    const Comparison comparison = compare(compared, held_against, settings,
                                          [&](double done, double total) { progress.update(done, total); });
    if (!arguments.json()) print_result("{}", as_text(comparison));
    nlohmann::json result = as_json(comparison);
    if (!request.output.empty()) {
        draw_picture(request.output,
                     comparison_picture(comparison, std::filesystem::path(request.motion).filename(),
                                        std::filesystem::path(request.reference).filename()));
        result["output"] = request.output;
        if (!arguments.json()) print_result("picture: {}\n", request.output);
    }
    result["motion"]["file"] = request.motion;
    result["reference"]["file"] = request.reference;
    return result;
}

}  // namespace

int compare_command(int argc, const char* const* argv) {
    Request request;
    Arguments arguments("samara compare", "Compares a motion with a reference, such as a fall by full CFD.");
    constexpr int most = 1'000'000'000;
    arguments.positional("MOTION", request.motion, "motion file, from 'samara simulate'");
    arguments.positional("REFERENCE", request.reference, "motion file of the reference");
    arguments.output_option("-o,--output", request.output,
                            "picture to write: .png (2000 x 1300 pixels) or .svg; none by default");
    arguments.option(
        "--body", request.body,
        "the body to compare; by default the only one in each file, or the one with the same name");
    arguments.option("--window", request.window,
                     "BEGIN,END: the window of the metrics, in seconds after the release; by default the "
                     "last two thirds of the shortest fall in either file");
    arguments.option("--run", request.run, "the motion's run, counted from 0; all by default", 0, most);
    arguments.option("--copy", request.copy, "the motion's copy; all by default", 0, most);
    arguments.option("--reference-run", request.reference_run, "the reference's run; all by default", 0,
                     most);
    arguments.option("--reference-copy", request.reference_copy, "the reference's copy; all by default", 0,
                     most);
    for (const Metric metric : compared_metrics) {
        const CataloguedMetric& entry = catalogued(metric);
        const std::string always = entry.allowed.always_words;
        arguments.option(fmt::format("--{}-tolerance", entry.heading), request.settings.tolerances[metric],
                         fmt::format("of the {}{}", entry.title,
                                     always.empty() ? "" : fmt::format("; {} is always allowed", always)),
                         0.0, 1e3);
    }
    arguments.footer(footer);
    return run_program(argc, argv, arguments, [&] { return run(request, arguments); });
}

}  // namespace samara
