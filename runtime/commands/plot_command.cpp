#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/commands.hpp"
#include "commands/motion_choice.hpp"
#include "samara/command/arguments.hpp"
#include "samara/motion/description.hpp"
#include "samara/motion/motion_file.hpp"
#include "samara/plot/gnuplot.hpp"
#include "samara/plot/motion_plot.hpp"

namespace samara {
namespace {

constexpr const char* footer =
    R"(Left: the body's silhouettes along its path at even times, from the front (x, z)
and from the side (y, z), to scale and coloured by time; of a long fall the last
stretch. Right: descent speed, inclination (angle between the shortest principal
axis and gravity) and angular velocity; shaded: the last two thirds of the fall,
over which the title's figures are measured. gnuplot draws it.

Example: samara plot motion.h5 -o motion.png)";

nlohmann::json plot(const std::string& input, const std::string& output, const std::string& name, int run,
                    int copy) {
    require_picture_format(output);
    const Motion motion = read_motion_file(input);
    const BodyMotion& body = find_body(input, motion, name);
    require_run(input, motion, run);
    require_copy(input, body, copy);
    const MotionPlot shown = plot_motion(output, motion, body, run, copy);
    return {{"output", output},
            {"body", body.name},
            {"run", run},
            {"copy", copy},
            {"silhouettes", shown.silhouettes},
            {"strip", {shown.strip.begin, shown.strip.end}},
            {"measures", as_json(shown.measures)}};
}

}  // namespace

int plot_command(int argc, const char* const* argv) {
    Arguments arguments("samara plot",
                        "Draws one body's motion: silhouettes along its path and its time series.");
    std::string input;
    std::string output;
    std::string body;
    int run = 0;
    int copy = 0;
    constexpr int most = 1'000'000'000;
    arguments.positional("MOTION", input, "motion file, from 'samara simulate'");
    arguments.required_option("-o,--output", output, "picture to write: .png (2000 x 1300 pixels) or .svg");
    arguments.option("--body", body, "the body to draw; the first where it is not given");
    arguments.option("--run", run, "the run to draw, counted from 0", 0, most);
    arguments.option("--copy", copy, "the copy to draw, counted from 0", 0, most);
    arguments.footer(footer);
    return run_program(argc, argv, arguments, [&] {
        nlohmann::json result = plot(input, output, body, run, copy);
        if (!arguments.json()) {
            fmt::print("{}: {}, {}, {} silhouettes\n", output, result["body"].get<std::string>(),
                       result["measures"]["regime"].get<std::string>(), result["silhouettes"].get<int>());
        }
        return result;
    });
}

}  // namespace samara
