#include "samara/core/body/surface_loads.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

#include "samara/core/surface/octahedral_map.hpp"
#include "samara/core/surface/silhouette.hpp"

namespace samara {
namespace {

constexpr int subdivisions = 8;
constexpr double blasius_friction = 1.33;  // of a plate, relative to the area of each side: times Re^-1/2
// About the rms differences from CFD over the directions of eight bodies
// (docs/explanation/loads-without-a-bake.md).
constexpr double error_of_force = 0.2;
constexpr double error_of_moment = 0.3;

constexpr double laminar_wake = 100.0;  // Reynolds number

/// A Reynolds number, and the base pressure of a sphere there.
struct SmoothWake {
    double reynolds_number;
    double base;
};
// By docs/studies/surface-loads/sphere_base.py.
constexpr SmoothWake smooth_wakes[] = {{1.0, -0.106}, {3.0, -0.541}, {1e1, -0.659}, {3e1, -0.624},
                                       {1e2, -0.532}, {3e2, -0.445}, {1e3, -0.380}, {3e3, -0.372},
                                       {1e4, -0.426}, {1e5, -0.508}};

/// An element in a steady translation along one direction.
struct ElementFlow {
    double attached;  ///< the pressure of the potential flow
    double in_wake;   ///< the share of the face that is in the wake; negative where the face faces the flow
};

ElementFlow element_flow(const SurfaceElement& element, const Vector3d& direction) {
    const double attached = 1.0 - (element.surface_velocity * direction).squaredNorm();
    const double cosine = element.normal.dot(direction);
    if (cosine >= along_the_flow) return {attached, -1.0};
    const double left = 1.0 + cosine;
    const double square = left * left;
    return {attached, 1.0 - square * square * left};
}

double pressure_of(const ElementFlow& flow, const SeparatedPressure& separated) {
    if (flow.in_wake < 0.0) return std::max(flow.attached, separated.floor);
    const double beside = std::min(0.0, std::max(flow.attached, separated.base));
    return flow.in_wake * separated.base + (1.0 - flow.in_wake) * beside;
}

std::vector<ElementFlow> flows_of(const std::vector<SurfaceElement>& elements, const Vector3d& direction) {
    std::vector<ElementFlow> flows;
    flows.reserve(elements.size());
    for (const SurfaceElement& element : elements) flows.push_back(element_flow(element, direction));
    return flows;
}

PressureLoads sum_of(const std::vector<SurfaceElement>& elements, const std::vector<ElementFlow>& flows,
                     const SeparatedPressure& separated) {
    PressureLoads sum;
    for (std::size_t i = 0; i < elements.size(); ++i) {
        const Vector3d push = -elements[i].area / reference_area_over_length_square *
                              pressure_of(flows[i], separated) * elements[i].normal;
        sum.force += push;
        sum.moment += elements[i].place.cross(push);
    }
    return sum;
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

SeparatedPressure separated_pressure(const Silhouette& silhouette, const SurfacePressure& pressure) {
    const double sharp = silhouette.edge_share;
    const double base = (1.0 - sharp) * pressure.smooth_base + sharp * pressure.edge_base;
    const double recovered = sharp * pressure.recovery * silhouette.depth / (1.0 + silhouette.depth);
    return {.base = base * (1.0 - recovered),
            .floor = (1.0 - sharp) * pressure.smooth_floor + sharp * pressure.edge_floor};
}

std::vector<PressureLoads> pressure_loads(const SurfaceLoads& loads, int cut_into,
                                          const SurfacePressure& pressure) {
    const std::vector<SurfaceElement> elements = surface_elements(loads);
    const std::vector<Vector3d> directions = octahedral_nodes(cut_into);
    const std::vector<Silhouette> seen = silhouettes(loads.surface, directions);
    std::vector<PressureLoads> all;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        all.push_back(
            sum_of(elements, flows_of(elements, directions[i]), separated_pressure(seen[i], pressure)));
    }
    return all;
}

LoadTables as_tables(const SurfaceLoads& loads, double length, const SurfacePressure& pressure,
                     const SurfaceWake& wake) {
    LoadTables tables;
    tables.reference_length = length;
    tables.subdivisions = subdivisions;
    for (const SmoothWake& smooth : smooth_wakes) tables.reynolds_numbers.push_back(smooth.reynolds_number);
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
    const std::vector<Silhouette> seen = silhouettes(loads.surface, directions);
    tables.entries.resize(directions.size() * std::size(smooth_wakes));
    std::vector<PressureLoads> pressed(directions.size());
    for (std::size_t node = 0; node < directions.size(); ++node) {
        const std::vector<ElementFlow> flows = flows_of(elements, directions[node]);
        double solved_base = 0.0;
        for (std::size_t i = 0; i < std::size(smooth_wakes); ++i) {
            SurfacePressure here = pressure;
            here.smooth_base = smooth_wakes[i].base;
            const SeparatedPressure separated = separated_pressure(seen[node], here);
            if (separated.base != solved_base) pressed[node] = sum_of(elements, flows, separated);
            solved_base = separated.base;
            const double friction = blasius_friction / std::sqrt(smooth_wakes[i].reynolds_number);
            LoadEntry& entry = tables.entries[i * directions.size() + node];
            entry.force = pressed[node].force + friction * friction_force * directions[node];
            entry.moment = pressed[node].moment + friction * friction_moment * directions[node];
            entry.turbulent_kinetic_energy =
                wake.turbulent_kinetic_energy *
                std::clamp(std::log10(smooth_wakes[i].reynolds_number / laminar_wake), 0.0, 1.0);
            entry.dissipation_rate = wake.dissipation_over_energy * entry.turbulent_kinetic_energy;
        }
    }
    const LoadEntryError error{
        .force = Vector3d::Constant(error_of_force / std::sqrt(3.0) * rms(pressed, &PressureLoads::force)),
        .moment =
            Vector3d::Constant(error_of_moment / std::sqrt(3.0) * rms(pressed, &PressureLoads::moment))};
    tables.errors.assign(tables.entries.size(), error);
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
                   const SeparatedPressure& separated) {
    return pressure_of(element_flow(element, direction), separated);
}

}  // namespace samara
