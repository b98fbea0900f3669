// The program samara-wind: velocity grids of other programs -> a wind file.

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "converter/wind/wind_readers.hpp"
#include "samara/commands/shared/arguments.hpp"
#include "samara/commands/shared/print.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/wind/wind_file.hpp"

namespace samara {
namespace {

struct Request {
    std::vector<std::string> inputs;
    std::string output;
    std::string up = "z";
    VdbOptions vdb;
    std::string box;
    bool latest = false;
};

double largest_speed(const WindGrid& grid) {
    double largest = 0.0;
    for (std::size_t i = 0; i + 2 < grid.velocities.size(); i += 3) {
        const Vector3d velocity(grid.velocities[i], grid.velocities[i + 1], grid.velocities[i + 2]);
        largest = std::max(largest, velocity.norm());
    }
    return largest;
}

void reject(const Arguments& arguments, const std::vector<std::string>& options, const std::string& whose) {
    for (const std::string& option : options) {
        if (arguments.given(option))
            throw Error(fmt::format("{}: applies only to {}; leave it out", option, whose));
    }
}

WindGrid of_vdb_files(Request& request, const Arguments& arguments) {
    reject(arguments, {"--box", "--latest"}, "an OpenFOAM case");
    std::vector<std::filesystem::path> files;
    for (const std::string& input : request.inputs) {
        if (std::filesystem::path(input).extension() != ".vdb") {
            throw Error(fmt::format(
                "{}: is neither a .vdb file nor the folder of an OpenFOAM case; give one of these", input));
        }
        files.emplace_back(input);
    }
    Progress progress("reading the wind", "files");
    request.vdb.y_up = request.up == "y";
    request.vdb.progress = [&](double done, double total) { progress.update(done, total); };
    return read_vdb_wind(files, request.vdb);
}

Eigen::AlignedBox3d box_of(const std::string& words) {
    Vector3d min;
    Vector3d max;
    int end = 0;
    const int found = std::sscanf(words.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf%n", &min.x(), &min.y(), &min.z(),
                                  &max.x(), &max.y(), &max.z(), &end);
    if (found != 6 || static_cast<std::size_t>(end) != words.size() || !((max - min).minCoeff() >= 0.0)) {
        throw Error(fmt::format(
            "--box takes X0,Y0,Z0,X1,Y1,Z1 in metres, the lower corner first; it was '{}'", words));
    }
    return {min, max};
}

WindGrid of_case(const Request& request, const Arguments& arguments) {
    if (request.inputs.size() > 1) throw Error("INPUT: give only one OpenFOAM case");
    reject(arguments, {"--grid", "--frame-rate", "--voxel-size"}, ".vdb files");
    if (!request.vdb.spacing)
        throw Error("--spacing: is missing; give the distance between the wind's nodes in metres");
    Progress progress("reading the wind", "times");
    FoamWindOptions options;
    options.spacing = *request.vdb.spacing;
    options.y_up = request.up == "y";
    options.latest = request.latest;
    if (!request.box.empty()) options.box = box_of(request.box);
    options.progress = [&](double done, double total) { progress.update(done, total); };
    return read_foam_wind(request.inputs.front(), options);
}

nlohmann::json run(Request& request, const Arguments& arguments) {
    if (std::filesystem::path(request.output).extension() != ".h5") {
        throw Error(fmt::format("{}: the output is a wind file; name it NAME.h5", request.output));
    }
    const WindGrid grid = std::filesystem::is_directory(request.inputs.front())
                              ? of_case(request, arguments)
                              : of_vdb_files(request, arguments);
    write_wind_file(request.output, grid);
    const double fastest = largest_speed(grid);
    if (!arguments.json()) {
        print_result(
            "{}: {} x {} x {} nodes, {:.4g} x {:.4g} x {:.4g} m apart, from ({:.4g}, {:.4g}, {:.4g}) m; "
            "{}; up to {:.3g} m/s\n",
            request.output, grid.nodes[0], grid.nodes[1], grid.nodes[2], grid.spacing.x(), grid.spacing.y(),
            grid.spacing.z(), grid.origin.x(), grid.origin.y(), grid.origin.z(),
            grid.frames == 1 ? std::string("steady")
                             : fmt::format("{} times over {:.4g} s", grid.frames, grid.duration()),
            fastest);
    }
    return {{"output", request.output},
            {"nodes", grid.nodes},
            {"spacing", {grid.spacing.x(), grid.spacing.y(), grid.spacing.z()}},
            {"origin", {grid.origin.x(), grid.origin.y(), grid.origin.z()}},
            {"frames", grid.frames},
            {"duration", grid.duration()},
            {"largest_speed", fastest}};
}

}  // namespace
}  // namespace samara

int main(int argc, char** argv) {
    using namespace samara;
    Request request;
    Arguments arguments(
        "samara wind",
        "Makes a wind file, for [wind.file] of a scene, from OpenVDB velocity grids or an OpenFOAM case.");
    arguments.positionals(
        "INPUT", request.inputs,
        ".vdb files in temporal order, a single one for a steady wind; or the folder of a solved case");
    arguments.required_output_option("-o,--output", request.output, "wind file to write (.h5)");
    arguments.option("--grid", request.vdb.grid,
                     "name of the velocity grid, or of three grids NAME.x, NAME.y, NAME.z; by default "
                     "velocity, vel or v, or the only vector grid");
    arguments.choice("--up", request.up, {"z", "y"},
                     "the vertical axis of the files: z from Blender, y from Houdini");
    arguments.option("--frame-rate", request.vdb.frame_rate, "files per second", 1e-6, 1e6);
    arguments.option("--voxel-size", request.vdb.voxel_size, "voxel size of grids that do not define it, m",
                     1e-9, 1e6);
    arguments.option(
        "--spacing", request.vdb.spacing,
        "distance between nodes, m; by default the voxel size of the first .vdb file; required for a case",
        1e-9, 1e6);
    arguments.option("--box", request.box,
                     "X0,Y0,Z0,X1,Y1,Z1: the box of the nodes (m, z up); by default around a case's mesh");
    arguments.flag("--latest", request.latest, "use only a case's last time, as a steady wind");
    arguments.footer(
        "Example: samara wind gust.0001.vdb gust.0002.vdb gust.0003.vdb -o gust.h5 --frame-rate 24\n"
        "         samara wind cases/alley -o alley.h5 --spacing 0.25 --box -5,-5,0,5,5,4\n"
        "then in the scene: [wind.file] path = \"gust.h5\"");
    return run_program(argc, argv, arguments, [&] { return run(request, arguments); });
}
