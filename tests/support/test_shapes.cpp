#include "support/test_shapes.hpp"

#include <cmath>
#include <map>
#include <random>
#include <utility>

#include "samara/core/surface/octahedral_map.hpp"

namespace samara::test {
namespace {

using Triangle = std::array<std::int32_t, 3>;

std::size_t index(std::int32_t value) {
    return static_cast<std::size_t>(value);
}

/// Order-2 surface: each edge gets its middle node, pushed out to the unit sphere.
Surface with_edge_nodes(Surface surface) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> known;
    const auto middle = [&](std::int32_t a, std::int32_t b) {
        const auto next = static_cast<std::int32_t>(surface.vertices.size());
        const auto [place, is_new] = known.try_emplace(std::minmax(a, b), next);
        if (is_new) {
            const Vector3d sum = surface.vertices[index(a)] + surface.vertices[index(b)];
            surface.vertices.push_back(sum.normalized());
        }
        return place->second;
    };
    for (const auto& [a, b, c] : surface.corners) {
        surface.edge_nodes.push_back({middle(a, b), middle(b, c), middle(c, a)});
    }
    return surface;
}

Surface icosahedron() {
    const double golden = 0.5 * (1.0 + std::sqrt(5.0));
    Surface surface;
    for (const double one : {-1.0, 1.0}) {
        for (const double phi : {-golden, golden}) {
            surface.vertices.push_back(Vector3d(0.0, one, phi).normalized());
            surface.vertices.push_back(Vector3d(one, phi, 0.0).normalized());
            surface.vertices.push_back(Vector3d(phi, 0.0, one).normalized());
        }
    }
    const double edge = 2.0 / std::sqrt(1.0 + golden * golden);
    const auto touch = [&](std::size_t a, std::size_t b) {
        return (surface.vertices[a] - surface.vertices[b]).norm() < 1.1 * edge;
    };
    for (std::size_t a = 0; a < 12; ++a) {
        for (std::size_t b = a + 1; b < 12; ++b) {
            for (std::size_t c = b + 1; c < 12; ++c) {
                if (!touch(a, b) || !touch(b, c) || !touch(c, a)) continue;
                const Vector3d& first = surface.vertices[a];
                const bool outward =
                    first.dot((surface.vertices[b] - first).cross(surface.vertices[c] - first)) > 0.0;
                const auto i = static_cast<std::int32_t>(a);
                const auto j = static_cast<std::int32_t>(outward ? b : c);
                const auto k = static_cast<std::int32_t>(outward ? c : b);
                surface.corners.push_back({i, j, k});
            }
        }
    }
    return surface;
}

}  // namespace

Surface icosphere(int level) {
    Surface surface = icosahedron();
    for (int i = 0; i < level; ++i) {
        const Surface with_nodes = with_edge_nodes(surface);
        surface.vertices = with_nodes.vertices;
        surface.corners.clear();
        for (std::size_t t = 0; t < with_nodes.corners.size(); ++t) {
            const auto& [a, b, c] = with_nodes.corners[t];
            const auto& [ab, bc, ca] = with_nodes.edge_nodes[t];
            surface.corners.insert(surface.corners.end(),
                                   {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
    }
    return surface;
}

Surface ellipsoid(const Vector3d& semi_axes, int level, const Vector3d& centre) {
    return mapped(icosphere(level), semi_axes.asDiagonal(), centre);
}

Surface curved_ellipsoid(const Vector3d& semi_axes, int level) {
    return mapped(with_edge_nodes(icosphere(level)), semi_axes.asDiagonal());
}

Surface box(const Vector3d& edges, int n) {
    Surface surface;
    std::map<std::array<int, 3>, std::int32_t> known;
    const auto vertex = [&](const std::array<int, 3>& place) {
        const auto next = static_cast<std::int32_t>(surface.vertices.size());
        const auto [found, is_new] = known.try_emplace(place, next);
        if (is_new) {
            const Vector3d unit = Vector3d(place[0], place[1], place[2]) / n - Vector3d::Constant(0.5);
            surface.vertices.push_back(unit.cwiseProduct(edges));
        }
        return found->second;
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const int side : {0, n}) {
            for (int i = 0; i < n; ++i) {
                for (int j = 0; j < n; ++j) {
                    const auto at = [&](int u, int v) {
                        std::array<int, 3> place{};
                        place[axis] = side;
                        place[(axis + 1) % 3] = side == n ? u : v;
                        place[(axis + 2) % 3] = side == n ? v : u;
                        return vertex(place);
                    };
                    surface.corners.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
                    surface.corners.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
                }
            }
        }
    }
    return surface;
}

Surface mapped(const Surface& surface, const Matrix3d& map, const Vector3d& shift) {
    Surface result = surface;
    for (Vector3d& vertex : result.vertices) vertex = (map * vertex + shift).eval();
    if (map.determinant() < 0.0) {
        for (Triangle& triangle : result.corners) std::swap(triangle[1], triangle[2]);
        for (Triangle& nodes : result.edge_nodes) std::swap(nodes[0], nodes[2]);
    }
    return result;
}

Surface together(const std::vector<Surface>& parts) {
    Surface all;
    for (const Surface& part : parts) {
        const auto first = static_cast<std::int32_t>(all.vertices.size());
        all.vertices.insert(all.vertices.end(), part.vertices.begin(), part.vertices.end());
        for (const auto& [a, b, c] : part.corners) all.corners.push_back({a + first, b + first, c + first});
        for (const auto& [a, b, c] : part.edge_nodes) {
            all.edge_nodes.push_back({a + first, b + first, c + first});
        }
    }
    return all;
}

Surface lopsided(Surface surface) {
    for (Vector3d& vertex : surface.vertices) {
        const double bump = std::exp(-2.0 * (vertex - Vector3d(0.6, 0.4, 0.3)).squaredNorm());
        vertex *= 1.0 + 0.5 * bump;
        vertex.z() += 0.2 * vertex.x() * vertex.y();
    }
    return surface;
}

Surface shaken_icosphere(int level, double amount, unsigned seed) {
    Surface surface = icosphere(level);
    const double edge = std::sqrt(surface_area(surface) / static_cast<double>(surface.triangle_count()));
    std::mt19937 generator(seed);
    for (Vector3d& vertex : surface.vertices) {
        Vector3d step;
        // Not std::uniform_real_distribution: its values differ between libraries.
        for (double& component : step)
            component = 2.0 * static_cast<double>(generator()) / 4294967296.0 - 1.0;
        vertex = (vertex + amount * edge * step).normalized();
    }
    return surface;
}

VolumeMoments moments_of(const Surface& surface) {
    VolumeMoments moments;
    moments.surface_area = surface_area(surface);
    Matrix3d about_origin = Matrix3d::Zero();
    const Vector3d origin = surface.vertices.front();
    Vector3d first = Vector3d::Zero();
    for (const Triangle& triangle : surface.corners) {
        const Vector3d a = surface.vertices[index(triangle[0])] - origin;
        const Vector3d b = surface.vertices[index(triangle[1])] - origin;
        const Vector3d c = surface.vertices[index(triangle[2])] - origin;
        const double volume = a.dot(b.cross(c)) / 6.0;
        const Vector3d sum = a + b + c;
        moments.volume += volume;
        first += volume * sum / 4.0;
        about_origin += volume / 20.0 *
                        (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
    }
    const Vector3d mean = first / moments.volume;
    moments.centroid = origin + mean;
    moments.second_moments = about_origin - moments.volume * mean * mean.transpose();
    return moments;
}

LoadTables smooth_tables(int subdivisions) {
    LoadTables tables;
    tables.reference_length = 0.5;
    tables.subdivisions = subdivisions;
    tables.axes = Eigen::AngleAxisd(0.7, Vector3d(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
    tables.reynolds_numbers = {10.0, 200.0, 3000.0};
    tables.quality = "preview";
    tables.provenance = R"([{"name": "first", "openfoam_version": "v1912"}, {"name": "second"}])";
    for (const double reynolds : tables.reynolds_numbers) {
        for (const Vector3d& direction : octahedral_nodes(subdivisions)) {
            LoadEntry entry;
            entry.force = -direction * (1.0 + 10.0 / reynolds) + Vector3d(0.1, 0.2, 0.3);
            entry.moment = direction.cross(Vector3d(1.0, 2.0, 3.0)) * std::log(reynolds);
            entry.turbulent_kinetic_energy = 0.01 + direction.x() * direction.x();
            entry.dissipation_rate = 0.6 + direction.y() * direction.z() + 1.0 / reynolds;
            tables.entries.push_back(entry);
            entry.force = 0.01 * entry.force.cwiseAbs();
            entry.moment = 0.02 * entry.moment.cwiseAbs();
            tables.errors.push_back(entry);
        }
    }
    return tables;
}

SurfaceLoads made_up_surface_loads(const Surface& surface, const VolumeMoments& moments) {
    SurfaceLoads loads;
    loads.surface = surface;
    loads.surface.edge_nodes.clear();
    const double length = reference_length(moments.surface_area);
    const Vector3d shares(-0.9, -0.4, -0.2);
    for (Vector3d& vertex : loads.surface.vertices) {
        vertex = (vertex - moments.centroid) / length;
        loads.potentials.emplace_back(shares.cwiseProduct(vertex));
    }
    return loads;
}

Body full_body() {
    Body body;
    body.name = "pebble";
    body.source = "pebble.stl (hash 0123456789abcdef), 80 triangles";
    body.surface = curved_ellipsoid({0.1, 0.2, 0.4}, 1);
    body.moments = moments_of(body.surface);
    body.symmetry.type = Symmetry::Type::axial;
    body.symmetry.axis = Vector3d(1.0, 2.0, 2.0) / 3.0;
    body.symmetry.elements = {Matrix3d::Identity(), Vector3d(-1.0, -1.0, 1.0).asDiagonal()};
    body.symmetry.axes = Eigen::AngleAxisd(0.3, Vector3d::UnitY()).toRotationMatrix();
    body.symmetry.tolerance = 1e-6;
    KirchhoffTensor kirchhoff;
    for (int row = 0; row < 6; ++row) {
        for (int column = 0; column < 6; ++column) {
            kirchhoff.matrix(row, column) = 1e-3 / (1.0 + row + column);
        }
    }
    kirchhoff.error_estimate = 0.0125;
    kirchhoff.asymmetry = 0.001;
    kirchhoff.triangles = 320;
    kirchhoff.method = "boundary elements";
    body.kirchhoff = kirchhoff;
    body.surface_loads = made_up_surface_loads(body.surface, body.moments);
    body.tables = smooth_tables(2);
    body.tables->error_sources = {{ErrorSource::tail, 0.01, 0.02, 0.03, 0.04},
                                  {ErrorSource::interpolation, 0.05, 0.06, 0.07, 0.08}};
    body.tables->left_out = R"([{"name":"direction_07","reason":"never settled"}])";
    DynamicCoefficients dynamic;
    dynamic.transport << 0.05, 0.004, -0.003, 0.004, 0.02, 0.001, -0.003, 0.001, -0.006;
    dynamic.rotational_transport = 0.8;
    dynamic.drag_in_motion << 0.3, 0.01, -0.02, 0.01, 0.2, 0.03, -0.02, 0.03, 0.1;
    dynamic.rotational_drag << 0.003, 0.0, 0.001, 0.0, 0.002, 0.0, 0.001, 0.0, 0.004;
    dynamic.unsteady_factor = 1.3;
    dynamic.settling_length = 12.5;
    dynamic.drag_in_spin = Vector3d(0.5, 0.6, 0.0).asDiagonal();
    dynamic.rotational_drag_in_spin = Vector3d(0.005, 0.006, 0.007).asDiagonal();
    dynamic.half_length = 0.41;
    dynamic.origin = "identified from 3 falls";
    DynamicCoefficients errors;
    errors.transport = Matrix3d::Constant(0.0004);
    errors.rotational_transport = 0.06;
    errors.drag_in_motion = Matrix3d::Constant(0.007);
    errors.rotational_drag = Matrix3d::Constant(0.0008);
    errors.unsteady_factor = 0.05;
    errors.settling_length = 0.0;
    errors.drag_in_spin = Matrix3d::Constant(0.009);
    errors.rotational_drag_in_spin = Matrix3d::Constant(0.0003);
    body.dynamic = {.values = dynamic, .standard_errors = errors, .densities = {1.3, 9.5}};
    return body;
}

}  // namespace samara::test
