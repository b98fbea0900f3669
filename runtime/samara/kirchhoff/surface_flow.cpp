#include "samara/kirchhoff/surface_flow.hpp"

#include <algorithm>
#include <numbers>
#include <vector>

#include "internal/body/curved_surface.hpp"
#include "internal/body/octahedral_map.hpp"
#include "internal/body/welded_surface.hpp"
#include "internal/kirchhoff/operators/hypersingular.hpp"
#include "internal/kirchhoff/surfaces/surface_ladder.hpp"

namespace samara {
namespace {

constexpr int subdivisions = 8;
// The potential's matrix is factorised: of so many triangles within a second.
constexpr std::size_t most_triangles = 2600;

Surface solvable_surface(const Surface& given, const VolumeMoments& moments, int threads) {
    const double length = reference_length(moments.surface_area);
    Surface surface = welded(given);
    for (Vector3d& vertex : surface.vertices) vertex = (vertex - moments.centroid) / length;
    if (surface.triangle_count() > most_triangles) {
        SurfaceLadder ladder(surface, threads);
        int rung = 0;
        while (rung > ladder.lowest() && ladder.rung(rung).surface.triangle_count() > most_triangles) --rung;
        surface = ladder.rung(rung).surface;
    }
    return without_edge_nodes(surface);
}

/// The gradient of the linear function that is 1 at the triangle's corner k and 0 at the others.
Vector3d gradient_of_corner(const Surface& surface, std::size_t triangle, std::size_t k,
                            const Vector3d& area) {
    const auto corner = [&](std::size_t i) -> const Vector3d& {
        return surface.vertices[static_cast<std::size_t>(surface.corners[triangle][i % 3])];
    };
    return area.cross(corner(k + 2) - corner(k + 1)) / (2.0 * area.squaredNorm());
}

/// Over rho U^2 / 2; `along`: the cosine between the face's normal and the velocity.
double pressure_on_face(const SurfacePressure& pressure, double along, double slip_square) {
    const double attached = std::max(1.0 - slip_square, pressure.base);
    if (along >= 0.0) return attached;
    const double separated = std::min(1.0, -along / pressure.separation_sine);
    return separated * pressure.base + (1.0 - separated) * std::min(0.0, attached);
}

constexpr double reference_area = std::numbers::pi / 4.0;  // over L^2

}  // namespace

SurfaceFlow::SurfaceFlow(const Surface& given, const VolumeMoments& moments, int threads) {
    const Surface surface = solvable_surface(given, moments, threads);
    const SixColumns potentials = unit_potentials(surface, threads);
    elements_.reserve(surface.triangle_count());
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        const Vector3d area = area_vector(surface, t);
        Element element{triangle_centroid(surface, t), area.normalized(), area.norm(), {}};
        element.slip = element.normal * element.normal.transpose() - Matrix3d::Identity();
        for (std::size_t k = 0; k < 3; ++k) {
            element.slip +=
                gradient_of_corner(surface, t, k, area) * potentials.row(surface.corners[t][k]).tail<3>();
        }
        elements_.push_back(element);
    }
}

PressureLoads SurfaceFlow::in_direction(const SurfacePressure& pressure, const Vector3d& direction) const {
    PressureLoads loads;
    for (const Element& element : elements_) {
        const double along = element.normal.dot(direction);
        const double slip_square = (element.slip * direction).squaredNorm();
        const Vector3d push =
            -element.area / reference_area * pressure_on_face(pressure, along, slip_square) * element.normal;
        loads.force += push;
        loads.moment += element.place.cross(push);
    }
    return loads;
}

SurfaceLoads SurfaceFlow::loads(const SurfacePressure& pressure) const {
    SurfaceLoads loads;
    loads.subdivisions = subdivisions;
    const int size = 2 * subdivisions + 1;
    for (int row = 0; row < size; ++row) {
        for (int column = 0; column < size; ++column) {
            loads.pressure.push_back(in_direction(pressure, octahedral_node(subdivisions, row, column)));
        }
    }
    for (const Element& element : elements_) {
        const Matrix3d along_face = element.normal * element.normal.transpose() - Matrix3d::Identity();
        const Matrix3d force = element.area / reference_area * along_face;
        loads.friction_force += force;
        loads.friction_moment += skew(element.place) * force;
    }
    return loads;
}

SurfaceLoads surface_loads(const Surface& surface, const VolumeMoments& moments, int threads) {
    return SurfaceFlow(surface, moments, threads).loads();
}

}  // namespace samara
