#include "samara/core/dynamics/steady_patches.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/body/surface_loads.hpp"
#include "samara/core/surface/octahedral_map.hpp"
#include "samara/core/surface/silhouette.hpp"
#include "samara/core/surface/surface_patches.hpp"

namespace samara {
namespace {

// The least share of its drag that a patch keeps, so that no patch is pushed along its path.
constexpr double least_drag = 0.1;

Vector3d area_of(const PatchFace& face) {
    return 0.5 * (face.corners[1] - face.corners[0]).cross(face.corners[2] - face.corners[0]);
}

/// The distances of faces from a place, and their resistance to a rotation about it.
struct Spread {
    double square = 0.0;                   ///< m^4: the integral of the squared distance over the area
    Matrix3d rotation = Matrix3d::Zero();  ///< the integral of (x cross n)(x cross n)^T
};

void add(const PatchFace& face, const Vector3d& center, Spread& spread) {
    const Vector3d area = area_of(face);
    const double size = area.norm();
    if (!(size > 0.0)) return;
    // The middles of the edges integrate a quadratic function exactly.
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector3d place = 0.5 * (face.corners[i] + face.corners[(i + 1) % 3]) - center;
        const Vector3d arm = place.cross(area / size);
        spread.square += size / 3.0 * place.squaredNorm();
        spread.rotation += size / 3.0 * arm * arm.transpose();
    }
}

/// Returns m^power of a positive semidefinite matrix m. Eigenvalues below a given share of the largest are
/// raised to it.
Matrix3d power_of(const Matrix3d& m, double power) {
    constexpr double least = 1e-9;
    const PrincipalValues principal = principal_values(m);
    const double floor = least * principal.values.maxCoeff();
    const Vector3d powers = principal.values.cwiseMax(floor).array().pow(power);
    return principal.directions * powers.asDiagonal() * principal.directions.transpose();
}

void set_what_is_left(const std::vector<SurfacePatch>& cut, DividedSurface& divided) {
    Vector3d middle = Vector3d::Zero();  // the middle of the surface, from the centroid of the volume
    double area = 0.0;
    for (const SurfacePatch& patch : cut) {
        for (const PatchFace& face : patch.faces) {
            const double size = area_of(face).norm();
            area += size;
            middle += size / 3.0 * (face.corners[0] + face.corners[1] + face.corners[2]);
        }
    }
    middle /= area;
    Spread about_middle;
    Spread about_centroid;
    Spread within;
    for (const SurfacePatch& patch : cut) {
        for (const PatchFace& face : patch.faces) {
            add(face, middle, about_middle);
            add(face, Vector3d::Zero(), about_centroid);
            add(face, middle + patch.place, within);
        }
    }
    divided.reach_within = std::sqrt(within.square / about_middle.square);
    divided.rotation_within = power_of(within.rotation, 0.5) * power_of(about_centroid.rotation, -0.5);
}

/// Returns the pressure's force on each patch in a steady translation along the direction, in units of rho
/// U^2 A / 2.
std::vector<Vector3d> pushes(const std::vector<SurfacePatch>& cut,
                             const std::vector<SurfaceElement>& elements, const Vector3d& direction,
                             const Silhouette& silhouette) {
    const SeparatedPressure separated = separated_pressure(silhouette);
    std::vector<double> pressures;
    pressures.reserve(elements.size());
    for (const SurfaceElement& element : elements) {
        pressures.push_back(pressure_on(element, direction, separated));
    }
    std::vector<Vector3d> forces(cut.size(), Vector3d::Zero());
    for (std::size_t i = 0; i < cut.size(); ++i) {
        for (const PatchFace& face : cut[i].faces) forces[i] -= pressures[face.triangle] * area_of(face);
        forces[i] /= reference_area_over_length_square;
    }
    return forces;
}

/// Returns the differences of the patches' forces from their shares of the whole, which add up to zero, as
/// far as each patch keeps a drag at all Reynolds numbers. `drag`: the whole's least, along the direction.
std::vector<Vector3d> departures(const std::vector<SteadyPatch>& patches, std::vector<Vector3d> forces,
                                 const Vector3d& direction, double drag) {
    Vector3d whole = Vector3d::Zero();
    for (const Vector3d& force : forces) whole += force;
    double kept = 1.0;
    for (std::size_t i = 0; i < patches.size(); ++i) {
        forces[i] -= patches[i].share * whole;
        const double most = (1.0 - least_drag) * patches[i].share * std::max(0.0, drag);
        const double thrust = forces[i].dot(direction);
        if (thrust > most) kept = std::min(kept, most / thrust);
    }
    for (Vector3d& force : forces) force *= kept;
    return forces;
}

void set_forces(const std::vector<SurfacePatch>& cut, const SurfaceLoads& loads, const LoadTables& tables,
                std::vector<SteadyPatch>& patches) {
    const std::vector<SurfaceElement> elements = surface_elements(loads);
    std::vector<Vector3d> directions;
    for (const Vector3d& node : octahedral_nodes(tables.subdivisions))
        directions.push_back(tables.axes * node);
    const std::vector<Silhouette> seen = silhouettes(loads.surface, directions);
    for (SteadyPatch& patch : patches) patch.force.resize(tables.entries.size());
    for (std::size_t node = 0; node < directions.size(); ++node) {
        const Vector3d& direction = directions[node];
        double drag = -tables.entries[node].force.dot(direction);
        for (std::size_t at = node; at < tables.entries.size(); at += directions.size()) {
            drag = std::min(drag, -tables.entries[at].force.dot(direction));
        }
        const std::vector<Vector3d> departing =
            departures(patches, pushes(cut, elements, direction, seen[node]), direction, drag);
        for (std::size_t at = node; at < tables.entries.size(); at += directions.size()) {
            for (std::size_t i = 0; i < patches.size(); ++i) {
                patches[i].force[at] = patches[i].share * tables.entries[at].force + departing[i];
            }
        }
    }
}

/// Returns the body's surface in units of L about the centroid of the volume.
Surface about_centroid(const Body& body) {
    const double length = reference_length(body.moments.surface_area);
    Surface surface = body.surface;
    for (Vector3d& vertex : surface.vertices) vertex = (vertex - body.moments.centroid) / length;
    return surface;
}

std::vector<SurfacePatch> cut_surface(const Body& body, int count) {
    return surface_patches(body.surface_loads ? body.surface_loads->surface : about_centroid(body), count);
}

/// Returns the patches without forces of their own.
DividedSurface divided_by(const std::vector<SurfacePatch>& cut, const Body& body) {
    const double length = reference_length(body.moments.surface_area);
    DividedSurface divided;
    divided.patches.reserve(cut.size());
    for (const SurfacePatch& patch : cut) divided.patches.push_back({length * patch.place, patch.share, {}});
    set_what_is_left(cut, divided);
    return divided;
}

}  // namespace

DividedSurface divided_surface(const Body& body, int count) {
    return divided_by(cut_surface(body, count), body);
}

DividedSurface divided_surface(const Body& body, const LoadTables& tables, int count) {
    const std::vector<SurfacePatch> cut = cut_surface(body, count);
    DividedSurface divided = divided_by(cut, body);
    if (body.surface_loads) set_forces(cut, *body.surface_loads, tables, divided.patches);
    return divided;
}

Matrix3d within_patches(const Matrix3d& rotational_drag, const DividedSurface& divided) {
    return divided.rotation_within * rotational_drag * divided.rotation_within.transpose();
}

DynamicCoefficients within_patches(DynamicCoefficients coefficients, const DividedSurface& divided) {
    coefficients.rotational_drag = within_patches(coefficients.rotational_drag, divided);
    coefficients.rotational_drag_in_spin = within_patches(coefficients.rotational_drag_in_spin, divided);
    coefficients.half_length *= divided.reach_within;
    return coefficients;
}

}  // namespace samara
