#include "meshes/remeshing/mesh_geometry.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmsh.h>

#include "internal/base/content_hash.hpp"
#include "internal/base/labelled.hpp"
#include "internal/body/curved_surface.hpp"
#include "meshes/checks/sound_surface.hpp"
#include "meshes/reading/confined_surface.hpp"
#include "meshes/reading/gmsh_session.hpp"
#include "meshes/reading/script_check.hpp"
#include "meshes/reading/shape_format.hpp"
#include "meshes/remeshing/mesh_size_field.hpp"
#include "meshes/remeshing/model_mesher.hpp"
#include "samara/base/error.hpp"

namespace samara {
namespace {

using ProgressCall = std::function<void(double)>;

// Tags of the surfaces between matter and fluid.
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

// What the sizes are measured on: fine enough to see curvature, coarse enough to be quick.
Surface reference_of_geometry(const std::string& label, const std::vector<int>& tags) {
    double low[3];
    double high[3];
    gmsh::model::getBoundingBox(-1, -1, low[0], low[1], low[2], high[0], high[1], high[2]);
    const double diagonal = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
    gmsh::option::setNumber("Mesh.MeshSizeMax", diagonal / 25);
    gmsh::option::setNumber("Mesh.MeshSizeMin", diagonal / 1000);
    gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", 24);
    Surface reference = generated(label, tags);
    forget_sizes_of_file();
    return reference;
}

Surface meshed_by_gmsh(const std::string& label, ShapeFormat format, const MeshOptions& options,
                       const ProgressCall& tell) {
    const GmshSession session;
    double enlarged = 1.0;
    if (format == ShapeFormat::script) {
        gmsh::option::setString("Geometry.OCCTargetUnit", "M");  // of the files that it merges
        GmshSession::open(label);
    } else {
        enlarged = GmshSession::import_shapes(label, format == ShapeFormat::step ? "step" : "brep");
    }
    const auto in_units_of_file = [&](Surface meshed) {
        for (Vector3d& vertex : meshed.vertices) vertex /= enlarged;
        return meshed;
    };
    Surface surface;
    GmshSession::run(label, "gmsh cannot mesh it", [&] {
        const std::vector<int> tags = outer_surfaces(label);
        if (options.sizing == MeshOptions::Sizing::keep) {
            GmshSession::generate_surface_mesh();
        } else {
            forget_sizes_of_file();
            const Surface reference = reference_of_geometry(label, tags);
            labelled(label, [&] { require_sound_surface(in_units_of_file(reference)); });
            tell(0.2);
            mesh_model(MeshSizeField(reference), options, options.size / options.scale * enlarged, tags);
        }
        tell(0.8);
        surface = in_units_of_file(mesh_held(label, tags, options.order == 1 ? 1 : 2));
    });
    return surface;
}

}  // namespace

Surface mesh_geometry(const std::filesystem::path& file, const MeshOptions& options,
                      const ProgressCall& progress) {
    const std::string label = file.string();
    const ShapeFormat format = shape_format(file);
    require_beginning(file, format);
    if (format == ShapeFormat::script) require_shape_script(read_bytes(file), label);
    Surface surface = confined_surface(
        file, options.time_limit,
        [&](const ProgressCall& tell) { return meshed_by_gmsh(label, format, options, tell); }, progress);
    if (options.order == automatic_order) straighten_overturned(surface);
    const bool flat = options.order == 1 || (options.order == automatic_order && has_straight_edges(surface));
    if (flat && surface.order() == 2) surface = without_edge_nodes(surface);
    labelled(label, [&] { require_sound_surface(surface); });
    for (Vector3d& vertex : surface.vertices) vertex *= options.scale;
    return surface;
}

}  // namespace samara
