#include "samara/kirchhoff/surfaces/rebuilt_surface.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <Eigen/Dense>

#include "samara/core/base/numbers.hpp"
#include "samara/core/base/parallel_for.hpp"
#include "samara/core/surface/curved_surface.hpp"
#include "samara/core/surface/surface_edges.hpp"

namespace samara {
namespace {

constexpr std::size_t enough_points = 14;     // around a vertex, for the nine terms of a cubic jet
constexpr std::size_t enough_for_cubic = 11;  // below, a quadratic jet with five terms
constexpr std::size_t enough_for_quadratic = 5;
// A node farther from the straight edge than this part of its length is not believed: on a circle that is an
// edge that spans 100 degrees.
constexpr double most_bulge = 0.23;

/// The part of a surface around one vertex, between creases, as a height over a plane: z = polynomial(x, y).
struct Jet {
    Vector3d origin = Vector3d::Zero();
    Matrix3d axes = Matrix3d::Identity();  // rows: x, y, z
    double size = 1.0;                     // of the unit in which the polynomial is written
    Eigen::Matrix<double, 9, 1> coefficients = Eigen::Matrix<double, 9, 1>::Zero();
    bool known = false;
};

Eigen::Matrix<double, 1, 9> monomials(double x, double y) {
    Eigen::Matrix<double, 1, 9> row;
    row << x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y;
    return row;
}

/// Returns the point of the jet's surface above or below `point`.
Vector3d on_jet(const Jet& jet, const Vector3d& point) {
    Vector3d local = jet.axes * (point - jet.origin) / jet.size;
    local.z() = monomials(local.x(), local.y()) * jet.coefficients;
    return jet.origin + jet.size * (jet.axes.transpose() * local);
}

Jet fit_jet(const Vector3d& origin, const Vector3d& normal, const std::vector<Vector3d>& points) {
    Jet jet;
    if (points.size() < enough_for_quadratic) return jet;
    jet.origin = origin;
    jet.axes.row(2) = normal.normalized().transpose();
    jet.axes.row(0) = normal.unitOrthogonal().transpose();
    jet.axes.row(1) = normal.normalized().cross(normal.unitOrthogonal()).transpose();
    double size = 0.0;
    for (const Vector3d& point : points) size = std::max(size, (point - origin).norm());
    jet.size = size;
    const Eigen::Index terms = points.size() >= enough_for_cubic ? 9 : 5;
    const auto count = static_cast<Eigen::Index>(points.size());
    Eigen::MatrixXd rows(count, terms);
    Eigen::VectorXd heights(count);
    for (Eigen::Index i = 0; i < count; ++i) {
        const Vector3d local = jet.axes * (points[static_cast<std::size_t>(i)] - origin) / size;
        const double weight = 1.0 / (0.05 + local.squaredNorm());
        rows.row(i) = weight * monomials(local.x(), local.y()).head(terms);
        heights(i) = weight * local.z();
    }
    // The least of all solutions where the points do not determine one, as on a strip of two rows.
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
    decomposition.setThreshold(1e-3);
    decomposition.compute(rows);
    jet.coefficients.head(terms) = decomposition.solve(heights);
    jet.known = jet.coefficients.allFinite();
    return jet;
}

/// Groups the corners of triangles into sectors: those about one vertex with no crease between them.
class Sectors {
  public:
    Sectors(const Surface& surface, const Creases& creases)
        : surface_(surface), creases_(creases), neighbours_(neighbours(surface)) {
        sector_.resize(3 * surface.triangle_count());
        std::fill(sector_.begin(), sector_.end(), -1);
        for (std::size_t corner = 0; corner < sector_.size(); ++corner) {
            if (sector_[corner] < 0) walk_around(corner);
        }
    }

    [[nodiscard]] std::size_t count() const { return triangles_.size(); }
    [[nodiscard]] std::size_t of(std::size_t triangle, std::size_t corner) const {
        return as_index(sector_[3 * triangle + corner]);
    }
    [[nodiscard]] std::int32_t vertex(std::size_t sector) const { return vertices_[sector]; }

    /// Returns the jet of one sector, from the vertices that can be reached without crossing a crease.
    [[nodiscard]] Jet jet(std::size_t sector) const {
        std::vector<std::int32_t> triangles = triangles_[sector];
        std::vector<std::int32_t> vertices = {vertices_[sector]};
        Vector3d normal = Vector3d::Zero();
        for (const std::int32_t t : triangles) normal += area_vector(surface_, as_index(t));
        std::size_t first = 0;
        for (int ring = 0; ring < 4; ++ring) {
            for (std::size_t i = first; i < triangles.size(); ++i) {
                for (const std::int32_t v : surface_.corners[as_index(triangles[i])]) {
                    if (std::find(vertices.begin(), vertices.end(), v) == vertices.end())
                        vertices.push_back(v);
                }
            }
            if (vertices.size() > enough_points || ring == 3) break;
            const std::size_t last = triangles.size();
            for (std::size_t i = first; i < last; ++i) add_neighbours(triangles, triangles[i]);
            first = last;
        }
        std::vector<Vector3d> points;
        for (std::size_t i = 1; i < vertices.size(); ++i) {
            points.push_back(surface_.vertices[as_index(vertices[i])]);
        }
        return fit_jet(surface_.vertices[as_index(vertices.front())], normal, points);
    }

  private:
    void add_neighbours(std::vector<std::int32_t>& triangles, std::int32_t triangle) const {
        for (std::size_t side = 0; side < 3; ++side) {
            const std::int32_t other = neighbours_[as_index(triangle)][side];
            if (other < 0 || creases_[as_index(triangle)][side]) continue;
            if (std::find(triangles.begin(), triangles.end(), other) == triangles.end()) {
                triangles.push_back(other);
            }
        }
    }

    void walk_around(std::size_t start) {
        const std::int32_t vertex = surface_.corners[start / 3][start % 3];
        const auto sector = static_cast<std::int32_t>(triangles_.size());
        std::vector<std::int32_t> triangles;
        std::vector<std::size_t> open = {start};
        while (!open.empty()) {
            const std::size_t corner = open.back();
            open.pop_back();
            if (sector_[corner] >= 0) continue;
            sector_[corner] = sector;
            const std::size_t triangle = corner / 3;
            triangles.push_back(static_cast<std::int32_t>(triangle));
            for (const std::size_t side : {corner % 3, (corner + 2) % 3}) {
                const std::int32_t other = neighbours_[triangle][side];
                if (other < 0 || creases_[triangle][side]) continue;
                const auto& corners = surface_.corners[as_index(other)];
                const auto place = std::find(corners.begin(), corners.end(), vertex);
                open.push_back(3 * as_index(other) + static_cast<std::size_t>(place - corners.begin()));
            }
        }
        triangles_.push_back(std::move(triangles));
        vertices_.push_back(vertex);
    }

    const Surface& surface_;
    const Creases& creases_;
    std::vector<std::array<std::int32_t, 3>> neighbours_;
    std::vector<std::int32_t> sector_;                  // of each corner, three a triangle
    std::vector<std::vector<std::int32_t>> triangles_;  // of each sector
    std::vector<std::int32_t> vertices_;                // of each sector
};

/// The creases as chains of vertices.
class CreaseCurves {
  public:
    CreaseCurves(const Surface& surface, const Creases& creases) : surface_(surface) {
        for (std::size_t t = 0; t < creases.size(); ++t) {
            for (std::size_t side = 0; side < 3; ++side) {
                const std::int32_t from = surface.corners[t][side];
                const std::int32_t to = surface.corners[t][(side + 1) % 3];
                if (!creases[t][side] || from > to) continue;
                ends_[from].push_back(to);
                ends_[to].push_back(from);
            }
        }
    }

    /// Returns the point halfway along the curve between two neighbours on it: by the cubic through them and
    /// the next one on each side, or by the parabola where the curve ends on one side.
    [[nodiscard]] Vector3d middle(std::int32_t a, std::int32_t b) const {
        const Vector3d& start = place(a);
        const Vector3d& end = place(b);
        const double length = (end - start).norm();
        const Vector3d straight = 0.5 * (start + end);
        std::vector<std::pair<double, Vector3d>> nodes = {{0.0, start}, {length, end}};
        for (const auto& [here, from] : {std::pair{a, b}, std::pair{b, a}}) {
            const std::int32_t next = beyond(here, from);
            if (next < 0) continue;
            const double step = (place(next) - place(here)).norm();
            nodes.emplace_back(here == a ? -step : length + step, place(next));
        }
        if (nodes.size() == 2) return straight;
        Vector3d sum = Vector3d::Zero();
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            double weight = 1.0;  // Lagrange's
            for (std::size_t j = 0; j < nodes.size(); ++j) {
                if (j == i) continue;
                weight *= (0.5 * length - nodes[j].first) / (nodes[i].first - nodes[j].first);
            }
            sum += weight * nodes[i].second;
        }
        return sum;
    }

  private:
    [[nodiscard]] const Vector3d& place(std::int32_t vertex) const {
        return surface_.vertices[as_index(vertex)];
    }

    /// Returns the vertex after `here` for one who comes from `from`; -1 where the curve has a corner or
    /// branches.
    [[nodiscard]] std::int32_t beyond(std::int32_t here, std::int32_t from) const {
        const std::vector<std::int32_t>& ends = ends_.at(here);
        if (ends.size() != 2) return -1;
        const std::int32_t next = ends[0] == from ? ends[1] : ends[0];
        const Vector3d before = place(here) - place(from);
        const Vector3d after = place(next) - place(here);
        const double angle = std::atan2(before.cross(after).norm(), before.dot(after));
        return angle > sharp_angle ? -1 : next;
    }

    const Surface& surface_;
    std::map<std::int32_t, std::vector<std::int32_t>> ends_;
};

/// Returns the node itself, or the straight edge's middle where it is not believable.
Vector3d believed(const Vector3d& node, const Vector3d& start, const Vector3d& end) {
    const Vector3d straight = 0.5 * (start + end);
    return (node - straight).norm() <= most_bulge * (end - start).norm() ? node : straight;
}

}  // namespace

Surface rebuilt_surface(const Surface& flat, const Creases& creases, int threads) {
    const Sectors sectors(flat, creases);
    std::vector<Jet> jets(sectors.count());
    parallel_for(jets.size(), 64, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t sector = begin; sector < end; ++sector) jets[sector] = sectors.jet(sector);
    });
    const CreaseCurves curves(flat, creases);

    Surface result = flat;
    result.edge_nodes.resize(flat.triangle_count());
    const std::vector<EdgeUse> uses = edge_uses(flat);
    for (const auto& edge : edges_of(uses)) {
        const auto node = static_cast<std::int32_t>(result.vertices.size());
        const auto triangle = as_index(edge.front().triangle);
        const auto side = as_index(edge.front().side);
        const Vector3d& start = flat.vertices[as_index(edge.front().low)];
        const Vector3d& end = flat.vertices[as_index(edge.front().high)];
        Vector3d middle = 0.5 * (start + end);
        if (creases[triangle][side]) {
            middle = curves.middle(edge.front().low, edge.front().high);
        } else {
            const Jet& one = jets[sectors.of(triangle, side)];
            const Jet& other = jets[sectors.of(triangle, (side + 1) % 3)];
            if (one.known && other.known) middle = 0.5 * (on_jet(one, middle) + on_jet(other, middle));
        }
        result.vertices.push_back(believed(middle, start, end));
        for (const EdgeUse& use : edge) {
            result.edge_nodes[as_index(use.triangle)][as_index(use.side)] = node;
        }
    }
    straighten_overturned(result);
    return result;
}

}  // namespace samara
