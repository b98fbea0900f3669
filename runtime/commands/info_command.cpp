// samara info: what a file holds, its units and its provenance.

#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "samara/analysis/metrics/description.hpp"
#include "samara/commands/body_report.hpp"
#include "samara/commands/commands.hpp"
#include "samara/commands/shared/arguments.hpp"
#include "samara/commands/shared/print.hpp"
#include "samara/commands/shared/progress.hpp"
#include "samara/commands/table_lookup_report.hpp"
#include "samara/commands/vector_words.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/hdf5_reader.hpp"
#include "samara/core/wind/wind_file.hpp"
#include "samara/formats/vector_json.hpp"
#include "samara/motion/motion_file.hpp"

namespace samara {
namespace {

nlohmann::json report_body(const std::string& path, bool json) {
    const Body body = read_body_file(path);
    if (!json) print_body(body);
    return body_as_json(body);
}

nlohmann::json report_motion(const std::string& path, bool json) {
    const MotionReader file(path);
    Progress progress("measuring", "poses");
    const std::vector<BodyMeasures> measures =
        measure_file(file, 0, [&](double done, double total) { progress.update(done, total); });
    if (!json) print_result("{}", describe_motion_text(file.motion(), measures));
    return describe_motion(file.motion(), measures);
}

std::string in_words(const Vector3d& v) {
    return fmt::format("({:.4g}, {:.4g}, {:.4g})", v.x(), v.y(), v.z());
}

nlohmann::json report_wind(const std::string& path, bool json) {
    const WindGrid grid = read_wind_file(path);
    const Vector3d end =
        grid.origin + grid.spacing.cwiseProduct(Vector3d(static_cast<double>(grid.nodes[0] - 1),
                                                         static_cast<double>(grid.nodes[1] - 1),
                                                         static_cast<double>(grid.nodes[2] - 1)));
    if (!json) {
        print_result("wind of {}\n  {} x {} x {} nodes, {} m apart, from {} to {} m\n  {}\n", grid.source,
                     grid.nodes[0], grid.nodes[1], grid.nodes[2], in_words(grid.spacing),
                     in_words(grid.origin), in_words(end),
                     grid.frames == 1 ? std::string("steady")
                                      : fmt::format("{} times, {:.4g} s apart", grid.frames, grid.interval));
    }
    return {{"kind", "wind"},
            {"source", grid.source},
            {"nodes", grid.nodes},
            {"origin", as_json(grid.origin)},
            {"spacing", as_json(grid.spacing)},
            {"frames", grid.frames},
            {"interval", grid.interval}};
}

nlohmann::json report(const std::string& path, bool json) {
    const Hdf5Reader file(path);
    nlohmann::json result = file.has("/surface")  ? report_body(path, json)
                            : file.has("/bodies") ? report_motion(path, json)
                                                  : report_wind(path, json);
    result["digest"] = file.has_digest();
    if (!json && !file.has_digest()) print_result("without a digest of its content\n");
    return result;
}

Vector3d parse_direction(const std::string& text) {
    const std::optional<Vector3d> direction = vector_of_words(text);
    if (direction && direction->norm() > 0.0) return direction->normalized();
    throw Error(
        fmt::format("--direction: '{}' is no direction; give x,y,z in shape axes, such as 0,0,-1", text));
}

/// What the tables of a body say in one direction.
nlohmann::json report_lookup(const std::string& path, const std::string& words, double reynolds_number,
                             bool json) {
    const Vector3d direction = parse_direction(words);
    const Body body = read_body_file(path);
    if (!body.tables) throw Error(fmt::format("{}: has no tables; make them with 'samara bake'", path));
    const double at = reynolds_number > 0.0 ? reynolds_number : body.tables->reynolds_numbers.back();
    if (!json) print_lookup(*body.tables, direction, at);
    return lookup_as_json(*body.tables, direction, at);
}

}  // namespace

int info_command(int argc, const char* const* argv) {
    std::string file;
    std::string direction;
    double reynolds_number = 0.0;
    Arguments arguments("samara info",
                        "What a body, motion or wind file holds, its units and its provenance.");
    arguments.positional("FILE", file, "body file (.body.h5), motion file or wind file (.h5)");
    arguments.option("--direction", direction,
                     "x,y,z: instead, what a body's tables say where it moves that way (shape axes)");
    arguments.option("--reynolds-number", reynolds_number, "U L/nu, with --direction; the tables' last", 1e-9,
                     1e12);
    arguments.footer(
        "JSON of a motion: kind, start, duration (s), frames, frame_rate, runs, gravity, seed, scene, bodies "
        "with their\n"
        "measures. Of a body: kind, name, source, triangles, order, volume (m^3), centroid (m), surface_area "
        "(m^2),\n"
        "principal_extents (m, shortest first), symmetry, kirchhoff and tables (null where there are none).");
    return run_program(argc, argv, arguments, [&] {
        if (!direction.empty()) return report_lookup(file, direction, reynolds_number, arguments.json());
        if (arguments.given("--reynolds-number")) {
            throw Error("--reynolds-number: belongs to --direction; give both");
        }
        return report(file, arguments.json());
    });
}

}  // namespace samara
