#include "meshes/remeshing/model_mesher.hpp"

#include <cmath>
#include <limits>

#include <gmsh.h>

#include "meshes/reading/gmsh_session.hpp"
#include "meshes/reading/gmsh_surface.hpp"
#include "samara/core/base/labelled.hpp"
#include "samara/core/surface/surface_edges.hpp"
#include "samara/core/surface/welded_surface.hpp"

namespace samara {
namespace {

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

}  // namespace

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
    // Sizes are no more than wishes: at gmsh's own 1e-9 curves take ten times as long as surfaces.
    set("Mesh.LcIntegrationPrecision", 1e-2);
}

Surface generated(const std::string& label, const std::vector<int>& tags) {
    GmshSession::generate_surface_mesh();
    return mesh_held(label, tags, 1);
}

Surface mesh_held(const std::string& label, const std::vector<int>& tags, int order) {
    Surface surface = labelled(label, [&] {
        return welded(order == 2 ? curved_surface_of_model(label, tags) : surface_of_model(label, tags));
    });
    orient_outwards(surface);
    return surface;
}

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

}  // namespace samara
