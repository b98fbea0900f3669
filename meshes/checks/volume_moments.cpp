#include <array>

#include "meshes/checks/shape_error.hpp"

namespace samara {
namespace {

// Gauss-Legendre on [0, 1], five points: exact to degree 9.
constexpr std::array<double, 5> gauss_points = {0.046910077030668004, 0.23076534494715845, 0.5,
                                                0.76923465505284155, 0.953089922969332};
constexpr std::array<double, 5> gauss_weights = {
    0.11846344252809454, 0.23931433524968324, 0.28444444444444444, 0.23931433524968324, 0.11846344252809454};

// Surface integrals about an origin of x . n / 3, x (x . n) / 4 and x x^T (x . n) / 5: the divergences of the
// vector fields are 1, x and x x^T.
struct Integrals {
    double volume = 0.0;
    Vector3d first = Vector3d::Zero();
    Matrix3d second = Matrix3d::Zero();
    double area = 0.0;
};

Vector3d vertex(const Surface& surface, std::int32_t index, const Vector3d& origin) {
    return surface.vertices[static_cast<std::size_t>(index)] - origin;
}

// Adds the tetrahedron between the origin and the triangle, in closed form.
void add_flat(const Surface& surface, std::size_t t, const Vector3d& origin, Integrals& sum) {
    const auto& corners = surface.corners[t];
    const Vector3d a = vertex(surface, corners[0], origin);
    const Vector3d b = vertex(surface, corners[1], origin);
    const Vector3d c = vertex(surface, corners[2], origin);
    const Vector3d total = a + b + c;
    const double volume = a.dot(b.cross(c)) / 6.0;
    sum.volume += volume;
    sum.first += volume / 4.0 * total;
    sum.second += volume / 20.0 *
                  (a * a.transpose() + b * b.transpose() + c * c.transpose() + total * total.transpose());
    sum.area += 0.5 * (b - a).cross(c - a).norm();
}

// The integrands are polynomials of degree 4, 6 and 8; one more for the collapsed square makes 9.
void add_quadratic(const Surface& surface, std::size_t t, const Vector3d& origin, Integrals& sum) {
    std::array<Vector3d, 6> nodes;
    for (std::size_t i = 0; i < 3; ++i) {
        nodes[i] = vertex(surface, surface.corners[t][i], origin);
        nodes[i + 3] = vertex(surface, surface.edge_nodes[t][i], origin);
    }
    for (std::size_t i = 0; i < gauss_points.size(); ++i) {
        for (std::size_t j = 0; j < gauss_points.size(); ++j) {
            const double u = gauss_points[i];
            const double v = (1.0 - u) * gauss_points[j];
            const double w = 1.0 - u - v;
            const Vector3d x = w * (2.0 * w - 1.0) * nodes[0] + u * (2.0 * u - 1.0) * nodes[1] +
                               v * (2.0 * v - 1.0) * nodes[2] +
                               4.0 * (w * u * nodes[3] + u * v * nodes[4] + v * w * nodes[5]);
            const Vector3d x_u = (1.0 - 4.0 * w) * nodes[0] + (4.0 * u - 1.0) * nodes[1] +
                                 4.0 * ((w - u) * nodes[3] + v * (nodes[4] - nodes[5]));
            const Vector3d x_v = (1.0 - 4.0 * w) * nodes[0] + (4.0 * v - 1.0) * nodes[2] +
                                 4.0 * ((w - v) * nodes[5] + u * (nodes[4] - nodes[3]));
            const Vector3d normal = gauss_weights[i] * gauss_weights[j] * (1.0 - u) * x_u.cross(x_v);
            const double flux = x.dot(normal);
            sum.volume += flux / 3.0;
            sum.first += flux / 4.0 * x;
            sum.second += flux / 5.0 * x * x.transpose();
            sum.area += normal.norm();
        }
    }
}

Integrals integrals(const Surface& surface, const Vector3d& origin) {
    Integrals sum;
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        if (surface.order() == 2) {
            add_quadratic(surface, t, origin, sum);
        } else {
            add_flat(surface, t, origin, sum);
        }
    }
    return sum;
}

}  // namespace

VolumeMoments volume_moments(const Surface& surface) {
    Vector3d middle = Vector3d::Zero();
    for (const Vector3d& point : surface.vertices) middle += point;
    if (!surface.vertices.empty()) middle /= static_cast<double>(surface.vertices.size());

    const Integrals about_middle = integrals(surface, middle);
    VolumeMoments moments;
    moments.volume = about_middle.volume;
    moments.surface_area = about_middle.area;
    moments.centroid = middle;
    if (about_middle.volume == 0.0) return moments;
    moments.centroid += about_middle.first / about_middle.volume;
    // About the centroid from the start: a shift of the sums would cancel digits.
    const Matrix3d second = integrals(surface, moments.centroid).second;
    moments.second_moments = 0.5 * (second + second.transpose());
    return moments;
}

}  // namespace samara
