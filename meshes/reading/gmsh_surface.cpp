#include "meshes/reading/gmsh_surface.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>

#include <Eigen/Cholesky>
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

// Places of points on one surface of the geometry.
class SurfaceProjection {
  public:
    explicit SurfaceProjection(int tag) : tag_(tag) {
        std::vector<std::size_t> tags;
        std::vector<double> coordinates;
        std::vector<double> parameters;
        constexpr bool with_boundary = true;
        constexpr bool with_parameters = true;
        gmsh::model::mesh::getNodes(tags, coordinates, parameters, 2, tag, with_boundary, with_parameters);
        for (std::size_t i = 0; i < tags.size() && 2 * i + 1 < parameters.size(); ++i) {
            parameters_[tags[i]] = {parameters[2 * i], parameters[2 * i + 1]};
        }
    }

    // The surface's point nearest to the middle of the nodes a and b: Gauss and Newton, from the middle of
    // their parameters. Where that fails, as over a seam, gmsh's own search, which is slow.
    [[nodiscard]] Vector3d nearest(const Vector3d& a, const Vector3d& b, std::size_t tag_a,
                                   std::size_t tag_b) const {
        const Vector3d middle = 0.5 * (a + b);
        const double length = (b - a).norm();
        if (parameters_.contains(tag_a) && parameters_.contains(tag_b)) {
            Eigen::Vector2d place = 0.5 * (parameters_.at(tag_a) + parameters_.at(tag_b));
            for (int iteration = 0; iteration < 20; ++iteration) {
                const Vector3d point = value(place);
                const Eigen::Matrix<double, 3, 2> slope = derivative(place);
                const Eigen::Vector2d gradient = slope.transpose() * (middle - point);
                const Eigen::Matrix2d normal_matrix = slope.transpose() * slope;
                const Eigen::Vector2d step = normal_matrix.ldlt().solve(gradient);
                if (!step.allFinite() || (point - middle).norm() > 0.5 * length) break;
                if ((slope * step).norm() < 1e-7 * length) return point;
                place += step;
            }
        }
        std::vector<double> found;
        std::vector<double> parametric;
        gmsh::model::getClosestPoint(2, tag_, {middle.x(), middle.y(), middle.z()}, found, parametric);
        return Vector3d(found.data());
    }

  private:
    [[nodiscard]] Vector3d value(const Eigen::Vector2d& place) const {
        std::vector<double> found;
        gmsh::model::getValue(2, tag_, {place.x(), place.y()}, found);
        return Vector3d(found.data());
    }
    [[nodiscard]] Eigen::Matrix<double, 3, 2> derivative(const Eigen::Vector2d& place) const {
        std::vector<double> found;
        gmsh::model::getDerivative(2, tag_, {place.x(), place.y()}, found);
        return Eigen::Map<const Eigen::Matrix<double, 3, 2>>(found.data());
    }

    int tag_;
    std::unordered_map<std::size_t, Eigen::Vector2d> parameters_;
};

class EdgeNodeMaker {
  public:
    explicit EdgeNodeMaker(Surface& surface) : surface_(surface) {
        Surface vertices;
        index_ = add_vertices(vertices);
    }

    // Curves before surfaces: an edge gets its node on the first that it lies on.
    void add_on_curve(int tag) {
        for (const auto& [from, to] : edges_on(1, tag)) {
            const Vector3d middle = 0.5 * (vertex(from) + vertex(to));
            std::vector<double> found;
            std::vector<double> parametric;
            if (!is_new(from, to)) continue;
            gmsh::model::getClosestPoint(1, tag, {middle.x(), middle.y(), middle.z()}, found, parametric);
            surface_.vertices.emplace_back(found.data());
        }
    }

    void add_on_surface(int tag) {
        const SurfaceProjection projection(tag);
        for (const auto& [from, to] : edges_on(2, tag)) {
            if (!is_new(from, to)) continue;
            surface_.vertices.push_back(projection.nearest(vertex(from), vertex(to), from, to));
        }
    }

    [[nodiscard]] std::int32_t node_between(std::int32_t a, std::int32_t b) const {
        return nodes_.at({std::min(a, b), std::max(a, b)});
    }

  private:
    using Tags = std::pair<std::size_t, std::size_t>;

    [[nodiscard]] const Vector3d& vertex(std::size_t tag) const {
        return surface_.vertices[static_cast<std::size_t>(index_.at(tag))];
    }

    // Books the next vertex as the node of the edge, unless the edge has one.
    bool is_new(std::size_t from, std::size_t to) {
        const std::int32_t a = index_.at(from);
        const std::int32_t b = index_.at(to);
        const auto next = static_cast<std::int32_t>(surface_.vertices.size());
        return nodes_.emplace(std::pair(std::min(a, b), std::max(a, b)), next).second;
    }

    // The mesh's edges, as tags of nodes, on a curve or a surface.
    static std::vector<Tags> edges_on(int dimension, int tag) {
        std::vector<int> types;
        std::vector<std::vector<std::size_t>> elements;
        std::vector<std::vector<std::size_t>> nodes;
        gmsh::model::mesh::getElements(types, elements, nodes, dimension, tag);
        std::vector<Tags> edges;
        const auto corners = static_cast<std::size_t>(dimension) + 1;
        for (const std::vector<std::size_t>& list : nodes) {
            for (std::size_t first = 0; first + corners <= list.size(); first += corners) {
                for (std::size_t i = 0; i < (dimension == 1 ? 1U : 3U); ++i) {
                    edges.emplace_back(list[first + i], list[first + (i + 1) % corners]);
                }
            }
        }
        return edges;
    }

    Surface& surface_;
    IndexOfTag index_;
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> nodes_;
};

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

Surface curved_surface_of_model(const std::string& label, const std::vector<int>& surface_tags) {
    Surface surface = surface_of_model(label, surface_tags);
    if (surface.order() == 2) return surface;
    EdgeNodeMaker maker(surface);
    gmsh::vectorpair curves;
    gmsh::model::getEntities(curves, 1);
    for (const auto& [dimension, tag] : curves) maker.add_on_curve(tag);
    for (const int tag : surface_tags) maker.add_on_surface(tag);
    for (const auto& [a, b, c] : surface.corners) {
        surface.edge_nodes.push_back(
            {maker.node_between(a, b), maker.node_between(b, c), maker.node_between(c, a)});
    }
    return surface;
}

}  // namespace samara
