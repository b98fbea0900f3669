#include "meshes/make_body.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "meshes/checks/shape_error.hpp"
#include "meshes/checks/sound_surface.hpp"
#include "meshes/reading/gmsh_session.hpp"
#include "meshes/reading/shape_reader.hpp"
#include "meshes/reading/thickened_sheet.hpp"
#include "meshes/remeshing/remesh.hpp"
#include "meshes/symmetry/image_comparison.hpp"
#include "meshes/symmetry/symmetry.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/body/body_check.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/surface/curved_surface.hpp"
#include "samara/core/surface/mended_surface.hpp"
#include "samara/core/surface/surface_edges.hpp"

namespace samara {
namespace {

void require_sane(const MeshOptions& options, const std::string& label) {
    const auto require = [&](bool sane, const char* what) {
        if (!sane) throw Error(fmt::format("{}: {}", label, what));
    };
    require(std::isfinite(options.scale) && options.scale > 0.0, "the scale must be positive");
    require(std::isfinite(options.thickness) && options.thickness >= 0.0,
            "the thickness must be zero or positive");
    require(options.order == automatic_order || options.order == 1 || options.order == 2,
            "the order must be 1 or 2");
    require(options.sizing != MeshOptions::Sizing::triangles || options.triangles >= 4,
            "the number of triangles must be at least 4");
    require(
        options.sizing != MeshOptions::Sizing::size || (std::isfinite(options.size) && options.size > 0.0),
        "the size of triangles must be positive");
}

Surface in_order(const Surface& surface, int order) {
    if (order == automatic_order || surface.order() == order) return surface;
    return order == 2 ? with_straight_edge_nodes(surface) : without_edge_nodes(surface);
}

using ProgressCall = std::function<void(double)>;

// Shares of the computing time, measured with a million triangles, up to the end of each stage.
constexpr double triangles_read = 0.03;
constexpr double triangles_welded = 0.12;
constexpr double triangles_checked = 0.45;
constexpr double triangles_meshed = 0.95;
constexpr double geometry_meshed = 0.9;

void tell(const ProgressCall& progress, double share) {
    if (progress) progress(share);
}

Surface sound_triangles(const std::filesystem::path& shape, const MeshOptions& options,
                        const ProgressCall& progress) {
    const std::string label = shape.string();
    const Surface read = read_triangles(shape, shape_format(shape), options.time_limit);
    tell(progress, triangles_read);
    Surface surface = labelled(label, [&] { return mended(read); });
    tell(progress, triangles_welded);
    if (options.flip) {
        for (std::size_t t = 0; t < surface.triangle_count(); ++t) reverse_triangle(surface, t);
    }
    if (options.thickness > 0.0) {
        surface = labelled(label, [&] { return thickened(surface, options.thickness / options.scale); });
    }
    // Before scaling: errors name places as the file has them.
    surface = labelled(label, [&] { return with_parts_joined(surface); });
    labelled(label, [&] { require_sound_surface(surface); });
    tell(progress, triangles_checked);
    for (Vector3d& vertex : surface.vertices) vertex *= options.scale;
    return surface;
}

void mesh_triangles(Body& body, const std::filesystem::path& shape, const MeshOptions& options,
                    const ProgressCall& progress) {
    const Surface original = sound_triangles(shape, options, progress);
    const auto meshing = [&](double share) {
        tell(progress, triangles_checked + share * (triangles_meshed - triangles_checked));
    };
    if (options.sizing == MeshOptions::Sizing::keep) {
        body.surface = in_order(original, options.order);
        body.shape_error = shape_error(original, body.surface);
        body.shape_error->faceting = original.order() == 1 ? smoothing_of(original).between : 0.0;
    } else {
        MeshedShape meshed = remesh(original, options, shape.string(), meshing);
        body.surface = std::move(meshed.surface);
        body.shape_error = meshed.error;
    }
    body.moments = volume_moments(body.surface);
    // New triangles follow the facets of the old ones and cut off their corners.
    const double tolerance =
        std::max(default_symmetry_tolerance, 2.0 * faceting(original, body.moments.centroid));
    body.symmetry = find_symmetry(body.surface, body.moments, tolerance);
}

void mesh_exact_geometry(Body& body, const std::filesystem::path& shape, const MeshOptions& options,
                         const ProgressCall& progress) {
    if (options.flip) {
        throw Error(
            fmt::format("{}: exact geometry is always oriented outwards; leave --flip out", shape.string()));
    }
    if (options.thickness > 0.0) {
        throw Error(
            fmt::format("{}: only sheets of triangles can be thickened; export the sheet as .stl or .obj",
                        shape.string()));
    }
    MeshedShape meshed =
        mesh_geometry(shape, options, [&](double share) { tell(progress, geometry_meshed * share); });
    body.surface = std::move(meshed.surface);
    body.shape_error = meshed.error;
    body.moments = volume_moments(body.surface);
    body.symmetry = find_symmetry(body.surface, body.moments);
}

std::string source_line(const std::filesystem::path& shape, const MeshOptions& options, int order) {
    std::string sizes = "kept triangles";
    if (options.sizing == MeshOptions::Sizing::triangles)
        sizes = fmt::format("{} triangles", options.triangles);
    if (options.sizing == MeshOptions::Sizing::size) sizes = fmt::format("size {} m", options.size);
    std::string line =
        fmt::format("{} (xxh128 {}), {}, order {}, scale {}{}", shape.filename().string(),
                    file_content_hash(shape), sizes, order, options.scale, options.flip ? ", flipped" : "");
    if (options.thickness > 0.0) line += fmt::format(", thickness {} m", options.thickness);
    if (is_read_by_gmsh(shape_format(shape))) line += ", gmsh " + gmsh_version();
    return line;
}

}  // namespace

Body make_body(const std::filesystem::path& shape, const MeshOptions& options,
               const std::function<void(double)>& progress) {
    require_sane(options, shape.string());
    Body body;
    body.name = body_name_of(shape);
    if (is_geometry(shape_format(shape))) {
        mesh_exact_geometry(body, shape, options, progress);
    } else {
        mesh_triangles(body, shape, options, progress);
    }
    body.source = source_line(shape, options, body.surface.order());
    if (const std::string error = error_of(body); !error.empty()) {
        throw Error(
            fmt::format("{}: {}; give the size of the file's unit in metres: 'samara mesh --scale', or scale "
                        "beside its shape in a scene",
                        shape.string(), error));
    }
    return body;
}

}  // namespace samara
