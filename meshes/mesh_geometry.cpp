#include "meshes/mesh_geometry.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmsh.h>

#include "meshes/gmsh_session.hpp"
#include "meshes/mesh_size_field.hpp"
#include "meshes/model_mesher.hpp"
#include "meshes/surface_check.hpp"
#include "samara/base/error.hpp"
#include "samara/body/curved_surface.hpp"

namespace samara {
namespace {

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

}  // namespace

Surface mesh_geometry(const std::filesystem::path& file, const MeshOptions& options,
                      const std::function<void(double)>& progress) {
    const auto tell = [&](double share) {
        if (progress) progress(share);
    };
    const std::string label = file.string();
    const GmshSession session;
    gmsh::option::setString("Geometry.OCCTargetUnit", "M");
    GmshSession::open(label);
    Surface surface;
    GmshSession::run(label, "gmsh cannot mesh it", [&] {
        const std::vector<int> tags = outer_surfaces(label);
        if (options.sizing == MeshOptions::Sizing::keep) {
            GmshSession::generate_surface_mesh();
        } else {
            forget_sizes_of_file();
            const Surface reference = reference_of_geometry(label, tags);
            require_sound_surface(reference, label);
            tell(0.2);
            mesh_model(MeshSizeField(reference, size_law(options.order)), options,
                       options.size / options.scale, tags);
        }
        tell(0.8);
        surface = mesh_held(label, tags, options.order == 1 ? 1 : 2);
    });
    if (options.order == automatic_order) straighten_overturned(surface);
    const bool flat = options.order == 1 || (options.order == automatic_order && has_straight_edges(surface));
    if (flat && surface.order() == 2) surface = without_edge_nodes(surface);
    require_sound_surface(surface, label);
    for (Vector3d& vertex : surface.vertices) vertex *= options.scale;
    return surface;
}

}  // namespace samara
