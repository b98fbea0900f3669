#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "samara/commands/commands.hpp"
#include "samara/commands/option_values.hpp"
#include "samara/commands/shared/arguments.hpp"
#include "samara/commands/shared/print.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/hdf5_reader.hpp"
#include "samara/motion/motion_file.hpp"
#include "samara/pictures/body_pictures.hpp"
#include "samara/pictures/draw.hpp"
#include "samara/pictures/motion_pictures.hpp"

namespace samara {
namespace {

constexpr const char* footer =
    R"(strip: the body's silhouettes along its path at equal intervals, from the front (x, z)
and from the side (y, z), to scale and coloured by time; for a long fall its last part.
The graphs show descent speed, inclination (angle between the shortest principal axis
and gravity) and angular velocity; shaded: the last two thirds of the fall, over which
the metrics in the title are measured.
phase: the tilt of the shortest axis from the vertical, in the plane in which it swings
most and signed, against its rate, coloured by time; and both over time.
forces, of a motion by 'samara simulate --forces': drag, lift and inertia as arrows at the
silhouettes; over time the size and the upward part of each force, and of the moments.
landing: where all copies and runs land, from above, with the mean and the circle of
the rms distance; the distributions of the distance and of the time of landing.
Without a ground: the positions at the last frame, and the distances descended.
polars, of a body file: drag, lift, moment and k against the direction of motion in the
planes of the principal axes, with their standard errors and the solved cases.
sphere: drag, moment, k and the force's standard error over all directions.
convergence: drag and k over the meshes, errors by source, drag over Reynolds numbers.
Python's matplotlib draws them.

Examples: samara plot motion.h5 -o motion.png
          samara plot motion.h5 -o phase.svg --kind phase
          samara plot leaf.body.h5 -o polars.svg)";

struct PlotOptions {
    std::string input;
    std::string output;
    std::string kind = "strip";  // by default; polars for a body file
    std::string body;
    int run = 0;
    int copy = 0;
};

bool is_body_kind(const std::string& kind) {
    return kind == "polars" || kind == "sphere" || kind == "convergence";
}

/// Returns the members of a picture's data that the result of the command reports.
nlohmann::json reported_of(const nlohmann::json& picture) {
    nlohmann::json result;
    for (const char* key : {"run",
                            "copy",
                            "measures",
                            "fall",
                            "highest_rate",
                            "lines",
                            "frames_in_swing",
                            "samples",
                            "landed",
                            "mean",
                            "spread",
                            "median",
                            "cases",
                            "planned",
                            "solved",
                            "shown_angle",
                            "reynolds_number",
                            "directions",
                            "meshes",
                            "sources"}) {
        if (picture.contains(key)) result[key] = picture[key];
    }
    return result;
}

nlohmann::json picture_of(const PlotOptions& options, bool of_body) {
    if (of_body) {
        const Body body = read_body_file(options.input);
        if (!body.tables) {
            throw Error(
                fmt::format("{}: has no tables to draw; make them with 'samara bake'", options.input));
        }
        return body_picture(options.kind, body);
    }
    const Motion motion = read_motion_file(options.input);
    const BodyMotion& body = find_body(options.input, motion, options.body);
    if (options.kind != "landing") {
        require_run(options.input, motion, options.run);
        require_copy(options.input, body, options.copy);
    }
    return motion_picture(options.kind, motion, body, options.run, options.copy);
}

/// Draws a picture that suits the type of the file; without --kind its first.
nlohmann::json plot(PlotOptions options, const Arguments& arguments) {
    require_picture_format(options.output);
    const bool of_body = Hdf5Reader(options.input).has("/surface");
    if (of_body && !arguments.given("--kind")) options.kind = "polars";
    if (of_body != is_body_kind(options.kind)) {
        throw Error(fmt::format("--kind {}: draws a {}, but {} is a {}", options.kind,
                                of_body ? "motion" : "body file", options.input,
                                of_body ? "body file; take polars, sphere or convergence"
                                        : "motion; take strip, phase, landing or forces"));
    }
    for (const char* option : {"--body", "--run", "--copy"}) {
        if (of_body && arguments.given(option)) {
            throw Error(fmt::format("{}: applies to a motion, but {} is a body file; leave it out", option,
                                    options.input));
        }
    }
    const nlohmann::json picture = picture_of(options, of_body);
    nlohmann::json result = reported_of(picture);
    result.update(draw_picture(options.output, picture));
    result["output"] = options.output;
    result["kind"] = options.kind;
    result["body"] = picture["name"];
    return result;
}

std::string in_words(const nlohmann::json& result) {
    const std::string start =
        fmt::format("{}: {}, ", result["output"].get<std::string>(), result["body"].get<std::string>());
    if (result["kind"] == "landing") {
        return start + fmt::format("{} of {} landed, spread {:.3g} m", result["landed"].get<int>(),
                                   result["samples"].get<int>(), result["spread"].get<double>());
    }
    if (result["kind"] == "convergence") {
        return start + fmt::format("{} directions on {} meshes, {} sources of error",
                                   result["directions"].get<int>(), result["meshes"].get<int>(),
                                   result["sources"].get<int>());
    }
    if (is_body_kind(result["kind"].get<std::string>())) {
        return start + fmt::format("{} at Reynolds number {:.6g}", result["kind"].get<std::string>(),
                                   result["reynolds_number"].get<double>());
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
                        "Draws the motion of one body (silhouettes and time series, a phase portrait or a "
                        "landing map), or a body's tables.");
    PlotOptions options;
    constexpr int most = 1'000'000'000;
    arguments.positional("FILE", options.input,
                         "motion file (.h5), from 'samara simulate', or body file (.body.h5) with tables");
    arguments.required_output_option("-o,--output", options.output,
                                     "picture to write: .png (2000 x 1300 pixels) or .svg");
    arguments.choice("--kind", options.kind,
                     {"strip", "phase", "landing", "forces", "polars", "sphere", "convergence"},
                     "what to draw; polars, sphere and convergence draw a body file (default: polars)");
    arguments.option("--body", options.body, "the body to draw; the first by default");
    arguments.option("--run", options.run, "the run to draw, counted from 0", 0, most);
    arguments.option("--copy", options.copy, "the copy to draw, counted from 0", 0, most);
    arguments.footer(footer);
    return run_program(argc, argv, arguments, [&] {
        for (const char* option : {"--run", "--copy"}) {
            if (options.kind == "landing" && arguments.given(option)) {
                throw Error(fmt::format("{}: a landing map shows all runs and copies; leave it out", option));
            }
        }
        nlohmann::json result = plot(options, arguments);
        if (!arguments.json()) print_result("{}\n", in_words(result));
        return result;
    });
}

}  // namespace samara
