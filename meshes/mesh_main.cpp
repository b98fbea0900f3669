// samara-mesh: a shape file -> a body file with its checked surface, volume moments and symmetry.

#include <chrono>
#include <string>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "meshes/make_body.hpp"
#include "meshes/symmetry/symmetry.hpp"
#include "samara/analysis/advice/input_warnings.hpp"
#include "samara/commands/shared/arguments.hpp"
#include "samara/commands/shared/body_notes.hpp"
#include "samara/commands/shared/load_body.hpp"
#include "samara/commands/shared/print.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/body/body_file.hpp"

namespace {

using samara::Body;
using samara::MeshOptions;

nlohmann::json rows(const samara::Matrix3d& matrix) {
    nlohmann::json result = nlohmann::json::array();
    for (int row = 0; row < 3; ++row) result.push_back({matrix(row, 0), matrix(row, 1), matrix(row, 2)});
    return result;
}

nlohmann::json summary(const Body& body, const std::string& output, double seconds) {
    const samara::VolumeMoments& moments = body.moments;
    return {{"body", output},
            {"triangles", body.surface.triangle_count()},
            {"vertices", body.surface.vertices.size()},
            {"order", body.surface.order()},
            {"volume", moments.volume},
            {"centroid", {moments.centroid.x(), moments.centroid.y(), moments.centroid.z()}},
            {"surface_area", moments.surface_area},
            {"second_moments", rows(moments.second_moments)},
            {"symmetry",
             {{"kind", samara::name_of(body.symmetry.type)},
              {"elements", body.symmetry.elements.size()},
              {"tolerance", body.symmetry.tolerance}}},
            {"shape_error",
             {{"distance", body.shape_error->distance},
              {"volume", body.shape_error->volume},
              {"area", body.shape_error->area},
              {"faceting", body.shape_error->faceting}}},
            {"seconds", seconds}};
}

void print_for_people(const Body& body, const MeshOptions& options, const std::string& output,
                      double seconds) {
    Eigen::AlignedBox3d box;
    for (const samara::Vector3d& vertex : body.surface.vertices) box.extend(vertex);
    const samara::Vector3d size = box.sizes();
    const samara::VolumeMoments& moments = body.moments;
    samara::print_result("{}: {} triangles of order {}, {} vertices, in {:.2f} s\n", output,
                         body.surface.triangle_count(), body.surface.order(), body.surface.vertices.size(),
                         seconds);
    const auto count = static_cast<double>(body.surface.triangle_count());
    if (options.sizing == MeshOptions::Sizing::triangles && count > 1.15 * options.triangles) {
        samara::print_result("  warning   {} triangles were requested; the shape's edges need more\n",
                             options.triangles);
    }
    samara::print_result("  extent    {:.5g} x {:.5g} x {:.5g} m\n", size.x(), size.y(), size.z());
    samara::print_result("  volume    {:.6g} m^3 (of this surface)\n", moments.volume);
    samara::print_result(
        "  deviation {:+.2f} % of volume, at most {:.2f} % of the size (mesh against file)\n",
        100.0 * body.shape_error->volume, 100.0 * body.shape_error->distance);
    samara::print_result("  area      {:.6g} m^2\n", moments.surface_area);
    samara::print_result("  centroid  ({:.5g}, {:.5g}, {:.5g}) m\n", moments.centroid.x(),
                         moments.centroid.y(), moments.centroid.z());
    samara::print_result("  symmetry  {} (within {:.2g} of the size)\n", samara::describe(body.symmetry),
                         body.symmetry.tolerance);
}

MeshOptions::Sizing sizing_of(const samara::Arguments& arguments, bool keep) {
    const bool by_size = arguments.given("--size");
    if (static_cast<int>(arguments.given("--triangles")) + static_cast<int>(by_size) +
            static_cast<int>(keep) >
        1) {
        throw samara::Error("--triangles, --size and --keep exclude each other; give one of them");
    }
    if (keep) return MeshOptions::Sizing::keep;
    return by_size ? MeshOptions::Sizing::size : MeshOptions::Sizing::triangles;
}

}  // namespace

int main(int argc, char** argv) {
    std::string shape;
    std::string output;
    std::string order = "automatic";
    bool keep = false;
    MeshOptions options;
    samara::Arguments arguments("samara mesh",
                                "Makes a body file from a shape: checked surface, volume, symmetry.");
    arguments.positional(
        "SHAPE", shape,
        "geometry (.geo .step .stp .brep) or triangles (.stl .obj .ply .off .glb .gltf .3mf .msh "
        ".body.h5)");
    arguments.required_output_option("-o,--output", output, "the body file to write, NAME.body.h5");
    arguments.option("--triangles", options.triangles, "approximate number of triangles", 4, 10'000'000);
    arguments.option("--size", options.size,
                     "edge length of the triangles (m) where the body is flat; smaller elsewhere", 1e-12,
                     1e12);
    arguments.flag("--keep", keep, "keep the triangles of the file; for geometry, the sizes set in the file");
    arguments.choice("--order", order, {"automatic", "1", "2"},
                     "1: flat triangles; 2: curved triangles with nodes on the edges; automatic: 2 if the "
                     "body has curved faces (--keep: as in the file)");
    arguments.option("--scale", options.scale,
                     "size of the file's unit, m (STEP and 3MF state their unit: keep 1)", 1e-12, 1e12);
    arguments.option("--thickness", options.thickness, samara::thickness_help, 0.0, 1e12);
    arguments.option("--time-limit", options.time_limit,
                     "limit of the CPU time to read and mesh the shape, s", 1.0, 1e9);
    arguments.flag("--flip", options.flip, "reverse all triangles, for a surface that is inside out");
    arguments.footer(
        "The surface must be closed, or a sheet with --thickness. Triangles are smaller on curved parts and "
        "near edges.\n"
        "Example: samara mesh meshes/shapes/ellipsoid.geo -o ellipsoid.body.h5 --triangles 1280");
    return samara::run_program(argc, argv, arguments, [&] {
        const auto start = std::chrono::steady_clock::now();
        options.sizing = sizing_of(arguments, keep);
        options.as_many_as_needed = !arguments.given("--triangles") && !arguments.given("--size");
        options.order = order == "automatic" ? samara::automatic_order : std::stoi(order);
        if (!samara::is_body_file_name(output)) {
            throw samara::Error(fmt::format("{}: the output is a body file; name it NAME.body.h5", output));
        }
        const Body body = [&] {
            samara::Progress progress("meshing " + shape, "percent");
            return samara::make_body(shape, options,
                                     [&](double share) { progress.update(100.0 * share, 100.0); });
        }();
        samara::write_body_file(output, body);
        samara::BodyNotes notes("samara mesh");
        notes.add("units", body.name, 0.0, samara::size_warnings(body, samara::ScaleRemedy::option));
        notes.add("shape", body.name, 0.0, samara::shape_warning(body));
        notes.print();
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        if (!arguments.json()) print_for_people(body, options, output, elapsed.count());
        return summary(body, output, elapsed.count());
    });
}
