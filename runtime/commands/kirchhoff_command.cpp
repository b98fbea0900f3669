// samara kirchhoff: the added mass of a body or shape.

#include <chrono>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "samara/analysis/advice/input_warnings.hpp"
#include "samara/commands/commands.hpp"
#include "samara/commands/option_values.hpp"
#include "samara/commands/shared/arguments.hpp"
#include "samara/commands/shared/body_notes.hpp"
#include "samara/commands/shared/load_body.hpp"
#include "samara/commands/shared/print.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/formats/json_text.hpp"
#include "samara/kirchhoff/kirchhoff_solver.hpp"
#include "samara/kirchhoff/surface_flow.hpp"

namespace samara {
namespace {

// The number of triangles of samara mesh by default, and its growth where a tolerance needs more.
constexpr int first_triangles = 1280;
constexpr int finer = 4;
constexpr int most_triangles = 20480;

struct Request {
    std::string file;
    std::string output;
    int triangles = 0;
    double thickness = 0.0;
    double tolerance = 0.0;
    int threads = 0;
    std::string about;
};

Vector3d parse_point(const std::string& text) {
    if (const auto point = vector_of_words(text)) return *point;
    throw Error(fmt::format("--about: '{}' is not a point; give x,y,z in metres, such as 0,0,-0.01", text));
}

void print_matrix(const Matrix6d& matrix) {
    constexpr const char* columns[] = {"omega_x", "omega_y", "omega_z", "v_x", "v_y", "v_z"};
    constexpr const char* rows[] = {"l_x", "l_y", "l_z", "p_x", "p_y", "p_z"};
    print_result("     ");
    for (const char* column : columns) print_result("{:>13}", column);
    print_result("\n");
    for (int row = 0; row < 6; ++row) {
        print_result("  {}", rows[row]);
        for (int column = 0; column < 6; ++column) print_result("{:>13.5g}", matrix(row, column));
        print_result("\n");
    }
}

std::string in_words(const Vector3d& point) {
    return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", point.x(), point.y(), point.z());
}

KirchhoffTensor solve(const Body& body, const Request& request) {
    Progress progress("Kirchhoff tensor", "percent");
    KirchhoffOptions options;
    options.threads = request.threads;
    options.tolerance = request.tolerance;
    options.progress = [&](double share) { progress.update(100.0 * share, 100.0); };
    return labelled(request.file, [&] { return kirchhoff_tensor(body, options); });
}

bool within_tolerance(const Body& body, const Request& request) {
    return request.tolerance == 0.0 || body.kirchhoff->error_estimate <= request.tolerance;
}

/// Returns the body of the file with its tensor. Where the tolerance asks for more triangles than a shape was
/// meshed with, and none were asked for, it is meshed again.
Body solved_body(const Request& request) {
    const auto solved = [&](int triangles) {
        Body body = load_body(request.file, {.thickness = request.thickness, .triangles = triangles});
        body.kirchhoff = solve(body, request);
        body.surface_loads = labelled(
            request.file, [&] { return surface_loads(body.surface, body.moments, request.threads); });
        return body;
    };
    Body body = solved(request.triangles);
    const bool is_shape = !is_body_file_name(request.file);
    if (is_shape && request.triangles == 0) {
        for (int triangles = finer * first_triangles;
             triangles <= most_triangles && !within_tolerance(body, request); triangles *= finer) {
            Body next = solved(triangles);
            if (next.kirchhoff->error_estimate >= body.kirchhoff->error_estimate) break;
            body = std::move(next);
        }
    }
    if (!within_tolerance(body, request)) {
        throw Error(fmt::format(
            "{}: the tolerance {:.2g} cannot be reached: {} triangles give {:.2g}; {}", request.file,
            request.tolerance, body.kirchhoff->triangles, body.kirchhoff->error_estimate,
            is_shape ? "give a larger --tolerance, or more --triangles"
                     : "give a larger --tolerance, or mesh the shape with more triangles"));
    }
    return body;
}

void print_text(const Body& body, const Matrix6d& matrix, const std::optional<Vector3d>& about,
                double seconds) {
    const KirchhoffTensor& kirchhoff = *body.kirchhoff;
    print_result("{}: added mass (Kirchhoff tensor) for a fluid of density 1 kg/m^3\n\n", body.name);
    print_matrix(matrix);
    print_result("\n  {:<16}kg m^2 (l of omega), kg m (l of v, p of omega), kg (p of v)\n", "units");
    print_result("  {:<16}l, p: angular and linear momentum; omega, v: angular velocity, velocity\n",
                 "order");
    print_result("  {:<16}of the shape file\n", "axes");
    print_result("  {:<16}{}{}\n", "reference point", in_words(about.value_or(body.moments.centroid)),
                 about ? "" : ", the centroid of the volume");
    print_result("  {:<16}{:.6g} m^3, centroid {}\n", "volume", body.moments.volume,
                 in_words(body.moments.centroid));
    print_result("  {:<16}{:.2g} % (estimate), asymmetry {:.2g} %\n", "error",
                 100.0 * kirchhoff.error_estimate, 100.0 * kirchhoff.asymmetry);
    print_result("  {:<16}{}, {} triangles, {:.3g} s\n", "method", kirchhoff.method, kirchhoff.triangles,
                 seconds);
}

nlohmann::json run(const Request& request, bool json) {
    std::optional<Vector3d> about;
    if (!request.about.empty()) about = parse_point(request.about);
    if (!request.output.empty() && !is_body_file_name(request.output)) {
        throw Error(fmt::format("{}: the name of a body file must end in .body.h5", request.output));
    }
    const auto start = std::chrono::steady_clock::now();
    const Body body = solved_body(request);
    BodyNotes notes("samara kirchhoff");
    notes.add("shape", body.name, 0.0, shape_warning(body));
    notes.print();
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    if (!request.output.empty()) write_body_file(request.output, body);

    const Vector3d& centroid = body.moments.centroid;
    const Matrix6d matrix =
        about ? about_point(body.kirchhoff->matrix, centroid, *about) : body.kirchhoff->matrix;
    if (!json) print_text(body, matrix, about, seconds.count());
    nlohmann::json result = {
        {"added_mass", rows_as_json(matrix)},
        {"reference_point", as_json(about.value_or(centroid))},
        {"volume", body.moments.volume},
        {"centroid", as_json(centroid)},
        {"triangles", body.kirchhoff->triangles},
        {"error_estimate", body.kirchhoff->error_estimate},
        {"asymmetry", body.kirchhoff->asymmetry},
        {"method", body.kirchhoff->method},
        {"seconds", seconds.count()},
    };
    if (!request.output.empty()) result["output"] = request.output;
    return result;
}

}  // namespace

int kirchhoff_command(int argc, const char* const* argv) {
    Request request;
    Arguments arguments(
        "samara kirchhoff",
        "Computes the added mass of a rigid body in an unbounded ideal fluid: its 6x6 Kirchhoff tensor.");
    arguments.positional("FILE", request.file,
                         "body file (.body.h5), or any shape (.geo .stl .obj .step ...)");
    arguments.output_option("-o,--output", request.output, "body file to write, with the tensor");
    arguments.option("--thickness", request.thickness, thickness_help, 0.0, 1e12);
    arguments.option("--triangles", request.triangles,
                     "approximate number of triangles to mesh the shape with; 0: the default of samara mesh",
                     0, 100'000);
    arguments.option("--tolerance", request.tolerance,
                     "relative error that is accepted, such as 1e-3; 0: use the mesh as it is", 0.0, 1.0);
    arguments.option("--threads", request.threads,
                     "number of threads, 0: all cores; the result does not depend on it", 0, 1024);
    arguments.option("--about", request.about,
                     "x,y,z: reference point in metres, shape axes; by default the centroid of the volume");
    arguments.footer(
        "The tensor is for a fluid of 1 kg/m^3 (multiply by the density), in the axes of the shape file; "
        "angular\n"
        "velocity comes first, then velocity. A body file stores it about the centroid, whatever --about "
        "is.\n"
        "JSON: added_mass (6x6; kg m^2, kg m, kg), reference_point and centroid (m), volume (m^3), "
        "triangles,\n"
        "error_estimate and asymmetry (relative), method, seconds (with meshing), output.\n"
        "Not offered: a body near a wall, a free surface or other bodies; Capytaine solves these.\n\n"
        "Example: samara kirchhoff rubber.stl -o rubber.body.h5");
    return run_program(argc, argv, arguments, [&] { return run(request, arguments.json()); });
}

}  // namespace samara
