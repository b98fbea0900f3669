#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/commands.hpp"
#include "commands/motion_choice.hpp"
#include "internal/base/vector_json.hpp"
#include "internal/command/arguments.hpp"
#include "internal/command/print.hpp"
#include "internal/motion/description.hpp"
#include "internal/motion/file_check.hpp"
#include "internal/plot/gnuplot.hpp"
#include "internal/plot/landing_plot.hpp"
#include "internal/plot/motion_plot.hpp"
#include "internal/plot/phase_plot.hpp"
#include "samara/base/error.hpp"
#include "samara/motion/motion_file.hpp"

namespace samara {
namespace {

constexpr const char* footer =
    R"(strip: the body's silhouettes along its path at even times, from the front (x, z) and
from the side (y, z), to scale and coloured by time; of a long fall the last stretch.
Beside them descent speed, inclination (angle between the shortest principal axis and
gravity) and angular velocity; shaded: the last two thirds of the fall, over which the
title's figures are measured.
phase: how far the shortest axis leans from the vertical, seen in the plane in which it
swings most and negative to one side, against its rate, coloured by time; both over time.
landing: where all copies and runs come down, from above, with the mean and the circle
of the rms distance; the distributions of the distance and of the time of landing.
Without a ground: the places at the last frame, and the ways descended.
gnuplot draws them.

Examples: samara plot motion.h5 -o motion.png
          samara plot motion.h5 -o phase.svg --kind phase)";

struct PlotOptions {
    std::string input;
    std::string output;
    std::string kind = "strip";
    std::string body;
    int run = 0;
    int copy = 0;
};

nlohmann::json plot_one(const PlotOptions& options, const Motion& motion, const BodyMotion& body) {
    require_run(options.input, motion, options.run);
    require_copy(options.input, body, options.copy);
    nlohmann::json result = {{"run", options.run}, {"copy", options.copy}};
    if (options.kind == "phase") {
        const PhasePlot shown = plot_phase(options.output, motion, body, options.run, options.copy);
        result["fall"] = {shown.fall.begin, shown.fall.end};
        result["highest_rate"] = shown.highest_rate;
        result["lines"] = shown.lines;
        result["frames_in_swing"] = or_null(shown.frames_in_swing);
        result["measures"] = as_json(shown.measures);
        return result;
    }
    const MotionPlot shown = plot_motion(options.output, motion, body, options.run, options.copy);
    result["silhouettes"] = shown.silhouettes;
    result["strip"] = {shown.strip.begin, shown.strip.end};
    result["measures"] = as_json(shown.measures);
    return result;
}

nlohmann::json landing_as_json(const LandingPlot& shown) {
    return {{"samples", shown.samples},
            {"landed", shown.landed},
            {"mean", as_json(shown.mean)},
            {"spread", shown.spread},
            {"median", shown.median}};
}

nlohmann::json plot(const PlotOptions& options) {
    require_picture_format(options.output);
    check_before_reading(options.input);
    const Motion motion = read_motion_file(options.input);
    const BodyMotion& body = find_body(options.input, motion, options.body);
    nlohmann::json result = options.kind == "landing"
                                ? landing_as_json(plot_landing(options.output, motion, body))
                                : plot_one(options, motion, body);
    result["output"] = options.output;
    result["kind"] = options.kind;
    result["body"] = body.name;
    return result;
}

std::string in_words(const nlohmann::json& result) {
    const std::string start =
        fmt::format("{}: {}, ", result["output"].get<std::string>(), result["body"].get<std::string>());
    if (result["kind"] == "landing") {
        return start + fmt::format("{} of {} landed, spread {:.3g} m", result["landed"].get<int>(),
                                   result["samples"].get<int>(), result["spread"].get<double>());
    }
    const std::string regime = result["measures"]["regime"].get<std::string>();
    if (result["kind"] == "phase") {
        return start +
               fmt::format("{}, rates up to {:.3g} rad/s", regime, result["highest_rate"].get<double>());
    }
    return start + fmt::format("{}, {} silhouettes", regime, result["silhouettes"].get<int>());
}

}  // namespace

int plot_command(int argc, const char* const* argv) {
    Arguments arguments("samara plot",
                        "Draws one body's motion: silhouettes along its path and its time series, a phase "
                        "portrait, or a map of its landings.");
    PlotOptions options;
    constexpr int most = 1'000'000'000;
    arguments.positional("MOTION", options.input, "motion file, from 'samara simulate'");
    arguments.required_option("-o,--output", options.output,
                              "picture to write: .png (2000 x 1300 pixels) or .svg");
    arguments.choice("--kind", options.kind, {"strip", "phase", "landing"}, "what to draw");
    arguments.option("--body", options.body, "the body to draw; the first where it is not given");
    arguments.option("--run", options.run, "the run to draw, counted from 0", 0, most);
    arguments.option("--copy", options.copy, "the copy to draw, counted from 0", 0, most);
    arguments.footer(footer);
    return run_program(argc, argv, arguments, [&] {
        for (const char* option : {"--run", "--copy"}) {
            if (options.kind == "landing" && arguments.given(option)) {
                throw Error(fmt::format("{}: a landing map is of all runs and copies; drop it", option));
            }
        }
        nlohmann::json result = plot(options);
        if (!arguments.json()) print_result("{}\n", in_words(result));
        return result;
    });
}

}  // namespace samara
