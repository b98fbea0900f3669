// samara info: what a file holds, its units and its provenance.
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>

#include "samara/analysis/metrics/description.hpp"
#include "samara/commands/body_report.hpp"
#include "samara/commands/commands.hpp"
#include "samara/commands/option_values.hpp"
#include "samara/commands/shared/arguments.hpp"
#include "samara/commands/shared/print.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/body/load_tables.hpp"
#include "samara/core/files/hdf5_reader.hpp"
#include "samara/core/surface/surface.hpp"
#include "samara/core/wind/wind_file.hpp"
#include "samara/formats/json_text.hpp"
#include "samara/motion/motion_file.hpp"

namespace samara {
namespace {

double drag(const LoadEntry& entry, const Vector3d& direction) {
    return -entry.force.dot(direction);
}

double drag_error(const LoadEntryError& error, const Vector3d& direction) {
    return error.force.cwiseProduct(direction).norm();
}

void print_vector(const char* name, const Vector3d& value, const Vector3d& error) {
    print_result("  {:<18}({:.4f}, {:.4f}, {:.4f}) +- ({:.4f}, {:.4f}, {:.4f})\n", name, value.x(), value.y(),
                 value.z(), error.x(), error.y(), error.z());
}

/// Returns the drag coefficient on the area (m^2) that the body projects along its motion, as the literature
/// has it; `drag`: the tables', on A = pi L^2/4.
double on_projected_area(double drag, const LoadTables& tables, double projected) {
    const double length = tables.reference_length;
    return drag * 0.25 * std::numbers::pi * length * length / projected;
}

/// Prints the tables' entry with its standard errors, on standard output, for a body that moves along the
/// unit direction (shape axes) at the Reynolds number.
void print_lookup(const Body& body, const Vector3d& direction, double reynolds_number) {
    const LoadTables& tables = *body.tables;
    const LoadEntry entry = look_up(tables, direction, reynolds_number);
    const LoadEntryError error = look_up_error(tables, direction, reynolds_number);
    print_result("moving along ({:.4f}, {:.4f}, {:.4f}) in shape axes at Reynolds number {:.6g}\n",
                 direction.x(), direction.y(), direction.z(), reynolds_number);
    print_result("  {:<18}{:.4f} +- {:.4f}\n", "drag coefficient", drag(entry, direction),
                 drag_error(error, direction));
    const double projected = projected_area(body.surface, direction);
    print_result("  {:<18}{:.4f} +- {:.4f}, on the {:.4g} m^2 that face the flow\n", "",
                 on_projected_area(drag(entry, direction), tables, projected),
                 on_projected_area(drag_error(error, direction), tables, projected), projected);
    print_vector("force", entry.force, error.force);
    print_vector("moment", entry.moment, error.moment);
    print_result("  {:<18}{:.5f} +- {:.5f}\n", "k/U^2", entry.turbulent_kinetic_energy,
                 error.turbulent_kinetic_energy);
    print_result("  {:<18}{:.5f} +- {:.5f}\n", "epsilon L/U^3", entry.dissipation_rate,
                 error.dissipation_rate);
    print_result("coefficients on A = pi L^2/4 and L = {:.6g} m, with standard errors\n",
                 tables.reference_length);
}

/// Returns the tables' entry in a direction as JSON: drag_coefficient, force, moment,
/// turbulent_kinetic_energy, dissipation_rate, each with its _error; on A = pi L^2/4 and L; and
/// projected_area (m^2) with the drag coefficient on it.
nlohmann::json lookup_as_json(const Body& body, const Vector3d& direction, double reynolds_number) {
    const LoadTables& tables = *body.tables;
    const double projected = projected_area(body.surface, direction);
    const LoadEntry entry = look_up(tables, direction, reynolds_number);
    const LoadEntryError error = look_up_error(tables, direction, reynolds_number);
    return {
        {"direction", as_json(direction)},
        {"reynolds_number", reynolds_number},
        {"reference_length", tables.reference_length},
        {"drag_coefficient", drag(entry, direction)},
        {"drag_coefficient_error", drag_error(error, direction)},
        {"projected_area", projected},
        {"drag_coefficient_on_projected_area", on_projected_area(drag(entry, direction), tables, projected)},
        {"force", as_json(entry.force)},
        {"force_error", as_json(error.force)},
        {"moment", as_json(entry.moment)},
        {"moment_error", as_json(error.moment)},
        {"turbulent_kinetic_energy", entry.turbulent_kinetic_energy},
        {"turbulent_kinetic_energy_error", error.turbulent_kinetic_energy},
        {"dissipation_rate", entry.dissipation_rate},
        {"dissipation_rate_error", error.dissipation_rate}};
}

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
        fmt::format("--direction: '{}' is not a direction; give x,y,z in shape axes, such as 0,0,-1", text));
}

/// Prints and returns the entry of a body's tables in one direction.
nlohmann::json report_lookup(const std::string& path, const std::string& words, double reynolds_number,
                             bool json) {
    const Vector3d direction = parse_direction(words);
    const Body body = read_body_file(path);
    if (!body.tables) throw Error(fmt::format("{}: has no tables; make them with 'samara bake'", path));
    const double at = reynolds_number > 0.0 ? reynolds_number : body.tables->reynolds_numbers.back();
    if (!json) print_lookup(body, direction, at);
    return lookup_as_json(body, direction, at);
}

}  // namespace

int info_command(int argc, const char* const* argv) {
    std::string file;
    std::string direction;
    double reynolds_number = 0.0;
    Arguments arguments("samara info",
                        "Prints the content of a body, motion or wind file, with units and provenance.");
    arguments.positional("FILE", file, "body file (.body.h5), motion file or wind file (.h5)");
    arguments.option(
        "--direction", direction,
        "x,y,z: print the entry of a body's tables for motion in this direction (shape axes) instead");
    arguments.option("--reynolds-number", reynolds_number,
                     "U L/nu, with --direction; by default the tables' last", 1e-9, 1e12);
    arguments.footer(
        "JSON of a motion: kind, start, duration (s), frames, frame_rate, runs, gravity, seed, scene, bodies "
        "with their\n"
        "measures. Of a body: kind, name, source, triangles, order, volume (m^3), centroid (m), surface_area "
        "(m^2),\n"
        "principal_extents (m, shortest first), symmetry, kirchhoff and tables (null if there are none).");
    return run_program(argc, argv, arguments, [&] {
        if (!direction.empty()) return report_lookup(file, direction, reynolds_number, arguments.json());
        if (arguments.given("--reynolds-number")) {
            throw Error("--reynolds-number: needs --direction; give both");
        }
        return report(file, arguments.json());
    });
}

}  // namespace samara
