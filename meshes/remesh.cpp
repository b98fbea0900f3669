#include "meshes/remesh.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmsh.h>

#include "meshes/gmsh_session.hpp"
#include "meshes/gmsh_surface.hpp"
#include "meshes/mesh_size_field.hpp"
#include "meshes/surface_check.hpp"
#include "meshes/volume_moments.hpp"
#include "samara/base/error.hpp"
#include "samara/body/curved_surface.hpp"
#include "samara/body/surface_edges.hpp"

namespace samara {
namespace {

constexpr int most_attempts = 6;
constexpr double good_count = 0.03;  // relative: nearer than this needs no further attempt
constexpr double unlimited = 1e22;   // gmsh's own default for the largest size

void set(const char* option, double value) {
    gmsh::option::setNumber(option, value);
}

// A .geo file may set any of these for itself.
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
}

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

Surface oriented(const Surface& surface, const std::string& label) {
    Surface result = welded(surface, label);
    orient_outwards(result);
    return result;
}

// A mesh of the geometry, welded and turned outwards.
Surface generate(const std::string& label, const std::vector<int>& tags, int order) {
    gmsh::model::mesh::clear();
    gmsh::model::mesh::generate(2);
    return oriented(order == 2 ? curved_surface_of_model(label, tags) : surface_of_model(label, tags), label);
}

// What the sizes are measured on: fine enough to see curvature, coarse enough to be quick.
Surface reference_of_geometry(const std::string& label, const std::vector<int>& tags) {
    double low[3];
    double high[3];
    gmsh::model::getBoundingBox(-1, -1, low[0], low[1], low[2], high[0], high[1], high[2]);
    const double diagonal = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
    set("Mesh.MeshSizeMax", diagonal / 25);
    set("Mesh.MeshSizeMin", diagonal / 1000);
    set("Mesh.MeshSizeFromCurvature", 24);
    Surface reference = generate(label, tags, 1);
    forget_sizes_of_file();
    return reference;
}

using Mesher = std::function<Surface(int order)>;

Surface mesh_with_size(const MeshSizeField& field, double size, int order, const Mesher& mesher) {
    gmsh::model::mesh::setSizeCallback(
        [&](int, int, double x, double y, double z) { return size * field(Vector3d(x, y, z)); });
    Surface surface = mesher(order);
    gmsh::model::mesh::removeSizeCallback();
    return surface;
}

double count_error(const Surface& surface, double wanted) {
    return std::abs(std::log(static_cast<double>(surface.triangle_count()) / wanted));
}

// The size for which the mesher makes about `wanted` triangles.
double size_for_count(const MeshSizeField& field, int wanted, const Mesher& mesher) {
    // gmsh makes about a sixth more triangles than equilateral ones would be.
    double size = std::sqrt(1.17 * field.triangle_count(1.0) / wanted);
    double best_size = size;
    double best_error = std::numeric_limits<double>::infinity();
    for (int attempt = 0; attempt < most_attempts && best_error > good_count; ++attempt) {
        const Surface surface = mesh_with_size(field, size, 1, mesher);
        if (count_error(surface, wanted) < best_error) {
            best_error = count_error(surface, wanted);
            best_size = size;
        }
        size *= std::sqrt(static_cast<double>(surface.triangle_count()) / wanted);
    }
    return best_size;
}

// `size` of the options is in the units of the model.
Surface mesh_model(const Surface& reference, const MeshOptions& options, double size, const Mesher& mesher) {
    const MeshSizeField field(reference);
    if (options.sizing == MeshOptions::Sizing::triangles) {
        size = size_for_count(field, options.triangles, mesher);
    }
    return mesh_with_size(field, size, options.order, mesher);
}

void scale_vertices(Surface& surface, double scale) {
    for (Vector3d& vertex : surface.vertices) vertex *= scale;
}

void add_discrete_surface(const Surface& surface) {
    gmsh::model::add("remesh");
    gmsh::model::addDiscreteEntity(2, 1);
    std::vector<std::size_t> tags(surface.vertices.size());
    std::iota(tags.begin(), tags.end(), std::size_t{1});
    std::vector<double> coordinates;
    for (const Vector3d& vertex : surface.vertices) {
        coordinates.insert(coordinates.end(), vertex.data(), vertex.data() + 3);
    }
    gmsh::model::mesh::addNodes(2, 1, tags, coordinates);
    std::vector<std::size_t> corners;
    for (const auto& triangle : surface.corners) {
        for (const std::int32_t vertex : triangle) corners.push_back(static_cast<std::size_t>(vertex) + 1);
    }
    constexpr int triangle_type = 2;
    gmsh::model::mesh::addElementsByType(1, triangle_type, {}, corners);
}

// The surface with edge nodes on the triangles that it was made of.
Surface with_nodes_on(const Surface& original, const Surface& surface) {
    const TriangleTree tree(original.vertices, original.corners);
    Surface result = with_straight_edge_nodes(surface);
    for (const auto& nodes : result.edge_nodes) {
        for (const std::int32_t node : nodes) {
            Vector3d& vertex = result.vertices[static_cast<std::size_t>(node)];
            vertex = tree.nearest(vertex).point;
        }
    }
    return result;
}

// The relative change of the volume: coarse chords lose some of a curved body, a lost crease or part more.
double volume_change(const Surface& before, const Surface& after) {
    const double volume = volume_moments(before).volume;
    return std::abs(volume_moments(after).volume - volume) / volume;
}

Surface remesh_cut_at(double angle, const Surface& flat, const MeshOptions& options,
                      const std::string& label) {
    const GmshSession session;
    Surface result;
    GmshSession::run(label, "gmsh cannot remesh it; use --keep, which takes its triangles as they are", [&] {
        add_discrete_surface(flat);
        constexpr bool cut_at_edges = true;
        constexpr bool cut_for_parametrisation = true;
        gmsh::model::mesh::classifySurfaces(angle, cut_at_edges, cut_for_parametrisation, std::numbers::pi);
        gmsh::model::mesh::createGeometry();
        forget_sizes_of_file();
        const auto mesher = [&](int) {
            gmsh::model::mesh::generate(2);
            return oriented(surface_of_model(label), label);
        };
        result = mesh_model(flat, options, options.size, mesher);
    });
    try {
        require_sound_surface(result, label);
    } catch (const Error& fault) {
        // The remedies for a file's own faults do not help here.
        const std::string text = fault.what();
        throw Error(fmt::format("{} after remeshing; use more triangles, or --keep",
                                text.substr(0, text.rfind("; "))));
    }
    return result;
}

}  // namespace

Surface mesh_geometry(const std::filesystem::path& file, const MeshOptions& options) {
    const std::string label = file.string();
    const GmshSession session;
    gmsh::option::setString("Geometry.OCCTargetUnit", "M");
    GmshSession::open(label);
    Surface surface;
    GmshSession::run(label, "gmsh cannot mesh it", [&] {
        const std::vector<int> tags = outer_surfaces(label);
        if (options.sizing == MeshOptions::Sizing::keep) {
            surface = generate(label, tags, options.order);
            return;
        }
        forget_sizes_of_file();
        const auto mesher = [&](int order) { return generate(label, tags, order); };
        const Surface reference = reference_of_geometry(label, tags);
        require_sound_surface(reference, label);
        surface = mesh_model(reference, options, options.size / options.scale, mesher);
    });
    require_sound_surface(surface, label);
    scale_vertices(surface, options.scale);
    return surface;
}

Surface remesh(const Surface& surface, const MeshOptions& options, const std::string& label) {
    const Surface flat = surface.order() == 1 ? surface : welded(flattened(surface, 2), label);
    // Thin bodies with shallow folds need these as edges; on coarse curved ones that would keep every facet.
    constexpr std::array<double, 2> cutting_angles = {sharp_angle, sharp_angle / 4.0};
    constexpr double good_change = 0.03;
    constexpr double most_change = 0.15;
    std::optional<Surface> best;
    std::optional<Error> fault;
    double smallest_change = std::numeric_limits<double>::infinity();
    for (const double angle : cutting_angles) {
        try {
            Surface result = remesh_cut_at(angle, flat, options, label);
            const double change = volume_change(flat, result);
            if (change < smallest_change) {
                smallest_change = change;
                best = std::move(result);
            }
        } catch (const Error& reason) {
            if (!fault) fault = reason;
        }
        if (smallest_change < good_change) break;
    }
    if (!best) throw *fault;
    if (smallest_change > most_change) {
        throw Error(fmt::format("{}: remeshing changed the volume by {:.0f} %; use more triangles, or --keep",
                                label, 100.0 * smallest_change));
    }
    return options.order == 2 ? with_nodes_on(flat, *best) : *best;
}

}  // namespace samara
