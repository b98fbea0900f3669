#include "meshes/gmsh_surface.hpp"

#include <cstdint>
#include <unordered_map>

#include <fmt/format.h>
#include <gmsh.h>

#include "samara/base/error.hpp"

namespace samara {
namespace {

// gmsh's numbers of the element types.
enum ElementType { triangle = 2, quadrangle = 3, quadratic_triangle = 9 };

using IndexOfTag = std::unordered_map<std::size_t, std::int32_t>;

IndexOfTag add_vertices(Surface& surface) {
    std::vector<std::size_t> tags;
    std::vector<double> coordinates;
    std::vector<double> parametric;
    gmsh::model::mesh::getNodes(tags, coordinates, parametric);
    IndexOfTag index;
    for (std::size_t i = 0; i < tags.size(); ++i) {
        index[tags[i]] = static_cast<std::int32_t>(i);
        surface.vertices.emplace_back(coordinates.data() + 3 * i);
    }
    return index;
}

void add_elements(Surface& surface, const IndexOfTag& index, int type, const std::vector<std::size_t>& nodes,
                  std::size_t stride) {
    for (std::size_t first = 0; first + stride <= nodes.size(); first += stride) {
        const auto node = [&](std::size_t i) { return index.at(nodes[first + i]); };
        surface.corners.push_back({node(0), node(1), node(2)});
        if (type == quadrangle) surface.corners.push_back({node(0), node(2), node(3)});
        if (type == quadratic_triangle) surface.edge_nodes.push_back({node(3), node(4), node(5)});
    }
}

}  // namespace

Surface surface_of_model(const std::string& label, const std::vector<int>& surface_tags) {
    Surface surface;
    const IndexOfTag index = add_vertices(surface);
    for (const int tag : surface_tags.empty() ? std::vector<int>{-1} : surface_tags) {
        std::vector<int> types;
        std::vector<std::vector<std::size_t>> elements;
        std::vector<std::vector<std::size_t>> nodes;
        gmsh::model::mesh::getElements(types, elements, nodes, 2, tag);
        for (std::size_t i = 0; i < types.size(); ++i) {
            if (types[i] != triangle && types[i] != quadrangle && types[i] != quadratic_triangle) {
                throw Error(
                    fmt::format("{}: holds surface elements of gmsh's type {}; use triangles of order 1 or 2",
                                label, types[i]));
            }
            if (!elements[i].empty()) {
                add_elements(surface, index, types[i], nodes[i], nodes[i].size() / elements[i].size());
            }
        }
    }
    if (surface.order() == 2 && surface.edge_nodes.size() != surface.corners.size()) {
        throw Error(fmt::format("{}: mixes elements of order 1 and 2; use one order", label));
    }
    return surface;
}

}  // namespace samara
