#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <gmsh.h>

#include "meshes/reading/gmsh_session.hpp"
#include "samara/core/base/error.hpp"

namespace samara {
namespace {

// Element types by gmsh's numbers.
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

// A quadratic edge follows a curve to fourth order where its node is the point of the curve whose tangent is
// parallel to the chord; with any other node, such as the point nearest to the chord's middle, only to third
// order where the curvature changes. On a surface the normal at that node is perpendicular to the chord and
// lies between the normals at the ends: affine images keep this property, so that the nodes of a sphere's
// chords become those of an ellipsoid's. Where the surface is flat these conditions say little, and a small
// weight on the distance from the middle decides.
constexpr double weight_of_middle = 0.01;
constexpr int most_steps = 20;
constexpr double good_step =
    1e-5;  // relative to the edge's length: an error of the node counts to second order
constexpr double most_astray = 0.5;  // distance from the middle, relative to the edge's length
constexpr double least_sine = 1e-6;  // between the normals at the ends

using Places = std::unordered_map<std::size_t, Eigen::Vector2d>;

// Returns the parameters of the nodes of a curve (only the first is used) or a surface and of its boundary,
// by their tags.
Places places_on(int dimension, int tag) {
    std::vector<std::size_t> tags;
    std::vector<double> coordinates;
    std::vector<double> parameters;
    constexpr bool with_boundary = true;
    constexpr bool with_parameters = true;
    gmsh::model::mesh::getNodes(tags, coordinates, parameters, dimension, tag, with_boundary,
                                with_parameters);
    Places places;
    const auto count = static_cast<std::size_t>(dimension);
    for (std::size_t i = 0; i < tags.size() && count * (i + 1) <= parameters.size(); ++i) {
        places[tags[i]] = {parameters[count * i], count == 2 ? parameters[2 * i + 1] : 0.0};
    }
    return places;
}

// Returns the parameters of the point of a curve or surface that is nearest to the given one, and that point.
// Slow.
std::pair<Eigen::Vector2d, Vector3d> nearest_on(int dimension, int tag, const Vector3d& point) {
    std::vector<double> nearest;
    std::vector<double> place;
    gmsh::model::getClosestPoint(dimension, tag, {point.x(), point.y(), point.z()}, nearest, place);
    gmsh::model::getParametrization(dimension, tag, nearest, place);
    return {{place[0], dimension == 2 ? place[1] : 0.0}, Vector3d(nearest.data())};
}

// Finds the nodes of edges on one surface of the geometry.
class NodesOnSurface {
  public:
    explicit NodesOnSurface(int tag) : tag_(tag), places_(places_on(2, tag)) {
        std::vector<double> low;
        std::vector<double> high;
        gmsh::model::getParametrizationBounds(2, tag, low, high);
        range_ = Eigen::Vector2d(high.data()) - Eigen::Vector2d(low.data());
    }

    // Returns the node of the edge from a to b.
    [[nodiscard]] Vector3d between(const Vector3d& a, const Vector3d& b, std::size_t tag_a,
                                   std::size_t tag_b) const {
        const Vector3d middle = 0.5 * (a + b);
        const auto one = places_.find(tag_a);
        const auto two = places_.find(tag_b);
        Vector3d axis = Vector3d::Zero();
        if (one != places_.end() && two != places_.end()) {
            for (const Eigen::Vector2d& end : {two->second, over_seam(one->second, two->second)}) {
                axis = axis_between(one->second, end);
                if (const auto found = from(0.5 * (one->second + end), b - a, middle, axis)) return *found;
            }
        }
        const auto [place, nearest] = nearest_on(2, tag_, middle);
        return from(place, b - a, middle, axis).value_or(nearest);
    }

  private:
    // Returns the parameters `two`, shifted by a period of a closed surface where that brings them nearer to
    // `one`.
    [[nodiscard]] Eigen::Vector2d over_seam(const Eigen::Vector2d& one, Eigen::Vector2d two) const {
        for (Eigen::Index i = 0; i < 2; ++i) {
            const double apart = two[i] - one[i];
            if (std::abs(apart) > 0.5 * range_[i]) two[i] -= std::copysign(range_[i], apart);
        }
        return two;
    }

    // Returns the unit vector perpendicular to the normals at two places; zero where they are parallel. The
    // places are moved slightly inwards, since at the poles of a sphere there is no normal.
    [[nodiscard]] Vector3d axis_between(const Eigen::Vector2d& one, const Eigen::Vector2d& two) const {
        constexpr double within = 1e-3;
        const Eigen::Vector2d near_one = one + within * (two - one);
        const Eigen::Vector2d near_two = two + within * (one - two);
        std::vector<double> normals;
        gmsh::model::getNormal(tag_, {near_one.x(), near_one.y(), near_two.x(), near_two.y()}, normals);
        const Vector3d axis = Vector3d(normals.data()).cross(Vector3d(normals.data() + 3));
        return axis.norm() > least_sine ? axis.normalized() : Vector3d::Zero();
    }

    // Gauss-Newton iteration from the place.
    [[nodiscard]] std::optional<Vector3d> from(Eigen::Vector2d place, const Vector3d& along,
                                               const Vector3d& middle, const Vector3d& axis) const {
        const double length = along.norm();
        const Vector3d chord = along / length;
        for (int step = 0; step < most_steps; ++step) {
            const std::vector<double> parameters = {place.x(), place.y()};
            std::vector<double> numbers;
            gmsh::model::getValue(2, tag_, parameters, numbers);
            const Vector3d point(numbers.data());
            if (!((point - middle).norm() < most_astray * length)) break;
            gmsh::model::getDerivative(2, tag_, parameters, numbers);
            const Eigen::Matrix<double, 3, 2> slope(numbers.data());
            gmsh::model::getSecondDerivative(2, tag_, parameters, numbers);
            const Vector3d uu(numbers.data());
            const Vector3d vv(numbers.data() + 3);
            const Vector3d uv(numbers.data() + 6);
            const Vector3d area = slope.col(0).cross(slope.col(1));
            const Vector3d normal = area.normalized();
            Eigen::Matrix<double, 3, 2> change;  // of the normal
            change << uu.cross(slope.col(1)) + slope.col(0).cross(uv),
                uv.cross(slope.col(1)) + slope.col(0).cross(vv);
            change = ((Matrix3d::Identity() - normal * normal.transpose()) * change / area.norm()).eval();
            const double pull = weight_of_middle / length;
            const Matrix3d across = pull * (Matrix3d::Identity() - normal * normal.transpose());
            Eigen::Matrix<double, 5, 2> jacobian;
            jacobian << chord.transpose() * change, axis.transpose() * change, across * slope;
            Eigen::Matrix<double, 5, 1> residual;
            residual << chord.dot(normal), axis.dot(normal), across * (point - middle);
            const Eigen::Matrix2d normal_matrix = jacobian.transpose() * jacobian;
            const Eigen::Vector2d shift = -normal_matrix.ldlt().solve(jacobian.transpose() * residual);
            if (!shift.allFinite()) break;
            if ((slope * shift).norm() < good_step * length) return point;
            place += shift;
        }
        return std::nullopt;
    }

    int tag_;
    Places places_;
    Eigen::Vector2d range_;
};

// Finds the nodes of edges on one curve of the geometry: the points that are farthest from the chords.
class NodesOnCurve {
  public:
    explicit NodesOnCurve(int tag) : tag_(tag), places_(places_on(1, tag)) {}

    [[nodiscard]] Vector3d between(const Vector3d& a, const Vector3d& b, std::size_t tag_a,
                                   std::size_t tag_b) const {
        const auto one = places_.find(tag_a);
        const auto two = places_.find(tag_b);
        if (one != places_.end() && two != places_.end()) {
            if (const auto found = from(0.5 * (one->second.x() + two->second.x()), a, b)) return *found;
        }
        // The parameters do not lead there across the end of a closed curve.
        const auto [place, nearest] = nearest_on(1, tag_, 0.5 * (a + b));
        return from(place.x(), a, b).value_or(nearest);
    }

  private:
    [[nodiscard]] std::optional<Vector3d> from(double place, const Vector3d& a, const Vector3d& b) const {
        const Vector3d middle = 0.5 * (a + b);
        const double length = (b - a).norm();
        const Vector3d chord = (b - a) / length;
        for (int step = 0; step < most_steps; ++step) {
            std::vector<double> numbers;
            gmsh::model::getValue(1, tag_, {place}, numbers);
            const Vector3d point(numbers.data());
            const Vector3d arm = point - middle;
            if (!(arm.norm() < most_astray * length)) break;
            gmsh::model::getDerivative(1, tag_, {place}, numbers);
            const Vector3d slope(numbers.data());
            gmsh::model::getSecondDerivative(1, tag_, {place}, numbers);
            const Vector3d bend(numbers.data());
            const Vector3d off = arm - arm.dot(chord) * chord;
            const Vector3d out = off.norm() > least_sine * length ? off.normalized() : Vector3d::Zero();
            const double speed = slope.norm();
            const Eigen::Vector2d residual(out.dot(slope) / speed,
                                           weight_of_middle / length * arm.dot(slope) / speed);
            const Eigen::Vector2d jacobian(out.dot(bend) / speed, weight_of_middle / length * speed);
            const double shift = -jacobian.dot(residual) / jacobian.squaredNorm();
            if (!std::isfinite(shift)) break;
            if (std::abs(shift) * speed < good_step * length) return point;
            place += shift;
        }
        return std::nullopt;
    }

    int tag_;
    Places places_;
};

class EdgeNodeMaker {
  public:
    explicit EdgeNodeMaker(Surface& surface) : surface_(surface) {
        Surface vertices;
        index_ = add_vertices(vertices);
    }

    // To be called before add_on_surface(): an edge gets its node on the first entity that it lies on.
    void add_on_curve(int tag) { add(NodesOnCurve(tag), edges_on(1, tag)); }

    void add_on_surface(int tag) { add(NodesOnSurface(tag), edges_on(2, tag)); }

    [[nodiscard]] std::int32_t node_between(std::int32_t a, std::int32_t b) const {
        return nodes_.at({std::min(a, b), std::max(a, b)});
    }

  private:
    using Tags = std::pair<std::size_t, std::size_t>;

    [[nodiscard]] const Vector3d& vertex(std::size_t tag) const {
        return surface_.vertices[static_cast<std::size_t>(index_.at(tag))];
    }

    // Registers the next vertex as the node of the edge, unless the edge has one; returns whether it did.
    bool is_new(std::size_t from, std::size_t to) {
        const std::int32_t a = index_.at(from);
        const std::int32_t b = index_.at(to);
        const auto next = static_cast<std::int32_t>(surface_.vertices.size());
        return nodes_.emplace(std::pair(std::min(a, b), std::max(a, b)), next).second;
    }

    template <class Nodes>
    void add(const Nodes& nodes, const std::vector<Tags>& edges) {
        for (const auto& [from, to] : edges) {
            if (!is_new(from, to)) continue;
            surface_.vertices.push_back(nodes.between(vertex(from), vertex(to), from, to));
        }
    }

    // Returns the mesh's edges on a curve or a surface, as tags of nodes.
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
