#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "samara/commands/commands.hpp"
#include "samara/commands/option_values.hpp"
#include "samara/commands/shared/arguments.hpp"
#include "samara/commands/shared/print.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/base/text.hpp"
#include "samara/export/chan_file.hpp"
#include "samara/export/csv_file.hpp"
#include "samara/export/gltf_file.hpp"
#include "samara/export/page_file.hpp"
#include "samara/export/usd_file.hpp"
#include "samara/motion/motion_file.hpp"
#include "samara/motion/resample.hpp"
#include "samara/motion/selection.hpp"

namespace samara {
namespace {

constexpr const char* footer = R"(Formats, by the ending of OUT:
  .glb   binary glTF 2.0: one mesh for each body, a node for each copy (NAME,
         NAME.001, ...) with translation and rotation keys; y up, as glTF requires;
         importers of z-up programs convert back.
  .usda  USD as text: z up, metres, a time code for each frame; one mesh for each
         body, an Xform for each copy; a PointInstancer from 20 copies on.
  .chan  channels, one file for each copy (OUT_NAME.chan, OUT_NAME.001.chan, ...),
         metres and degrees, y up as in .glb, in the layout of a program:
           nuke     frame tx ty tz rx ry rz, rotation order ZXY (R = Ry Rx Rz)
           houdini  tx ty tz rx ry rz, rotation order XYZ (R = Rz Ry Rx)
  .html  a page that plays the motion in a browser, offline: all bodies in 3D, with
         graphs of descent speed, inclination and angular speed.
  .csv   run,body,copy,time,position_{x,y,z},orientation_{w,x,y,z},
         velocity_{x,y,z},angular_velocity_{x,y,z}; SI units, world axes, z up.
         All runs unless --run is given.
All formats give the position of the shape file's origin, so that the shape file
itself can be placed there; the velocity in .csv is that of this point.

Keys of .glb and samples of .usda that linear interpolation between their
neighbours reproduces are left out: to within --tolerance of the position, and
to within the angle that moves the body's farthest point by as much. By default
1/500 of the body's radius; 0 keeps all keys.

Examples: samara export motion.h5 -o motion.glb --frame-rate 24
  samara export motion.h5 -o slow.usda --frame-rate 24 --slow 10 --body leaf
  samara export motion.h5 -o still.glb --at 4 --instances --colors c8553d,e09f3e)";

struct ExportOptions {
    std::string input;
    std::string output;
    std::optional<int> run;
    std::optional<double> frame_rate;
    std::optional<double> tolerance;
    std::optional<double> loop;
    std::string body;
    std::string copy;
    std::optional<double> slow;
    std::optional<double> at;
    std::string colors;
    bool instances = false;
    std::string chan = "nuke";
};

std::size_t copies_in(const Motion& motion) {
    std::size_t copies = 0;
    for (const BodyMotion& body : motion.bodies) copies += static_cast<std::size_t>(body.copies);
    return copies;
}

/// Writes the motion in the format of the output's ending and returns what was written.
nlohmann::json write(const ExportOptions& options, const std::string& format, const Motion& motion,
                     const CopyStyle& style) {
    const int run = options.run.value_or(0);
    if (format == ".csv") {
        Progress progress("writing " + options.output, "rows");
        const std::size_t rows = write_csv(
            options.output, motion, options.run,
            [&](double done, double total) { progress.update(done, total); }, style.first);
        return {{"rows", rows}, {"runs", options.run ? 1 : motion.runs}};
    }
    if (format == ".chan") {
        nlohmann::json files = nlohmann::json::array();
        Progress progress("writing " + options.output, "files");
        const auto written = write_chan(
            options.output, motion, run, [&](double done, double total) { progress.update(done, total); },
            options.chan == "houdini" ? ChanLayout::houdini : ChanLayout::nuke, style.first);
        for (const auto& file : written) files.push_back(file.string());
        return {{"files", files}, {"run", run}};
    }
    if (format == ".usda") {
        const std::size_t samples = write_usda(options.output, motion, run, options.tolerance, style);
        return {{"meshes", motion.bodies.size()},
                {"transforms", copies_in(motion)},
                {"samples", samples},
                {"run", run}};
    }
    if (format == ".html") {
        const std::string title = std::filesystem::path(options.input).stem().string();
        const std::string runs = motion.runs > 1 ? fmt::format(", run {} of {}", run, motion.runs) : "";
        const std::string slow =
            options.slow ? fmt::format(", {:g} times slower, speeds too", *options.slow) : "";
        write_page(options.output, motion, run, title,
                   fmt::format("{} frames per second{}{}", motion.frame_rate, slow, runs), style);
        return {{"bodies", motion.bodies.size()}, {"copies", copies_in(motion)}, {"run", run}};
    }
    const std::size_t keys =
        write_glb(options.output, motion, run, options.tolerance, style, options.instances);
    return {{"meshes", motion.bodies.size()},
            {options.instances ? "instances" : "nodes", copies_in(motion)},
            {"keys", keys},
            {"run", run}};
}

/// Notes where a body rotates too far between frames for programs that interpolate.
void note_fast_rotation(const Motion& motion, int run) {
    const FastRotation fastest = fastest_rotation(motion, run);
    if (!(fastest.revolutions > 0.5)) return;
    print_note(
        "samara export: warning: '{}' rotates by up to {:.2g} revolutions from frame to frame; above half a "
        "revolution interpolation between frames shows a wrong rotation; give --frame-rate {:.0f} or more\n",
        fastest.body, fastest.revolutions, std::ceil(4.0 * fastest.revolutions * motion.frame_rate));
}

/// Throws Error where an option is given that the format, or another option, leaves without effect.
void require_formats(const ExportOptions& options, const std::string& format) {
    struct Rule {
        bool given;
        const char* option;
        std::vector<std::string_view> formats;
    };
    const std::vector<Rule> rules = {{options.tolerance.has_value(), "--tolerance", {".glb", ".usda"}},
                                     {!options.colors.empty(), "--colors", {".glb", ".usda", ".html"}},
                                     {options.instances, "--instances", {".glb"}},
                                     {options.chan != "nuke", "--chan", {".chan"}}};
    for (const Rule& rule : rules) {
        if (!rule.given || std::find(rule.formats.begin(), rule.formats.end(), format) != rule.formats.end())
            continue;
        throw Error(fmt::format("{}: {} applies to {} only; leave it out", options.output, rule.option,
                                fmt::join(rule.formats, " and ")));
    }
    if (options.at && options.loop)
        throw Error("--at gives one frame and --loop a motion; leave one of them out");
    if (options.instances && !options.at) {
        throw Error("--instances: the instances of glTF cannot move; add --at SECONDS for one frame");
    }
}

/// Returns the bodies, obstacles and copies that the options name, and gives the first copy's number to
/// `style`.
Motion named_part(const ExportOptions& options, Motion motion, CopyStyle& style) {
    std::vector<std::string> known;
    for (const BodyMotion& body : motion.bodies) known.push_back(body.name);
    for (const Obstacle& obstacle : motion.obstacles) known.push_back(obstacle.name);
    const std::vector<std::string> names = comma_separated(options.body);
    for (const std::string& name : names) {
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        throw Error(fmt::format("{}: holds no body or obstacle '{}'; it holds: {}{}", options.input, name,
                                fmt::join(known, ", "), did_you_mean(name, known)));
    }
    motion = selected(std::move(motion), names, std::nullopt);
    if (motion.bodies.empty()) {
        throw Error(fmt::format("--body {}: names obstacles alone; name a body too", options.body));
    }
    if (options.copy.empty()) return motion;
    const CopyRange copies = copy_range("--copy", options.copy);
    for (const BodyMotion& body : motion.bodies) require_copy(options.input, body, copies.last);
    style.first = copies.first;
    return selected(std::move(motion), {}, copies);
}

nlohmann::json export_motion(ExportOptions options) {
    const std::string format = std::filesystem::path(options.output).extension().string();
    constexpr std::array<std::string_view, 5> formats = {".glb", ".usda", ".chan", ".html", ".csv"};
    if (std::find(formats.begin(), formats.end(), format) == formats.end()) {
        throw Error(
            fmt::format("{}: the format '{}' is unknown; end the name in .glb, .usda, .chan, .html or .csv",
                        options.output, format));
    }
    require_formats(options, format);
    Motion motion = read_motion_file(options.input);
    require_run(options.input, motion, options.run.value_or(0));
    CopyStyle style;
    if (!options.colors.empty()) style.colors = colors_of_words("--colors", options.colors);
    motion = named_part(options, std::move(motion), style);
    const double frame_rate = options.frame_rate.value_or(motion.frame_rate);
    if (options.slow) motion = slowed(std::move(motion), *options.slow);
    if (options.at) {
        motion = still_at(motion, *options.at);
        motion.frame_rate = frame_rate;
    } else if (options.frame_rate || options.slow) {
        motion = resampled(motion, frame_rate);
    }
    if (options.loop) {
        motion = looped(motion, options.run.value_or(0), *options.loop);
        options.run.reset();
    }
    if (format != ".csv" && !options.at) note_fast_rotation(motion, options.run.value_or(0));
    nlohmann::json result = {{"output", options.output},
                             {"format", format.substr(1)},
                             {"frames", motion.frames()},
                             {"frame_rate", motion.frame_rate}};
    result.update(write(options, format, motion, style));
    std::uintmax_t bytes = 0;
    for (const auto& file : result.value("files", nlohmann::json::array({options.output}))) {
        bytes += std::filesystem::file_size(file.get<std::string>());
    }
    result["bytes"] = bytes;
    return result;
}

/// Prints "OUT: 3 nodes, 200 keys, 240 frames, 12345 bytes".
void print_summary(const nlohmann::json& result) {
    std::string counts;
    constexpr std::array<std::array<const char*, 2>, 7> words = {{{"rows", "row"},
                                                                  {"nodes", "node"},
                                                                  {"instances", "instance"},
                                                                  {"keys", "key"},
                                                                  {"transforms", "transform"},
                                                                  {"samples", "sample"},
                                                                  {"copies", "copy"}}};
    for (const auto& [plural, singular] : words) {
        if (!result.contains(plural)) continue;
        const auto count = result[plural].get<std::size_t>();
        counts += fmt::format("{} {}, ", count, count == 1 ? singular : plural);
    }
    if (result.contains("files")) {
        const std::size_t count = result["files"].size();
        counts += fmt::format("{} file{}, ", count, count == 1 ? "" : "s");
    }
    print_result("{}: {}{} frames, {} bytes\n", result["output"].get<std::string>(), counts,
                 result["frames"].get<int>(), result["bytes"].get<std::uintmax_t>());
}

}  // namespace

int export_command(int argc, const char* const* argv) {
    Arguments arguments("samara export", "Writes a motion file for animation tools and spreadsheets.");
    ExportOptions options;
    arguments.positional("MOTION", options.input, "motion file, from 'samara simulate'");
    arguments.required_output_option("-o,--output", options.output,
                                     "file to write; its ending gives the format");
    arguments.option("--run", options.run, "the run to write, counted from 0 (default: 0; .csv: all)", 0,
                     1'000'000'000);
    arguments.option("--frame-rate", options.frame_rate,
                     "frames per second to write (default: the motion file's)", 1e-3, 1e6);
    arguments.option("--loop", options.loop,
                     "length of a loop (s): the motion is cut into pieces of this length, which play as "
                     "copies side by side",
                     1e-6, 1e6);
    arguments.option("--body", options.body,
                     "names of the bodies and obstacles to write, separated by commas (default: all)");
    arguments.option(
        "--copy", options.copy,
        "the copy of each body to write, counted from 0, or copies such as 10-19 (default: all)");
    arguments.option("--slow", options.slow,
                     "how many times slower than it was the motion is written, at the same frame rate", 1e-3,
                     1e6);
    arguments.option("--at", options.at, "write one frame, at this time (s)", -1e6, 1e9);
    arguments.option("--colors", options.colors,
                     "colours of the copies in turn, in hexadecimal, such as c8553d,e09f3e (.glb, .usda, "
                     ".html; not of display meshes)");
    arguments.flag("--instances", options.instances,
                   "write copies as instances (EXT_mesh_gpu_instancing) in the .glb of one frame");
    arguments.choice("--chan", options.chan, {"nuke", "houdini"}, "layout of .chan");
    arguments.option("--tolerance", options.tolerance,
                     "largest position error of the keys of .glb and .usda, m (default: 1/500 of the radius)",
                     0.0, 1e6);
    arguments.footer(footer);
    return run_program(argc, argv, arguments, [&] {
        const nlohmann::json result = export_motion(options);
        if (!arguments.json()) print_summary(result);
        return result;
    });
}

}  // namespace samara
