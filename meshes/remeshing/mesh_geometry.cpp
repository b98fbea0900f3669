#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmsh.h>

#include "meshes/checks/shape_error.hpp"
#include "meshes/checks/sound_surface.hpp"
#include "meshes/reading/gmsh_session.hpp"
#include "meshes/reading/shape_reader.hpp"
#include "meshes/remeshing/mesh_size_field.hpp"
#include "meshes/remeshing/remesh.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/files/input_file.hpp"
#include "samara/core/surface/curved_surface.hpp"
#include "samara/core/surface/surface_edges.hpp"
#include "samara/core/surface/welded_surface.hpp"

namespace samara {
namespace {

using ProgressCall = std::function<void(double)>;

constexpr int most_attempts = 6;
constexpr double good_count = 0.05;  // relative: nearer than this needs no further attempt
constexpr double unlimited = 1e22;   // gmsh's own default for the largest size

void set(const char* option, double value) {
    gmsh::option::setNumber(option, value);
}

void generate_with_size(const MeshSizeField& field, double size) {
    gmsh::model::mesh::setSizeCallback(
        [&](int, int, double x, double y, double z) { return size * field(Vector3d(x, y, z)); });
    GmshSession::generate_surface_mesh();
    gmsh::model::mesh::removeSizeCallback();
}

std::size_t triangle_count(const std::vector<int>& tags) {
    std::size_t count = 0;
    for (const int tag : tags.empty() ? std::vector<int>{-1} : tags) {
        std::vector<int> types;
        std::vector<std::vector<std::size_t>> elements;
        std::vector<std::vector<std::size_t>> nodes;
        gmsh::model::mesh::getElements(types, elements, nodes, 2, tag);
        for (const std::vector<std::size_t>& list : elements) count += list.size();
    }
    return count;
}

// Sets the options of the current GmshSession that meshing anew starts from, whatever a .geo file has set.
void forget_sizes_of_file() {
    set("Mesh.Algorithm", 6);  // frontal Delaunay: the best triangles
    set("Mesh.ElementOrder", 1);
    set("Mesh.RecombineAll", 0);
    set("Mesh.SubdivisionAlgorithm", 0);
    set("Mesh.MeshSizeFactor", 1);
    set("Mesh.MeshSizeMin", 0);
    set("Mesh.MeshSizeMax", unlimited);
    set("Mesh.MeshSizeFromPoints", 0);
    set("Mesh.MeshSizeFromCurvature", 0);
    set("Mesh.MeshSizeExtendFromBoundary", 0);
    // Sizes need not be exact: at gmsh's default of 1e-9 curves take ten times as long as surfaces.
    set("Mesh.LcIntegrationPrecision", 1e-2);
}

// The mesh that gmsh holds of the surfaces with these tags (all, where none are given): welded, turned
// outwards, of order 1, or of order 2 with nodes on the geometry.
Surface mesh_held(const std::string& label, const std::vector<int>& tags, int order) {
    Surface surface = labelled(label, [&] {
        return welded(order == 2 ? curved_surface_of_model(label, tags) : surface_of_model(label, tags));
    });
    orient_outwards(surface);
    return surface;
}

// Has gmsh mesh the surfaces anew and returns mesh_held() of order 1.
Surface generated(const std::string& label, const std::vector<int>& tags) {
    GmshSession::generate_surface_mesh();
    return mesh_held(label, tags, 1);
}

// Has gmsh mesh the model with sizes by the field: `size` (units of the model) where they are largest, or,
// with Sizing::triangles, as it takes for about options.triangles triangles; `size` is not used then.
void mesh_model(const MeshSizeField& field, const MeshOptions& options, double size,
                const std::vector<int>& tags) {
    if (options.sizing != MeshOptions::Sizing::triangles) {
        generate_with_size(field, size);
        return;
    }
    // gmsh makes about a sixth more triangles than equilateral ones would be.
    double next = std::sqrt(1.17 * field.triangle_count(1.0) / options.triangles);
    double best = next;
    double smallest_error = std::numeric_limits<double>::infinity();
    for (int attempt = 0; attempt < most_attempts; ++attempt) {
        generate_with_size(field, next);
        const double ratio = static_cast<double>(triangle_count(tags)) / options.triangles;
        const double error = std::abs(std::log(ratio));
        if (error < good_count) return;
        if (error < smallest_error) {
            smallest_error = error;
            best = next;
        }
        next *= std::sqrt(ratio);
    }
    generate_with_size(field, best);
}

// The limit of miss_of() where the number or size of triangles is given: 15 % of the volume.
constexpr double most_missed_where_asked = 30.0;

// Returns the tags of the surfaces between body and fluid.
std::vector<int> outer_surfaces(const std::string& label) {
    gmsh::vectorpair entities;
    gmsh::model::getEntities(entities, 3);
    if (entities.empty()) {
        gmsh::model::getEntities(entities, 2);
    } else {
        gmsh::vectorpair boundary;
        constexpr bool without_shared_faces = true;
        gmsh::model::getBoundary(entities, boundary, without_shared_faces, false, false);
        entities = boundary;
    }
    std::vector<int> tags;
    for (const auto& [dimension, tag] : entities) tags.push_back(tag);
    if (tags.empty()) {
        throw Error(
            fmt::format("{}: holds no surface; give the body as a volume or as a closed surface", label));
    }
    return tags;
}

constexpr double finest = 1000.0;  // triangles across the body

// Returns the mesh on which sizes are measured: fine enough to resolve curvature, coarse enough to be quick.
Surface reference_of_geometry(const std::string& label, const std::vector<int>& tags) {
    double low[3];
    double high[3];
    gmsh::model::getBoundingBox(-1, -1, low[0], low[1], low[2], high[0], high[1], high[2]);
    const double diagonal = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
    gmsh::option::setNumber("Mesh.MeshSizeMax", diagonal / 25);
    gmsh::option::setNumber("Mesh.MeshSizeMin", diagonal / finest);
    gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", 24);
    Surface reference = generated(label, tags);
    forget_sizes_of_file();
    return reference;
}

// Returns the mesh that gmsh holds, of the order that is asked for; overturned curved triangles are made
// straight.
Surface held_in_order(const std::string& label, const std::vector<int>& tags, int order) {
    Surface surface = mesh_held(label, tags, order == 1 ? 1 : 2);
    if (order != 1) straighten_overturned(surface);
    const bool flat = order == 1 || (order == automatic_order && has_straight_edges(surface));
    return flat && surface.order() == 2 ? without_edge_nodes(surface) : surface;
}

// Returns the mesh, and the finer one of order 2 that it was compared with.
std::vector<Surface> meshed_by_gmsh(const std::string& label, ShapeFormat format, const MeshOptions& options,
                                    const ProgressCall& tell) {
    constexpr int most_times_finer = 8;
    constexpr double equilateral_ones = 1.0 / 1.17;
    constexpr double most_needed = 20000.0;
    const GmshSession session;
    double enlarged = 1.0;
    if (format == ShapeFormat::script) {
        gmsh::option::setString("Geometry.OCCTargetUnit",
                                "M");  // applies to the files that the script merges
        GmshSession::open(label);
    } else {
        enlarged = GmshSession::import_shapes(label, format == ShapeFormat::step ? "step" : "brep");
    }
    const auto in_units_of_file = [&](Surface meshed) {
        for (Vector3d& vertex : meshed.vertices) vertex /= enlarged;
        return meshed;
    };
    Surface surface;
    Surface shape;
    GmshSession::run(label, "gmsh cannot mesh it", [&] {
        const std::vector<int> tags = outer_surfaces(label);
        if (options.sizing == MeshOptions::Sizing::keep) {
            GmshSession::generate_surface_mesh();
            surface = in_units_of_file(held_in_order(label, tags, options.order));
            tell(0.4);
        }
        forget_sizes_of_file();
        const Surface reference = reference_of_geometry(label, tags);
        labelled(label, [&] { require_sound_surface(in_units_of_file(reference)); });
        shape = in_units_of_file(mesh_held(label, tags, 2));
        straighten_overturned(shape);
        tell(0.5);
        if (options.sizing == MeshOptions::Sizing::keep) return;
        const MeshSizeField field(reference);
        MeshOptions sizes = options;
        sizes.size *= enlarged / options.scale;
        if (options.as_many_as_needed) {
            // gmsh takes long, so that meshing starts with the number that the curvature needs.
            const double needed = equilateral_ones * field.triangle_count(field.size_for_curvature());
            sizes.triangles = static_cast<int>(std::clamp(needed, 1.0 * options.triangles, most_needed));
        }
        for (int finer = 1; finer <= most_times_finer; finer *= 2) {
            mesh_model(field, sizes, sizes.size, tags);
            surface = in_units_of_file(held_in_order(label, tags, options.order));
            tell(0.5 + 0.5 * finer / most_times_finer);
            if (!options.as_many_as_needed || miss_of(shape_error(shape, surface)) <= 1.0) break;
            sizes.triangles *= 2;
        }
    });
    return {std::move(surface), std::move(shape)};
}

}  // namespace

MeshedShape mesh_geometry(const std::filesystem::path& file, const MeshOptions& options,
                          const ProgressCall& progress) {
    const std::string label = file.string();
    const ShapeFormat format = shape_format(file);
    require_beginning(file, format);
    if (format == ShapeFormat::script) require_shape_script(read_at_most(file, most_mesh_bytes), label);
    std::vector<Surface> surfaces = confined_surfaces(
        file, 2, options.time_limit,
        [&](const ProgressCall& tell) { return meshed_by_gmsh(label, format, options, tell); }, progress);
    MeshedShape meshed{std::move(surfaces.front()), {}};
    labelled(label, [&] { require_sound_surface(meshed.surface); });
    for (Surface* const surface : {&meshed.surface, &surfaces.back()}) {
        for (Vector3d& vertex : surface->vertices) vertex *= options.scale;
    }
    meshed.error = shape_error(surfaces.back(), meshed.surface);
    const bool asked = !options.as_many_as_needed || options.sizing == MeshOptions::Sizing::keep;
    if (miss_of(meshed.error) > (asked ? most_missed_where_asked : 1.0)) {
        throw Error(
            fmt::format("{}: its mesh of {} triangles deviates by {:.2g} % in volume and by {:.2g} % of its "
                        "size in the surface; use more triangles, such as --triangles {}",
                        label, meshed.surface.triangle_count(), 100.0 * meshed.error.volume,
                        100.0 * meshed.error.distance, 4 * meshed.surface.triangle_count()));
    }
    return meshed;
}

}  // namespace samara
