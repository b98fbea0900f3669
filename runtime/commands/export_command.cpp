#include <filesystem>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/commands.hpp"
#include "commands/motion_choice.hpp"
#include "samara/base/error.hpp"
#include "samara/command/arguments.hpp"
#include "samara/command/progress.hpp"
#include "samara/export/csv_file.hpp"
#include "samara/export/gltf_file.hpp"
#include "samara/motion/motion_file.hpp"

namespace samara {
namespace {

constexpr const char* footer = R"(Formats, by the ending of OUT:
  .glb  binary glTF 2.0: one mesh for each body, a node for each copy (NAME,
        NAME.001, ...) with translation and rotation keys at every frame; y up,
        as glTF asks, so that importers for z-up programs restore the scene.
        One run: 0 unless --run is given.
  .csv  run,body,copy,time,position_{x,y,z},orientation_{w,x,y,z},
        velocity_{x,y,z},angular_velocity_{x,y,z}; SI units, world axes, z up.
        All runs unless --run is given.
Both give the place of the shape file's origin, so that the shape file itself can
be put there; the velocity in .csv is the velocity of that point.

Example: samara export motion.h5 -o motion.glb)";

nlohmann::json export_motion(const std::string& input, const std::string& output, int run, bool run_given) {
    const std::string format = std::filesystem::path(output).extension().string();
    if (format != ".glb" && format != ".csv") {
        throw Error(
            fmt::format("{}: the format '{}' is unknown; end the name in .glb or .csv", output, format));
    }
    const Motion motion = read_motion_file(input);
    require_run(input, motion, run);
    nlohmann::json result = {{"output", output}, {"format", format.substr(1)}, {"frames", motion.frames()}};
    if (format == ".csv") {
        Progress progress("writing " + output, "rows");
        const std::optional<int> one_run = run_given ? std::optional<int>(run) : std::nullopt;
        result["rows"] = write_csv(output, motion, one_run,
                                   [&](double done, double total) { progress.update(done, total); });
        result["runs"] = run_given ? 1 : motion.runs;
    } else {
        write_glb(output, motion, run);
        int nodes = 0;
        for (const BodyMotion& body : motion.bodies) nodes += body.copies;
        result["meshes"] = motion.bodies.size();
        result["nodes"] = nodes;
        result["run"] = run;
    }
    result["bytes"] = std::filesystem::file_size(output);
    return result;
}

}  // namespace

int export_command(int argc, const char* const* argv) {
    Arguments arguments("samara export", "Writes a motion file for animation tools and spreadsheets.");
    std::string input;
    std::string output;
    int run = 0;
    arguments.positional("MOTION", input, "motion file, from 'samara simulate'");
    arguments.required_option("-o,--output", output, "file to write; its ending gives the format");
    arguments.option("--run", run, "the run to write, counted from 0", 0, 1'000'000'000);
    arguments.footer(footer);
    return run_program(argc, argv, arguments, [&] {
        nlohmann::json result = export_motion(input, output, run, arguments.given("--run"));
        if (!arguments.json()) {
            const bool is_table = result["format"] == "csv";
            const auto count = result[is_table ? "rows" : "nodes"].get<std::size_t>();
            const std::string what =
                fmt::format("{} {}{}", count, is_table ? "row" : "node", count == 1 ? "" : "s");
            fmt::print("{}: {}, {} frames, {} bytes\n", output, what, result["frames"].get<int>(),
                       result["bytes"].get<std::uintmax_t>());
        }
        return result;
    });
}

}  // namespace samara
