#include "samara/core/body/surface_loads.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "samara/core/surface/octahedral_map.hpp"

namespace samara {
namespace {

constexpr int subdivisions = 8;
constexpr double blasius_friction = 1.33;  // of a plate, relative to the area of each side: times Re^-1/2
// About the rms differences from CFD over the directions of three bodies
// (docs/explanation/loads-without-a-bake.md).
constexpr double error_of_force = 0.3;
constexpr double error_of_moment = 0.3;

std::vector<PressureLoads> in_directions(const std::vector<SurfaceElement>& elements,
                                         const std::vector<Vector3d>& directions,
                                         const SurfacePressure& pressure) {
    std::vector<PressureLoads> all(directions.size());
    for (std::size_t i = 0; i < directions.size(); ++i) {
        for (const SurfaceElement& element : elements) {
            const Vector3d push = -element.area / reference_area_over_length_square *
                                  pressure_on(element, directions[i], pressure) * element.normal;
            all[i].force += push;
            all[i].moment += element.place.cross(push);
        }
    }
    return all;
}

double rms(const std::vector<PressureLoads>& loads, Vector3d PressureLoads::*part) {
    double sum = 0.0;
    for (const PressureLoads& load : loads) sum += (load.*part).squaredNorm();
    return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, loads.size())));
}

/// Returns the gradient of the linear function that is 1 at the triangle's corner k and 0 at the others.
Vector3d gradient_of_corner(const Surface& surface, std::size_t triangle, std::size_t k,
                            const Vector3d& area) {
    const auto corner = [&](std::size_t i) -> const Vector3d& {
        return surface.vertices[static_cast<std::size_t>(surface.corners[triangle][i % 3])];
    };
    return area.cross(corner(k + 2) - corner(k + 1)) / (2.0 * area.squaredNorm());
}

}  // namespace

std::vector<PressureLoads> pressure_loads(const SurfaceLoads& loads, int cut_into,
                                          const SurfacePressure& pressure) {
    return in_directions(surface_elements(loads), octahedral_nodes(cut_into), pressure);
}

LoadTables as_tables(const SurfaceLoads& loads, double length, const SurfacePressure& pressure) {
    LoadTables tables;
    tables.reference_length = length;
    tables.subdivisions = subdivisions;
    tables.reynolds_numbers = {1.0, 3.0, 1e1, 3e1, 1e2, 3e2, 1e3, 3e3, 1e4, 1e5};
    tables.stokes_throughout = true;
    // Matrices that, times direction and friction coefficient, are the force of friction on the surface and
    // its moment.
    Matrix3d friction_force = Matrix3d::Zero();
    Matrix3d friction_moment = Matrix3d::Zero();
    const std::vector<SurfaceElement> elements = surface_elements(loads);
    for (const SurfaceElement& element : elements) {
        const Matrix3d along_face = element.normal * element.normal.transpose() - Matrix3d::Identity();
        const Matrix3d force = element.area / reference_area_over_length_square * along_face;
        friction_force += force;
        friction_moment += skew(element.place) * force;
    }
    const std::vector<Vector3d> directions = octahedral_nodes(subdivisions);
    const std::vector<PressureLoads> pressed = in_directions(elements, directions, pressure);
    const LoadEntryError error{
        .force = Vector3d::Constant(error_of_force / std::sqrt(3.0) * rms(pressed, &PressureLoads::force)),
        .moment =
            Vector3d::Constant(error_of_moment / std::sqrt(3.0) * rms(pressed, &PressureLoads::moment))};
    for (const double reynolds_number : tables.reynolds_numbers) {
        const double friction = blasius_friction / std::sqrt(reynolds_number);
        for (std::size_t node = 0; node < directions.size(); ++node) {
            LoadEntry entry;
            entry.force = pressed[node].force + friction * friction_force * directions[node];
            entry.moment = pressed[node].moment + friction * friction_moment * directions[node];
            tables.entries.push_back(entry);
            tables.errors.push_back(error);
        }
    }
    tables.quality = "surface";
    return tables;
}

std::vector<SurfaceElement> surface_elements(const SurfaceLoads& loads) {
    const Surface& surface = loads.surface;
    std::vector<SurfaceElement> elements(surface.triangle_count());
    for (std::size_t t = 0; t < elements.size(); ++t) {
        const Vector3d area = area_vector(surface, t);
        SurfaceElement& element = elements[t];
        element.place = triangle_centroid(surface, t);
        element.area = area.norm();
        if (!(element.area > 0.0)) continue;
        element.normal = area / element.area;
        element.surface_velocity = element.normal * element.normal.transpose() - Matrix3d::Identity();
        for (std::size_t k = 0; k < 3; ++k) {
            const auto vertex = static_cast<std::size_t>(surface.corners[t][k]);
            element.surface_velocity +=
                gradient_of_corner(surface, t, k, area) * loads.potentials[vertex].transpose();
        }
    }
    return elements;
}

double pressure_on(const SurfaceElement& element, const Vector3d& direction,
                   const SurfacePressure& pressure) {
    const double along = element.normal.dot(direction);
    const double attached =
        std::max(1.0 - (element.surface_velocity * direction).squaredNorm(), pressure.base);
    if (along >= 0.0) return attached;
    const double separated = std::min(1.0, -along / pressure.separation_sine);
    return separated * pressure.base + (1.0 - separated) * std::min(0.0, attached);
}

}  // namespace samara
